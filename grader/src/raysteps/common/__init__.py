"""What every part of the grader uses."""
