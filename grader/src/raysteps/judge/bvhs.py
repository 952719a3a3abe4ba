"""Answers that are bounding volume hierarchies: any of them is right that loses no surface and is not too dear."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from raysteps.common.vectors import add, times
from raysteps.judge.answers import Answer, TooLarge, TooMuchWork
from raysteps.judge.protocol import Box, Inputs, ProtocolError, TokenReader
from raysteps.judge.surfaces import Sphere, Surface, Surfaces, Triangle

# Whoever writes an answer by hand may write any tree; framework/worker/protocol.hpp knows the same numbers.
MAX_NODES = 5000
MAX_ENTRIES = 50000
_MAX = {"nodes": f"{MAX_NODES} nodes", "surfaces": f"{MAX_ENTRIES} surfaces"}
MAX_LEVELS = 64  # as the contract says
_MARGIN = 1e-4  # of the scene's size: what rounding may do to a box
_BOX_TESTS = 1.0  # of two boxes, in units of one surface test
_MANY = 80  # surfaces: so many must be divided well
MAX_COST = 3.0  # times the reference's
_MAX_IN_LEAF = 0.5  # of many surfaces, on average


@dataclass(frozen=True)
class BvhNode:
    box: Box
    first: int
    count: int


@dataclass(frozen=True)
class Bvh:
    """`surfaces` are numbers of the scene's surfaces. `excess` is what a tree has too much of that was not told."""

    nodes: tuple[BvhNode, ...]
    surfaces: tuple[int, ...]
    excess: str = ""


def read_bvh(tokens: TokenReader) -> Bvh:
    kind = tokens.word()
    if kind == "large" and (excess := tokens.word()) in _MAX:
        return Bvh((), (), excess)
    if kind != "bvh":
        raise ProtocolError("the answer is no tree")
    nodes = []
    for _ in range(tokens.whole(0, MAX_NODES)):
        box = Box(tokens.vector(), tokens.vector())
        nodes.append(BvhNode(box, tokens.whole(0, (1 << 32) - 1), tokens.whole(0, (1 << 32) - 1)))
    size = tokens.whole(0, MAX_ENTRIES)
    return Bvh(tuple(nodes), tokens.wholes(size, -1, MAX_ENTRIES))


def area(box: Box) -> float:
    """Of the six faces."""
    x, y, z = (max(0.0, high - low) for low, high in zip(box.low, box.high, strict=True))
    return 2 * (x * y + y * z + z * x)


def bvh_cost(tree: Bvh, whole: Box | None = None) -> float:
    """Surface tests that a ray into the box `whole`, or else into the root's, takes on average, by the surface area
    heuristic. Nodes that cannot be reached do not count."""
    if not tree.nodes:
        return float(len(tree.surfaces))
    total = area(whole or tree.nodes[0].box)
    if total <= 0:
        return float(len(tree.surfaces))
    return sum(area(node.box) / total * (node.count or _BOX_TESTS) for node in reached(tree))


def reached(tree: Bvh) -> Iterator[BvhNode]:
    """The nodes below the root, of what is a tree or not."""
    seen: set[int] = set()
    open_ = [0]
    while open_:
        place = open_.pop()
        if place not in seen and place < len(tree.nodes):
            seen.add(place)
            node = tree.nodes[place]
            yield node
            open_ += [] if node.count else [node.first, node.first + 1]


def bvh_words(tree: Bvh) -> str:
    if tree.excess:
        return f"a tree of more than {_MAX[tree.excess]}"
    leaves = sum(node.count > 0 for node in tree.nodes)
    return f"a tree of {len(tree.nodes)} nodes, {leaves} of them leaves; a ray costs {bvh_cost(tree):.3g} surface tests"


def bounds(surface: Surface) -> Box:
    if isinstance(surface, Sphere):
        x, y, z = surface.center
        r = surface.radius
        return Box((x - r, y - r, z - r), (x + r, y + r, z + r))
    assert isinstance(surface, Triangle)
    low, high = ([pick(xs) for xs in zip(surface.a, surface.b, surface.c, strict=True)] for pick in (min, max))
    return Box((low[0], low[1], low[2]), (high[0], high[1], high[2]))


def _holds(outer: Box, inner: Box, margin: float) -> bool:
    """Not where a number is NaN."""
    lows = all(a <= b + margin for a, b in zip(outer.low, inner.low, strict=True))
    return lows and all(a >= b - margin for a, b in zip(outer.high, inner.high, strict=True))


def _around(boxes: Sequence[Box]) -> Box:
    low = [min(xs) for xs in zip(*(box.low for box in boxes), strict=True)]
    high = [max(xs) for xs in zip(*(box.high for box in boxes), strict=True)]
    return Box((low[0], low[1], low[2]), (high[0], high[1], high[2]))


def _middle(box: Box) -> Box:
    x, y, z = times(0.5, add(box.low, box.high))
    return Box((x, y, z), (x, y, z))


