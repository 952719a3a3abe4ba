"""Differences between two rays and all that follow from them."""

from collections.abc import Iterator
from dataclasses import replace

from raysteps.commands.inspect import expected
from raysteps.commands.inspect.blame import blame_bounce, start_problem
from raysteps.commands.inspect.pair import EYE, Difference, Pair, not_unit
from raysteps.commands.inspect.parting_hit import hit_differences
from raysteps.commands.inspect.parting_lights import light_differences
from raysteps.commands.inspect.values import (
    CLOSE,
    Record,
    coarser,
    dot,
    parted,
    point,
    same_color,
    same_direction,
    same_point,
    told,
)


def _bounces(ray: Record, *roles: str) -> list[Record]:
    return [bounce for bounce in ray["bounces"] if bounce["role"] in roles]


def _follows(bounce: Record, hit: Record, kind: str) -> bool:
    """Whether the ray goes where the contract sends it from this hit."""
    right = expected.refracted(hit) if kind == "refract" else None
    mirrors = right is None
    right = right or expected.mirrored(hit["ray_direction"], hit["normal"])
    wanted = "reflect" if kind == "reflect" else "internal" if mirrors else "refract"
    return bounce["role"] == wanted and same_direction(bounce["direction"], right)


def _bounced(pair: Pair, mine: Record, reference: Record, kind: str) -> Iterator[Difference]:
    """One ray that goes on from the hit, in both records."""
    glass = kind == "refract"
    name = f"the {'refracted' if glass else 'reflected'} ray, depth {reference['depth']}"
    close = coarser(mine, reference)
    child = replace(pair, mine=mine, reference=reference, place=(*pair.place, kind), name=name, close=close)
    whole, part, own = ("transmitted_ray", "refract", "refracted") if glass else ("reflected_ray", "mirror", "mirrored")
    right = _follows(mine, pair.mine["hit"], kind)
    if mine["role"] != reference["role"] or not same_direction(mine["direction"], reference["direction"]):
        function = blame_bounce(mine, pair.mine["hit"][own], pair.reference["hit"][own], whole, part)
        if not right:
            yield Difference(
                (*child.place, "ray"), f"{name}: {_ways(mine, reference)}", function, not_unit(mine["direction"])
            )
        if mine["role"] != reference["role"]:
            return
    side = 1 if dot(reference["direction"], pair.reference["hit"]["normal"]) > 0 else -1
    problem = start_problem(mine, pair.mine["hit"], side)
    if problem and "itself" not in problem:
        yield Difference((*child.place, "ray"), f"{name}: yours begins at {point(mine['origin'])}", whole, problem)
    for below in along(child):
        if problem and below.place == (*child.place, "hit"):
            yield below._replace(function=whole, why=problem, shaky=False)
        else:
            yield below


def _ways(mine: Record, reference: Record) -> str:
    if mine["role"] != reference["role"]:
        told = {"refract": "passes into or out of the glass", "internal": "is mirrored inside it"}
        return f"yours {told[mine['role']]}, the reference's {told[reference['role']]}"
    return f"yours goes towards {point(mine['direction'])}, the reference's towards {point(reference['direction'])}"


def _kind_of_bounces(pair: Pair, kind: str, *roles: str) -> Iterator[Difference]:
    mine, reference = _bounces(pair.mine, *roles), _bounces(pair.reference, *roles)
    for own, theirs in zip(mine, reference, strict=False):
        yield from _bounced(pair, own, theirs, kind)
    if len(mine) == len(reference) or same_color(pair.mine["color"], pair.reference["color"], 10 * pair.close):
        return
    function = "transmitted_light" if kind == "refract" else "trace"
    word = "refracted" if kind == "refract" else "reflected"
    depth = (mine + reference)[min(len(mine), len(reference))]["depth"]
    if len(mine) < len(reference):
        yield pair.at("color", f"yours sends no {word} ray, the reference does (depth {depth})", function)
    else:
        yield pair.at(kind, f"yours sends a {word} ray (depth {depth}), the reference sends none", "trace")


def along(pair: Pair) -> Iterator[Difference]:
    """From the search of one ray to its colour, in the order of computing."""
    mine, reference = pair.mine, pair.reference
    if mine["depth"] != reference["depth"]:
        function = "trace" if mine["role"] == "reflect" else "transmitted_light"
        yield pair.at("ray", f"yours has depth {mine['depth']}, the reference's {reference['depth']}", function)
    if pair.step > 1:
        yield from hit_differences(pair)
    if (mine["hit"] is None) != (reference["hit"] is None):
        return
    if (mine["local"] is None) != (reference["local"] is None):
        asks = "yours does not ask for the light of the hit" if mine["local"] is None else "yours asks for light"
        yield pair.at("color", f"{asks}, the reference does{'' if mine['local'] is None else ' not'}", "trace")
        return
    if mine["local"] is not None:
        yield from light_differences(pair)
    yield from _kind_of_bounces(pair, "refract", "refract", "internal")
    through = expected.brought(mine, "transmittance", "refract", "internal")
    if parted(mine["transmitted"], reference["transmitted"], through, 10 * CLOSE):
        words = f"what shines through is {told(mine['transmitted'])}"
        yield pair.at("transmitted", f"{words}, the reference's {told(reference['transmitted'])}", "transmitted_light")
    yield from _kind_of_bounces(pair, "reflect", "reflect")
    whole = expected.added(mine["local"], expected.brought(mine, "ks", "reflect")) if pair.step >= 5 else None
    if not expected.is_unseen(mine) and parted(mine["color"], reference["color"], whole, 10 * CLOSE):
        words = f"the colour of the ray is {told(mine['color'])}, the reference's {told(reference['color'])}"
        yield pair.at("color", words, "trace" if pair.step >= 5 else "")


def ray_differences(mine: Record, reference: Record) -> Iterator[Difference]:
    """From the eye ray on."""
    own, theirs = mine["ray"], reference["ray"]
    step, accel, lights = (reference[name] for name in ("step", "accel", "lights"))
    pair = Pair(own, theirs, (EYE,), "the eye ray", CLOSE, step, accel, lights)
    if not same_direction(own["direction"], theirs["direction"]):
        words = f"yours goes towards {point(own['direction'])}, the reference's towards {point(theirs['direction'])}"
        yield pair.at("ray", words, "primary_ray", not_unit(own["direction"]))
    if not same_point(own["origin"], theirs["origin"], CLOSE, 0.0):
        yield pair.at(
            "ray",
            f"yours begins at {point(own['origin'])}, the reference's at {point(theirs['origin'])}",
            "primary_ray",
        )
    if reference["rays"]["eye"] > mine["rays"]["eye"]:
        yield pair.at("hit", "yours never asks what it meets", "trace" if step >= 5 else "")
    yield from along(pair)
