"""The page of the finale: the large picture, the way to it step by step, the work, and what comes next."""

from collections.abc import Sequence
from dataclasses import dataclass

from raysteps.common.text import join_and, mean
from raysteps.course.manifest import Step
from raysteps.finale.own_pictures import Counted, LargePicture
from raysteps.images.compare import Pixels
from raysteps.report.page import PictureData, pixel_data, render_page


@dataclass(frozen=True)
class Station:
    """A step on the way: its picture, or a word why there is none."""

    step: Step
    pixels: Pixels | None
    note: str = ""


@dataclass(frozen=True)
class Finale:
    """All that the page shows. No date and no clock: the same steps give the same page."""

    title: str
    name: str
    words: str  # of how the picture came about
    large: LargePicture
    stations: Sequence[Station]
    counted: Sequence[Counted]
    command: str  # ./raysteps, as it is typed here


@dataclass(frozen=True)
class _Bar:
    name: str
    surfaces: str
    boxes: str
    share: float  # of 100, of the longest bar
    spared: str


def _bars(counted: Sequence[Counted]) -> list[_Bar]:
    most = max((one.work.tests_per_ray for one in counted), default=0.0) or 1.0
    bars = []
    for one in counted:
        share = one.work.tests_per_ray / most
        spared = "" if one is counted[0] else f"{100 * (1 - share):.1f} %"
        surfaces, boxes = mean(one.work.surfaces_per_ray), mean(one.work.boxes_per_ray)
        bars.append(_Bar(one.name, surfaces, boxes, round(100 * share, 2), spared))
    return bars


def in_words(amount: int) -> str:
    """`8.17 billion`, `31.2 million`, `640 thousand`, `12`."""
    for unit, word in ((1_000_000_000, "billion"), (1_000_000, "million"), (1_000, "thousand")):
        if amount >= unit:
            return f"{amount / unit:.3g} {word}"
    return str(amount)


def finale_page(finale: Finale) -> str:
    """The document."""
    stations = [
        {
            "number": station.step.number,
            "title": station.step.title,
            "bonus": station.step.bonus,
            "new": station.step.about,
            "picture": None if station.pixels is None else pixel_data(station.pixels),
            "note": station.note,
        }
        for station in finale.stations
    ]
    picture: PictureData = pixel_data(finale.large.pixels)
    secondary = [f"{in_words(amount)} {name}" for name, amount in finale.large.secondary.items() if amount]
    work = finale.large.work
    context = {
        "finale": finale,
        "picture": picture,
        "secondary": join_and(secondary) if secondary else "",
        "stations": stations,
        "bars": _bars(finale.counted),
        "rays": in_words(work.rays),
        "tests": in_words(work.surface_tests + work.box_tests),
    }
    return render_page("finale", finale.title, context, styles=("finale",))
