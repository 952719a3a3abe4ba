"""The table of ranges in docs/judge.md, and what is drawn."""

import math
import re
from collections.abc import Callable, Iterable
from typing import Any

import pytest

from raysteps.common.vectors import add, cross, dot, length, minus, times, unit
from raysteps.course.project import Project
from raysteps.judge.functions import functions_of
from raysteps.judge.protocol import Inputs
from raysteps.judge.random_source import RandomSource

pytestmark = pytest.mark.portable

_DRAWS = 400
_REACHED = 1.35  # how near the ends are come to, as a factor
_SLACK = 1.02  # what rounding may add


def _longest_edge(inputs: Any) -> float:
    t = inputs["triangle"]
    return max(length(minus(*pair)) for pair in ((t.a, t.b), (t.b, t.c), (t.c, t.a)))


def _from_plane(inputs: Any) -> float:
    """Along the ray."""
    t, ray = inputs["triangle"], inputs["ray"]
    normal = unit(cross(minus(t.b, t.a), minus(t.c, t.a)))
    return abs(dot(normal, minus(t.a, ray.origin)) / dot(normal, ray.direction))


def _sine_with_plane(inputs: Any) -> float:
    t = inputs["triangle"]
    return abs(dot(unit(cross(minus(t.b, t.a), minus(t.c, t.a))), inputs["ray"].direction))


def _share_beside_edge(inputs: Any) -> float:
    """The least of the three weights that the corners have where the ray meets the plane."""
    t, ray = inputs["triangle"], inputs["ray"]
    across = cross(minus(t.b, t.a), minus(t.c, t.a))
    distance = dot(across, minus(t.a, ray.origin)) / dot(across, ray.direction)
    spoke, whole = minus(add(ray.origin, ray.direction, distance), t.a), dot(across, across)
    b = dot(cross(spoke, minus(t.c, t.a)), across) / whole
    c = dot(cross(minus(t.b, t.a), spoke), across) / whole
    return min(abs(b), abs(c), abs(1 - b - c))


def _length_of_blend(inputs: Any) -> float:
    face, weights = inputs["face"], inputs["weights"].value
    corners = zip(weights, (face.a, face.b, face.c), strict=True)
    return math.hypot(*(sum(parts) for parts in zip(*(times(w, corner.normal) for w, corner in corners), strict=True)))


def _over_lamp(inputs: Any) -> float:
    return dot(inputs["normal"].value, minus(inputs["from"].value, inputs["position"].value))


def _over_surface(inputs: Any) -> float:
    return dot(inputs["hit"].normal, minus(inputs["position"].value, inputs["hit"].position))


def _from_sphere(inputs: Any) -> float:
    s, ray = inputs["sphere"], inputs["ray"]
    return abs(length(minus(ray.origin, s.center)) - float(s.radius))


def _to_light(inputs: Any) -> float:
    return length(minus(inputs["light"].position, inputs["hit"].position))


def _to_lights(inputs: Any) -> list[float]:
    return [length(minus(light.position, inputs["hit"].position)) for light in inputs["lights"].lights]


_QUANTITIES: dict[tuple[str, str], Callable[[Any], float | Iterable[float]]] = {
    ("point_at", "distance"): lambda i: i["distance"].value,
    ("view_frame", "angle in degrees"): lambda i: i["camera"].angle,
    ("view_frame", "width / height"): lambda i: i["camera"].width / i["camera"].height,
    ("primary_ray", "width in pixels"): lambda i: i["camera"].width,
    ("Triangle::intersect", "longest edge"): _longest_edge,
    ("Triangle::intersect", "distance from the plane"): _from_plane,
    ("Triangle::intersect", "sine of the angle with the plane"): _sine_with_plane,
    ("Triangle::intersect", "distance from an edge, as a share"): _share_beside_edge,
    ("Sphere::intersect", "radius"): lambda i: i["sphere"].radius,
    ("Sphere::intersect", "distance from the surface"): _from_sphere,
    ("closest_hit", "distance"): lambda i: [s.distance for s in i["surfaces"].surfaces if s.distance is not None],
    ("closest_hit", "number of surfaces"): lambda i: len(i["surfaces"].surfaces),
    ("specular", "shine"): lambda i: i["fill"].shine,
    ("shade", "number of lights"): lambda i: len(i["lights"].lights),
    ("shade", "distance of a light"): _to_lights,
    ("shadow_ray", "distance of the light"): _to_light,
    ("is_lit", "distance of the light"): _to_light,
    ("trace", "ks"): lambda i: [hit.ks for hit in i["tracer"].hits],
    ("trace", "most bounces"): lambda i: i["tracer"].max_depth,
    ("Box::clip", "small numbers of the direction"): lambda i: sorted(map(abs, i["ray"].direction))[:2],
    ("closest_hit_in_octree", "number of surfaces"): lambda i: len(i["surfaces"].surfaces),
    ("shading_normal", "length of the blend"): _length_of_blend,
    ("solid_angle_pdf", "distance"): lambda i: length(minus(i["from"].value, i["position"].value)),
    ("solid_angle_pdf", "height over the lamp's plane"): _over_lamp,
    ("sampled_light", "height over the surface's plane"): _over_surface,
    ("sampled_light", "pdf"): lambda i: i["pdf"].value,
}


def _rows(project: Project) -> list[tuple[str, str, float, float, str]]:
    text = (project.root / "docs" / "judge.md").read_text(encoding="utf-8")
    found = re.findall(r"^\| `([^`]+)` \| ([^|]+) \| ([0-9.]+) \| ([0-9.]+) \| ([^|]+) \|$", text, re.MULTILINE)
    return [(function, what, float(low), float(high), kind) for function, what, low, high, kind in found]


def _drawn(function: str, what: str, kind: str) -> list[float]:
    known = next(functions for n in range(1, 16) if function in (functions := functions_of(f"{n:02d}")))[function]
    draw = RandomSource(f"ranges/{function}/{kind}")
    values: list[float] = []
    for _ in range(_DRAWS):
        inputs: Inputs = known.by_name[kind].make(draw)
        value = _QUANTITIES[function, what](inputs)
        values += [value] if isinstance(value, (int, float)) else value
    return values


def test_every_quantity_is_in_the_table(project: Project) -> None:
    assert {(function, what) for function, what, *_ in _rows(project)} == set(_QUANTITIES)


def test_what_is_drawn_reaches_as_far_as_the_table_says(project: Project) -> None:
    for function, what, low, high, kind in _rows(project):
        values = _drawn(function, what, kind)
        place = f"{function}, {what}, {kind}: {min(values):g} to {max(values):g}"
        assert low / _SLACK <= min(values) <= low * _REACHED, place
        assert high / _REACHED <= max(values) <= high * _SLACK, place


def test_wide_ranges_are_drawn_by_their_logarithm(project: Project) -> None:
    """Else what is small in one of them would hardly ever come."""
    for function, what, low, high, kind in _rows(project):
        if kind == "of any size":
            values = _drawn(function, what, kind)
            small = sum(value < math.sqrt(low * high) for value in values)
            assert 0.35 * len(values) < small < 0.65 * len(values), f"{function}, {kind}"
