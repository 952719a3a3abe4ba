"""Transformations and findings on made-up pictures."""

from collections.abc import Callable

import numpy as np
import pytest

from raysteps.course.manifest import ImageCase, Step
from raysteps.diagnosis.diagnose import transformations
from raysteps.diagnosis.evidence import Picture
from raysteps.diagnosis.pixel_regions import Object, ObjectMap, numbered, place_of, size_of, without_highlights
from raysteps.diagnosis.transforms import BEFORE, in_words, transformation_of
from raysteps.images.compare import Pixels
from raysteps.toolchain.kit_artifacts import BuiltKit


def _reference() -> Pixels:
    """Smooth colours on a background, and nothing symmetric."""
    y, x = np.mgrid[0:60, 0:80]
    red = 40 + 2 * x + (x - 30) ** 2 / 40
    green = 30 + 3 * y
    blue = 200 - x - y + y * y / 40
    picture: Pixels = np.clip(np.stack([red, green, blue], axis=2), 0, 235).astype(np.uint8)
    picture[:12] = (100, 110, 120)
    picture[40:50, 5:20] = (220, 40, 30)
    return picture


def _picture(mine: Pixels, reference: Pixels | None = None) -> Picture:
    case = ImageCase("balls-lit", "scenes/lessons/three.nff", ("--step", "3"), 0.003)
    return Picture(case, np.ascontiguousarray(mine), _reference() if reference is None else reference)


_CHANGES: list[tuple[str, Callable[[Pixels], Pixels]]] = [
    ("upside-down", lambda pixels: pixels[::-1]),
    ("mirrored", lambda pixels: pixels[:, ::-1]),
    ("half-turn", lambda pixels: pixels[::-1, ::-1]),
    ("shifted-by-one", lambda pixels: np.roll(pixels, 1, axis=1)),
    ("negative", lambda pixels: 255 - pixels),
    ("red-and-blue-swapped", lambda pixels: pixels[..., ::-1]),
    ("channels-permuted", lambda pixels: pixels[..., [1, 2, 0]]),
    ("gamma-applied", lambda pixels: (255 * (pixels / 255) ** (1 / 2.2)).astype(np.uint8)),
    ("gamma-removed", lambda pixels: (255 * (pixels / 255) ** 2.2).astype(np.uint8)),
    ("too-dark", lambda pixels: (pixels * 0.5).astype(np.uint8)),
    ("too-bright", lambda pixels: np.minimum(pixels * 2.0, 255).astype(np.uint8)),
    ("grey", lambda pixels: np.repeat(pixels.mean(axis=2, keepdims=True), 3, axis=2).astype(np.uint8)),
]


@pytest.mark.parametrize(("name", "change"), _CHANGES, ids=[name for name, _ in _CHANGES])
def test_what_happened_to_the_whole_picture_is_told(name: str, change: Callable[[Pixels], Pixels]) -> None:
    found = transformation_of(_picture(change(_reference())), {})
    assert found is not None
    assert found.id == name
    diagnosis = in_words(found.id, found.detail, ["balls-lit"])
    assert all((diagnosis.title, diagnosis.sees, diagnosis.cause, diagnosis.hint))
    assert "{" not in diagnosis.title


@pytest.mark.parametrize(
    ("other", "told"), [(np.roll(_reference(), 1, axis=1), True), (_reference()[::2, ::-1], False)]
)
def test_a_shift_is_told_where_it_explains_all_that_is_wrong(
    kit: BuiltKit, steps: list[Step], other: Pixels, told: bool
) -> None:
    """Rays that miss their pixels do so in every scene."""
    step = next(step for step in steps if step.index not in BEFORE)
    pictures = {
        "one": _picture(np.roll(_reference(), 1, axis=1)),
        "other": _picture(other, _reference()[: len(other)]),
    }
    titles = [one.title for one in transformations(kit, step, pictures, pictures)]
    assert (in_words("shifted-by-one", "", []).title in titles) is told


def _slope(off: float) -> Pixels:
    y, x = np.mgrid[0:30, 0:40] + off
    slope: Pixels = np.rint(np.stack([20 + 5.2 * x, 230 - 7.1 * y, 10 + 3 * x + 3.4 * y], axis=2)).astype(np.uint8)
    return slope


