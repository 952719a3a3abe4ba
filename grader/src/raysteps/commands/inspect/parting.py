"""Where two records part first, in the order in which a pixel is computed."""

from collections.abc import Iterator

from raysteps.commands.inspect.expected import tone_mapped
from raysteps.commands.inspect.pair import Difference
from raysteps.commands.inspect.parting_rays import ray_differences
from raysteps.commands.inspect.values import CLOSE, Record, as_float, parted, point, same_direction, same_number

_BYTES = 3  # by which bytes of right solutions may differ


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
    if mine["mapped"] is not None and reference["mapped"] is not None:
        exact = [tone_mapped(channel) for channel in mine["color"]]
        if parted(mine["mapped"], reference["mapped"], exact, CLOSE):
            words = f"tone mapping: yours makes {point(mine['mapped'])} of {point(mine['color'])}"
            yield Difference(("mapped",), f"{words}, the reference {point(reference['mapped'])}", "tone_map")
    words = f"the bytes: yours are {mine['bytes']}, the reference's {reference['bytes']}"
    for channel, byte in zip(mine["mapped"] or [], mine["bytes"] or [], strict=False):
        size = 255 * min(max(as_float(channel), 0.0), 1.0)
        if mine["bytes"] != reference["bytes"] and not abs(byte - size) <= 0.51:
            yield Difference(("bytes",), words, "to_byte", f"{size:.2f} was to be rounded to the nearest")
    if not _as_bright(mine, reference, _BYTES):
        yield Difference(("bytes",), words, "", "every part differs by no more than rounding may explain")


def _as_bright(mine: Record, reference: Record, most: int) -> bool:
    """Whether no byte differs by more than that."""
    if mine["bytes"] is None or reference["bytes"] is None:
        return mine["bytes"] is reference["bytes"]
    return all(abs(a - b) <= most for a, b in zip(mine["bytes"], reference["bytes"], strict=True))


def _differences(mine: Record, reference: Record) -> Iterator[Difference]:
    yield from _frame(mine["frame"], reference["frame"])
    yield from ray_differences(mine, reference)
    yield from _ending(mine, reference)


def find_parting(mine: Record, reference: Record) -> Difference | None:
    """The first difference that rounding does not explain; nothing where the two agree."""
    alike = _as_bright(mine, reference, 1)
    for difference in _differences(mine, reference):
        if not (difference.shaky and alike):
            return difference
    return None
