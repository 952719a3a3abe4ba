"""Where two records part first, in the order in which a pixel is computed."""

from collections.abc import Iterator
from dataclasses import replace

from raysteps.inspector import blame as expected
from raysteps.inspector.blame import blame_bounce, blame_hit, blame_shadow, shown, start_problem
from raysteps.inspector.lamp_differences import lamp_differences
from raysteps.inspector.model import Frame, Hit, LightShare, Ray, Record, Way
from raysteps.inspector.records import (
    CLOSE,
    EYE,
    Difference,
    Pair,
    as_float,
    brief,
    coarser,
    diverged,
    dot,
    intersect_of,
    length,
    meets,
    minus,
    not_unit,
    point,
    same_color,
    same_direction,
    same_meeting,
    same_number,
    same_point,
    same_samples,
    same_way,
    shadow_words,
    told,
)

# Differences in what a ray meets.


def hit_differences(pair: Pair) -> Iterator[Difference]:
    mine, reference = pair.mine.hit, pair.reference.hit
    if not same_meeting(mine, reference, pair.close):
        function = blame_hit(pair.mine, pair.reference, pair.accel)
        yield pair.at("hit", f"yours {meets(mine)}, the reference's {meets(reference)}", function)
        return
    if mine is None or reference is None:
        return
    own = intersect_of(mine.kind)
    reach = as_float(reference.distance) + length(pair.reference.origin)
    if not same_point(mine.position, reference.position, pair.close, reach):
        moved = not same_point(mine.point_at, reference.point_at, pair.close, reach)
        words = f"the hit lies at {point(mine.position)}, the reference's at {point(reference.position)}"
        yield pair.at("position", words, "point_at" if moved else own)
    if not same_direction(mine.normal, reference.normal, 10 * pair.close):
        words = f"the normal is {point(mine.normal)}, the reference's {point(reference.normal)}"
        yield pair.at("normal", words, own, not_unit(mine.normal))
    if mine.from_outside != reference.from_outside:
        told = "is true, the reference's false" if mine.from_outside else "is false, the reference's true"
        yield pair.at("position", f"front_face of the hit {told}", own)
    if mine.fill != reference.fill:
        yield pair.at("hit", "the fill of the hit is not that of the surface", own)
    if not same_direction(mine.ray_direction, reference.ray_direction, 10 * pair.close):
        words = f"ray_direction of the hit is {point(mine.ray_direction)}"
        yield pair.at("hit", f"{words}, the reference's {point(reference.ray_direction)}", own)


# Differences in the light that a hit sends by itself.


def _verdict(light: LightShare) -> str:
    if light.lit:
        return "is free"
    return f"is {shadow_words(light)}" if light.rays else "was never cast, and the light is said to be hidden"


def _shadow(pair: Pair, mine: LightShare, reference: LightShare) -> Iterator[Difference]:
    """The shadow ray of one light, in both records."""
    number = reference.light + 1
    item = f"light{number}"
    name = f"shadow ray to light {number}"
    verdict = f"{name}: yours {_verdict(mine)}, the reference's {_verdict(reference)}"
    if not reference.rays:
        return
    if not mine.rays:
        if mine.lit != reference.lit:
            yield pair.at(item, verdict, "is_lit", "yours casts no shadow ray")
        return
    own, theirs = mine.rays[-1], reference.rays[-1]
    room = 0.03 / max(1e-3, length(minus(_light_end(reference, theirs), theirs.origin)))
    if not same_direction(own.direction, theirs.direction, 10 * pair.close + min(room, 0.1)):
        words = f"{name}: yours goes towards {point(own.direction)}"
        words += f", the reference's towards {point(theirs.direction)}"
        given = mine.shadow_ray
        strayed = given is not None and not same_direction(own.direction, given.direction, 10 * pair.close)
        why = "your shadow_ray gives another direction" if strayed else not_unit(own.direction)
        yield pair.at(item, words, "is_lit" if strayed else "shadow_ray", why)
    if mine.lit == reference.lit:
        return
    function, why = blame_shadow(own, theirs, pair.hits[0], pair.accel, lit=mine.lit)
    yield pair.at(item, verdict, function, why)


