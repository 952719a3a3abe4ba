"""What is wrong with a sample of a lamp is told by the point that it took, whichever the reference's took."""

import io
import math
from collections.abc import Callable

import pytest
from inspect_records import lamp_record
from rich.console import Console

from raysteps.common.documents import convert, plain
from raysteps.inspector.divergence import find_divergence
from raysteps.inspector.model import LampSample, Record
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


def _at_another_point(record: Record) -> None:
    """A right sample of the same disk, whose area is 49."""
    lamp, shadow = record.ray.lamps[0], record.ray.lamps[0].rays[0]
    way = [3.0, 0.0, 7.0]
    size = math.hypot(*way)
    cosine = way[2] / size
    lamp.position = [3, 0, 8]
    lamp.pdf = size**2 / cosine / 49
    lamp.unshadowed = lamp.brought = [3 * 0.7 / math.pi * cosine / lamp.pdf * part for part in (0.9, 0.4, 0.1)]
    shadow.direction = [part / size for part in way]
    record.ray.local = record.ray.color = record.color = list(lamp.brought)
    record.mapped, record.bytes = None, [90, 70, 20]


def test_another_point_is_no_difference_and_told() -> None:
    mine, reference = lamp_record(), lamp_record()
    _at_another_point(mine)
    assert find_divergence(mine, reference) is None
    console = Console(width=160, record=True, file=io.StringIO())
    print_verdict(console, [], mine, reference, None)
    assert "No difference: the samples of lamps took other points, as they may" in console.export_text()
    assert "The samples of lamps took other points, as they may" in page_html(mine, reference)
    same = page_html(reference, lamp_record())
    assert "Both come to the same colour in the same way." in same


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
