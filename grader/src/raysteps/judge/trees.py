"""Answers that are trees: any division of space that loses no surface is right."""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from raysteps.judge.answers import Answer, TooLarge, Wasteful
from raysteps.judge.boxes import Boxes
from raysteps.judge.numbers import Vector
from raysteps.judge.surface_points import points_on
from raysteps.judge.surfaces import Surface, Surfaces
from raysteps.judge.tokens import Garbled, Tokens
from raysteps.judge.values import Inputs

_Table: TypeAlias = npt.NDArray[np.bool_]  # of nodes (rows) and surfaces (columns)

# Whoever writes an answer by hand may write any tree; framework/worker/simple_octree.cpp knows the same numbers.
MOST_NODES = 5000
MOST_ENTRIES = 50000
DEEPEST = 500
_MOST = {
    "boxes": f"{MOST_NODES} boxes",
    "entries": f"{MOST_ENTRIES} entries in its lists",
    "levels": f"{DEEPEST} levels",
}
_MOST_SURFACES = 1000  # of any case
_MARGIN = 1e-3  # of the scene's size: what stands nearer to a wall may be on either side
_MANY = 80  # surfaces: so many small ones must be divided
_MOST_IN_LEAF = 0.5  # of them, on average


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


def read_tree(tokens: Tokens) -> Tree:
    """Without recursion, and in time and memory that the caps bound."""
    kind = tokens.word()
    if kind == "large" and (excess := tokens.word()) in _MOST:
        return Tree((), excess)
    if kind != "tree":
        raise Garbled("the answer is no tree")
    nodes: list[TreeNode] = []
    entries = 0
    open_: list[tuple[int, int]] = [(0, 0)]  # parent and depth of a node that is to come
    while open_:
        parent, depth = open_.pop()
        low, high = tokens.vector(), tokens.vector()
        size = tokens.whole(0, MOST_ENTRIES - entries)
        entries += size
        known = tokens.wholes(size, -1, _MOST_SURFACES)
        children = tokens.whole(0, MOST_NODES)
        nodes.append(TreeNode(low, high, known, parent, children == 0))
        if len(nodes) + len(open_) + children > MOST_NODES or depth > DEEPEST:
            raise Garbled("the tree is too large")
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
        return f"a tree of more than {_MOST[tree.excess]}"
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
        return TooLarge(f"the tree has more than {_MOST[actual.excess]} for {len(surfaces)} surfaces")
    if any(node.known and not 0 <= min(node.known) <= max(node.known) < len(surfaces) for node in actual.nodes):
        return "a list holds something that is no surface of the scene"
    if not surfaces:
        return "" if len(actual.nodes) == 1 else "a tree without surfaces is a single leaf"
    own, every = _tables(actual, len(surfaces))
    problem = _lost(actual, surfaces, own, every)
    if not problem and len(surfaces) >= _MANY:
        leaves = np.array([node.is_leaf for node in actual.nodes])
        mean = every[leaves].sum(axis=1).mean()
        if mean > _MOST_IN_LEAF * len(surfaces):
            return Wasteful("the lists are hardly shorter than the whole scene")
    return problem


TREE = Answer(read_tree, tree_words, _tree_problem)
