"""Differences in the light that a hit sends by itself."""

from collections.abc import Iterator

from raysteps.commands.inspect import expected
from raysteps.commands.inspect.blame import blame_shadow
from raysteps.commands.inspect.pair import Difference, Pair, not_unit, surface_name
from raysteps.commands.inspect.values import (
    CLOSE,
    Record,
    as_float,
    brief,
    length,
    minus,
    parted,
    point,
    same_color,
    same_direction,
    told,
)


def _verdict(light: Record) -> str:
    if light["lit"]:
        return "is free"
    rays = light["rays"]
    if not rays:
        return "was never cast, and the light is said to be hidden"
    hit = rays[-1]["hit"]
    return "is blocked" if hit is None else f"is blocked by {surface_name(hit)} at distance {brief(hit['distance'])}"


def _shadow(pair: Pair, mine: Record, reference: Record) -> Iterator[Difference]:
    """The shadow ray of one light, in both records."""
    number = reference["light"] + 1
    item = f"light{number}"
    name = f"shadow ray to light {number}"
    verdict = f"{name}: yours {_verdict(mine)}, the reference's {_verdict(reference)}"
    if not reference["rays"]:
        return
    if not mine["rays"]:
        if mine["lit"] != reference["lit"]:
            yield pair.at(item, verdict, "is_lit", "yours casts no shadow ray")
        return
    own, theirs = mine["rays"][-1], reference["rays"][-1]
    room = 0.03 / max(1e-3, length(minus(_light_end(reference, theirs), theirs["origin"])))
    if not same_direction(own["direction"], theirs["direction"], 10 * pair.close + min(room, 0.1)):
        words = f"{name}: yours goes towards {point(own['direction'])}"
        words += f", the reference's towards {point(theirs['direction'])}"
        strayed = not same_direction(own["direction"], mine["shadow_ray"]["direction"], 10 * pair.close)
        why = "your shadow_ray gives another direction" if strayed else not_unit(own["direction"])
        yield pair.at(item, words, "is_lit" if strayed else "shadow_ray", why)
    if mine["lit"] == reference["lit"]:
        return
    function, why = blame_shadow(own, theirs, pair.mine["hit"], pair.accel, lit=mine["lit"])
    yield pair.at(item, verdict, function, why)


def _light_end(light: Record, ray: Record) -> list[float]:
    """A point far enough along the ray to stand for the light."""
    limit = ray["limit"] if isinstance(ray["limit"], int | float) else 1.0
    return [as_float(a) + limit * as_float(b) for a, b in zip(ray["origin"], light["to_light"], strict=True)]


def _terms(pair: Pair, mine: Record, reference: Record) -> Iterator[Difference]:
    number = reference["light"] + 1
    item, hit, source = f"terms{number}", pair.mine["hit"], pair.lights[reference["light"]]
    turned = expected.mirrored([-as_float(value) for value in mine["to_light"]], hit["normal"])
    if not (same_direction(mine["mirrored"], reference["mirrored"]) or same_direction(mine["mirrored"], turned)):
        words = f"light {number}: its mirrored direction is {point(mine['mirrored'])}"
        yield pair.at(item, f"{words}, the reference's {point(reference['mirrored'])}", "mirror")
    for term, right in (("diffuse", expected.diffuse), ("specular", expected.specular)):
        if parted(mine[term], reference[term], right(hit, mine, source), 10 * CLOSE):
            words = f"light {number}: the {term} term is {point(mine[term])}, the reference's {point(reference[term])}"
            yield pair.at(item, words, term)


def light_differences(pair: Pair) -> Iterator[Difference]:
    """Each light, then their sum."""
    mine, reference = pair.mine, pair.reference
    own = {light["light"]: light for light in mine["lights"]}
    agree = same_color(mine["direct"], reference["direct"], 10 * pair.close)
    for light in reference["lights"]:
        if light["light"] in own and not agree:
            yield from _shadow(pair, own[light["light"]], light)
    for light in reference["lights"]:
        if light["light"] in own:
            yield from _terms(pair, own[light["light"]], light)
    if parted(mine["direct"], reference["direct"], expected.direct(mine["lights"]), 10 * CLOSE):
        words = f"the sum over the lights is {told(mine['direct'])}, the reference's {told(reference['direct'])}"
        yield pair.at("direct", words, "shade")
