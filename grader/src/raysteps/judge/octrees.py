"""Answers that are trees: any division of space that loses no surface is right."""

from dataclasses import dataclass
from functools import lru_cache
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from raysteps.common.vectors import Vector, add
from raysteps.judge.answers import Answer, TooLarge, TooMuchWork
from raysteps.judge.protocol import Inputs, ProtocolError, TokenReader
from raysteps.judge.random_source import RandomSource
from raysteps.judge.surfaces import Sphere, Surface, Surfaces, Triangle

# Points on surfaces, to see which boxes a surface touches.

Points: TypeAlias = npt.NDArray[np.float64]  # one in each row; of many surfaces, a row for each of them

_POINTS = 14  # on each surface


def _sphere_points(sphere: Sphere, draw: RandomSource) -> list[Vector]:
    return [add(sphere.center, draw.direction(), sphere.radius) for _ in range(_POINTS)]


def _triangle_points(t: Triangle, draw: RandomSource) -> list[Vector]:
    """The corners, and points all over it."""
    points = [t.a, t.b, t.c]
    while len(points) < _POINTS:
        u, v = draw.real(0, 1), draw.real(0, 1)
        if u + v <= 1:
            points.append(t.at(u, v))
    return points


def _points(surface: Surface, draw: RandomSource) -> Points:
    if isinstance(surface, Sphere):
        return np.array(_sphere_points(surface, draw))
    assert isinstance(surface, Triangle)
    return np.array(_triangle_points(surface, draw))


@lru_cache(maxsize=128)  # the reference's tree and a student's are looked at with the same ones
def points_on(surfaces: tuple[Surface, ...]) -> tuple[Points, ...]:
    """The same ones every time."""
    draw = RandomSource("points on surfaces")
    return tuple(_points(surface, draw) for surface in surfaces)


# Many boxes at once, and which points lie in them.

_Flags: TypeAlias = npt.NDArray[np.bool_]
_SURFACES_AT_ONCE = 8  # which bounds the memory for any tree, and soon ends the search in a wrong one


class Boxes:
    """One array for each side of all of them. A margin makes every box larger, and a negative one smaller."""

    def __init__(self, low: Points, high: Points) -> None:
        self._low = low.T.copy()
        self._high = high.T.copy()

    def around(self, low: Points, high: Points, margin: float) -> _Flags:
        """Of each extent (row) and box (column) whether the box holds the whole extent."""
        found: _Flags = np.ones((len(low), self._low.shape[1]), dtype=np.bool_)
        for axis in range(3):
            found &= low[:, axis : axis + 1] >= self._low[axis] - margin
            found &= high[:, axis : axis + 1] <= self._high[axis] + margin
        return found

    def touching(self, low: Points, high: Points, margin: float) -> _Flags:
        """Of each extent (row) and box (column) whether they have a place in common."""
        found: _Flags = np.ones((len(low), self._low.shape[1]), dtype=np.bool_)
        for axis in range(3):
            found &= high[:, axis : axis + 1] >= self._low[axis] - margin
            found &= low[:, axis : axis + 1] <= self._high[axis] + margin
        return found

    def holding(self, points: Points, pairs: _Flags, margin: float) -> _Flags:
        """Of each point (column) of each set (row) whether it lies in one of the boxes that the set is paired with."""
        held: _Flags = np.zeros(points.shape[:2], dtype=np.bool_)
        sets, box = np.nonzero(pairs)
        inside: _Flags = np.ones((len(sets), points.shape[1]), dtype=np.bool_)
        for axis in range(3):
            along = points[sets, :, axis]
            inside &= along >= (self._low[axis, box] - margin)[:, np.newaxis]
            inside &= along <= (self._high[axis, box] + margin)[:, np.newaxis]
        first = np.flatnonzero(np.diff(sets, prepend=-1))  # of each set's pairs, which lie together
        if len(first):
            held[sets[first]] = np.logical_or.reduceat(inside, first, axis=0)
        return held


_Table: TypeAlias = npt.NDArray[np.bool_]  # of nodes (rows) and surfaces (columns)

# Whoever writes an answer by hand may write any tree; framework/worker/protocol.hpp and simple_octree.cpp know the same
# numbers.
MAX_NODES = 5000
MAX_ENTRIES = 50000
DEEPEST = 500
_MAX = {
    "boxes": f"{MAX_NODES} boxes",
    "entries": f"{MAX_ENTRIES} entries in its lists",
    "levels": f"{DEEPEST} levels",
}
_MAX_SURFACES = 1000  # of any case
_MARGIN = 1e-3  # of the scene's size: what stands nearer to a wall may be on either side
_MANY = 80  # surfaces: so many small ones must be divided
_MAX_IN_LEAF = 0.5  # of them, on average


@dataclass(frozen=True)
class OctreeNode:
    """One box; `listed` are the surfaces in its own list. `parent` is the place of the box around it in the tree."""

    low: Vector
    high: Vector
    listed: tuple[int, ...]
    parent: int
    is_leaf: bool


@dataclass(frozen=True)
class Octree:
    """Parents come before their children. `excess` is what a tree has too much of that was not told."""

    nodes: tuple[OctreeNode, ...]
    excess: str = ""


