"""The kinds of cases of every step, one module each."""
