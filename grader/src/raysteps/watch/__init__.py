"""A step is built, tested and drawn again with every save."""
