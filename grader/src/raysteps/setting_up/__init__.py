"""Before the first command: what a machine lacks, and the Python part's own room. Needs nothing but Python itself."""
