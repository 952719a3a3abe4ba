"""What a picture cost: tests that the program counted, and the structure that it built. No clock is involved."""

import json
from dataclasses import dataclass
from typing import Any

_MOST = 2**63  # a counter of the framework has 64 bits


@dataclass(frozen=True)
class Work:
    """The counters of one picture, as `raytrace --stats` writes them."""

    rays: int
    surface_tests: int
    box_tests: int
    boxes: int
    references: int  # entries in the lists of the structure; a surface may stand in several
    bytes: int

    @property
    def surfaces_per_ray(self) -> float:
        return self.surface_tests / self.rays if self.rays else 0.0

    @property
    def boxes_per_ray(self) -> float:
        return self.box_tests / self.rays if self.rays else 0.0

    @property
    def tests_per_ray(self) -> float:
        """A test of a surface and a test of a box weigh alike."""
        return (self.surface_tests + self.box_tests) / self.rays if self.rays else 0.0


def _count(value: Any) -> int:
    if type(value) is not int or not 0 <= value < _MOST:
        raise ValueError("not a counter")
    return value


def read_work(stats: bytes) -> Work | None:
    """None when these are no statistics of raytrace: a student's program may have written anything."""
    try:
        told = json.loads(stats)
        structure = told["structure"]
        return Work(
            rays=sum(_count(told["rays"][kind]) for kind in ("eye", "shadow", "reflect", "refract")),
            surface_tests=_count(told["surface_tests"]),
            box_tests=_count(told["box_tests"]),
            boxes=_count(structure["boxes"]),
            references=_count(structure["references"]),
            bytes=_count(structure["bytes"]),
        )
    except (ValueError, KeyError, TypeError, RecursionError):
        return None
