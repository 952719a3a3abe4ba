"""What the makers of the kit type."""
