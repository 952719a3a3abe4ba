"""What the makers of the kit type; no part of the package that students and autograders install."""