def test_half_a_pixel() -> None:
    found = transformation_of(_picture(_slope(0.0), _slope(0.5)), {})
    assert found is not None
    assert found.id == "shifted-by-half"


def test_what_is_stretched_is_not_moved_by_half_a_pixel() -> None:
    """On average it is: nothing at the left edge, a whole pixel at the right one."""
    x = np.arange(40) + np.linspace(0, 1, 40)
    slope = np.rint(np.stack([20 + 5.2 * x, 230 - 5 * x, 10 + 3 * x], axis=1)).astype(np.uint8)
    before = np.rint(np.stack([20 + 5.2 * np.arange(40), 230 - 5 * np.arange(40), 10 + 3 * np.arange(40)], axis=1))
    stretched, right = (np.repeat(row[np.newaxis], 30, axis=0) for row in (slope, before.astype(np.uint8)))
    assert transformation_of(_picture(stretched, right), {}) is None


def test_the_factor_is_said() -> None:
    found = transformation_of(_picture((_reference() * 0.5).astype(np.uint8)), {})
    assert found is not None
    assert "0.5 times" in in_words(found.id, found.detail, []).title


def test_the_background_may_stay_as_it_is() -> None:
    dark = _reference()
    dark[12:] = (dark[12:] * 0.5).astype(np.uint8)
    found = transformation_of(_picture(dark), {})
    assert found is not None
    assert found.id == "too-dark"


def test_one_object_alone_is_no_matter_of_the_whole_picture() -> None:
    dark = _reference()
    dark[40:50, 5:20] //= 2
    assert transformation_of(_picture(dark), {}) is None


def test_the_picture_of_an_earlier_step() -> None:
    earlier = _reference()
    earlier[20:40, 20:40] = 250
    found = transformation_of(_picture(earlier), {"no-shadows": earlier})
    assert found is not None
    assert found.id == "no-shadows"
    for name, step in BEFORE.values():
        assert in_words(name, "", []).title
        assert 1 <= step <= 7


def test_noise_is_no_transformation() -> None:
    noise = np.random.default_rng(2).integers(0, 255, (60, 80, 3), dtype=np.uint8)
    assert transformation_of(_picture(noise), {}) is None


def test_the_objects_of_a_scene_get_numbers() -> None:
    nff = "b 1 1 1\n# a ball\nf 1 0 0 1 0.5 1 0 1\ns 0 0 0 1\np 3\n0 0 0\n1 0 0\n0 1 0\n"
    text, objects = numbered(nff)
    assert objects == [Object("sphere", 4), Object("polygon", 5)]
    lines = text.splitlines()
    assert lines[0] == "b 0 0 0"
    assert lines[3].startswith("f 0 0 0.00392156")
    assert lines[4] == "s 0 0 0 1"
    assert "f 1 0 0 1 0 1 0 1" in without_highlights(nff)
    assert size_of(("--step", "2", "--size", "4x3", "--depth", "2")) == ("--size", "4x3")
    assert size_of(("--step", "2")) == ()


def _objects() -> ObjectMap:
    numbers = np.zeros((60, 80), dtype=np.int32)
    numbers[12:] = 1
    numbers[40:50, 5:20] = 2
    numbers[15:25, 50:60] = 3
    return ObjectMap(numbers, [Object("polygon", 7), Object("sphere", 23), Object("sphere", 25)])


def test_a_finding_names_object_place_and_direction() -> None:
    dark = _reference()
    dark[40:50, 5:20] //= 2
    said = place_of(_picture(dark), _objects(), ["where there is shadow"])
    assert said == (
        "In balls-lit the wrong pixels lie on the sphere of line 23 of three.nff, where there is shadow, "
        "in the lower left part, x 5 to 19, y 40 to 49; they are too dark."
    )


def test_a_finding_knows_edges_and_everywhere() -> None:
    edges = _reference()
    for row in (11, 12):
        edges[row] = 255 - edges[row]
    assert "along the edges of things" in place_of(_picture(edges), _objects(), [])
    noise = np.random.default_rng(2).integers(0, 255, (60, 80, 3), dtype=np.uint8)
    assert place_of(_picture(noise), _objects(), []) == "In balls-lit the wrong pixels lie nearly everywhere."
