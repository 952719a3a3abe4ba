"""What came of a grading, in memory and as results.json."""
