"""Where two records part first, in the order in which a pixel is computed."""

from collections.abc import Iterator

from raysteps.commands.inspect.pair import Difference
from raysteps.commands.inspect.parting_rays import ray_differences
from raysteps.commands.inspect.values import CLOSE, Record, as_float, point, same_color, same_direction, same_number


def _frame(mine: Record, reference: Record) -> Iterator[Difference]:
    for name in ("right", "up", "forward"):
        if not same_direction(mine[name], reference[name]):
            words = (
                f"the camera's axis `{name}`: yours is {point(mine[name])}, the reference's {point(reference[name])}"
            )
            yield Difference(("frame",), words, "view_frame")
    for name in ("half_width", "half_height"):
        if not same_number(mine[name], reference[name], CLOSE):
            words = f"`{name}` of the image plane: yours is {mine[name]}, the reference's {reference[name]}"
            yield Difference(("frame",), words, "view_frame")


def _ending(mine: Record, reference: Record) -> Iterator[Difference]:
    """From the colour to the bytes."""
    if not same_color(mine["mapped"], reference["mapped"], CLOSE):
        words = f"tone mapping: yours makes {point(mine['mapped'])} of {point(mine['color'])}"
        yield Difference(("mapped",), f"{words}, the reference {point(reference['mapped'])}", "tone_map")
    if mine["mapped"] is not None and mine["bytes"] != reference["bytes"]:
        for channel, byte in zip(mine["mapped"], mine["bytes"], strict=True):
            exact = 255 * min(max(as_float(channel), 0.0), 1.0)
            if not abs(byte - exact) <= 0.51:
                words = f"the bytes: yours are {mine['bytes']}, the reference's {reference['bytes']}"
                yield Difference(("bytes",), words, "to_byte", f"{exact:.2f} was to be rounded to the nearest")


def _differences(mine: Record, reference: Record) -> Iterator[Difference]:
    yield from _frame(mine["frame"], reference["frame"])
    yield from ray_differences(mine, reference)
    yield from _ending(mine, reference)


def find_parting(mine: Record, reference: Record) -> Difference | None:
    """The first difference that rounding does not explain; nothing where the two agree."""
    return next(_differences(mine, reference), None)
