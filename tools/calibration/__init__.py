"""Where the limits of the pictures belong, and whether every correct solution stays within them."""
