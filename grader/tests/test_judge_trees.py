"""Any division of space that loses no surface is a right tree."""

import pytest

from raysteps.common.errors import GraderFault
from raysteps.judge.surfaces import Sphere, Surfaces, Triangle
from raysteps.judge.trees import TREE
from raysteps.judge.values import Inputs

_LEFT, _RIGHT = Sphere((-2.0, 0.0, 0.0), 1.0), Sphere((2.0, 0.0, 0.0), 1.0)
_TWO: Inputs = {"surfaces": Surfaces((_LEFT, _RIGHT))}
_ALL = "-3 -1 -1 3 1 1"
_WEST, _EAST = "-3 -1 -1 0 1 1", "0 -1 -1 3 1 1"
_GOOD = f"tree {_ALL} 0 2 {_WEST} 1 0 0 {_EAST} 1 1 0"


def _problem(line: str, inputs: Inputs = _TWO) -> str:
    return TREE.verdict("build_octree", inputs, line if inputs is not _TWO else _GOOD, line).problem


@pytest.mark.parametrize(
    "tree",
    [
        _GOOD,
        f"tree {_ALL} 2 0 1 0",  # one leaf for all
        f"tree {_ALL} 1 1 1 {_WEST} 1 0 0",  # one kept above, the other below, no box for the empty half
        f"tree {_ALL} 0 2 {_WEST} 2 0 1 0 {_EAST} 2 0 1 0",  # too many entries
        f"tree -9 -9 -9 9 9 9 0 2 {_WEST} 1 0 0 1 -1 -1 3 1 1 1 1 0",  # a shrunk box, and a large one
    ],
)
def test_right_trees(tree: str) -> None:
    assert _problem(tree) == ""


@pytest.mark.parametrize(
    ("tree", "said"),
    [
        (f"tree {_ALL} 0 2 {_WEST} 1 0 0 {_EAST} 0 0", "in no box"),
        (f"tree {_ALL} 0 2 {_WEST} 1 0 0 1.5 -1 -1 3 1 1 1 1 0", "in no box"),
        (f"tree {_ALL} 0 3 {_WEST} 1 0 0 {_EAST} 1 1 0 {_EAST} 0 0", "does not have it in its list"),
        (f"tree {_ALL} 0 2 {_WEST} 2 0 -1 0 {_EAST} 1 1 0", "no surface of the scene"),
        (f"tree {_ALL} 0 2 {_WEST} 2 0 2 0 {_EAST} 1 1 0", "no surface of the scene"),
        ("tree 0 0 0 0 0 0 0 0", "in no box"),
        ("tree nan nan nan nan nan nan 2 0 1 0", "in no box"),
    ],
)
def test_wrong_trees(tree: str, said: str) -> None:
    assert said in _problem(tree)


@pytest.mark.parametrize(
    "tree",
    [
        "large",
        "tree",
        f"tree {_ALL} 0 100000 {_WEST}",
        f"tree {_ALL} 99999999 0",
        f"tree {_ALL} 0 8 " + f"{_ALL} 0 8 " * 5000,
        f"{_GOOD} 1",
        "tree 1 2 3",
    ],
)
def test_no_proper_tree(tree: str) -> None:
    assert _problem(tree) == "no proper answer came"


def test_a_deep_tree_is_read() -> None:
    deep = "tree " + f"{_ALL} 0 1 " * 5000 + f"{_ALL} 2 0 1 0"
    assert _problem(deep) == ""


def test_many_small_surfaces_must_be_divided() -> None:
    spheres = tuple(Sphere((float(i % 10), float(i // 10), 0.0), 0.25) for i in range(100))
    inputs: Inputs = {"surfaces": Surfaces(spheres)}
    everything = " ".join(str(i) for i in range(100))
    box = "-1 -1 -1 10 10 1"
    halves = [
        "-1 -1 -1 4.5 10 1 50 " + " ".join(str(i) for i in range(100) if i % 10 < 5) + " 0",
        "4.5 -1 -1 10 10 1 50 " + " ".join(str(i) for i in range(100) if i % 10 > 4) + " 0",
    ]
    good = f"tree {box} 0 2 {halves[0]} {halves[1]}"
    assert TREE.verdict("build_octree", inputs, good, good).problem == ""
    assert "hardly shorter" in TREE.verdict("build_octree", inputs, good, f"tree {box} 100 {everything} 0").problem


def test_no_surfaces() -> None:
    inputs: Inputs = {"surfaces": Surfaces(())}
    empty = "tree inf inf inf -inf -inf -inf 0 0"
    assert _problem(empty, inputs) == ""
    assert TREE.verdict("build_octree", inputs, empty, f"tree {_ALL} 0 1 {_ALL} 0 0").problem != ""


def test_a_triangle_through_a_box_without_a_corner_in_it() -> None:
    inputs: Inputs = {"surfaces": Surfaces((Triangle((-4.0, 0.0, 0.0), (4.0, 0.0, 0.0), (0.0, 4.0, 0.0)),))}
    good = "tree -4 0 0 4 4 0 1 0 0"
    parts = ["-4 0 -1 -2 4 1", "-2 0 -1 2 4 1", "2 0 -1 4 4 1"]
    lost = f"tree -4 0 -1 4 4 1 0 3 {parts[0]} 1 0 0 {parts[1]} 0 0 {parts[2]} 1 0 0"
    assert "no box" in TREE.verdict("build_octree", inputs, good, lost).problem


def test_a_reference_that_loses_a_surface_is_the_kits_fault() -> None:
    with pytest.raises(GraderFault, match="in no box"):
        TREE.verdict("build_octree", _TWO, f"tree {_WEST} 1 0 0", _GOOD)
