"""Which known mistake, turn or recolouring explains what is wrong."""
