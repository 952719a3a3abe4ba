"""Differences in what a ray meets."""

from collections.abc import Iterator

from raysteps.commands.inspect.blame import blame_hit, intersect_of
from raysteps.commands.inspect.pair import Difference, Pair, meets, not_unit, same_meeting
from raysteps.commands.inspect.values import as_float, length, point, same_direction, same_point


def hit_differences(pair: Pair) -> Iterator[Difference]:
    mine, reference = pair.mine["hit"], pair.reference["hit"]
    if not same_meeting(mine, reference, pair.close):
        function = blame_hit(pair.mine, pair.reference, pair.accel)
        yield pair.at("hit", f"yours {meets(mine)}, the reference's {meets(reference)}", function)
        return
    if mine is None:
        return
    own = intersect_of(mine["kind"])
    reach = as_float(reference["distance"]) + length(pair.reference["origin"])
    if not same_point(mine["position"], reference["position"], pair.close, reach):
        moved = not same_point(mine["point_at"], reference["point_at"], pair.close, reach)
        words = f"the hit lies at {point(mine['position'])}, the reference's at {point(reference['position'])}"
        yield pair.at("position", words, "point_at" if moved else own)
    if not same_direction(mine["normal"], reference["normal"], 10 * pair.close):
        words = f"the normal is {point(mine['normal'])}, the reference's {point(reference['normal'])}"
        yield pair.at("normal", words, own, not_unit(mine["normal"]))
    for item, name in (("from_outside", "from_outside"), ("fill", "the fill")):
        if mine[item] != reference[item]:
            words = f"{name} of the hit is {_shown(mine[item])}, the reference's {_shown(reference[item])}"
            yield pair.at("hit", words, own)
    if not same_direction(mine["ray_direction"], reference["ray_direction"], 10 * pair.close):
        words = f"ray_direction of the hit is {point(mine['ray_direction'])}"
        yield pair.at("hit", f"{words}, the reference's {point(reference['ray_direction'])}", own)


def _shown(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return "another one" if isinstance(value, dict) else str(value)
