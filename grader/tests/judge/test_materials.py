"""What the judge says of microfacets and of samples of metal and glass that are wrong in one way."""

import math
from dataclasses import replace

import numpy as np
import pytest

from raysteps.judge.cases.materials import FUNCTIONS
from raysteps.judge.cases.microfacets import dielectric, visible_problem
from raysteps.judge.functions import Case
from raysteps.judge.protocol import Fill, Hit, Inputs, Real, Vec, Whole, text
from raysteps.judge.statistics import Numbers

_FUNCTIONS = {function.name: function for function in FUNCTIONS}
_TIMES = 2048
_ALPHA = 0.4
_VIEW = np.array([0.8, 0.0, 0.6])
_STRETCH = np.array([_ALPHA, _ALPHA, 1.0])


def _line(numbers: Numbers) -> str:
    return " ".join(text(float(np.float32(number))) for number in numbers.ravel())


def _unit(v: Numbers) -> Numbers:
    return np.asarray(v / np.linalg.norm(v, axis=-1, keepdims=True))


def _seen(seed: int = 14, alpha: float = _ALPHA, view: Numbers = _VIEW, turn: float = 1.0) -> Numbers:
    """By the cap of a sphere (Dupuy and Benyoub 2023), which the judge does not do."""
    u, v = np.random.default_rng(seed).random((2, _TIMES))
    stretch = np.array([alpha, alpha, 1.0])
    seen = _unit(view * stretch)
    height = 1 - v * (1 + seen[2])
    across = np.sqrt(1 - height**2)
    angle = 2 * math.pi * turn * u
    cap = np.stack([across * np.cos(angle), across * np.sin(angle), height], axis=1)
    return _unit((cap + seen) * stretch)


def _left_on_the_half_sphere() -> Numbers:
    """Seen rightly, and not brought back from where the surface is stretched."""
    return _unit(_seen() / _STRETCH)


def _all_of_them() -> Numbers:
    """Normals by GGX alone, whether they are seen or not."""
    u, v = np.random.default_rng(14).random((2, _TIMES))
    tangent, angle = _ALPHA * np.sqrt(u / (1 - u)), 2 * math.pi * v
    return _unit(np.stack([tangent * np.cos(angle), tangent * np.sin(angle), np.ones(_TIMES)], axis=1))


def _said(name: str, inputs: Inputs, right: str, line: str) -> str:
    return Case(name, "", inputs).verdict(_FUNCTIONS[name].answer, right, line).problem


_VX, _VY, _VZ = (float(x) for x in _VIEW)
_NORMALS: Inputs = {"view": Vec((_VX, _VY, _VZ)), "alpha": Real(_ALPHA), "seed": Whole(1), "times": Whole(_TIMES)}


def _of_normals(normals: Numbers) -> str:
    return _said("sample_visible_normal", _NORMALS, _line(_seen()), _line(normals))


def test_right_normals_never_fail() -> None:
    assert not any(_of_normals(_seen(seed)) for seed in range(100))


@pytest.mark.parametrize(
    ("normals", "said"),
    [
        (_all_of_them(), "lean too much away from the view"),
        (_seen(view=np.array([0.0, 0.0, 1.0])), "lean too much away from the view"),
        (_seen(alpha=0.5), "microfacets"),
        (_seen(alpha=0.28), "microfacets"),
        (_seen(turn=0.5), "evenly to both sides"),
        (_seen() * (1, -0.5, 1), "length 1"),
        (-_seen(), "below the surface"),
        (_seen()[:-1], "no proper answer"),
        (np.full((_TIMES, 3), np.nan), "NaN"),
    ],
)
def test_each_wrong_density_has_its_words(normals: Numbers, said: str) -> None:
    assert said in _of_normals(np.asarray(normals))


def test_what_normals_are_instead_is_said_of_many_only() -> None:
    """A smallest case has a few, of which anything might be said."""
    normals = _left_on_the_half_sphere()
    assert "those of the half sphere" in visible_problem(normals, (_VX, _VY, _VZ), _ALPHA)
    few = visible_problem(np.repeat(normals[:1], 64, axis=0), (_VX, _VY, _VZ), _ALPHA)
    assert few
    assert "half sphere" not in few


