"""What is wrong with a sample of a lamp is told by the point that it took, whichever the reference's took."""

import io
import math
from collections.abc import Callable
from dataclasses import replace

import pytest
from inspect_records import lamp_record
from rich.console import Console

from raysteps.common.documents import convert, plain
from raysteps.inspector.divergence import find_divergence
from raysteps.inspector.model import LampSample, PathStep, Record, Scattered, Triple
from raysteps.inspector.pixel_page import page_html
from raysteps.inspector.side_by_side import print_trees, print_verdict

Change = Callable[[LampSample], None]


def _pdf(lamp: LampSample) -> None:
    lamp.pdf = 2.0


def _turned_round(lamp: LampSample) -> None:
    lamp.normal = [0, 0, 1]


def _not_unit(lamp: LampSample) -> None:
    lamp.normal = [0, 0, -2]


def _off_the_disk(lamp: LampSample) -> None:
    lamp.position = [0, 0, 7]


def _nowhere(lamp: LampSample) -> None:
    lamp.position = ["nan", 0, 8]


def _half_as_bright(lamp: LampSample) -> None:
    lamp.unshadowed = [float(part) / 2 for part in lamp.unshadowed]


def _past_the_lamp(lamp: LampSample) -> None:
    lamp.rays[0].direction = [0, 1, 0]


def _unasked(lamp: LampSample) -> None:
    lamp.rays, lamp.lit = [], False


def _said_to_be_hidden(lamp: LampSample) -> None:
    lamp.lit = False


@pytest.mark.parametrize(
    ("change", "function", "words", "why"),
    [
        (_pdf, "sample_disk", "its pdf is 2 at (0, 0, 8), the reference's 1", "or solid_angle_pdf"),
        (_turned_round, "sample_disk", "its normal is (0, 0, 1), the reference's (0, 0, -1)", ""),
        (_not_unit, "sample_disk", "its normal is (0, 0, -2)", "its length is 2 and not 1"),
        (_off_the_disk, "sample_disk", "yours at (0, 0, 7) with the normal (0, 0, -1) is off", ""),
        (_nowhere, "sample_disk", "yours is at (nan, 0, 8)", ""),
        (_half_as_bright, "sampled_light", "without shadows it brings (0.30", ""),
        (_past_the_lamp, "shadow_ray", "its shadow ray goes towards (0, 1, 0), not to the sample", ""),
        (_unasked, "is_lit", "yours casts no shadow ray", ""),
        (_said_to_be_hidden, "is_lit", "its shadow ray is blocked, the reference's is free", "your ray met nothing"),
    ],
)
def test_the_function_that_gave_a_wrong_sample_is_named(change: Change, function: str, words: str, why: str) -> None:
    mine, reference = lamp_record(), lamp_record()
    change(mine.ray.lamps[0])
    found = find_divergence(mine, reference)
    assert found is not None
    assert (found.place, found.function) == (("eye", "lamp1"), function)
    assert found.words.startswith(f"sample of lamp 1: {words}")
    assert why in found.why
    console = Console(width=160, record=True, file=io.StringIO())
    print_trees(console, mine, reference, found)
    (marked,) = [line for line in console.export_text().splitlines() if line.lstrip().startswith(">")]
    assert "lamp 1: " in marked


def _likelier(lamp: LampSample) -> None:
    lamp.pdf = 1.1


def _from_behind(lamp: LampSample) -> None:
    lamp.position, lamp.normal = [0, 0, -10], [0, 0, -1]


def _beside_the_ball(lamp: LampSample) -> None:
    lamp.position, lamp.normal = [3, 0, -8], [0, 0.6, 0.8]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (_likelier, "its pdf is 1.1 at (0, 0, -8), the reference's 1"),
        (_from_behind, "at (0, 0, -10) its normal (0, 0, -1) points away from the hit"),
        (_beside_the_ball, "yours at (3, 0, -8) with the normal (0, 0.6, 0.8) is off the lamp"),
    ],
)
def test_a_point_of_a_sphere_is_seen_from_the_hit_and_all_are_as_likely(change: Change, words: str) -> None:
    mine = lamp_record()
    change(mine.ray.lamps[1])
    found = find_divergence(mine, lamp_record())
    assert found is not None
    assert (found.place, found.function) == (("eye", "lamp2"), "sample_sphere")
    assert found.words.startswith(f"sample of lamp 2: {words}")


