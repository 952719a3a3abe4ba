"""A pixel as a page: its rays and boxes in three dimensions, and the tree of rays in words."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType

from raysteps.common.documents import plain
from raysteps.common.files import write_out
from raysteps.common.text import count
from raysteps.inspector.model import BoxEvent, Hit, LampSample, LightShare, PathStep, Ray, Record, Way
from raysteps.inspector.records import (
    EYE,
    Difference,
    Vector,
    agreement,
    as_float,
    brief,
    meets,
    minus,
    point,
    shadow_words,
)
from raysteps.report.page import SPACE_SCRIPTS, PictureData, render_page

# A record as the lines of a tree, each with a key, so that two trees can stand side by side.

Key = tuple[str, ...]

TITLES = {
    "eye": "eye ray",
    "reflect": "reflected ray",
    "refract": "refracted ray",
    "internal": "ray mirrored inside the glass",
}
_WAYS: tuple[Way, ...] = ("refract", "reflect")


@dataclass(frozen=True)
class Line:
    """`cost`: it tells of work, in which two right programs may differ."""

    key: Key
    level: int
    text: str
    cost: bool = False


def _search(ray: Ray, key: Key, level: int) -> Iterator[Line]:
    counts = ray.counts
    if counts.box_tests:
        text = f"boxes: {counts.box_tests} asked, {counts.boxes_entered} entered"
        yield Line((*key, "boxes"), level, text, cost=True)
    if counts.surface_tests:
        text = f"{count(counts.surface_tests, 'surface test')}, {counts.unique_surfaces} different"
        yield Line((*key, "tests"), level, text, cost=True)


def _view(hit: Hit) -> str:
    """Back along the ray, as the hit record has it."""
    return point([-as_float(part) for part in hit.ray_direction])


def _hit(ray: Ray, key: Key, level: int) -> Iterator[Line]:
    hit = ray.hit
    yield Line((*key, "hit"), level, meets(hit))
    if hit is not None:
        side = "outside" if hit.from_outside else "inside"
        yield Line((*key, "position"), level + 1, f"position {point(hit.position)}, from {side}")
        yield Line((*key, "normal"), level + 1, f"normal {point(hit.normal)}")
        yield Line((*key, "view"), level + 1, f"v {_view(hit)}")


def light_words(light: LightShare | LampSample) -> str:
    if isinstance(light, LampSample) and light.is_dark:
        return "brings nothing"
    if light.lit:
        return "visible" if light.rays else "counts"
    return shadow_words(light) if light.rays else "hidden"


def _light(light: LightShare, key: Key, level: int) -> Iterator[Line]:
    number = light.light + 1
    yield Line((*key, f"light{number}"), level, f"light {number}: {light_words(light)}")
    for ray in light.rays:
        text = f"shadow ray {point(ray.origin)} towards {point(ray.direction)}"
        yield Line((*key, f"shadow{number}"), level + 1, text)
        yield from _search(ray, (*key, f"shadow{number}"), level + 2)
    text = f"r {point(light.mirrored)}  l.n {brief(light.l_n)}  r.v {brief(light.r_v)}"
    yield Line((*key, f"mirrored{number}"), level + 1, text)
    text = f"diffuse {point(light.diffuse)}  specular {point(light.specular)}"
    yield Line((*key, f"terms{number}"), level + 1, text)


def _lamp_words(lamp: LampSample) -> Iterator[tuple[str, str]]:
    """Of one sample: where it lies, and what it brings."""
    yield "sample", f"at {point(lamp.position)}  normal {point(lamp.normal)}  pdf {brief(lamp.pdf)} per steradian"
    if lamp.scatter_pdf is not None and lamp.weight is not None:
        words = f"the path goes there with pdf {brief(lamp.scatter_pdf)}: the sample counts {brief(lamp.weight)} times"
        yield "weight", f"{words} {point(lamp.unshadowed)}"
    if lamp.lit:
        yield "brought", f"brings {point(lamp.brought)}"
    elif not lamp.is_dark:
        yield "brought", f"would bring {point(lamp.unshadowed)}, not added"


def _lamps(ray: Ray, key: Key, level: int) -> Iterator[Line]:
    for number, lamp in enumerate(ray.lamps, start=1):
        yield Line((*key, f"lamp{number}"), level, f"lamp {lamp.lamp + 1}: {light_words(lamp)}")
        for shadow in lamp.rays:
            text = f"shadow ray {point(shadow.origin)} towards {point(shadow.direction)}"
            yield Line((*key, f"lamp{number}-shadow"), level + 1, text)
            yield from _search(shadow, (*key, f"lamp{number}-shadow"), level + 2)
        for name, text in _lamp_words(lamp):
            yield Line((*key, f"lamp{number}-{name}"), level + 1, text)
    if ray.lamps_beyond:
        yield Line((*key, "lamps-beyond"), level, _beyond_words(ray))


def _beyond_words(ray: Ray) -> str:
    return f"and {count(ray.lamps_beyond, 'more sample')} of lamps, not kept"


def _sums(ray: Ray) -> Iterator[tuple[str, str]]:
    """Over the lights, and over the samples of lamps: what else the hit sends but for what shines through it."""
    if ray.direct is None:
        return
    yield "direct", f"sum over the lights {point(ray.direct)}"
    if ray.lamps and ray.local is not None:
        rest = minus(minus(ray.local, ray.direct), ray.transmitted or [0, 0, 0])
        yield "area-lights", f"area lights {point(rest)}, by one sample of each, and what the surface sends out itself"


def _path_words(step: PathStep | None) -> Iterator[tuple[str, str]]:
    """What a path found at a hit, and where it went on."""
    if step is None:
        return
    if step.lamps is not None:
        yield "lamps", f"lamps {point(step.lamps)}, by one sample of each"
    if step.scatter is None:
        yield "scattered", "the path ends here"
    else:
        found = step.scatter
        only = "  specular: no other direction" if found.specular else ""
        words = f"scattered towards {point(found.direction)}  weight {point(found.weight)}  pdf {brief(found.pdf)}"
        yield "scattered", words + only


def _ray(ray: Ray, key: Key, level: int, record: Record) -> Iterator[Line]:
    depth = "" if ray.role == "eye" else f", depth {ray.depth}"
    text = f"{TITLES[ray.role]}{depth}: {point(ray.origin)} towards {point(ray.direction)}"
    yield Line((*key, "ray"), level, text)
    if record.step > 1:
        yield from _search(ray, key, level + 1)
        yield from _hit(ray, key, level + 1)
    for light in ray.lights:
        yield from _light(light, key, level + 1)
    yield from _lamps(ray, key, level + 1)
    for name, text in (*_sums(ray), *_path_words(ray.path)):
        yield Line((*key, name), level + 1, text)
    for way in _WAYS:
        for bounce in ray.bounces_of(way):
            yield from _ray(bounce, (*key, way), level + 1, record)
        if way == "refract" and ray.transmitted is not None and any(map(float, ray.transmitted)):
            yield Line((*key, "transmitted"), level + 1, f"shines through {point(ray.transmitted)}")
    if ray.color is not None or not record.follows_paths:
        color = "unknown" if ray.color is None else point(ray.color)
        yield Line((*key, "color"), level + 1, f"colour {color}")


def lines_of(record: Record) -> list[Line]:
    """From the camera to the bytes."""
    frame = record.frame
    lines = [Line(("frame",), 0, f"camera: forward {point(frame.forward)}, up {point(frame.up)}")]
    lines += _ray(record.ray, (EYE,), 0, record)
    if record.mapped is not None:
        what = "for a screen" if record.is_of_part_two else "tone mapping"
        lines.append(Line(("mapped",), 0, f"{what} {point(record.mapped)}"))
    ending = "the rays never end" if record.endless else f"bytes {' '.join(map(str, record.bytes or []))}"
    return [*lines, Line(("bytes",), 0, ending)]


# A record as a tree of rays for a page, in words; where each ray runs in space: inspect-record.js.


@dataclass
class PageRay:
    """One ray; `key` begins the keys of its lines in the tree."""

    key: Key
    title: str
    ending: str
    record: Ray
    lines: list[str] = field(default_factory=list)  # of the hit
    sums: list[str] = field(default_factory=list)  # of the light, in the order of computation
    color: str = ""  # as HTML names colours
    boxes: list[str] = field(default_factory=list)
    children: list["PageRay"] = field(default_factory=list)
    role: str = ""

    @property
    def id(self) -> str:
        return "-".join(self.key)

    def all_rays(self) -> Iterator["PageRay"]:
        """Itself, and all that come of it."""
        yield self
        for child in self.children:
            yield from child.all_rays()


def shown_color(color: Vector | None) -> str:
    """What a screen shows of it, cut off at 1."""
    if color is None:
        return "#000000"
    parts = [as_float(part) for part in color]
    return "#" + "".join(f"{round(255 * min(max(part, 0.0), 1.0)) if part == part else 0:02x}" for part in parts)


def _box_words(box: BoxEvent) -> str:
    level = "" if box.level is None else f"level {box.level}: "
    if box.enter is None or box.leave is None:
        return f"{level}missed"
    listed = f", lists {count(box.listed, 'surface')}" if box.listed else ""
    return f"{level}enters at {brief(box.enter)}, leaves at {brief(box.leave)}{listed}"


def _search_lines(ray: Ray, surfaces: int) -> list[str]:
    counts = ray.counts

    def share(number: int) -> str:
        return f"{100 * number / surfaces:.3g} % of {surfaces}" if surfaces else "of none"

    lines = []
    if counts.box_tests:
        lines.append(f"{counts.box_tests} boxes asked, {counts.boxes_entered} entered")
    if counts.candidates:
        lines.append(f"{counts.candidates} candidates, duplicates counted ({share(counts.candidates)})")
    if counts.surface_tests:
        unique = counts.unique_surfaces
        lines.append(f"{count(counts.surface_tests, 'test')} on {unique} different surfaces ({share(unique)})")
    return lines


def _hit_lines(hit: Hit) -> list[str]:
    fill = hit.fill
    glass = f"  transmittance {brief(fill.transmittance)}  index {brief(fill.index)}"
    return [
        f"position {point(hit.position)}, from {'outside' if hit.from_outside else 'inside'}",
        f"normal {point(hit.normal)}",
        f"v {_view(hit)}, ray_direction turned round",
        f"colour {point(fill.color)}  kd {brief(fill.kd)}  ks {brief(fill.ks)}  shine {brief(fill.shine)}"
        + (glass if as_float(fill.transmittance) else ""),
    ]


def _new(ray: Ray, key: Key, title: str, surfaces: int) -> PageRay:
    made = PageRay(key, title, meets(ray.hit), ray, role=ray.role)
    made.lines = [f"from {point(ray.origin)} towards {point(ray.direction)}", *_search_lines(ray, surfaces)]
    made.boxes = [_box_words(box) for box in ray.boxes]
    if ray.hit is not None and ray.role != "shadow":
        made.lines += _hit_lines(ray.hit)
    return made


def _shadow_rays(light: LightShare | LampSample, key: Key, name: str, surfaces: int) -> Iterator[PageRay]:
    for again, ray in enumerate(light.rays):
        more = (f"ray{again + 1}",) if again else ()
        shadow = _new(ray, (*key, *more), f"shadow ray to {name}", surfaces)
        shadow.ending = light_words(light)
        shadow.role = "lit" if light.lit else "blocked"
        yield shadow


def page_ray(ray: Ray, record: Record, key: Key = ("eye",)) -> PageRay:
    """The ray with its shadow rays and bounces."""
    surfaces = record.surfaces
    depth = "" if ray.role == "eye" else f", depth {ray.depth}"
    made = _new(ray, key, TITLES[ray.role] + depth, surfaces)
    made.role = ray.way
    made.color = shown_color(ray.color)
    for light in ray.lights:
        number = light.light + 1
        made.children += _shadow_rays(light, (*key, f"light{number}"), f"light {number}", surfaces)
        terms = f"r {point(light.mirrored)}  r.v {brief(light.r_v)}  "
        terms += f"diffuse {point(light.diffuse)}  specular {point(light.specular)}"
        made.sums.append(f"light {number}, {light_words(light)}: l.n {brief(light.l_n)}  {terms}")
    for number, lamp in enumerate(ray.lamps, start=1):
        name = f"lamp {lamp.lamp + 1}"
        made.children += _shadow_rays(lamp, (*key, f"lamp{number}"), name, surfaces)
        made.sums.append(f"{name}, {light_words(lamp)}: {'; '.join(text for _, text in _lamp_words(lamp))}")
    if ray.lamps_beyond:
        made.sums.append(_beyond_words(ray))
    made.sums += [text for _, text in _sums(ray)]
    for bounce in ray.bounces:
        made.children.append(page_ray(bounce, record, (*key, bounce.way)))
    if ray.transmitted is not None and any(map(as_float, ray.transmitted)):
        made.sums.append(f"shines through {point(ray.transmitted)}")
    made.sums += [text for _, text in _path_words(ray.path)]
    if ray.color is not None or not record.follows_paths:
        made.sums.append("colour unknown" if ray.color is None else f"colour {point(ray.color)}")
    return made


# The page.


def _diverges_at(tree: PageRay, divergence: Difference | None) -> str:
    """The ray of the difference: the deepest one whose key begins the difference's place."""
    if divergence is None:
        return ""
    place = tuple(part.replace("shadow", "light").replace("terms", "light") for part in divergence.place)
    holders = [ray for ray in tree.all_rays() if place[: len(ray.key)] == ray.key]
    return max(holders, key=lambda ray: len(ray.key)).id if holders else ""


