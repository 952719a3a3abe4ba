"""What only a students' kit has: its commands, and how it takes in a newer release."""
