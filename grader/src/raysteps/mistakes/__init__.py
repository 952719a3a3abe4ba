"""The catalogue of known mistakes, and other correct ways to write a step."""
