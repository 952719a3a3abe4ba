"""Where a student stands in the course: the steps, the next one, hints, and beginning again."""
