"""Pictures that are right but for what happened to them as a whole."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations

import numpy as np
import numpy.typing as npt

from raysteps.diagnosis.evidence import Picture, differing
from raysteps.images.compare import Pixels, commonest_color
from raysteps.results.model import Diagnosis

Levels = npt.NDArray[np.floating]

_MAX_LEFT = 0.02  # of the pixels may still be wrong
_MAX_OF_WRONG = 0.1  # of the pixels that were wrong may still be
_FEWEST = 0.01  # of the pixels must be wrong for a change of colours
_GAMMA = 2.2
_FACTORS = (0.05, 20.0)
_LEAST_FACTOR = 0.03  # off 1
_DARK, _BRIGHT = 24, 250  # levels between which a factor can be measured


@dataclass(frozen=True)
class TransformedPicture:
    """The reference's picture after something happened to it. `tolerance`: levels by which rounding may be off."""

    id: str
    pixels: Pixels
    tolerance: int = 2
    everywhere: bool = True  # or only where the student's picture is wrong
    detail: str = ""


def _levels(values: Levels) -> Pixels:
    pixels: Pixels = np.clip(np.rint(values), 0, 255).astype(np.uint8)
    return pixels


def _turned(picture: Picture) -> Iterator[TransformedPicture]:
    reference = picture.reference
    yield TransformedPicture("upside-down", reference[::-1])
    yield TransformedPicture("mirrored", reference[:, ::-1])
    yield TransformedPicture("half-turn", reference[::-1, ::-1])
    if reference.shape[0] == reference.shape[1]:
        yield TransformedPicture("transposed", reference.transpose(1, 0, 2))


def _shifted(picture: Picture) -> Iterator[TransformedPicture]:
    """By a whole pixel, and by half a one; the border, of which nothing is known, is taken from the student's."""
    reference = picture.reference.astype(np.float64)
    for name, down, across in (("x", 0, 1), ("x", 0, -1), ("y", 1, 0), ("y", -1, 0), ("xy", 1, 1), ("xy", -1, -1)):
        moved = np.roll(reference, (down, across), axis=(0, 1))
        for title, values, tolerance in (("one", moved, 2), ("half", _half(reference, down, across), 1)):
            whole = _levels(values)
            for border in ((0, ...), (-1, ...), (slice(None), 0), (slice(None), -1)):
                whole[border] = picture.mine[border]
            yield TransformedPicture(f"shifted-by-{title}", whole, tolerance, detail=name)


def _half(reference: Levels, down: int, across: int) -> Levels:
    once = (reference + np.roll(reference, down, axis=0)) / 2 if down else reference
    return (once + np.roll(once, across, axis=1)) / 2 if across else once


def _recoloured(picture: Picture) -> Iterator[TransformedPicture]:
    reference = picture.reference
    yield TransformedPicture("negative", 255 - reference, everywhere=False)
    for order in permutations(range(3)):
        if order != (0, 1, 2):
            name = "red-and-blue-swapped" if order == (2, 1, 0) else "channels-permuted"
            letters = "".join("RGB"[channel] for channel in order)
            yield TransformedPicture(name, reference[..., list(order)], everywhere=False, detail=letters)
    share = reference.astype(np.float64) / 255
    yield TransformedPicture("gamma-applied", _levels(255 * share ** (1 / _GAMMA)), 4, everywhere=False)
    yield TransformedPicture("gamma-applied", _levels(255 * np.sqrt(share)), 4, everywhere=False)
    yield TransformedPicture("gamma-removed", _levels(255 * share**_GAMMA), 3, everywhere=False)
    yield TransformedPicture("gamma-removed", _levels(255 * share**2), 3, everywhere=False)
    grey: Levels = np.repeat(share @ np.array([[0.2126], [0.7152], [0.0722]]), 3, axis=2)
    yield TransformedPicture("grey", _levels(255 * grey), 3, everywhere=False)
    yield TransformedPicture(
        "grey", _levels(255 * share.mean(axis=2, keepdims=True).repeat(3, axis=2)), 3, everywhere=False
    )


