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
    if mine["from_outside"] != reference["from_outside"]:
        told = "is true, the reference's false" if mine["from_outside"] else "is false, the reference's true"
        yield pair.at("position", f"from_outside of the hit {told}", own)
    if mine["fill"] != reference["fill"]:
        yield pair.at("hit", "the fill of the hit is not that of the surface", own)
    if not same_direction(mine["ray_direction"], reference["ray_direction"], 10 * pair.close):
        words = f"ray_direction of the hit is {point(mine['ray_direction'])}"
        yield pair.at("hit", f"{words}, the reference's {point(reference['ray_direction'])}", own)
