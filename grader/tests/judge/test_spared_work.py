"""Few tests of objects count where something has spared them, and other mistakes take nothing back."""

import pytest

from raysteps.judge.answers import TooLarge, TooMuchWork, Verdict
from raysteps.judge.functions import Case, functions_of
from raysteps.judge.hidden_tests import revoke_tree_points, spares_nothing, unspared
from raysteps.judge.protocol import Inputs
from raysteps.judge.searches import TreeSource, work_problem
from raysteps.judge.surfaces import Sphere, Surfaces
from raysteps.judge.worker import JudgedCase
from raysteps.results.model import HiddenResult, ImageResult

_SAVING = "few surfaces are asked"
_MUCH, _LARGE = TooMuchWork("most surfaces were asked"), TooLarge("it cannot be read")


def _judged(*problems: str, group: str = _SAVING, asked: bool = True) -> list[JudgedCase]:
    case = Case("closest_hit_in_octree", group, {})
    return [
        JudgedCase(case, Verdict(problem, "", ""), "wrong" if problem else "ok", asked=asked) for problem in problems
    ]


@pytest.mark.parametrize(
    ("problems", "expected"),
    [
        ((_MUCH, _MUCH, _MUCH), True),
        ((_MUCH, _MUCH, "a wrong hit"), True),
        ((_MUCH, _MUCH, ""), False),  # one is right: it spares something
        ((_MUCH, "a wrong hit", "a wrong hit"), False),  # another mistake
        (("crashed", "crashed"), False),
        ((_LARGE, _LARGE), False),
        ((_MUCH, _LARGE), True),
        ((), False),
    ],
)
def test_what_spares_nothing(problems: tuple[str, ...], expected: bool) -> None:
    search = functions_of("06")["closest_hit_in_octree"]
    assert spares_nothing(search, _judged(*problems)) is expected
    assert not spares_nothing(search, _judged(*problems, group="from inside"))


@pytest.mark.parametrize(("asked", "wasteful"), [(60, False), (89, False), (91, True)])
def test_a_poor_tree_of_step_09_spares_something(asked: int, wasteful: bool) -> None:
    sphere = Sphere((0.0, 0.0, 0.0), 1.0)
    inputs: Inputs = {"surfaces": Surfaces((sphere,) * 100), "tree": TreeSource(own=True)}
    problem = work_problem(inputs, [5, 5], [asked, asked])
    assert "too many surfaces" in problem
    assert isinstance(problem, TooMuchWork) is wasteful


def test_without_surfaces_nothing_is_to_be_spared() -> None:
    """As where a wrong case is made smaller and smaller."""
    inputs: Inputs = {"surfaces": Surfaces(()), "tree": TreeSource(own=True)}
    assert work_problem(inputs, [0, 0], [0, 0]) == ""


def test_a_crash_on_purpose_is_no_way_out() -> None:
    search = functions_of("06")["closest_hit_in_octree"]
    judged = _judged(_MUCH, _MUCH) + _judged("not asked", "not asked", "not asked", asked=False)
    assert spares_nothing(search, judged + _judged("crashed", group="from inside"))


def _pictures(*shares: float) -> list[ImageResult]:
    return [
        ImageResult(f"picture {n}", "a.nff", share <= 0.6, 0.01, max_share=0.6, share_tested=share)
        for n, share in enumerate(shares)
    ]


def _hidden(*, spares: bool) -> list[HiddenResult]:
    return [HiddenResult("build_octree", "function", 0.5, spares_nothing=not spares)]


@pytest.mark.parametrize(
    ("shares", "kept"),
    [
        ((0.01, 0.3), 0),
        ((0.9, 0.3), 1),  # the first tests too many: then the second may be mostly sky
        ((0.9, 0.01), 0),  # so few are not even tested in the sky
    ],
)
def test_few_tests_that_nothing_spared(shares: tuple[float, ...], kept: int) -> None:
    images = _pictures(*shares)
    revoke_tree_points(images, _hidden(spares=True))
    assert [image.passed for image in images] == [share <= 0.6 for share in shares]
    revoke_tree_points(images, _hidden(spares=False))
    assert sum(image.passed for image in images) == kept
    assert all(
        "build_octree" in image.message for image in images if not image.passed and (image.share_tested or 0) < 0.6
    )


def test_pictures_without_a_limit_keep_their_points() -> None:
    images = [ImageResult("plain", "a.nff", True, 0.01), *_pictures(0.3)]
    assert unspared(images, _hidden(spares=True)) == ""
    assert "build_octree" in unspared(images, _hidden(spares=False))
    revoke_tree_points(images, _hidden(spares=False))
    assert [image.passed for image in images] == [True, False]
