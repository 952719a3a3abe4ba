"""Looks for solutions where none may be."""
