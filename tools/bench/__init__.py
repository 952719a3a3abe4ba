"""Benchmarks: what the reference costs, beside other programs, and how it grows."""
