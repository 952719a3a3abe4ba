"""A scene of spheres, cones and triangles, from the NFF that `raysteps-bench nff` writes."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from raysteps.common.errors import GraderFault

Numbers = tuple[float, ...]


@dataclass(frozen=True)
class Shape:
    """One surface. s: centre, radius; c: two ends, each with radius; p: three corners; pp: each with a normal."""

    kind: str
    numbers: Numbers
    fill: Numbers  # colour, kd, ks, shine, transmittance, index of refraction


@dataclass
class FlatScene:
    """What a peer needs to draw the same picture."""

    view: dict[str, Numbers] = field(default_factory=dict)
    lights: list[Numbers] = field(default_factory=list)
    shapes: list[Shape] = field(default_factory=list)


_MORE_LINES = {"c": 2, "p": 3, "pp": 3}
_VIEW = ("from", "at", "up", "angle", "hither", "resolution")


def _numbers(words: list[str]) -> Numbers:
    return tuple(float(word) for word in words)


def _shape(kind: str, words: list[str], lines: Iterator[str], fill: Numbers) -> Shape:
    if kind == "s":
        return Shape(kind, _numbers(words), fill)
    if kind in ("p", "pp") and words != ["3"]:
        raise GraderFault(f"expected triangles only, found a polygon of {' '.join(words)} corners")
    rows = [next(lines) for _ in range(_MORE_LINES[kind] - len(words) // 4)]
    first = _numbers(words) if kind == "c" else ()
    return Shape(kind, first + tuple(number for row in rows for number in _numbers(row.split())), fill)


def read_flat(text: str) -> FlatScene:
    """The text that write_nff makes, not any NFF."""
    scene = FlatScene()
    fill: Numbers = ()
    lines = iter(text.splitlines())
    for line in lines:
        kind, *words = line.split()
        if kind in _VIEW:
            scene.view[kind] = _numbers(words)
        elif kind == "l":
            scene.lights.append(_numbers(words))
        elif kind == "f":
            fill = _numbers(words)
        elif kind in ("s", "c", "p", "pp"):
            scene.shapes.append(_shape(kind, words, lines, fill))
        elif kind not in ("v", "b"):
            raise GraderFault(f"expected NFF as raysteps-bench writes it, found '{line[:80]}'")
    return scene
