"""Takes a student's work in."""
