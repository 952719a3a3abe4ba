"""Any hierarchy that loses no surface and is not too dear is a right one."""

import random
import sys
from collections.abc import Sequence

import pytest

from raysteps.common.errors import GraderFault
from raysteps.judge import bvhs
from raysteps.judge.answers import TooLarge, TooMuchWork, Verdict
from raysteps.judge.bvhs import (
    BVH,
    MAX_COST,
    MAX_ENTRIES,
    MAX_LEVELS,
    MAX_NODES,
    Bvh,
    BvhNode,
    _around,
    _outermost,
    bounds,
    bvh_cost,
)
from raysteps.judge.functions import Case
from raysteps.judge.protocol import Box, Inputs
from raysteps.judge.surfaces import Sphere, Surfaces, Triangle

pytestmark = pytest.mark.portable

_LEFT, _RIGHT = Sphere((-2.0, 0.0, 0.0), 1.0), Sphere((2.0, 0.0, 0.0), 1.0)
_TWO: Inputs = {"surfaces": Surfaces((_LEFT, _RIGHT))}
_ALL, _WEST, _EAST = "-3 -1 -1 3 1 1", "-3 -1 -1 -1 1 1", "1 -1 -1 3 1 1"
_BETWEEN_MIDDLES = "-2 0 0 2 0 0"
_ROOT = f"{_ALL} 1 0"
_GOOD = f"bvh 3 {_ROOT} {_WEST} 0 1 {_EAST} 1 1 2 0 1"
_HUNDRED: Inputs = {"surfaces": Surfaces(tuple(Sphere((float(i), 0.0, 0.0), 0.25) for i in range(100)))}


def _problem(line: str, inputs: Inputs = _TWO) -> str:
    return Case("build_bvh", "", inputs).verdict(BVH, line if inputs is not _TWO else _GOOD, line).problem


def _row(leaf: int, step: int = 1, *, loose: bool = False) -> str:
    """Over the hundred: halves of halves, and as many in a leaf; with another step the row is not sorted first.
    `loose`: each box is as large as the root's."""
    order = sorted(range(100), key=lambda i: i * step % 100)
    nodes = [""]

    def build(place: int, begin: int, end: int) -> None:
        held = order if loose else order[begin:end]
        box = f"{min(held) - 0.25} -0.25 -0.25 {max(held) + 0.25} 0.25 0.25"
        if end - begin <= leaf:
            nodes[place] = f"{box} {begin} {end - begin}"
            return
        first, middle = len(nodes), (begin + end) // 2
        nodes[place] = f"{box} {first} 0"
        nodes.extend(("", ""))
        build(first, begin, middle)
        build(first + 1, middle, end)

    build(0, 0, 100)
    return f"bvh {len(nodes)} {' '.join(nodes)} 100 {' '.join(map(str, order))}"


@pytest.mark.parametrize(
    "tree",
    [
        _GOOD,
        f"bvh 1 {_ALL} 0 2 2 0 1",  # one leaf for all
        f"bvh 3 {_ROOT} {_EAST} 0 1 {_WEST} 1 1 2 1 0",  # the other way round
        f"bvh 3 -9 -9 -9 9 9 9 1 0 {_ALL} 0 1 {_ALL} 1 1 2 0 1",  # boxes larger than they have to be
        f"bvh 5 {_ALL} 3 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 {_WEST} 0 1 {_EAST} 1 1 2 0 1",  # places that nobody reaches
        f"bvh 3 {_ROOT} {_WEST} 0 1 {_EAST} 2 1 3 0 -1 1",  # and so in the list
    ],
)
def test_right_trees(tree: str) -> None:
    assert _problem(tree) == ""


