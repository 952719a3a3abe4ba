"""What the finale leaves behind: a page with the large picture, the way to it step by step, the work and what comes
next; and a poster."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from raysteps.common.text import join_and, mean
from raysteps.course.manifest import Step
from raysteps.finale.own_pictures import CountedPicture, LargePicture
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
    counted: Sequence[CountedPicture]
    command: str  # ./raysteps, as it is typed here


@dataclass(frozen=True)
class _Bar:
    name: str
    surfaces: str
    boxes: str
    share: float  # of 100, of the longest bar
    spared: str


def _bars(counted: Sequence[CountedPicture]) -> list[_Bar]:
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


# The poster: the picture in a frame, with a title and a name. It holds no date, so that the same picture gives the same
# poster.

_PAPER, _LINE, _INK, _FAINT = (16, 18, 21), (58, 63, 71), (236, 233, 227), (163, 169, 176)
_BORDER = 0.1  # of the picture's width, at the left, the right and the top
_FOOT = 0.165  # below it
# Pillow brings letters for English. Where a name needs others, a font of the system is taken that has them all.
_SYSTEM_FONTS = (
    "DejaVuSans.ttf",
    "NotoSans-Regular.ttf",
    "LiberationSans-Regular.ttf",
    "segoeui.ttf",
    "Arial Unicode.ttf",
    "arial.ttf",
    "NotoSansCJK-Regular.ttc",
    "msyh.ttc",
    "PingFang.ttc",
)
_NO_LETTER = "\uffff"
Font = ImageFont.FreeTypeFont | ImageFont.ImageFont


@cache
def _font(name: str | None, size: int) -> Font | None:
    try:
        return ImageFont.load_default(size) if name is None else ImageFont.truetype(name, size)
    except OSError:
        return None


def _has(font: Font, text: str) -> bool:
    box = bytes(font.getmask(_NO_LETTER))
    return all(letter.isspace() or bytes(font.getmask(letter)) != box for letter in text)


def _font_for(text: str, size: int) -> Font | None:
    fonts = (_font(name, size) for name in (None, *_SYSTEM_FONTS))
    return next((font for font in fonts if font is not None and _has(font, text)), None)


def has_glyphs(text: str) -> bool:
    """Whether some font here has all its letters."""
    return _font_for(text, 20) is not None


def _write(pen: ImageDraw.ImageDraw, text: str, middle: float, top: float, size: float, color: tuple[int, ...]) -> None:
    """Centred, smaller where it would be wider than the paper; nothing where no font has its letters."""
    whole = 2 * middle * (1 - _BORDER)
    font = _font_for(text, max(6, round(size)))
    if font is None or not text:
        return
    if font.getlength(text) > whole:
        font = _font_for(text, max(1, int(size * whole / font.getlength(text)))) or font
    pen.text((middle - font.getlength(text) / 2, top), text, color, font)


def poster(picture: Pixels, title: str, name: str, small: str) -> Pixels:
    """The picture keeps its pixels, and the rest is as large as suits it."""
    height, width = picture.shape[:2]
    border, foot = round(_BORDER * width), round(_FOOT * width)
    paper = Image.new("RGB", (width + 2 * border, height + border + foot), _PAPER)
    pen = ImageDraw.Draw(paper)
    edge = max(1, width // 800)
    pen.rectangle(
        (border - 4 * edge, border - 4 * edge, border + width + 4 * edge - 1, border + height + 4 * edge - 1),
        outline=_LINE,
        width=edge,
    )
    paper.paste(Image.fromarray(picture), (border, border))
    below, middle = border + height, paper.width / 2
    _write(pen, title, middle, below + 0.028 * width, 0.036 * width, _INK)
    _write(pen, name, middle, below + 0.079 * width, 0.021 * width, _INK)
    _write(pen, small, middle, below + 0.116 * width, 0.0125 * width, _FAINT)
    return np.asarray(paper)
