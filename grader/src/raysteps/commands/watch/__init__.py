"""The command `watch`: a step is built, tested and drawn again with every save."""