@pytest.mark.parametrize(
    ("tree", "said"),
    [
        ("bvh 0 0", "no nodes"),
        ("bvh 0 2 0 1", "no nodes"),
        (f"bvh 1 {_ALL} 0 1 2 0 1", "in no leaf"),
        (f"bvh 3 {_ROOT} {_WEST} 0 1 {_ALL} 0 2 2 0 1", "in two leaves"),
        (f"bvh 3 {_ROOT} {_WEST} 0 1 {_EAST} 1 2 2 0 1", "beyond the end of the list"),
        (f"bvh 3 {_ROOT} {_WEST} 0 1 {_EAST} 1 1 2 0 -1", "no surface of the scene"),
        (f"bvh 3 {_ROOT} {_WEST} 0 1 {_EAST} 1 1 2 0 2", "no surface of the scene"),
        (f"bvh 3 {_ROOT} {_EAST} 0 1 {_WEST} 1 1 2 0 1", "sticks out of the box of its leaf"),
        (f"bvh 1 {_WEST} 0 2 2 0 1", "all of its surfaces but one"),
        (f"bvh 1 {_BETWEEN_MIDDLES} 0 2 2 0 1", "holds the middles of its surfaces"),
        (f"bvh 3 {_WEST} 1 0 {_WEST} 0 1 {_EAST} 1 1 2 0 1", "sticks out of its parent's"),
        (f"bvh 3 nan nan nan nan nan nan 1 0 {_WEST} 0 1 {_EAST} 1 1 2 0 1", "holds a number that is NaN"),
        (f"bvh 2 {_ROOT} {_WEST} 0 1 2 0 1", "beyond the end of the nodes"),
        (f"bvh 3 {_ROOT} {_ALL} 0 0 {_EAST} 1 1 2 0 1", "reached twice"),
        (f"bvh 2 {_ALL} 0 0 {_EAST} 1 1 2 0 1", "reached twice"),
    ],
)
def test_wrong_trees(tree: str, said: str) -> None:
    assert said in _problem(tree)


@pytest.mark.parametrize(
    "tree",
    [
        "bvh",
        "tree 0",
        "large",
        "large forests",
        f"bvh 1 {_ALL} 0 -1 2 0 1",
        f"bvh {MAX_NODES + 1} " + f"{_ROOT} " * (MAX_NODES + 1) + "0",
        f"bvh 1 {_ALL} 0 2 99999999 0 1",
        f"{_GOOD} 1",
        "bvh 3 1 2 3",
    ],
)
def test_no_proper_tree(tree: str) -> None:
    assert _problem(tree) == "no proper answer came"


def test_the_levels_are_counted() -> None:
    def chain(levels: int) -> str:
        """Each inner node has a leaf with one surface and the rest; the last level are two leaves."""
        nodes = [f"0 0 0 9 9 9 {2 * i + 1} 0 0 0 0 9 9 9 {i} 1" for i in range(levels - 1)]
        words = " ".join(nodes).split()
        root, rest = words[:8], words[8:]
        return f"bvh {2 * levels - 1} {' '.join(root)} {' '.join(rest)} 0 0 0 9 9 9 {levels - 1} 1"

    for levels, said in ((MAX_LEVELS, ""), (MAX_LEVELS + 1, f"more than {MAX_LEVELS} levels")):
        inputs: Inputs = {"surfaces": Surfaces((Sphere((4.0, 4.0, 4.0), 1.0),) * levels)}
        line = f"{chain(levels)} {levels} {' '.join(map(str, range(levels)))}"
        good = f"bvh 1 0 0 0 9 9 9 0 {levels} {levels} {' '.join(map(str, range(levels)))}"
        assert said in Case("build_bvh", "", inputs).verdict(BVH, good, line).problem
        assert bool(Case("build_bvh", "", inputs).verdict(BVH, good, line).problem) == bool(said)


def test_the_cost_of_a_tree() -> None:
    """Of the handout: nine surfaces in the first quarter of a box, one in the last."""
    whole = Box((0.0, 0.0, 0.0), (4.0, 2.0, 2.0))
    first, last = Box((0.0, 0.0, 0.0), (1.0, 2.0, 2.0)), Box((3.0, 0.0, 0.0), (4.0, 2.0, 2.0))
    tree = Bvh((BvhNode(whole, 1, 0), BvhNode(first, 0, 9), BvhNode(last, 9, 1)), tuple(range(10)))
    assert bvh_cost(tree) == pytest.approx(5)
    assert bvh_cost(Bvh((BvhNode(whole, 0, 10),), tuple(range(10)))) == pytest.approx(10)


