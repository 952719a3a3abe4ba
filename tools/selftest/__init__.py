"""The command `test`: everything that shows the kit works."""
