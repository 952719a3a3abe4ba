"""Where hidden cases that went wrong are kept, below the folder of results.json."""

import re

FOLDER = "cases"


def place_of(number: str, function: str) -> str:
    """One file for each function of a step."""
    name = re.sub(r"[^a-z0-9]+", "-", function.lower()).strip("-")
    return f"{FOLDER}/{number}-{name}.json"