# Samples, from nearly above: hardly any are lost.

_ABOVE = _unit(np.array([0.3, 0.0, 1.0]))
_SMOOTH = 0.04
_F0 = np.array([0.9, 0.6, 0.3])
_HIT = Hit((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (-float(_ABOVE[0]), 0.0, -float(_ABOVE[2])), 1.0, Fill((0.9, 0.6, 0.3)))


def _lambda(v: Numbers, alpha: float) -> Numbers:
    return np.asarray((np.sqrt(1 + alpha**2 * (1 / v[..., 2:] ** 2 - 1)) - 1) / 2)


def _rows(directions: Numbers, weights: Numbers, pdfs: Numbers, specular: float) -> str:
    ones = np.ones((len(directions), 1))
    weights = weights * np.ones((len(directions), 3))
    return _line(np.concatenate([ones, directions, weights, pdfs * ones, specular * ones], axis=1))


def _metal(
    weight: float = 1.0,
    pdf: float = 1.0,
    specular: float = 0.0,
    alpha: float = _SMOOTH,
    seed: int = 14,
    lean: Numbers | None = None,
) -> str:
    normals = _seen(seed, alpha, _ABOVE)
    if lean is not None:  # all to one side
        normals = np.asarray(np.where(lean < 0, -np.abs(normals), np.where(lean > 0, np.abs(normals), normals)))
    cosines = (normals @ _ABOVE)[:, None]
    directions = 2 * cosines * normals - _ABOVE
    above = directions[:, 2] > 0
    normals, cosines, directions = normals[above], cosines[above], directions[above]
    seen = 1 + _lambda(_ABOVE, _SMOOTH)
    fresnel = _F0 + (1 - _F0) * (1 - cosines) ** 5
    root = (_SMOOTH**2 - 1) * normals[:, 2:] ** 2 + 1
    pdfs = pdf * _SMOOTH**2 / (math.pi * root**2) / (4 * seen * _ABOVE[2])
    lost = " 0" * (_TIMES - len(directions))
    return _rows(directions, weight * fresnel * seen / (seen + _lambda(directions, _SMOOTH)), pdfs, specular) + lost


_SCATTER: Inputs = {"hit": _HIT, "roughness": Real(_SMOOTH), "seed": Whole(1), "times": Whole(_TIMES)}


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (_metal(), ""),
        (_metal(weight=0.99), "the weight is not f cos / pdf"),
        (_metal(pdf=1.02), "the pdf is not that of the direction"),
        (_metal(specular=1.0), "a specular sample"),
        (_metal(alpha=0.5), "nothing comes too often"),
        (_metal(alpha=0.06), "microfacets"),
        (_metal(lean=np.array([0, 1, 0])), "evenly to both sides"),
        (_metal(lean=np.array([-1, 0, 0])), "lean too much"),
        ("0 " * _TIMES, "no proper answer"),
    ],
)
def test_each_part_of_a_sample_of_metal_is_looked_at(line: str, said: str) -> None:
    found = _said("scatter_metal", _SCATTER, _metal(), line)
    assert said in found
    assert bool(said) == bool(found)


def test_right_samples_of_metal_never_fail() -> None:
    assert not any(_said("scatter_metal", _SCATTER, _metal(), _metal(seed=seed)) for seed in range(20))


@pytest.mark.parametrize(
    ("line", "said"),
    [("0 " * _TIMES, ""), (_metal(), "the view is not above the surface"), ("0 " * (_TIMES - 1), "no proper answer")],
)
def test_metal_that_is_seen_from_below_gives_nothing(line: str, said: str) -> None:
    inputs = {**_SCATTER, "hit": replace(_HIT, ray_direction=(0.6, 0.0, 0.8))}
    found = _said("scatter_metal", inputs, "0 " * _TIMES, line)
    assert said in found
    assert bool(said) == bool(found)