def _scaled(picture: Picture) -> Iterator[TransformedPicture]:
    """By the factor that most of the wrong pixels agree on."""
    mine, reference = picture.mine[picture.wrong], picture.reference[picture.wrong]
    usable = (reference >= _DARK) & (mine >= _DARK // 2) & (mine <= _BRIGHT) & (reference <= _BRIGHT)
    if usable.sum() < _FEWEST * picture.reference.size:
        return
    factor = float(np.median(mine[usable] / reference[usable].astype(np.float64)))
    if _FACTORS[0] <= factor <= _FACTORS[1] and abs(factor - 1) >= _LEAST_FACTOR:
        name = "too-bright" if factor > 1 else "too-dark"
        whole = _levels(picture.reference * factor)
        yield TransformedPicture(name, whole, 2 + int(np.ceil(factor)), everywhere=False, detail=f"{factor:.2g}")


_ALL: tuple[Callable[[Picture], Iterator[TransformedPicture]], ...] = (_turned, _shifted, _recoloured, _scaled)


def _left(picture: Picture, changed: TransformedPicture) -> float | None:
    """The share of the picture that the change leaves wrong, or none where it explains too little."""
    off = differing(picture.mine, changed.pixels, changed.tolerance)
    if not changed.everywhere:
        if picture.wrong.mean() < _FEWEST or not _touches_the_whole(picture, changed):
            return None
        off &= picture.wrong
    share, before = float(off.mean()), float(picture.wrong.mean())
    return share if share <= min(_MAX_LEFT, _MAX_OF_WRONG * before) else None


def _touches_the_whole(picture: Picture, changed: TransformedPicture) -> bool:
    """A change of colours must have reached most of what it would change: else only some object has another colour.
    What is as in the reference may be the background, which no function of the step touches: it has one colour."""
    would = differing(changed.pixels, picture.reference, 2 * changed.tolerance)
    color = commonest_color(picture.reference)
    background = ~differing(picture.reference, np.broadcast_to(color, picture.reference.shape))
    concerned = would & (~background | picture.wrong)
    return bool(concerned.any()) and float((concerned & picture.wrong).sum() / concerned.sum()) >= 1 - _MAX_OF_WRONG


def transformation_of(picture: Picture, more: Mapping[str, Pixels]) -> TransformedPicture | None:
    """The change that explains the picture best. `more`: pictures that it may be taken for, by what that means."""
    found = [TransformedPicture(name, pixels) for name, pixels in more.items() if pixels.shape == picture.mine.shape]
    found += [changed for make in _ALL for changed in make(picture)]
    left = [(share, changed) for changed in found if (share := _left(picture, changed)) is not None]
    return min(left, key=lambda pair: pair[0])[1] if left else None


# What is said of a picture to which something happened.


@dataclass(frozen=True)
class TransformWords:
    """`{}` stands for the detail."""

    title: str
    sees: str
    cause: str
    hint: str


_TABLE: Mapping[str, TransformWords] = {
    "upside-down": TransformWords(
        "the picture is upside down",
        "The picture is the right one, but its upper and lower edge have changed places.",
        "Rows were counted from the bottom, or a vertical axis points the other way.",
        "Row 0 is the uppermost row of a picture. Which way must it look from the middle?",
    ),
    "mirrored": TransformWords(
        "left and right are swapped",
        "The picture is the right one, seen in a mirror.",
        "A horizontal axis points the other way: the factors of a cross product changed places, or x lost its sign.",
        "Column 0 is the leftmost column. Check with your right hand where the axis must point.",
    ),
    "half-turn": TransformWords(
        "the picture is turned by 180 degrees",
        "The picture is the right one, turned on its head: left and right and up and down are swapped.",
        "Both axes of the picture point the other way.",
        "What would make both axes turn round at once?",
    ),
    "transposed": TransformWords(
        "rows and columns are swapped",
        "The picture is the right one, folded over its diagonal.",
        "x was used where y belongs, and the other way round.",
        "Which of the two goes with the width?",
    ),
    "shifted-by-one": TransformWords(
        "the picture is moved by one pixel",
        "Everything is in its place but for one pixel.",
        "Pixels were counted from 1, or an edge of the picture was taken for its neighbour.",
        "What is the number of the first pixel, and of the last?",
    ),
    "shifted-by-half": TransformWords(
        "the picture is moved by half a pixel",
        "The colours are a little off everywhere, by half of what lies between two pixels.",
        "The rays go through corners or edges of pixels rather than through their centres.",
        "Where in a pixel does its ray go through?",
    ),
    "negative": TransformWords(
        "the colours are inverted",
        "Bright is dark, and every colour is the opposite one.",
        "A colour was subtracted from white.",
        "Follow one colour through your code: where does it get turned round?",
    ),
    "normals-reversed": TransformWords(
        "all normals point the other way",
        "Every colour is the opposite one: the picture shows directions, and all of them are turned round.",
        "A normal has the wrong sign.",
        "Towards which side of the surface does the normal in the record point?",
    ),
    "red-and-blue-swapped": TransformWords(
        "red and blue are swapped",
        "The colours are right but for red, which is blue, and blue, which is red.",
        "The channels were read or written in the order blue, green, red.",
        "Which of the three numbers of a colour comes first?",
    ),
    "channels-permuted": TransformWords(
        "the colour channels are in another order ({} rather than RGB)",
        "Shapes and light are right, the colours are not.",
        "The three numbers of a colour or of a vector changed places.",
        "Which of the three numbers comes first, second and third?",
    ),
    "axes-exchanged": TransformWords(
        "the numbers x, y and z of the vectors are in another order",
        "The picture shows directions as colours, x as red, y as green, z as blue. Its colours changed places.",
        "Two components of a vector were exchanged.",
        "Which of the three numbers of the vector comes first, second and third?",
    ),
    "grey": TransformWords(
        "the colours are lost",
        "The light is right, but everything is grey.",
        "One number was used for all three channels.",
        "What is done for red must be done for green and blue with their own numbers.",
    ),
    "gamma-applied": TransformWords(
        "the levels are gamma-encoded",
        "Dark parts are much too bright, black and white are right.",
        "A power or a square root was applied to the colours before they became bytes.",
        "The handout maps colours to bytes in a straight line. Is there a step too many?",
    ),
    "gamma-removed": TransformWords(
        "the levels are squared or raised to a power",
        "Dark parts are much too dark, black and white are right.",
        "A power was applied to the colours, or a product was taken twice.",
        "Is there a factor that is multiplied in twice?",
    ),
    "too-bright": TransformWords(
        "everything is {} times as bright as it should be",
        "Shapes and colours are right, but the whole picture is too bright.",
        "A factor is missing or was applied too often, or something was added up more than once.",
        "Where does a number of that size come from, and where should it be multiplied in?",
    ),
    "too-dark": TransformWords(
        "everything is only {} times as bright as it should be",
        "Shapes and colours are right, but the whole picture is too dark.",
        "A factor was multiplied in that does not belong there, or only a part of the light was added up.",
        "Compare one pixel by hand: which number is too small?",
    ),
    "plain-colours": TransformWords(
        "the surfaces show their plain colour, whatever the light",
        "The picture is flat: no side of a thing is darker than another.",
        "The colour of the fill was returned as it is.",
        "On which two directions does the light depend that a surface sends to the eye?",
    ),
    "no-shadows": TransformWords(
        "nothing lies in shadow",
        "The picture is that of step 03: the light goes through everything.",
        "No blocker is ever found, or what is found is not asked for.",
        "Try one point of which you know that it lies in shadow. What does its shadow ray meet, and at which distance?",
    ),
    "no-mirrors": TransformWords(
        "nothing is mirrored",
        "The picture is that of step 04: the mirrors show only their own colour.",
        "The bounced ray is never cast, or what it brings is thrown away.",
        "Follow one ray that meets a mirror. When does it bounce, and where does the colour that it finds go?",
    ),
    "clamped": TransformWords(
        "the colours are cut off at 1 rather than mapped",
        "The picture is that of step 06: bright parts are white and have lost their details.",
        "The tone map returns its colour as it is, or only limits it.",
        "What becomes of two colours that are both above 1?",
    ),
    "no-glass": TransformWords(
        "glass lets nothing through",
        "The picture is that of step 07: what is of glass shows only its own light.",
        "The transmitted ray is never cast, or not where it leaves the glass again, or what it brings is thrown away.",
        "Follow one ray that meets glass. When does it go on, and where does the colour that it finds go?",
    ),
}

# What the picture of an earlier step means where it comes out of a later one.
BEFORE: Mapping[int, tuple[str, int]] = {
    3: ("plain-colours", 2),
    4: ("no-shadows", 3),
    5: ("no-mirrors", 4),
    7: ("clamped", 6),
    8: ("no-glass", 7),
}


def in_words(name: str, detail: str, seen_in: Sequence[str]) -> Diagnosis:
    words = _TABLE[name]
    title = words.title.format(detail)
    return Diagnosis("transformation", name, title, words.sees, words.cause, words.hint, list(seen_in))
