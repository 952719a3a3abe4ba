"""The command `dev new`: a step of an instructor's own, as a small one that works."""
