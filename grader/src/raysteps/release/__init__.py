"""Makes the repository that students get."""