def _brings(lamp: LampSample, cosine: float) -> None:
    """To the surface, by its own density."""
    lamp.unshadowed = [3 * 0.7 / math.pi * max(0.0, cosine) / float(lamp.pdf) * part for part in (0.9, 0.4, 0.1)]
    lamp.brought = list(lamp.unshadowed)


def _at_another_point(record: Record) -> None:
    """A right sample of the same disk, whose area is 49."""
    lamp, shadow = record.ray.lamps[0], record.ray.lamps[0].rays[0]
    way = [3.0, 0.0, 7.0]
    size = math.hypot(*way)
    cosine = way[2] / size
    lamp.position = [3, 0, 8]
    lamp.pdf = size**2 / cosine / 49
    _brings(lamp, cosine)
    shadow.direction = [part / size for part in way]
    record.ray.local = record.ray.color = record.color = list(lamp.brought)
    record.mapped, record.bytes = None, [90, 70, 20]


def test_another_point_is_no_difference_and_told() -> None:
    mine, reference = lamp_record(), lamp_record()
    _at_another_point(mine)
    assert find_divergence(mine, reference) is None
    console = Console(width=160, record=True, file=io.StringIO())
    print_verdict(console, [], mine, reference, None)
    assert "No difference: the samples of lamps took other points, or shadow rays began" in console.export_text()
    assert "by itself. How points and ways are spread one pixel does not show." in page_html(mine, reference)
    same = page_html(reference, lamp_record())
    assert "Both come to the same colour in the same way." in same


def _on_the_wall(record: Record, height: float) -> LampSample:
    """A right sample of a disk of area 4 at x = 5, so high above the hit or below its horizon."""
    lamp = record.ray.lamps[0]
    size = math.hypot(5, height)
    lamp.position, lamp.normal, lamp.pdf = [5, 0, 1 + height], [-1, 0, 0], size**3 / 5 / 4
    _brings(lamp, height / size)
    lamp.rays[0].direction = [5 / size, 0, height / size]
    record.ray.local = record.ray.color = record.color = list(lamp.brought)
    record.mapped, record.bytes = None, [20, 20, 20] if height > 0 else [0, 0, 0]
    if height < 0:
        lamp.lit, lamp.rays = False, []
    return lamp


def test_a_point_below_the_horizon_is_rightly_dark() -> None:
    mine, reference = lamp_record(), lamp_record()
    _on_the_wall(mine, -1.0)
    _on_the_wall(reference, 1.0)
    assert find_divergence(mine, reference) is None
    assert find_divergence(reference, mine) is None
    _on_the_wall(mine := lamp_record(), 0.5).unshadowed = [0, 0, 0]
    found = find_divergence(mine, reference)
    assert found is not None
    assert found.function == "sampled_light"


def _leans(lamp: LampSample) -> None:
    lamp.normal = [0, 0, 1.004]


def _sees_nothing(lamp: LampSample) -> None:
    lamp.position, lamp.normal, lamp.pdf = [0, 0, 0], [0, 0, 0], 0


def _sees_something(lamp: LampSample) -> None:
    lamp.position, lamp.normal, lamp.pdf = [0, 0.001, 1], [0, 0, 1], 0.159


def _sees_little(lamp: LampSample) -> None:
    lamp.position, lamp.normal, lamp.pdf = [4, 0, 1], [0, 0, -1], 1e-7


@pytest.mark.parametrize(
    ("number", "mine", "reference"),
    [
        (1, _leans, lambda _: None),  # a solution that divides by the radius
        (1, _sees_nothing, _sees_something),
        (1, _sees_something, _sees_nothing),
        (0, _sees_little, _sees_nothing),
    ],
)
def test_what_rounding_decides_is_no_difference(number: int, mine: Change, reference: Change) -> None:
    """The hit lies on the lamp itself, or the ball is small."""
    records = [lamp_record(), lamp_record()]
    for record, change in zip(records, (mine, reference), strict=True):
        change(record.ray.lamps[number])
        for lamp in record.ray.lamps:
            lamp.unshadowed, lamp.lit, lamp.brought, lamp.rays = [0, 0, 0], False, [0, 0, 0], []
            lamp.radiance = [0, 0, 0]
    assert find_divergence(*records) is None


