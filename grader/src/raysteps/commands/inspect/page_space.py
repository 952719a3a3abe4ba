"""What a page draws of a record in space."""

import math
from typing import Any

from raysteps.commands.inspect.page_rays import PageRay
from raysteps.commands.inspect.values import Record, Vector, as_float, is_finite, length, minus

_FAR = 3.0  # sizes of the view that a ray which meets nothing is drawn long


def _plain(vector: Vector) -> list[float]:
    """JSON has no infinity."""
    return [value if math.isfinite(value) else 0.0 for value in map(as_float, vector)]


def _along(origin: Vector, direction: Vector, distance: float) -> list[float]:
    return _plain([a + distance * b for a, b in zip(_plain(origin), _plain(direction), strict=True)])


def _end(ray: Record, size: float) -> list[float]:
    if ray["hit"] is not None and is_finite(ray["hit"]["position"]):
        return _plain(ray["hit"]["position"])
    limit = _FAR * size if ray["limit"] is None else min(as_float(ray["limit"]), 10 * _FAR * size)
    return _along(ray["origin"], ray["direction"], limit)


def _ray(page_ray: PageRay, size: float) -> dict[str, Any]:
    ray = page_ray.record
    return {
        "id": page_ray.id,
        "role": page_ray.role,
        "origin": _plain(ray["origin"]),
        "end": _end(ray, size),
        "hit": None if ray["hit"] is None else ray["hit"]["surface"],
        "boxes": [
            {"min": _plain(b["min"]), "max": _plain(b["max"]), "entered": b["enter"] is not None, "level": b["level"]}
            for b in ray["boxes"]
        ],
        "tests": [
            {"surface": test["surface"], "hit": test["distance"] is not None, "before": test["boxes_before"]}
            for test in ray["tests"]
        ],
    }


def _camera(record: Record) -> dict[str, Any]:
    camera, frame = record["camera"], record["frame"]
    half_width, half_height = as_float(frame["half_width"]), as_float(frame["half_height"])
    axes = [_plain(frame[name]) for name in ("forward", "right", "up")]

    def corner(right: int, up: int) -> list[float]:
        return _plain([f + right * half_width * r + up * half_height * u for f, r, u in zip(*axes, strict=True)])

    return {
        **{name: _plain(camera[name]) for name in ("from", "at", "up")},
        "halfHeight": math.tan(math.radians(as_float(camera["angle"])) / 2),
        "aspect": camera["width"] / camera["height"],
        "corners": [corner(-1, 1), corner(1, 1), corner(1, -1), corner(-1, -1)],
    }


def _goal(record: Record) -> list[float]:
    """What the pixel shows; a sky far behind the scene is no good place to look at."""
    camera, hit = record["camera"], record["ray"]["hit"]
    if hit is not None and is_finite(hit["position"]):
        far = _FAR * length(minus(camera["at"], camera["from"]))
        if length(minus(hit["position"], camera["from"])) <= far:
            return _plain(hit["position"])
    return _plain(camera["at"])


def space_of(record: Record, tree: PageRay) -> dict[str, Any]:
    """Camera, lights, surfaces near the rays, and the rays; `size` is how far the eye is from the goal."""
    goal = _goal(record)
    size = max(length(minus(goal, record["camera"]["from"])), 1e-3)
    return {
        "camera": _camera(record),
        "goal": goal,
        "size": size,
        "lights": [_plain(light["position"]) for light in record["lights"]],
        "surfaces": [
            {
                "surface": near["surface"],
                "points": [_plain(corner) for corner in near["points"]],
                "radii": _plain(near["radii"]),
                "color": _plain(near["color"]),
            }
            for near in record["near"]
        ],
        "rays": [_ray(ray, size) for ray in tree.all_rays()],
    }
