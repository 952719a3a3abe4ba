"""Runs what cannot be trusted."""
