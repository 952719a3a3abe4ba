"""Where a student stands in the course: checks, hints, the next step, and a fresh start."""