def page_html(
    record: Record,
    reference: Record | None = None,
    divergence: Difference | None = None,
    pictures: Mapping[str, PictureData] = MappingProxyType({}),
) -> str:
    """The document; with a reference both trees stand side by side, and the first difference is marked. `pictures`: of
    which the pixel is one, by the names of the records."""
    records = {"mine": record} if reference is None else {"mine": record, "reference": reference}
    trees = {name: page_ray(one.ray, one) for name, one in records.items()}
    pixel = record.pixel
    context = {
        "record": record,
        "reference": reference,
        "trees": trees,
        "divergence": divergence,
        "agreement": "" if reference is None else agreement(record, reference),
        "pictures": pictures,
        "diverges_at": {name: _diverges_at(tree, divergence) for name, tree in trees.items()},
        "swatch": shown_color([byte / 255 for byte in record.bytes] if record.bytes else None),
    }
    data = {name: plain(one) for name, one in records.items()}
    title = f"Inside pixel ({pixel.x}, {pixel.y})"
    return render_page("inspect", title, context, scripts=SPACE_SCRIPTS, styles=("inspect",), data=data)


def write_page(
    record: Record,
    reference: Record | None,
    divergence: Difference | None,
    target: Path,
    pictures: Mapping[str, PictureData] = MappingProxyType({}),
) -> None:
    """Writes the page of one record, or of two beside each other with the first difference marked."""
    write_out(target, page_html(record, reference, divergence, pictures).encode("utf-8", "replace"))
