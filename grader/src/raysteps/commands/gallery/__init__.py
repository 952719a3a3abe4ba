"""The command `gallery`: a page on which a person walks through the steps."""
