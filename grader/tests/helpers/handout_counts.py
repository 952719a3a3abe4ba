"""Counted work that the handouts of the trees name in tables, beside what a program counts."""

import re
from collections.abc import Callable
from typing import Any

from raysteps.course.manifest import Step

Render = Callable[[list[str]], dict[str, Any]]  # arguments of raytrace; what it writes for --stats
Inspect = Callable[[list[str]], str]  # arguments of inspect; what it prints

_STRUCTURES = {"every surface": "none", "paper's": "boxes", "octree": "octree", "bounding volumes": "bvh"}
_ROW = re.compile(r"^\| (?P<name>[^|]+) \| (?P<surfaces>[\d.]+) surfaces\b(?:.*? and (?P<boxes>[\d.]+) boxes)?", re.M)
_PIXEL_ROW = re.compile(r"^\| `(?P<accel>\w+)` \| (?P<boxes>\d+) \| (?P<surfaces>\d+) \|$", re.M)
_PIXEL = re.compile(r"(?:(\d+) boxes asked, \d+ entered; )?(\d+) surface tests? on ")
_INSPECT = re.compile(r"^\./raysteps inspect (.+?) --accel \w+$", re.M)


def _section(text: str, name: str) -> str:
    return text.partition(f"\n## {name}\n")[2].partition("\n## ")[0]


def _same(shown: str | None, measured: float) -> bool:
    """To the digits that are shown; none are shown of a count of 0."""
    digits = len((shown or "0").partition(".")[2])
    return f"{measured:.{digits}f}" == (shown or "0")


def wrong_counts(text: str, step: Step, structures: set[str], render: Render, inspect: Inspect) -> list[str]:
    """Rows whose numbers the programs do not count. Structures that a kit lacks are left out."""
    wrong = []
    seen, pixel = _section(text, "What you will see"), _section(text, "Inspect it")
    (scene,) = set(re.findall(r"`([\w-]+\.nff)`, \d+ surfaces: tests per ray", seen))
    case = next(case for case in step.images if case.scene.endswith(f"/{scene}"))
    rows = list(_ROW.finditer(seen))
    pixel_rows = list(_PIXEL_ROW.finditer(pixel))
    assert len(rows) >= 3 <= len(pixel_rows) + 1
    for row in rows:
        (accel,) = {accel for words, accel in _STRUCTURES.items() if words in row["name"]}
        if accel not in structures:
            continue
        args = [
            word if before != "--accel" else accel for before, word in zip(("", *case.args), case.args, strict=False)
        ]
        stats = render([case.scene, *args])
        rays = sum(count for kind, count in stats["rays"].items() if kind != "eye_hit")
        measured = stats["surface_tests"] / rays, stats["box_tests"] / rays
        if not _same(row["surfaces"], measured[0]) or not _same(row["boxes"], measured[1]):
            wrong.append(f"{row[0]}: counted {measured[0]:.4g} surfaces and {measured[1]:.4g} boxes")
    (base,) = set(_INSPECT.findall(pixel))
    for row in pixel_rows:
        if row["accel"] in structures:
            found = _PIXEL.findall(inspect([*base.split(), "--accel", row["accel"]]))[-1]
            if (row["boxes"], row["surfaces"]) != (found[0] or "0", found[1]):
                wrong.append(f"{row[0]}: counted {found}")
        else:
            wrong.append(f"{row[0]}: this kit has no such structure")
    return wrong
