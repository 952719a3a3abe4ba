"""The life of one pixel, and where it parts from the reference's."""
