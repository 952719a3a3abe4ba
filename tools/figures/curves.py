"""Plots of formulas: how a highlight falls off, and how light becomes brightness."""

import math

from tools.bench.charts import Axis, Chart, Series, svg_text

_WIDE = 560.0


def tone() -> str:
    """c / (c + 1) beside cutting off."""
    light = [i / 20 for i in range(101)]
    series = [
        Series("cut off at 1", [(c, min(c, 1.0)) for c in light], marked=False),
        Series("c / (c + 1)", [(c, c / (c + 1)) for c in light], marked=False),
    ]
    x, y = Axis("light c of one channel", 0.0, 5.0), Axis("what is shown, 1 is white", 0.0, 1.0)
    words = (
        "Cutting off is a straight line up to 1 and flat from there on, so 2 and 5 look the same. c / (c + 1) "
        "begins as steep, bends, is 0.5 at 1 and 0.83 at 5, and never reaches 1."
    )
    return svg_text([Chart("from light to brightness", x, y, series)], width=_WIDE, description=words, plate=True)


def highlight() -> str:
    """The cosine to the power of shine."""
    series = []
    for shine in (1, 10, 50, 200):
        points = [(float(degrees), math.cos(math.radians(degrees)) ** shine) for degrees in range(91)]
        series.append(Series(f"shine {shine}", points, marked=False))
    x, y = Axis("angle between r and v, in degrees", 0.0, 90.0), Axis("share of ks", 0.0, 1.0)
    words = "All curves begin at 1 and fall to 0; with shine 1 slowly, at 90 degrees, with shine 200 within 15 degrees."
    return svg_text([Chart("the width of a highlight", x, y, series)], width=_WIDE, description=words, plate=True)