def _outermost(boxes: Sequence[Box]) -> set[int]:
    """Places of those that reach farthest to one side or another: without any other one all reach just as far."""
    places = range(len(boxes))
    lows = {min(places, key=lambda i: boxes[i].low[axis]) for axis in range(3)}
    return lows | {max(places, key=lambda i: boxes[i].high[axis]) for axis in range(3)}


def _sticking_out(leaf: Box, held: Sequence[Box], margin: float) -> str:
    """What the box of a leaf was made of, where that can be told; not all that it should hold. A leaf may list very
    many surfaces: each is looked at a few times."""

    def is_of(boxes: Sequence[Box]) -> bool:
        right = _around(boxes)
        return _holds(leaf, right, margin) and _holds(right, leaf, margin)

    if is_of([_middle(box) for box in held]):
        return "the box of a leaf holds the middles of its surfaces, and not all of them"
    if len(held) > 1 and any(is_of([*held[:i], *held[i + 1 :]]) for i in _outermost(held)):
        return "the box of a leaf holds all of its surfaces but one"
    return "a surface sticks out of the box of its leaf"


def _size(boxes: Sequence[Box]) -> float:
    def spread(axis: int) -> float:
        return max(box.high[axis] for box in boxes) - min(box.low[axis] for box in boxes)

    return max(spread(axis) for axis in range(3))


def _leaf_problem(tree: Bvh, node: BvhNode, boxes: Sequence[Box], margin: float, seen: set[int]) -> str:
    if node.first + node.count > len(tree.surfaces):
        return "a leaf reaches beyond the end of the list of surfaces"
    numbers = tree.surfaces[node.first : node.first + node.count]
    for number in numbers:
        if not 0 <= number < len(boxes):
            return "the list holds something that is no surface of the scene"
        if number in seen:
            return "a surface is in two leaves"
        seen.add(number)
        if not _holds(node.box, boxes[number], margin):
            return _sticking_out(node.box, [boxes[own] for own in numbers if 0 <= own < len(boxes)], margin)
    return ""


def _structure_problem(tree: Bvh, boxes: Sequence[Box]) -> str:
    margin = _MARGIN * _size(boxes) + _vanishing(boxes)
    seen: set[int] = set()
    reached: set[int] = set()
    open_ = [(0, 1)]  # nodes that are to come, and their levels
    while open_:
        place, level = open_.pop()
        if place in reached:
            return "a node is reached twice"
        reached.add(place)
        node = tree.nodes[place]
        if level > MAX_LEVELS:
            return f"the tree has more than {MAX_LEVELS} levels"
        if node.count:
            if problem := _leaf_problem(tree, node, boxes, margin, seen):
                return problem
            continue
        if node.first + 1 >= len(tree.nodes):
            return "an inner node has children beyond the end of the nodes"
        if not all(_holds(node.box, tree.nodes[child].box, margin) for child in (node.first, node.first + 1)):
            return "the box of a child sticks out of its parent's"
        open_ += [(node.first + 1, level + 1), (node.first, level + 1)]
    return "" if len(seen) == len(boxes) else "a surface is in no leaf"


def _vanishing(boxes: Sequence[Box]) -> float:
    """What float cannot tell at the place where the boxes are."""
    return 1e-6 * max(abs(x) for box in boxes for x in (*box.low, *box.high))


def _problem(inputs: Inputs, expected: Bvh, actual: Bvh) -> str:
    given = inputs["surfaces"]
    assert isinstance(given, Surfaces)
    size = len(given.surfaces)
    if actual.excess:
        return TooLarge(f"the tree has more than {_MAX[actual.excess]} for {size} surfaces")
    if not size:
        return "" if not actual.nodes else "a tree without surfaces has no nodes"
    if not actual.nodes:
        return "the tree has no nodes"
    problem = _structure_problem(actual, [bounds(surface) for surface in given.surfaces])
    if problem or size < _MANY:
        return problem
    if sum(node.count > 0 for node in reached(actual)) < 1 / _MAX_IN_LEAF:
        return TooMuchWork("the tree has hardly any leaves: a ray is spared nothing")
    whole = expected.nodes[0].box
    most = MAX_COST * bvh_cost(expected, whole)
    if bvh_cost(actual, whole) <= most:
        return ""
    is_loose = bvh_cost(_tight(actual, [bounds(surface) for surface in given.surfaces]), whole) <= most
    return "boxes are larger than what is in them" if is_loose else "the tree is right, but its cuts are dear"


def _tight(tree: Bvh, boxes: Sequence[Box]) -> Bvh:
    """The same one, each box as small as it may be."""
    nodes = [*tree.nodes]

    def fit(place: int) -> Box:
        node = nodes[place]
        numbers = tree.surfaces[node.first : node.first + node.count]
        below = [boxes[number] for number in numbers] or [fit(node.first), fit(node.first + 1)]
        nodes[place] = replace(node, box=_around(below))
        return nodes[place].box

    fit(0)
    return replace(tree, nodes=tuple(nodes))


BVH = Answer(read_bvh, bvh_words, _problem)
