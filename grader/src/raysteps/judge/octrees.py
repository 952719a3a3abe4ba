"""Answers that are trees: any division of space that loses no surface is right."""

from collections.abc import Sequence
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

Points: TypeAlias = npt.NDArray[np.float64]  # one in each row

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


class Boxes:
    """One array for each side of all of them."""

    def __init__(self, low: Sequence[Vector], high: Sequence[Vector]) -> None:
        self._low = np.array(low).T.copy()
        self._high = np.array(high).T.copy()

    def holding(self, points: Points, which: _Flags, margin: float) -> _Flags:
        """Of each point whether it lies in one of these boxes, grown by the margin."""
        low, high = self._low[:, which] - margin, self._high[:, which] + margin
        least, most = points.min(axis=0)[:, np.newaxis], points.max(axis=0)[:, np.newaxis]
        # Most boxes hold all points or are far from them, which is quickly seen.
        if ((low <= least) & (high >= most)).all(axis=0).any():
            return np.ones(len(points), dtype=np.bool_)
        near: _Flags = ((low <= most) & (high >= least)).all(axis=0)
        low, high = low[:, near], high[:, near]
        inside: _Flags = np.ones((len(points), low.shape[1]), dtype=np.bool_)
        for axis in range(3):
            along = points[:, axis : axis + 1]
            np.logical_and(inside, along >= low[axis], out=inside)
            np.logical_and(inside, along <= high[axis], out=inside)
        held: _Flags = np.any(inside, axis=1)
        return held


_Table: TypeAlias = npt.NDArray[np.bool_]  # of nodes (rows) and surfaces (columns)

# Whoever writes an answer by hand may write any tree; framework/worker/simple_octree.cpp knows the same numbers.
MOST_NODES = 5000
MOST_ENTRIES = 50000
DEEPEST = 500
_MAX = {
    "boxes": f"{MOST_NODES} boxes",
    "entries": f"{MOST_ENTRIES} entries in its lists",
    "levels": f"{DEEPEST} levels",
}
_MAX_SURFACES = 1000  # of any case
_MARGIN = 1e-3  # of the scene's size: what stands nearer to a wall may be on either side
_MANY = 80  # surfaces: so many small ones must be divided
_MAX_IN_LEAF = 0.5  # of them, on average


@dataclass(frozen=True)
class TreeNode:
    """One box; `known` are the surfaces in its own list. `parent` is the place of the box around it in the tree."""

    low: Vector
    high: Vector
    known: tuple[int, ...]
    parent: int
    is_leaf: bool


@dataclass(frozen=True)
class Tree:
    """Parents come before their children. `excess` is what a tree has too much of that was not told."""

    nodes: tuple[TreeNode, ...]
    excess: str = ""


def read_tree(tokens: TokenReader) -> Tree:
    """Without recursion, and in time and memory that the caps bound."""
    kind = tokens.word()
    if kind == "large" and (excess := tokens.word()) in _MAX:
        return Tree((), excess)
    if kind != "tree":
        raise ProtocolError("the answer is no tree")
    nodes: list[TreeNode] = []
    entries = 0
    open_: list[tuple[int, int]] = [(0, 0)]  # parent and depth of a node that is to come
    while open_:
        parent, depth = open_.pop()
        low, high = tokens.vector(), tokens.vector()
        size = tokens.whole(0, MOST_ENTRIES - entries)
        entries += size
        known = tokens.wholes(size, -1, _MAX_SURFACES)
        children = tokens.whole(0, MOST_NODES)
        nodes.append(TreeNode(low, high, known, parent, children == 0))
        if len(nodes) + len(open_) + children > MOST_NODES or depth > DEEPEST:
            raise ProtocolError("the tree is too large")
        open_ += [(len(nodes) - 1, depth + 1)] * children
    return Tree(tuple(nodes))


def _tables(tree: Tree, surfaces: int) -> tuple[_Table, _Table]:
    """Which surfaces are in each node's own list, and which in that or in the lists of the boxes around it."""
    own = np.zeros((len(tree.nodes), surfaces), dtype=np.bool_)
    for place, node in enumerate(tree.nodes):
        own[place, list(node.known)] = True
    every = own.copy()
    for place, node in enumerate(tree.nodes):
        every[place] |= every[node.parent]
    return own, every


def tree_words(tree: Tree) -> str:
    if tree.excess:
        return f"a tree of more than {_MAX[tree.excess]}"
    lists = {number for node in tree.nodes for number in node.known}
    leaves = np.array([node.is_leaf for node in tree.nodes])
    # Unknown surfaces are -1, the last column.
    mean = _tables(tree, max(lists, default=-1) + 2)[1][leaves].sum(axis=1).mean()
    return f"a tree of {len(tree.nodes)} boxes; {leaves.sum()} leaves with {mean:.3g} surfaces on average"


def _lost(tree: Tree, surfaces: tuple[Surface, ...], own: _Table, every: _Table) -> str:
    points = points_on(surfaces)
    together = np.concatenate(points)
    margin = _MARGIN * float((together.max(axis=0) - together.min(axis=0)).max())
    boxes = Boxes([node.low for node in tree.nodes], [node.high for node in tree.nodes])
    leaves = np.array([node.is_leaf for node in tree.nodes])
    for number, mine in enumerate(points):
        holders = own[:, number] | (leaves & every[:, number])
        if not boxes.holding(mine, holders, margin).all():
            return "a part of a surface is in no box that has the surface in its list"
        if boxes.holding(mine, leaves & ~every[:, number], -margin).any():
            return "a surface runs through a leaf that does not have it in its list"
    return ""


def _tree_problem(inputs: Inputs, _expected: Tree, actual: Tree) -> str:
    given = inputs["surfaces"]
    assert isinstance(given, Surfaces)
    surfaces = given.surfaces
    if actual.excess:
        return TooLarge(f"the tree has more than {_MAX[actual.excess]} for {len(surfaces)} surfaces")
    if any(node.known and not 0 <= min(node.known) <= max(node.known) < len(surfaces) for node in actual.nodes):
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


TREE = Answer(read_tree, tree_words, _tree_problem)
