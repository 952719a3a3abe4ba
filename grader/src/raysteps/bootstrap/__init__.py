"""Before the first command: what a machine lacks, and the Python part's own folder."""
