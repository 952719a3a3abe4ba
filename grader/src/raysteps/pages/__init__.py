"""Pages that open from a disk, in any browser, without a network. They know nothing of grading."""
