"""What several measurements of the same thing say."""

import statistics
from collections.abc import Sequence
from typing import Any


def spread_of(values: Sequence[float]) -> dict[str, Any]:
    """As raysteps-bench writes it: median, extremes, quartiles and every value."""
    ordered = sorted(values)
    quartiles = statistics.quantiles(ordered, n=4, method="inclusive") if len(ordered) > 1 else ordered * 3
    return {
        "median": statistics.median(ordered),
        "min": ordered[0],
        "max": ordered[-1],
        "q1": quartiles[0],
        "q3": quartiles[2],
        "rounds": list(values),
    }
