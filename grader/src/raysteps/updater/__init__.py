"""A students' kit takes in a newer release."""