def test_many_surfaces_must_be_divided_well() -> None:
    def verdict(line: str) -> Verdict:
        return Case("build_bvh", "", _HUNDRED).verdict(BVH, _row(1), line)

    for leaf in (1, 2, 4, 8):
        assert verdict(_row(leaf)).problem == "", "any sorted row is cheap enough"
    whole = verdict(_row(100))
    assert "hardly any leaves" in whole.problem
    assert isinstance(whole.problem, TooMuchWork)
    mixed = verdict(_row(4, 37))
    assert "dear" in mixed.problem
    assert not isinstance(mixed.problem, TooMuchWork)
    root = " ".join(_row(4, 37).split(" ")[2:8])
    inflated = _row(4, 37).replace(root, "-300 -300 -300 300 300 300", 1)
    assert "dear" in verdict(inflated).problem, "a larger root makes no tree cheaper"
    assert "larger than what is in them" in verdict(_row(4, loose=True)).problem
    assert MAX_COST > 1.5


def test_a_tree_that_was_too_large_to_tell() -> None:
    for excess, said in (("nodes", "5000 nodes"), ("surfaces", "50000 surfaces")):
        verdict = Case("build_bvh", "", _TWO).verdict(BVH, _GOOD, f"large {excess}")
        assert said in verdict.problem
        assert isinstance(verdict.problem, TooLarge)


def test_the_largest_tree_is_judged_in_few_calls() -> None:
    line = f"bvh {MAX_NODES} " + " ".join(f"{_ALL} {i + 1} 0" for i in range(MAX_NODES)) + " 2 0 1"
    calls = 0

    def count(*_: object) -> None:
        nonlocal calls
        calls += 1

    sys.setprofile(count)
    try:
        problem = _problem(line)
    finally:
        sys.setprofile(None)
    assert problem != ""
    assert calls < 400 * MAX_NODES, "it does not look at each box from each other one"


@pytest.mark.parametrize("box", [_WEST, _BETWEEN_MIDDLES, "9 9 9 9 9 9"])
def test_the_largest_leaf_is_looked_through_a_few_times(box: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """It lists the same surfaces again and again."""
    looked_at = 0

    def around(boxes: Sequence[Box]) -> Box:
        nonlocal looked_at
        looked_at += len(boxes)
        assert looked_at <= 7 * MAX_ENTRIES, "all of them at once, and without each of six"
        return _around(boxes)

    monkeypatch.setattr(bvhs, "_around", around)
    assert "leaf" in _problem(f"bvh 1 {box} 0 {MAX_ENTRIES} {MAX_ENTRIES} {'1 0 ' * (MAX_ENTRIES // 2)}")
    assert looked_at >= MAX_ENTRIES


def test_only_what_reaches_farthest_is_missed() -> None:
    """Without any other box the one around all of them is the same."""
    rng = random.Random(9)

    def box() -> Box:
        x, y, z = (float(rng.randrange(6)) for _ in range(3))
        return bounds(Sphere((x, y, z), float(rng.randrange(1, 4))))

    for _ in range(200):
        boxes = [box() for _ in range(rng.randrange(2, 12))]
        for i in set(range(len(boxes))) - _outermost(boxes):
            assert _around([*boxes[:i], *boxes[i + 1 :]]) == _around(boxes)


def test_no_surfaces() -> None:
    inputs: Inputs = {"surfaces": Surfaces(())}
    assert _problem("bvh 0 0", inputs) == ""
    assert Case("build_bvh", "", inputs).verdict(BVH, "bvh 0 0", f"bvh 1 {_ALL} 0 0 0").problem != ""


def test_a_flat_triangle_may_have_a_flat_box() -> None:
    inputs: Inputs = {"surfaces": Surfaces((Triangle((0.0, 0.0, 1.0), (1.0, 0.0, 1.0), (0.0, 1.0, 1.0)),))}
    assert _problem("bvh 1 0 0 1 1 1 1 0 1 1 0", inputs) == ""


def test_a_reference_that_loses_a_surface_is_the_kits_fault() -> None:
    with pytest.raises(GraderFault, match="in no leaf"):
        Case("build_bvh", "", _TWO).verdict(BVH, f"bvh 1 {_ALL} 0 1 2 0 1", _GOOD)
