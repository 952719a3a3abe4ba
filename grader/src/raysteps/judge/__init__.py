"""Asks a student's functions questions and knows the answers."""