def _light_end(light: LightShare, ray: Ray) -> list[float]:
    """A point far enough along the ray to stand for the light."""
    limit = ray.limit if isinstance(ray.limit, int | float) else 1.0
    return [as_float(a) + limit * as_float(b) for a, b in zip(ray.origin, light.to_light, strict=True)]


def _terms(pair: Pair, mine: LightShare, reference: LightShare) -> Iterator[Difference]:
    number = reference.light + 1
    item, hit, source = f"terms{number}", pair.hits[0], pair.lights[reference.light]
    turned = expected.mirrored([-as_float(value) for value in mine.to_light], hit.normal)
    if not (same_direction(mine.mirrored, reference.mirrored) or same_direction(mine.mirrored, turned)):
        words = f"light {number}: its mirrored direction is {point(mine.mirrored)}"
        yield pair.at(item, f"{words}, the reference's {point(reference.mirrored)}", "mirror")
    for term, own, theirs, right in (
        ("diffuse", mine.diffuse, reference.diffuse, expected.diffuse),
        ("specular", mine.specular, reference.specular, expected.specular),
    ):
        if diverged(own, theirs, right(hit, mine, source), 10 * CLOSE):
            words = f"light {number}: the {term} term is {point(own)}, the reference's {point(theirs)}"
            yield pair.at(item, words, term)


def light_differences(pair: Pair) -> Iterator[Difference]:
    """Each light, then their sum."""
    mine, reference = pair.mine, pair.reference
    own = {light.light: light for light in mine.lights}
    agree = same_color(mine.direct, reference.direct, 10 * pair.close)
    for light in reference.lights:
        if light.light in own and not agree:
            yield from _shadow(pair, own[light.light], light)
    for light in reference.lights:
        if light.light in own:
            yield from _terms(pair, own[light.light], light)
    if diverged(mine.direct, reference.direct, expected.direct(mine.lights), 10 * CLOSE):
        words = f"the sum over the lights is {told(mine.direct)}, the reference's {told(reference.direct)}"
        yield pair.at("direct", words, "shade")


# Differences between two rays and all that follow from them.


def _follows(bounce: Ray, hit: Hit, way: Way) -> bool:
    """Whether the ray goes where the contract sends it from this hit."""
    right = expected.refracted(hit) if way == "refract" else None
    mirrors = right is None
    right = right or expected.mirrored(hit.ray_direction, hit.normal)
    wanted = "reflect" if way == "reflect" else "internal" if mirrors else "refract"
    return bounce.role == wanted and same_direction(bounce.direction, right)


def _bounced(pair: Pair, mine: Ray, reference: Ray, way: Way) -> Iterator[Difference]:
    """One ray that goes on from the hit, in both records."""
    glass = way == "refract"
    name = f"the {'refracted' if glass else 'reflected'} ray, depth {reference.depth}"
    close = coarser(mine, reference)
    child = replace(pair, mine=mine, reference=reference, place=(*pair.place, way), name=name, close=close)
    whole, part = ("transmitted_ray", "refract") if glass else ("reflected_ray", "mirror")
    hit, other = pair.hits
    right = _follows(mine, hit, way)
    if mine.role != reference.role or not same_direction(mine.direction, reference.direction):
        given = (hit.refracted, other.refracted) if glass else (hit.mirrored, other.mirrored)
        function = blame_bounce(*given, whole, part)
        if not right:
            yield Difference(
                (*child.place, "ray"), f"{name}: {_ways(mine, reference)}", function, not_unit(mine.direction)
            )
        if mine.role != reference.role:
            return
    side = 1 if dot(reference.direction, other.normal) > 0 else -1
    problem = start_problem(mine, hit, side)
    if problem and "itself" not in problem:
        yield Difference((*child.place, "ray"), f"{name}: yours begins at {point(mine.origin)}", whole, problem)
    for below in along(child):
        if problem and below.place == (*child.place, "hit"):
            yield below._replace(function=whole, why=problem, ill_conditioned=False)
        else:
            yield below


