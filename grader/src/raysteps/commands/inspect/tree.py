"""A record as the lines of a tree, each with a key, so that two trees can stand side by side."""

from collections.abc import Iterator
from dataclasses import dataclass

from raysteps.commands.inspect.pair import EYE, meets, surface_name
from raysteps.commands.inspect.values import Record, brief, point
from raysteps.common.text import count

Key = tuple[str, ...]

TITLES = {
    "eye": "eye ray",
    "reflect": "reflected ray",
    "refract": "refracted ray",
    "internal": "ray mirrored inside the glass",
}
_KINDS = {"internal": "refract"}


@dataclass(frozen=True)
class Line:
    """`cost`: it tells of work, in which two right programs may differ."""

    key: Key
    level: int
    text: str
    cost: bool = False


def _search(ray: Record, key: Key, level: int) -> Iterator[Line]:
    counts = ray["counts"]
    if counts["box_tests"]:
        text = f"boxes: {counts['box_tests']} asked, {counts['boxes_entered']} entered"
        yield Line((*key, "boxes"), level, text, cost=True)
    if counts["surface_tests"]:
        text = f"{count(counts['surface_tests'], 'surface test')}, {counts['unique_surfaces']} different"
        yield Line((*key, "tests"), level, text, cost=True)


def _hit(ray: Record, key: Key, level: int) -> Iterator[Line]:
    hit = ray["hit"]
    yield Line((*key, "hit"), level, meets(hit))
    if hit is not None:
        side = "outside" if hit["from_outside"] else "inside"
        yield Line((*key, "position"), level + 1, f"position {point(hit['position'])}, from {side}")
        yield Line((*key, "normal"), level + 1, f"normal {point(hit['normal'])}")


def light_words(light: Record) -> str:
    if light["lit"]:
        return "visible" if light["rays"] else "counts"
    hit = light["rays"][-1]["hit"] if light["rays"] else None
    return "hidden" if hit is None else f"blocked by {surface_name(hit)} at distance {brief(hit['distance'])}"


def _light(light: Record, key: Key, level: int) -> Iterator[Line]:
    number = light["light"] + 1
    yield Line((*key, f"light{number}"), level, f"light {number}: {light_words(light)}")
    for ray in light["rays"]:
        text = f"shadow ray {point(ray['origin'])} towards {point(ray['direction'])}"
        yield Line((*key, f"shadow{number}"), level + 1, text)
        yield from _search(ray, (*key, f"shadow{number}"), level + 2)
    text = f"l.n {brief(light['l_n'])}  diffuse {point(light['diffuse'])}  specular {point(light['specular'])}"
    yield Line((*key, f"terms{number}"), level + 1, text)


def _ray(ray: Record, key: Key, level: int, step: int) -> Iterator[Line]:
    depth = "" if ray["role"] == "eye" else f", depth {ray['depth']}"
    text = f"{TITLES[ray['role']]}{depth}: {point(ray['origin'])} towards {point(ray['direction'])}"
    yield Line((*key, "ray"), level, text)
    if step > 1:
        yield from _search(ray, key, level + 1)
        yield from _hit(ray, key, level + 1)
    for light in ray["lights"]:
        yield from _light(light, key, level + 1)
    if ray["direct"] is not None:
        yield Line((*key, "direct"), level + 1, f"sum over the lights {point(ray['direct'])}")
    for kind in ("refract", "reflect"):
        for bounce in ray["bounces"]:
            if _KINDS.get(bounce["role"], bounce["role"]) == kind:
                yield from _ray(bounce, (*key, kind), level + 1, step)
        if kind == "refract" and ray["transmitted"] is not None and any(map(float, ray["transmitted"])):
            yield Line((*key, "transmitted"), level + 1, f"shines through {point(ray['transmitted'])}")
    color = "unknown" if ray["color"] is None else point(ray["color"])
    yield Line((*key, "color"), level + 1, f"colour {color}")


def lines_of(record: Record) -> list[Line]:
    """From the camera to the bytes."""
    frame = record["frame"]
    lines = [Line(("frame",), 0, f"camera: forward {point(frame['forward'])}, up {point(frame['up'])}")]
    lines += _ray(record["ray"], (EYE,), 0, record["step"])
    if record["mapped"] is not None:
        lines.append(Line(("mapped",), 0, f"tone mapping {point(record['mapped'])}"))
    ending = "the rays never end" if record["endless"] else f"bytes {' '.join(map(str, record['bytes'] or []))}"
    return [*lines, Line(("bytes",), 0, ending)]
