"""Submissions ranked by counted work."""
