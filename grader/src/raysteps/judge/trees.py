"""Answers that are trees: any division of space that loses no surface is right."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from raysteps.judge.answers import Answer
from raysteps.judge.drawing import Draw
from raysteps.judge.numbers import Vector, add, minus
from raysteps.judge.surfaces import Sphere, Surface, Surfaces, Triangle
from raysteps.judge.tokens import Garbled, Tokens
from raysteps.judge.values import Inputs

_Array: TypeAlias = npt.NDArray[np.float64]

_MOST_NODES = 100000
_MOST_ENTRIES = 1000000
_POINTS = 14  # looked for on each surface
_MARGIN = 1e-3  # of the scene's size: what stands nearer to a wall may be on either side
_MANY = 80  # surfaces: so many small ones must be divided
_MOST_IN_LEAF = 0.5  # of them, on average


@dataclass(frozen=True)
class TreeNode:
    """One box; `known` are the surfaces in its own list, `above` those in the lists of the boxes around it."""

    low: Vector
    high: Vector
    known: frozenset[int]
    above: frozenset[int]
    is_leaf: bool


@dataclass(frozen=True)
class Tree:
    nodes: tuple[TreeNode, ...]


def read_tree(tokens: Tokens) -> Tree:
    """Without recursion: nobody knows how deep it is."""
    if tokens.word() != "tree":
        raise Garbled(f"the tree has more than {_MOST_NODES} boxes or {_MOST_ENTRIES} entries in its lists")
    nodes: list[TreeNode] = []
    open_: list[frozenset[int]] = [frozenset()]
    while open_:
        above = open_.pop()
        low, high = tokens.vector(), tokens.vector()
        known = frozenset(tokens.whole(-1) for _ in range(tokens.whole(0, _MOST_ENTRIES)))
        children = tokens.whole(0, _MOST_NODES)
        nodes.append(TreeNode(low, high, known, above, children == 0))
        if len(nodes) + len(open_) + children > _MOST_NODES:
            raise Garbled("the tree is too large")
        open_ += [above | known if known else above] * children
    return Tree(tuple(nodes))


def tree_words(tree: Tree) -> str:
    leaves = [node for node in tree.nodes if node.is_leaf]
    mean = sum(len(leaf.known | leaf.above) for leaf in leaves) / len(leaves)
    return f"a tree of {len(tree.nodes)} boxes; {len(leaves)} leaves with {mean:.3g} surfaces on average"


def _sphere_points(sphere: Sphere, draw: Draw) -> list[Vector]:
    return [add(sphere.center, draw.direction(), sphere.radius) for _ in range(_POINTS)]


def _triangle_points(t: Triangle, draw: Draw) -> list[Vector]:
    """The corners, and points all over it."""
    points = [t.a, t.b, t.c]
    while len(points) < _POINTS:
        u, v = draw.real(0, 1), draw.real(0, 1)
        if u + v <= 1:
            points.append(add(add(t.a, minus(t.b, t.a), u), minus(t.c, t.a), v))
    return points


def _points(surface: Surface, draw: Draw) -> _Array:
    if isinstance(surface, Sphere):
        return np.array(_sphere_points(surface, draw))
    assert isinstance(surface, Triangle)
    return np.array(_triangle_points(surface, draw))


def _inside(points: _Array, nodes: Sequence[TreeNode], margin: float) -> npt.NDArray[np.bool_]:
    """Which points (rows) lie in which boxes (columns), grown by the margin."""
    if not nodes:
        return np.zeros((len(points), 0), dtype=np.bool_)
    low = np.array([node.low for node in nodes]) - margin
    high = np.array([node.high for node in nodes]) + margin
    spread = points[:, np.newaxis, :]
    inside: npt.NDArray[np.bool_] = np.all((spread >= low) & (spread <= high), axis=2)
    return inside


def _lost(tree: Tree, surfaces: Sequence[Surface]) -> str:
    draw = Draw("points on surfaces")
    points = [_points(surface, draw) for surface in surfaces]
    every = np.concatenate(points)
    margin = _MARGIN * float((every.max(axis=0) - every.min(axis=0)).max())
    leaves = [node for node in tree.nodes if node.is_leaf]
    for number, mine in enumerate(points):
        holders = [node for node in tree.nodes if number in node.known or (node.is_leaf and number in node.above)]
        if not _inside(mine, holders, margin).any(axis=1).all():
            return "a part of a surface is in no box that has the surface in its list"
        others = [leaf for leaf in leaves if number not in leaf.known and number not in leaf.above]
        if _inside(mine, others, -margin).any():
            return "a surface runs through a leaf that does not have it in its list"
    return ""


def _tree_problem(inputs: Inputs, _expected: Tree, actual: Tree) -> str:
    given = inputs["surfaces"]
    assert isinstance(given, Surfaces)
    surfaces = given.surfaces
    known = frozenset().union(*(node.known for node in actual.nodes))
    if any(number < 0 or number >= len(surfaces) for number in known):
        return "a list holds something that is no surface of the scene"
    if not surfaces:
        return "" if len(actual.nodes) == 1 else "a tree without surfaces is a single leaf"
    problem = _lost(actual, surfaces)
    if not problem and len(surfaces) >= _MANY:
        leaves = [node for node in actual.nodes if node.is_leaf]
        mean = sum(len(leaf.known | leaf.above) for leaf in leaves) / len(leaves)
        problem = "the lists are hardly shorter than the whole scene" if mean > _MOST_IN_LEAF * len(surfaces) else ""
    return problem


TREE = Answer(read_tree, tree_words, _tree_problem)
