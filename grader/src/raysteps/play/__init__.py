"""The page to work in: a compiler, an editor and the steps in a browser."""
