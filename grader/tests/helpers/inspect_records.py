"""Small records of pixels for tests of what is made of them; form raysteps/inspect/v1."""

import math
from typing import Any

from raysteps.common.documents import convert, plain
from raysteps.inspector.model import LampSample, Record

_COUNTS = {"box_tests": 2, "boxes_entered": 1, "candidates": 1, "surface_tests": 1, "unique_surfaces": 1}
_KD = 0.7
_COLOR = [0.9, 0.4, 0.1]
_BALL = {"color": _COLOR, "kd": _KD, "ks": 0.3, "shine": 30, "transmittance": 0, "index": 1}


def _ray(role: str, depth: int, origin: list[float], direction: list[float], **more: Any) -> dict[str, Any]:
    ray: dict[str, Any] = {
        "role": role,
        "depth": depth,
        "origin": origin,
        "direction": direction,
        "limit": None,
        "any": None,
    }
    ray |= {"counts": dict(_COUNTS), "boxes": [], "tests": [], "hit": None, "missed": None, "lights": [], "bounces": []}
    ray |= {"direct": None, "transmitted": None, "local": None, "path": None, "color": None}
    return ray | more


def _box(corner: float, enter: float | None, level: int) -> dict[str, Any]:
    leave = None if enter is None else enter + 2 * corner
    ends = {"min": [-corner] * 3, "max": [corner] * 3}
    return {**ends, "enter": enter, "leave": leave, "level": level, "listed": 1}


def _hit(surface: int, position: list[float]) -> dict[str, Any]:
    hit: dict[str, Any] = {"surface": surface, "kind": "sphere", "distance": 4.0, "position": position}
    hit |= {"point_at": position, "normal": [0, 0, 1], "ray_direction": [0, 0, -1], "from_outside": True}
    return hit | {"mirrored": [0, 0, 1], "refracted": None, "fill": dict(_BALL)}


def ball_record(*, lit: bool = True) -> Record:
    """The middle pixel of a picture of a ball that mirrors the sky, with one light before it."""
    shadow = _ray(
        "shadow", 1, [0, 0, 1.001], [0, 0, 1], limit=7.0, any=not lit, hit=None if lit else _hit(1, [0, 0, 1.5])
    )
    light: dict[str, Any] = {"light": 0, "lit": lit, "to_light": [0, 0, 1], "mirrored": [0, 0, 1]}
    light["shadow_ray"] = {"origin": shadow["origin"], "direction": shadow["direction"]}
    light |= {"l_n": 1.0, "r_v": 1.0, "diffuse": [0.5, 0.2, 0.1], "specular": [0.3, 0.3, 0.3], "rays": [shadow]}
    eye = _ray(
        "eye",
        1,
        [0, 0, 5],
        [0, 0, -1],
        boxes=[_box(2.0, 3.0, 0), _box(1.0, None, 1)],
        tests=[{"surface": 0, "distance": 4.0, "boxes_before": 1}],
        hit=_hit(0, [0, 0, 1]),
        lights=[light],
        direct=[0.8, 0.5, 0.4] if lit else [0, 0, 0],
        local=[0.8, 0.5, 0.4] if lit else [0, 0, 0],
        bounces=[_ray("reflect", 2, [0, 0, 1.001], [0, 0, 1], color=[0, 0, 0])],
        color=[0.8, 0.5, 0.4] if lit else [0, 0, 0],
    )
    record: dict[str, Any] = {"schema": "raysteps/inspect/v1", "scene": "scenes/ball & <sky>.nff", "surfaces": 2}
    record |= {"step": 8, "view": "color", "depth": 5, "accel": "octree", "pixel": {"x": 8, "y": 6}}
    camera = {"from": [0, 0, 5], "at": [0, 0, 0], "up": [0, 1, 0], "angle": 40, "width": 16, "height": 12}
    axes = {"right": [1, 0, 0], "up": [0, 1, 0], "forward": [0, 0, -1], "half_width": 0.48, "half_height": 0.36}
    record |= {"camera": camera, "frame": axes, "background": [0.2, 0.3, 0.5]}
    record |= {"lights": [{"position": [0, 0, 8], "color": [1, 1, 1]}], "structure": {"boxes": 2, "references": 2}}
    record |= {"ray": eye, "endless": False, "color": eye["color"]}
    record["mapped"] = [0.44, 0.33, 0.29] if lit else [0, 0, 0]
    record |= {
        "bytes": [113, 85, 73] if lit else [0, 0, 0],
        "rays": {"eye": 1, "shadow": 1, "reflect": 1, "refract": 0},
    }
    record |= {"counts": dict(_COUNTS), "left_out": {"rays": 0, "boxes": 0, "tests": 0}}
    near = {"kind": "sphere", "radii": [1], "color": [0.9, 0.4, 0.1]}
    record["near"] = [{"surface": 0, "points": [[0, 0, 0]], **near}, {"surface": 1, "points": [[0, 0, 2.5]], **near}]
    return convert(record, Record)


def lamp_record(*, lit: bool = True) -> Record:
    """The same pixel in step 12, lit by two lamps: a disk above it, and a ball behind it that brings nothing."""
    record = ball_record(lit=lit)
    (light,), record.ray.lights = record.ray.lights, []
    record.step, record.lights = 12, []
    brought = [3 * _KD / math.pi * part for part in _COLOR]
    disk = {"lamp": 0, "shape": "disk", "radiance": [3, 3, 3], "lit": lit, "position": [0, 0, 8], "normal": [0, 0, -1]}
    disk |= {"pdf": 1.0, "unshadowed": brought, "scatter_pdf": None, "weight": None}
    disk |= {"brought": brought if lit else [0, 0, 0], "rays": plain(light.rays)}
    ball = {**disk, "lamp": 1, "shape": "sphere", "position": [0, 0, -8], "normal": [0, 0, 1], "lit": False}
    ball |= {"unshadowed": [0, 0, 0], "brought": [0, 0, 0], "rays": []}
    record.ray.lamps = [convert(lamp, LampSample) for lamp in (disk, ball)]
    record.ray.lamps_beyond = 3
    record.ray.direct = [0, 0, 0]
    return record
