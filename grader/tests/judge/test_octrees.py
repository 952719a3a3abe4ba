"""Any division of space that loses no surface is a right tree."""

import time
import tracemalloc

import pytest

from raysteps.common.errors import GraderFault
from raysteps.judge.answers import TooLarge, TooMuchWork, Verdict
from raysteps.judge.functions import Case
from raysteps.judge.octrees import DEEPEST, MAX_ENTRIES, MAX_NODES, OCTREE
from raysteps.judge.protocol import Inputs
from raysteps.judge.surfaces import Sphere, Surfaces, Triangle

_LEFT, _RIGHT = Sphere((-2.0, 0.0, 0.0), 1.0), Sphere((2.0, 0.0, 0.0), 1.0)
_TWO: Inputs = {"surfaces": Surfaces((_LEFT, _RIGHT))}
_ALL = "-3 -1 -1 3 1 1"
_WEST, _EAST = "-3 -1 -1 0 1 1", "0 -1 -1 3 1 1"
_GOOD = f"tree {_ALL} 0 2 {_WEST} 1 0 0 {_EAST} 1 1 0"
_HUNDRED: Inputs = {"surfaces": Surfaces(tuple(Sphere((float(i % 10), float(i // 10), 0.0), 0.25) for i in range(100)))}
_AROUND_HUNDRED = "-1 -1 -1 10 10 1"
_WHOLE_HUNDRED = f"tree {_AROUND_HUNDRED} 100 {' '.join(map(str, range(100)))}"
_HALVES = [
    "-1 -1 -1 4.5 10 1 50 " + " ".join(str(i) for i in range(100) if i % 10 < 5) + " 0",
    "4.5 -1 -1 10 10 1 50 " + " ".join(str(i) for i in range(100) if i % 10 > 4) + " 0",
]
_GOOD_HUNDRED = f"tree {_AROUND_HUNDRED} 0 2 {_HALVES[0]} {_HALVES[1]}"


def _problem(line: str, inputs: Inputs = _TWO) -> str:
    return Case("build_octree", "", inputs).verdict(OCTREE, line if inputs is not _TWO else _GOOD, line).problem


def _chain(nodes: int) -> str:
    """Boxes in one another, each with another surface in its list."""
    return "tree " + "".join(f"{_ALL} 1 {i % 1000} 1 " for i in range(nodes)) + f"{_ALL} 2 0 1 0"


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
        ("tree nan nan nan nan nan nan 2 0 1 0", "holds a number that is NaN"),
        (f"tree nan nan nan nan nan nan 0 1 {_ALL} 2 0 1 0", "holds a number that is NaN"),  # a search ends at the root
        (f"tree 5 5 5 6 6 6 0 1 {_ALL} 2 0 1 0", "in no box"),
        (f"tree {_ALL} 0 2 5 5 5 6 6 6 0 1 {_WEST} 1 0 0 {_EAST} 1 1 0", "in no box"),
    ],
)
def test_wrong_trees(tree: str, said: str) -> None:
    assert said in _problem(tree)


@pytest.mark.parametrize(
    "tree",
    [
        "large",
        "large forests",
        "tree",
        f"tree {_ALL} 0 100000 {_WEST}",
        f"tree {_ALL} 0 {MAX_NODES} " + f"{_ALL} 0 0 " * MAX_NODES,
        f"tree {_ALL} 99999999 0",
        f"tree {_ALL} {MAX_ENTRIES} " + "0 " * MAX_ENTRIES + f"1 {_ALL} 1 0 0",
        f"tree {_ALL} 1 1001 0",
        "tree " + "1 " * 3_000_000,
        "tree " + f"{_ALL} 0 1 " * (DEEPEST + 1) + f"{_ALL} 2 0 1 0",
        _chain(MAX_NODES),
        f"tree {_ALL} 0 8 " + f"{_ALL} 0 8 " * 5000,
        f"{_GOOD} 1",
        "tree 1 2 3",
    ],
)
def test_no_proper_tree(tree: str) -> None:
    assert _problem(tree) == "no proper answer came"


def test_a_deep_tree_is_read() -> None:
    deep = "tree " + f"{_ALL} 0 1 " * DEEPEST + f"{_ALL} 2 0 1 0"
    assert _problem(deep) == ""


def test_a_forged_chain_takes_little_memory() -> None:
    """Each of its boxes has other surfaces around it; the first ones are not too many to be read."""
    for line in (_chain(DEEPEST), _chain(20000)):
        tracemalloc.start()
        Case("build_octree", "", _TWO).verdict(OCTREE, _GOOD, line)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < 30e6


def test_the_largest_tree_is_judged_at_once() -> None:
    """Every list is as long as it may be, and no box holds a surface as a whole but the last one."""
    size = (MAX_ENTRIES - 100) // MAX_NODES
    boxes = [f"{_AROUND_HUNDRED} {size} {' '.join(str((i + j) % 100) for j in range(size))} 0" for i in range(100)]
    halves = [box.replace("10 10 1", f"{i % 10} {i // 10} 0", 1) for i, box in enumerate(boxes)]
    line = f"{_WHOLE_HUNDRED} {MAX_NODES - 1} " + " ".join([*(halves * MAX_NODES)[: MAX_NODES - 2], boxes[0]])
    start = time.process_time()
    OCTREE.parse(line)
    read = time.process_time()
    verdict = Case("build_octree", "", _HUNDRED).verdict(OCTREE, _GOOD_HUNDRED, line)  # which reads it, too
    assert time.process_time() - read < 12 * (read - start), "judging a tree takes much longer than reading it"
    assert verdict.actual.startswith(f"a tree of {MAX_NODES} boxes")


@pytest.mark.parametrize(
    ("excess", "said"),
    [
        ("boxes", "more than 5000 boxes for 2 surfaces"),
        ("entries", "more than 50000 entries in its lists for 2 surfaces"),
        ("levels", "more than 500 levels for 2 surfaces"),
    ],
)
def test_a_tree_that_was_too_large_to_tell(excess: str, said: str) -> None:
    verdict = Case("build_octree", "", _TWO).verdict(OCTREE, _GOOD, f"large {excess}")
    assert said in verdict.problem
    assert isinstance(verdict.problem, TooLarge)
    assert said.removesuffix(" for 2 surfaces") in verdict.actual


def test_many_small_surfaces_must_be_divided() -> None:
    def verdict(line: str) -> Verdict:
        return Case("build_octree", "", _HUNDRED).verdict(OCTREE, _GOOD_HUNDRED, line)

    assert verdict(_GOOD_HUNDRED).problem == ""
    whole = verdict(f"{_WHOLE_HUNDRED} 0")
    assert "hardly shorter" in whole.problem
    assert isinstance(whole.problem, TooMuchWork)
    lost = verdict(f"tree {_AROUND_HUNDRED} 0 1 {_HALVES[0]}")
    assert lost.problem
    assert not isinstance(lost.problem, TooMuchWork)


def test_no_surfaces() -> None:
    inputs: Inputs = {"surfaces": Surfaces(())}
    empty = "tree inf inf inf -inf -inf -inf 0 0"
    assert _problem(empty, inputs) == ""
    assert Case("build_octree", "", inputs).verdict(OCTREE, empty, f"tree {_ALL} 0 1 {_ALL} 0 0").problem != ""


def test_a_triangle_through_a_box_without_a_corner_in_it() -> None:
    inputs: Inputs = {"surfaces": Surfaces((Triangle((-4.0, 0.0, 0.0), (4.0, 0.0, 0.0), (0.0, 4.0, 0.0)),))}
    good = "tree -4 0 0 4 4 0 1 0 0"
    parts = ["-4 0 -1 -2 4 1", "-2 0 -1 2 4 1", "2 0 -1 4 4 1"]
    lost = f"tree -4 0 -1 4 4 1 0 3 {parts[0]} 1 0 0 {parts[1]} 0 0 {parts[2]} 1 0 0"
    assert "no box" in Case("build_octree", "", inputs).verdict(OCTREE, good, lost).problem


def test_a_reference_that_loses_a_surface_is_the_kits_fault() -> None:
    with pytest.raises(GraderFault, match="in no box"):
        Case("build_octree", "", _TWO).verdict(OCTREE, f"tree {_WEST} 1 0 0", _GOOD)
