"""Results for people, on pages and in the terminal."""