def _ways(mine: Ray, reference: Ray) -> str:
    if mine.role != reference.role:
        told = {"refract": "passes into or out of the glass", "internal": "is mirrored inside it"}
        return f"yours {told[mine.role]}, the reference's {told[reference.role]}"
    return f"yours goes towards {point(mine.direction)}, the reference's towards {point(reference.direction)}"


def _bounces(pair: Pair, way: Way) -> Iterator[Difference]:
    mine, reference = pair.mine.bounces_of(way), pair.reference.bounces_of(way)
    for own, theirs in zip(mine, reference, strict=False):
        yield from _bounced(pair, own, theirs, way)
    if len(mine) == len(reference) or same_color(pair.mine.color, pair.reference.color, 10 * pair.close):
        return
    function = "transmitted_light" if way == "refract" else "trace"
    word = "refracted" if way == "refract" else "reflected"
    depth = (mine + reference)[min(len(mine), len(reference))].depth
    if len(mine) < len(reference):
        yield pair.at("color", f"yours sends no {word} ray, the reference does (depth {depth})", function)
    else:
        yield pair.at(way, f"yours sends a {word} ray (depth {depth}), the reference sends none", "trace")


_PATHS = {13: "path_light", 14: "path_light", 15: "mis_path_light"}  # who follows a path


def _scattering(pair: Pair) -> Iterator[Difference]:
    """What a path weighs behind a hit from which both go on in one direction."""
    paths = pair.mine.path, pair.reference.path
    own, theirs = (None if path is None else path.scatter for path in paths)
    if own is None or theirs is None or not same_direction(own.direction, theirs.direction):
        return
    function = "scatter_diffuse" if pair.step == min(_PATHS) else ""
    if not same_number(own.pdf, theirs.pdf, 100 * CLOSE):
        words = f"the direction of the path has pdf {brief(own.pdf)}, the reference's {brief(theirs.pdf)}"
        yield pair.at("color", words, function)
    if not same_color(own.weight, theirs.weight, 100 * CLOSE):
        words = f"the direction of the path has weight {point(own.weight)}, the reference's {point(theirs.weight)}"
        yield pair.at("color", words, function)


def along(pair: Pair) -> Iterator[Difference]:
    """From the search of one ray to its colour, in the order of computing."""
    mine, reference = pair.mine, pair.reference
    if mine.depth != reference.depth:
        function = "trace" if mine.role == "reflect" else "transmitted_light"
        yield pair.at("ray", f"yours has depth {mine.depth}, the reference's {reference.depth}", function)
    if pair.step > 1:
        yield from hit_differences(pair)
    if (mine.hit is None) != (reference.hit is None):
        return
    if (mine.local is None) != (reference.local is None):
        asks = "yours does not ask for the light of the hit" if mine.local is None else "yours asks for light"
        yield pair.at("color", f"{asks}, the reference does{'' if mine.local is None else ' not'}", "trace")
        return
    if mine.local is not None:
        yield from light_differences(pair)
    if mine.hit is not None:
        yield from lamp_differences(pair)
    yield from _bounces(pair, "refract")
    through = expected.brought(mine, "refract")
    if diverged(mine.transmitted, reference.transmitted, through, 10 * CLOSE):
        words = f"what shines through is {told(mine.transmitted)}"
        yield pair.at("transmitted", f"{words}, the reference's {told(reference.transmitted)}", "transmitted_light")
    if same_way(mine, reference):
        yield from _scattering(pair)
        yield from _bounces(pair, "reflect")
    whole = expected.added(mine.local, expected.brought(mine, "reflect")) if pair.step >= 5 else None
    may_differ = expected.is_unseen(mine) or (mine.path is not None and not same_samples(mine, reference))
    if not may_differ and diverged(mine.color, reference.color, whole, 10 * CLOSE):
        words = f"the colour of the ray is {told(mine.color)}, the reference's {told(reference.color)}"
        follows = "trace" if pair.step >= 5 else ""
        yield pair.at("color", words, follows if mine.path is None else _PATHS.get(pair.step, ""))


