"""A student's programs: built, limited, run, and the pictures they make."""
