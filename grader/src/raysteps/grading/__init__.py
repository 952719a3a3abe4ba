"""Runs, compares and scores one submission."""