_GLASS: Inputs = {
    "hit": Hit((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (-0.6, 0.0, -0.8), 1.0, Fill((1.0, 1.0, 1.0), index=1.5), True),
    "roughness": Real(0.0),
    "seed": Whole(1),
    "times": Whole(_TIMES),
}
_SHARE = 0.0452  # of the light that comes back at that angle


def _clear(
    share: float = _SHARE, weight: float = 1.0, specular: float = 1.0, bent: float = 0.4, pdf: float = 1.0
) -> str:
    is_mirrored = np.random.default_rng(14).random((_TIMES, 1)) < share
    through = np.array([-bent, 0.0, -math.sqrt(1 - bent**2)])
    directions = np.where(is_mirrored, np.array([-0.6, 0.0, 0.8]), through)
    again = np.concatenate([directions, directions[:1]])
    return _rows(again, np.full((1, 3), weight), np.full((1, 1), pdf), specular)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (_clear(), ""),
        (_clear(share=2 * _SHARE), "too much light is mirrored"),
        (_clear(share=0.0), "too little light is mirrored"),
        (_clear(weight=0.99), "the weight is wrong"),
        (_clear(specular=0.0), "not specular"),
        (_clear(pdf=0.5), "the pdf is not 1"),
        (_clear(bent=0.9), "the refracted direction is wrong"),
        (_clear().rpartition(" 1 -0.4")[0] + " 1 -0.6 0 0.8 1 1 1 1 1", "the same stream gave another answer"),
    ],
)
def test_each_part_of_a_sample_of_glass_is_looked_at(line: str, said: str) -> None:
    found = _said("scatter_glass", _GLASS, _clear(), line)
    assert said in found
    assert bool(said) == bool(found)


_FROST = 0.4


def _frosted(seed: int, *, first: str = "") -> str:
    view = np.array([0.6, 0.0, 0.8])
    normals = _seen(seed, _FROST, view)
    cosines = normals @ view
    odds = np.random.default_rng(1000 + seed).random(_TIMES)
    if first in ("steepest", "flattest"):  # as if the number that decides were that which chose the microfacet
        odds = np.argsort(np.argsort(-(cosines if first == "steepest" else normals[:, 2]))) / _TIMES
    elif first == "of one side":
        odds = np.where(normals[:, 1] > 0, odds, 1 + odds) / 2
    is_mirrored = (odds < dielectric(cosines, 1 / 1.5))[:, None]
    further = np.sqrt(1 - (1 - cosines**2) / 1.5**2)
    through = (cosines / 1.5 - further)[:, None] * normals - view / 1.5
    directions = np.where(is_mirrored, 2 * cosines[:, None] * normals - view, through)
    kept = np.where(is_mirrored[:, 0], directions[:, 2] > 0, directions[:, 2] < 0)
    directions = directions[kept]
    seen = 1 + _lambda(view, _FROST)

    def rows(directions: Numbers) -> str:
        return _rows(directions, seen / (seen + _lambda(directions, _FROST)), np.ones((1, 1)), 1.0)

    lost = " 0" * int((~kept).sum())
    return f"{rows(directions)}{lost} {rows(directions[:1])}"  # and the first once more


def test_what_is_bent_farther_than_glass_bends_was_mirrored() -> None:
    """And must not lead below the surface, however little."""
    inputs, right = {**_GLASS, "roughness": Real(_FROST)}, _frosted(0)
    numbers = right.split()
    numbers[10:13] = _line(np.array([0.0, 1.0, -0.001])).split()  # of the second sample
    assert _said("scatter_glass", inputs, right, " ".join(numbers)).startswith("a direction below the surface is bent")


def test_what_is_mirrored_in_frosted_glass_is_fresnels_to_say() -> None:
    inputs = {**_GLASS, "roughness": Real(_FROST)}
    right = _frosted(0)
    for seed in range(20):
        assert not _said("scatter_glass", inputs, right, _frosted(seed))
        for first in ("steepest", "flattest", "of one side"):
            said = _said("scatter_glass", inputs, right, _frosted(seed, first=first))
            assert "depends on the microfacet" in said
