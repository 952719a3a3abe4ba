"""Models from elsewhere, made into scenes that this kit draws."""
