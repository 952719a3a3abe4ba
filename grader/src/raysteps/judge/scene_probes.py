"""What a search costs in the scene of a picture, measured and not claimed.

A few hundred of the picture's own rays go through the submission's tree of that scene, and the surfaces that are asked
count for themselves: rays from the eye that meet something, and from there rays towards the lights. Rays that fly past
everything may cost nothing. Wrong or missing answers spare nothing, for the picture was right.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Case
from raysteps.judge.hits import found_problem
from raysteps.judge.judging import reference_lines
from raysteps.judge.nff_reading import SceneText, read_scene
from raysteps.judge.numbers import Vector, add, cross, length, minus, rounded, times, unit
from raysteps.judge.searches import SEARCHES, Rays, Search, WhoseTree
from raysteps.judge.surfaces import Surfaces
from raysteps.judge.time_budget import TimeBudget
from raysteps.judge.tokens import Garbled
from raysteps.judge.values import Inputs, Ray
from raysteps.judge.worker_client import Ask, ask_worker

_FUNCTION = "closest_hit_in"
_LOOKS = 400  # rays from the eye
_MOST_SEEN = 100  # of them are asked, and as many go on
_MOST_WRONG = 0.1  # of the answers; a program that drew the right picture knows better
_BACK = 1e-4  # of a ray's length: it goes on a little before the surface
_SURE = 0.8  # of what the sample says: mirrored rays are not in it, and may meet less


@dataclass(frozen=True)
class ProbedScene:
    """A picture's scene. Of all its rays `seen` is the share of those from the eye that meet something, `onward` the
    share of those that leave from a surface."""

    name: str
    nff: str
    aspect: float  # width / height
    surfaces: int
    seen: float
    onward: float


@dataclass(frozen=True)
class _Probe:
    """The first half of the rays comes from the eye."""

    scene: ProbedScene
    case: Case
    expected: tuple[Search, ...]


def _case(scene: SceneText, rays: Sequence[Ray]) -> Case:
    inputs: Inputs = {"tree": WhoseTree(own=True), "surfaces": Surfaces(scene.surfaces), "rays": Rays(tuple(rays))}
    return Case(_FUNCTION, "the scene of a picture", inputs)


def _look(scene: SceneText, aspect: float, draw: Draw) -> Ray:
    """Through any point of the picture."""
    forward = unit(minus(scene.at, scene.origin))
    right = unit(cross(forward, scene.up))
    high = math.tan(math.radians(scene.angle) / 2)
    aim = add(forward, right, draw.fine(-1, 1) * high * aspect)
    return Ray(scene.origin, rounded(unit(add(aim, cross(right, forward), draw.fine(-1, 1) * high))))


def _onward(ray: Ray, distance: float, light: Vector) -> Ray:
    place = rounded(add(ray.origin, ray.direction, (1 - _BACK) * distance))
    way = minus(light, place)
    return Ray(place, rounded(times(1 / length(way), way)) if length(way) > 0 else ray.direction)


def _reference(ask: Ask, case: Case) -> tuple[Search, ...]:
    return SEARCHES.parse(reference_lines(ask, [case], _FUNCTION)[0])


def _probe(probed: ProbedScene, reference: Ask) -> _Probe | None:
    scene = read_scene(probed.nff)
    if scene is None or not scene.lights or len(scene.surfaces) != probed.surfaces:
        return None
    draw = Draw(probed.nff)
    looks = [_look(scene, probed.aspect, draw) for _ in range(_LOOKS)]
    found = zip(looks, _reference(reference, _case(scene, looks)), strict=True)
    seen = [(ray, search.found.hit.distance) for ray, search in found if search.found.hit][:_MOST_SEEN]
    if not seen:
        return None
    rays = [ray for ray, _ in seen]
    rays += [_onward(*pair, scene.lights[draw.whole(0, len(scene.lights) - 1)]) for pair in seen]
    case = _case(scene, rays)
    return _Probe(probed, case, _reference(reference, case))


def _wrong(expected: Search, actual: Search) -> bool:
    unasked = actual.found.hit is not None and not actual.asked
    return unasked or bool(found_problem(expected.found, actual.found))


def _costs(probe: _Probe, line: str) -> list[float]:
    """Of each ray, as a share of the scene's surfaces."""
    nothing_spared = [1.0] * len(probe.expected)
    try:
        actual = SEARCHES.parse(line)
    except (Garbled, OverflowError):
        return nothing_spared
    if len(actual) != len(probe.expected):
        return nothing_spared
    wrong = [_wrong(*pair) for pair in zip(probe.expected, actual, strict=True)]
    if sum(wrong) > _MOST_WRONG * len(wrong):
        return nothing_spared
    costs = [min(1.0, search.asked / probe.scene.surfaces) for search in actual]
    return [1.0 if bad else cost for bad, cost in zip(wrong, costs, strict=True)]


def least_share(scene: ProbedScene, costs: Sequence[float]) -> float:
    """Below this no honest count of that picture lies. Where every ray asks everything, all others of the picture do so
    too; the more they are spared, the less the sample says of the others. Therefore the squares."""
    half = len(costs) // 2
    eye, onward = sum(costs[:half]) / half, sum(costs[half:]) / (len(costs) - half)
    return _SURE * (scene.seen * eye**2 + scene.onward * onward**2)


def least_shares(scenes: Sequence[ProbedScene], student: Ask, reference: Ask, seconds: float) -> dict[str, float]:
    """By the scenes' names; those of which nothing can be said are missing."""
    probes = [probe for scene in scenes if (probe := _probe(scene, reference))]
    replies = ask_worker(student, [probe.case for probe in probes], TimeBudget(seconds, 1)).replies
    pairs = zip(probes, replies, strict=True)
    return {probe.scene.name: least_share(probe.scene, _costs(probe, reply.line)) for probe, reply in pairs}
