"""Shows that grades are true: whatever is handed in loses points where it is wrong, and nowhere else."""