def ray_differences(mine: Record, reference: Record) -> Iterator[Difference]:
    """From the eye ray on."""
    own, theirs = mine.ray, reference.ray
    step = reference.step
    pair = Pair(own, theirs, (EYE,), "the eye ray", CLOSE, step, reference.accel, reference.lights)
    if not same_direction(own.direction, theirs.direction):
        words = f"yours goes towards {point(own.direction)}, the reference's towards {point(theirs.direction)}"
        yield pair.at("ray", words, "primary_ray", not_unit(own.direction))
    if not same_point(own.origin, theirs.origin, CLOSE, 0.0):
        yield pair.at(
            "ray",
            f"yours begins at {point(own.origin)}, the reference's at {point(theirs.origin)}",
            "primary_ray",
        )
    if reference.rays.eye > mine.rays.eye:
        yield pair.at("hit", "yours never asks what it meets", "trace" if step >= 5 else "")
    yield from along(pair)


_BYTES = 3  # by which bytes of right solutions may differ


def _frame(mine: Frame, reference: Frame) -> Iterator[Difference]:
    axes = [
        ("right", mine.right, reference.right),
        ("up", mine.up, reference.up),
        ("forward", mine.forward, reference.forward),
    ]
    for name, axis, right in axes:
        if not same_direction(axis, right):
            words = f"the camera's axis `{name}`: yours is {point(axis)}, the reference's {point(right)}"
            yield Difference(("frame",), words, "view_frame")
    sizes = [
        ("half_width", mine.half_width, reference.half_width),
        ("half_height", mine.half_height, reference.half_height),
    ]
    for name, size, wanted in sizes:
        if not same_number(size, wanted, CLOSE):
            words = f"`{name}` of the window: yours is {size}, the reference's {wanted}"
            yield Difference(("frame",), words, "view_frame")


_TONE = "tone mapping", "tone_map"


def _ending(mine: Record, reference: Record) -> Iterator[Difference]:
    """From the colour to the bytes."""
    if mine.color is not None and mine.mapped is not None and reference.mapped is not None:
        exact = [shown(channel, for_screen=mine.is_of_part_two) for channel in mine.color]
        if diverged(mine.mapped, reference.mapped, exact, CLOSE):
            what, function = ("the curve of a screen", "linear_to_srgb") if mine.is_of_part_two else _TONE
            words = f"{what}: yours makes {point(mine.mapped)} of {point(mine.color)}"
            yield Difference(("mapped",), f"{words}, the reference {point(reference.mapped)}", function)
    words = f"the bytes: yours are {mine.bytes}, the reference's {reference.bytes}"
    for channel, byte in zip(mine.mapped or [], mine.bytes or [], strict=False):
        size = 255 * min(max(as_float(channel), 0.0), 1.0)
        if mine.bytes != reference.bytes and not abs(byte - size) <= 0.51:
            yield Difference(("bytes",), words, "to_byte", f"{size:.2f} was to be rounded to the nearest")
    if not _as_bright(mine, reference, _BYTES) and same_samples(mine.ray, reference.ray):
        yield Difference(("bytes",), words, "", "every part differs by no more than rounding may explain")


def _as_bright(mine: Record, reference: Record, most: int) -> bool:
    """Whether no byte differs by more than that."""
    if mine.bytes is None or reference.bytes is None:
        return mine.bytes is reference.bytes
    return all(abs(a - b) <= most for a, b in zip(mine.bytes, reference.bytes, strict=True))


def _differences(mine: Record, reference: Record) -> Iterator[Difference]:
    yield from _frame(mine.frame, reference.frame)
    yield from ray_differences(mine, reference)
    yield from _ending(mine, reference)


def find_divergence(mine: Record, reference: Record) -> Difference | None:
    """The first difference that rounding does not explain; nothing where the two agree."""
    alike = _as_bright(mine, reference, 1)
    for difference in _differences(mine, reference):
        if not (difference.ill_conditioned and alike):
            return difference
    return None
