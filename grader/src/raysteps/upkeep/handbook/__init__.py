"""The pages of docs/mistakes/: every known mistake with its picture, made from the catalogue."""
