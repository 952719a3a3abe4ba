"""A record as a tree of rays for a page: words to read, and where each ray runs in space."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from raysteps.commands.inspect.pair import meets
from raysteps.commands.inspect.tree import TITLES, Key, light_words
from raysteps.commands.inspect.values import Record, Vector, as_float, brief, point
from raysteps.common.text import count


@dataclass
class PageRay:
    """One ray; `key` begins the keys of its lines in the tree."""

    key: Key
    title: str
    ending: str
    record: Record
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


def _box_words(box: Record) -> str:
    level = "" if box["level"] is None else f"level {box['level']}: "
    if box["enter"] is None:
        return f"{level}missed"
    listed = f", lists {count(box['listed'], 'surface')}" if box["listed"] else ""
    return f"{level}enters at {brief(box['enter'])}, leaves at {brief(box['leave'])}{listed}"


def _search_lines(ray: Record, surfaces: int) -> list[str]:
    counts = ray["counts"]

    def share(number: int) -> str:
        return f"{100 * number / surfaces:.3g} % of {surfaces}" if surfaces else "of none"

    lines = []
    if counts["box_tests"]:
        lines.append(f"{counts['box_tests']} boxes asked, {counts['boxes_entered']} entered")
    if counts["candidates"]:
        lines.append(f"{counts['candidates']} candidates, duplicates counted ({share(counts['candidates'])})")
    if counts["surface_tests"]:
        unique = counts["unique_surfaces"]
        lines.append(f"{count(counts['surface_tests'], 'test')} on {unique} different surfaces ({share(unique)})")
    return lines


def _hit_lines(hit: Record) -> list[str]:
    fill = hit["fill"]
    glass = f"  transmittance {brief(fill['transmittance'])}  index {brief(fill['index'])}"
    return [
        f"position {point(hit['position'])}, from {'outside' if hit['from_outside'] else 'inside'}",
        f"normal {point(hit['normal'])}",
        f"colour {point(fill['color'])}  kd {brief(fill['kd'])}  ks {brief(fill['ks'])}  shine {brief(fill['shine'])}"
        + (glass if as_float(fill["transmittance"]) else ""),
    ]


def _new(ray: Record, key: Key, title: str, surfaces: int) -> PageRay:
    made = PageRay(key, title, meets(ray["hit"]), ray, role=ray["role"])
    made.lines = [f"from {point(ray['origin'])} towards {point(ray['direction'])}", *_search_lines(ray, surfaces)]
    made.boxes = [_box_words(box) for box in ray["boxes"]]
    if ray["hit"] is not None and ray["role"] != "shadow":
        made.lines += _hit_lines(ray["hit"])
    return made


def _shadow_rays(light: Record, key: Key, surfaces: int) -> Iterator[PageRay]:
    number = light["light"] + 1
    for again, ray in enumerate(light["rays"]):
        more = (f"ray{again + 1}",) if again else ()
        shadow = _new(ray, (*key, f"light{number}", *more), f"shadow ray to light {number}", surfaces)
        shadow.ending = light_words(light)
        shadow.role = "lit" if light["lit"] else "blocked"
        yield shadow


def page_ray(ray: Record, surfaces: int, key: Key = ("eye",)) -> PageRay:
    """The ray with its shadow rays and bounces."""
    depth = "" if ray["role"] == "eye" else f", depth {ray['depth']}"
    made = _new(ray, key, TITLES[ray["role"]] + depth, surfaces)
    made.role = "refract" if ray["role"] == "internal" else ray["role"]
    made.color = shown_color(ray["color"])
    for light in ray["lights"]:
        made.children += _shadow_rays(light, key, surfaces)
        terms = f"diffuse {point(light['diffuse'])}  specular {point(light['specular'])}"
        number = light["light"] + 1
        made.sums.append(f"light {number}, {light_words(light)}: l.n {brief(light['l_n'])}  {terms}")
    if ray["direct"] is not None:
        made.sums.append(f"sum over the lights {point(ray['direct'])}")
    for bounce in ray["bounces"]:
        kind = "refract" if bounce["role"] == "internal" else bounce["role"]
        made.children.append(page_ray(bounce, surfaces, (*key, kind)))
    if ray["transmitted"] is not None and any(map(as_float, ray["transmitted"])):
        made.sums.append(f"shines through {point(ray['transmitted'])}")
    made.sums.append("colour unknown" if ray["color"] is None else f"colour {point(ray['color'])}")
    return made
