"""A release as students have it: the list of its files, and how a newer one is taken in."""