def read_octree(tokens: TokenReader) -> Octree:
    """Without recursion, and in time and memory that the caps bound."""
    kind = tokens.word()
    if kind == "large" and (excess := tokens.word()) in _MAX:
        return Octree((), excess)
    if kind != "tree":
        raise ProtocolError("the answer is no tree")
    nodes: list[OctreeNode] = []
    entries = 0
    open_: list[tuple[int, int]] = [(0, 0)]  # parent and depth of a node that is to come
    while open_:
        parent, depth = open_.pop()
        low, high = tokens.vector(), tokens.vector()
        size = tokens.whole(0, MAX_ENTRIES - entries)
        entries += size
        known = tokens.wholes(size, -1, _MAX_SURFACES)
        children = tokens.whole(0, MAX_NODES)
        nodes.append(OctreeNode(low, high, known, parent, children == 0))
        if len(nodes) + len(open_) + children > MAX_NODES or depth > DEEPEST:
            raise ProtocolError("the tree is too large")
        open_ += [(len(nodes) - 1, depth + 1)] * children
    return Octree(tuple(nodes))


def _tables(tree: Octree, surfaces: int) -> tuple[_Table, _Table]:
    """Which surfaces are in each node's own list, and which in that or in the lists of the boxes around it."""
    own = np.zeros((len(tree.nodes), surfaces), dtype=np.bool_)
    for place, node in enumerate(tree.nodes):
        own[place, list(node.listed)] = True
    every = own.copy()
    for place, node in enumerate(tree.nodes):
        every[place] |= every[node.parent]
    return own, every


def tree_words(tree: Octree) -> str:
    if tree.excess:
        return f"a tree of more than {_MAX[tree.excess]}"
    lists = {number for node in tree.nodes for number in node.listed}
    leaves = np.array([node.is_leaf for node in tree.nodes])
    # Unknown surfaces are -1, the last column.
    mean = _tables(tree, max(lists, default=-1) + 2)[1][leaves].sum(axis=1).mean()
    return f"a tree of {len(tree.nodes)} boxes; {leaves.sum()} leaves with {mean:.3g} surfaces on average"


def _reached(tree: Octree) -> Boxes:
    """What a search sees of each box: the part in all boxes around it. Nothing where a number is NaN."""
    low, high = (np.array([getattr(node, side) for node in tree.nodes]) for side in ("low", "high"))
    for place, node in enumerate(tree.nodes):
        low[place] = np.maximum(low[place], low[node.parent])
        high[place] = np.minimum(high[place], high[node.parent])
    return Boxes(low, high)


def _lost(tree: Octree, surfaces: tuple[Surface, ...], own: _Table, every: _Table) -> str:
    points = np.stack(points_on(surfaces))
    margin = _MARGIN * float((points.max(axis=(0, 1)) - points.min(axis=(0, 1))).max())
    boxes = _reached(tree)
    leaves = np.array([node.is_leaf for node in tree.nodes])
    for start in range(0, len(points), _SURFACES_AT_ONCE):
        some = slice(start, start + _SURFACES_AT_ONCE)
        problem = _lost_of(boxes, leaves, points[some], own.T[some], every.T[some], margin)
        if problem:
            return problem
    return ""


def _lost_of(boxes: Boxes, leaves: _Flags, points: Points, own: _Table, known: _Table, margin: float) -> str:
    """Of some surfaces, one in each row; what is wrong with the first one that is lost."""
    least, most = points.min(axis=1), points.max(axis=1)
    holders = own | (leaves & known)
    # Most boxes hold a whole surface or are far from it, which is quickly seen.
    whole: _Flags = np.any(holders & boxes.around(least, most, margin), axis=1)
    near = holders & boxes.touching(least, most, margin) & ~whole[:, np.newaxis]
    outside: _Flags = ~(whole | np.all(boxes.holding(points, near, margin), axis=1))
    strangers = leaves & ~known & boxes.touching(least, most, -margin)
    through: _Flags = np.any(boxes.holding(points, strangers, -margin), axis=1)
    wrong: _Flags = outside | through
    if not wrong.any():
        return ""
    if outside[wrong.argmax()]:
        return "a part of a surface is in no box that has the surface in its list"
    return "a surface runs through a leaf that does not have it in its list"


def _tree_problem(inputs: Inputs, _expected: Octree, actual: Octree) -> str:
    given = inputs["surfaces"]
    assert isinstance(given, Surfaces)
    surfaces = given.surfaces
    if actual.excess:
        return TooLarge(f"the tree has more than {_MAX[actual.excess]} for {len(surfaces)} surfaces")
    if any(node.listed and not 0 <= min(node.listed) <= max(node.listed) < len(surfaces) for node in actual.nodes):
        return "a list holds something that is no surface of the scene"
    if not surfaces:
        return "" if len(actual.nodes) == 1 else "a tree without surfaces is a single leaf"
    own, every = _tables(actual, len(surfaces))
    problem = _lost(actual, surfaces, own, every)
    if not problem and len(surfaces) >= _MANY:
        leaves = np.array([node.is_leaf for node in actual.nodes])
        mean = every[leaves].sum(axis=1).mean()
        if mean > _MAX_IN_LEAF * len(surfaces):
            return TooMuchWork("the lists are hardly shorter than the whole scene")
    return problem


OCTREE = Answer(read_octree, tree_words, _tree_problem)
