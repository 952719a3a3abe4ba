"""A page on which a person walks through the steps in pictures."""
