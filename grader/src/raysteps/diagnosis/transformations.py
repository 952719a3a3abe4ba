"""Pictures that are right but for what happened to them as a whole."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import permutations

import numpy as np
import numpy.typing as npt

from raysteps.diagnosis.evidence import Picture, differing
from raysteps.programs.pictures import Pixels

Levels = npt.NDArray[np.floating]

_MOST_LEFT = 0.02  # of the pixels may still be wrong
_MOST_OF_WRONG = 0.1  # of the pixels that were wrong may still be
_FEWEST = 0.01  # of the pixels must be wrong for a change of colours
_GAMMA = 2.2
_FACTORS = (0.05, 20.0)
_LEAST_FACTOR = 0.03  # off 1
_DARK, _BRIGHT = 24, 250  # levels between which a factor can be measured


@dataclass(frozen=True)
class Changed:
    """The reference's picture after something happened to it. `tolerance`: levels by which rounding may be off."""

    id: str
    pixels: Pixels
    tolerance: int = 2
    everywhere: bool = True  # or only where the student's picture is wrong
    detail: str = ""


def _levels(values: Levels) -> Pixels:
    pixels: Pixels = np.clip(np.rint(values), 0, 255).astype(np.uint8)
    return pixels


def _turned(picture: Picture) -> Iterator[Changed]:
    reference = picture.reference
    yield Changed("upside-down", reference[::-1])
    yield Changed("mirrored", reference[:, ::-1])
    yield Changed("half-turn", reference[::-1, ::-1])
    if reference.shape[0] == reference.shape[1]:
        yield Changed("transposed", reference.transpose(1, 0, 2))


def _shifted(picture: Picture) -> Iterator[Changed]:
    """By a whole pixel, and by half a one; the border, of which nothing is known, is taken from the student's."""
    reference = picture.reference.astype(np.float64)
    for name, down, across in (("x", 0, 1), ("x", 0, -1), ("y", 1, 0), ("y", -1, 0), ("xy", 1, 1), ("xy", -1, -1)):
        moved = np.roll(reference, (down, across), axis=(0, 1))
        for title, values, tolerance in (("one", moved, 2), ("half", _half(reference, down, across), 3)):
            whole = _levels(values)
            for border in ((0, ...), (-1, ...), (slice(None), 0), (slice(None), -1)):
                whole[border] = picture.mine[border]
            yield Changed(f"shifted-by-{title}", whole, tolerance, detail=name)


def _half(reference: Levels, down: int, across: int) -> Levels:
    once = (reference + np.roll(reference, down, axis=0)) / 2 if down else reference
    return (once + np.roll(once, across, axis=1)) / 2 if across else once


def _recoloured(picture: Picture) -> Iterator[Changed]:
    reference = picture.reference
    yield Changed("negative", 255 - reference, everywhere=False)
    for order in permutations(range(3)):
        if order != (0, 1, 2):
            name = "red-and-blue-swapped" if order == (2, 1, 0) else "channels-permuted"
            letters = "".join("RGB"[channel] for channel in order)
            yield Changed(name, reference[..., list(order)], everywhere=False, detail=letters)
    share = reference.astype(np.float64) / 255
    yield Changed("gamma-applied", _levels(255 * share ** (1 / _GAMMA)), 4, everywhere=False)
    yield Changed("gamma-applied", _levels(255 * np.sqrt(share)), 4, everywhere=False)
    yield Changed("gamma-removed", _levels(255 * share**_GAMMA), 3, everywhere=False)
    yield Changed("gamma-removed", _levels(255 * share**2), 3, everywhere=False)
    grey: Levels = np.repeat(share @ np.array([[0.2126], [0.7152], [0.0722]]), 3, axis=2)
    yield Changed("grey", _levels(255 * grey), 3, everywhere=False)
    yield Changed("grey", _levels(255 * share.mean(axis=2, keepdims=True).repeat(3, axis=2)), 3, everywhere=False)


def _scaled(picture: Picture) -> Iterator[Changed]:
    """By the factor that most of the wrong pixels agree on."""
    mine, reference = picture.mine[picture.wrong], picture.reference[picture.wrong]
    usable = (reference >= _DARK) & (mine >= _DARK // 2) & (mine <= _BRIGHT) & (reference <= _BRIGHT)
    if usable.sum() < _FEWEST * picture.reference.size:
        return
    factor = float(np.median(mine[usable] / reference[usable].astype(np.float64)))
    if _FACTORS[0] <= factor <= _FACTORS[1] and abs(factor - 1) >= _LEAST_FACTOR:
        name = "too-bright" if factor > 1 else "too-dark"
        whole = _levels(picture.reference * factor)
        yield Changed(name, whole, 2 + int(np.ceil(factor)), everywhere=False, detail=f"{factor:.2g}")


_ALL: tuple[Callable[[Picture], Iterator[Changed]], ...] = (_turned, _shifted, _recoloured, _scaled)


def _left(picture: Picture, changed: Changed) -> float | None:
    """The share of the picture that the change leaves wrong, or none where it explains too little."""
    off = differing(picture.mine, changed.pixels, changed.tolerance)
    if not changed.everywhere:
        if picture.wrong.mean() < _FEWEST or not _touches_the_whole(picture, changed):
            return None
        off &= picture.wrong
    share, before = float(off.mean()), float(picture.wrong.mean())
    return share if share <= min(_MOST_LEFT, _MOST_OF_WRONG * before) else None


def _touches_the_whole(picture: Picture, changed: Changed) -> bool:
    """A change of colours must have reached most of what it would change: else only some object has another colour.
    What is as in the reference may be the background, which no function of the step touches: it has one colour."""
    would = differing(changed.pixels, picture.reference, 2 * changed.tolerance)
    background = ~differing(picture.reference, np.broadcast_to(_commonest(picture), picture.reference.shape))
    concerned = would & (~background | picture.wrong)
    return bool(concerned.any()) and float((concerned & picture.wrong).sum() / concerned.sum()) >= 1 - _MOST_OF_WRONG


def _commonest(picture: Picture) -> Pixels:
    colours, counts = np.unique(picture.reference.reshape(-1, 3), axis=0, return_counts=True)
    commonest: Pixels = colours[int(counts.argmax())]
    return commonest


def transformation_of(picture: Picture, more: Mapping[str, Pixels]) -> Changed | None:
    """The change that explains the picture best. `more`: pictures that it may be taken for, by what that means."""
    found = [Changed(name, pixels) for name, pixels in more.items() if pixels.shape == picture.mine.shape]
    found += [changed for make in _ALL for changed in make(picture)]
    left = [(share, changed) for changed in found if (share := _left(picture, changed)) is not None]
    return min(left, key=lambda pair: pair[0])[1] if left else None
