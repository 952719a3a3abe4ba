"""Builds, checks and grades the steps of the course."""
