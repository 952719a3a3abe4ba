"""The finish worth showing: a large smooth picture by the student's own program, a page about the way, a poster."""