def test_a_lamp_that_all_or_none_see_is_held_against_the_reference() -> None:
    for lit, other in ((_sees_nothing, _likelier), (_likelier, _sees_nothing)):
        mine, reference = lamp_record(), lamp_record()
        lit(mine.ray.lamps[1])
        other(reference.ray.lamps[1])
        found = find_divergence(mine, reference)
        assert found is not None
        assert (found.place, found.function) == (("eye", "lamp2"), "sample_sphere")


def test_an_edge_that_one_of_two_right_starts_gets_past_is_no_difference() -> None:
    mine, reference = lamp_record(lit=False), lamp_record()
    mine.ray.lamps[0].rays[0].origin = [0, 0, 1.002]
    assert find_divergence(mine, reference) is None
    hit = mine.ray.lamps[0].rays[0].hit
    assert hit is not None
    hit.distance = 6.99  # of the lamp itself
    found = find_divergence(mine, reference)
    assert found is not None
    assert found.function == "shadow_ray"


def test_along_a_path_other_points_bring_another_colour() -> None:
    mine, reference = lamp_record(), lamp_record()
    for record in (mine, reference):
        record.step, record.ray.local, record.ray.direct = 13, None, None
        record.ray.path = PathStep(lamps=record.ray.lamps[0].brought, scatter=None)
    mine.ray.color = mine.color = [0.1, 0.1, 0.1]
    found = find_divergence(mine, reference)
    assert found is not None
    assert (found.place, found.function) == (("eye", "color"), "path_light")
    _at_another_point(mine)
    mine.ray.local = None
    assert find_divergence(mine, reference) is None


def _on_a_path(record: Record, direction: Triple, weight: float = 0.5, pdf: float = 0.2) -> None:
    """It goes on from the first hit, and meets nothing."""
    record.step, record.ray.local, record.ray.direct = 13, None, None
    scatter = Scattered(direction=direction, weight=[weight] * 3, pdf=pdf, specular=False)
    record.ray.path = PathStep(lamps=record.ray.lamps[0].brought, scatter=scatter)
    way = replace(record.ray, role="reflect", depth=2, direction=direction, hit=None, lamps=[], lights=[], path=None)
    start = record.ray.lamps[0].rays[0].origin
    record.ray.bounces = [replace(way, origin=start, color=[0, 0, 0], bounces=[])]


def test_a_path_may_go_another_way_and_a_wrong_weight_is_found() -> None:
    reference = lamp_record()
    _on_a_path(reference, [0, 0.6, 0.8])
    along: Triple = [0, 0.6, 0.8]
    elsewhere: Triple = [0.6, 0, 0.8]
    for direction, numbers, function in (
        (along, (0.5, 0.2), None),
        (elsewhere, (0.5, 0.2), None),
        (along, (0.7, 0.2), "scatter_diffuse"),
        (along, (0.5, 0.63), "scatter_diffuse"),
    ):
        mine = lamp_record()
        _on_a_path(mine, direction, *numbers)
        found = find_divergence(mine, reference)
        assert (None if found is None else found.function) == function


def test_a_wrong_pdf_at_another_point_is_found() -> None:
    mine = lamp_record()
    _at_another_point(mine)
    mine.ray.lamps[0].pdf = 1.0
    found = find_divergence(mine, lamp_record())
    assert found is not None
    assert found.function == "sample_disk"


def test_records_of_before_have_no_lamps() -> None:
    document = plain(lamp_record())
    assert isinstance(document, dict)
    del document["ray"]["lamps"], document["ray"]["lamps_beyond"]
    record = convert(document, Record)
    assert record.ray.lamps == []
    assert find_divergence(record, record) is None
