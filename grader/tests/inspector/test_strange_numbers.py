"""Numbers that only a mistake makes: no unit, no end, no number at all. Each is told, and none is a fault of ours."""

import io
import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from inspect_records import ball_record
from rich.console import Console

from raysteps.cli.inspect import InspectOptions, inspect
from raysteps.common.documents import Malformed, as_text, convert, plain
from raysteps.inspector.divergence import find_divergence
from raysteps.inspector.model import Record
from raysteps.inspector.pixel_page import page_html
from raysteps.inspector.side_by_side import print_trees

Change = Callable[[Record], None]


def _no_window(record: Record) -> None:
    record.frame.half_width = "nan"
    record.frame.forward = ["nan", "nan", "nan"]


def _lost_hit(record: Record) -> None:
    hit, shadow = record.ray.hit, record.ray.lights[0].rays[0]
    assert hit is not None
    hit.distance = shadow.limit = "nan"
    hit.position = hit.normal = shadow.origin = ["nan", "nan", "nan"]
    record.ray.color = record.color = ["nan", "nan", "nan"]


def _normal_of_any_length(record: Record) -> None:
    """The cosine is 900: to the power of 300 that is more than a number can hold."""
    record.ray.lights[0].r_v = 900.0
    record.ray.lights[0].specular = ["inf", "inf", "inf"]


def _endless_ray(record: Record) -> None:
    record.ray.bounces[0].direction = ["inf", 0, 0]
    record.ray.bounces[0].origin = ["-inf", 0, 0]


@pytest.mark.parametrize(
    ("change", "function"),
    [
        (_no_window, "view_frame"),
        (_lost_hit, "Sphere::intersect"),
        (_normal_of_any_length, None),
        (_endless_ray, "reflected_ray"),
    ],
)
def test_it_is_compared_and_drawn_all_the_same(change: Change, function: str | None) -> None:
    mine, reference = ball_record(), ball_record()
    for record in (mine, reference):
        assert record.ray.hit is not None
        record.ray.hit.fill.shine = 300
    change(mine)
    divergence = find_divergence(mine, reference)
    assert (divergence.function if divergence else None) == function
    drawn = re.search(r'id="data">(.*?)</script>', page_html(mine, reference, divergence), re.DOTALL)
    assert drawn is not None
    assert json.loads(drawn[1], parse_constant=pytest.fail)["mine"]["rays"]
    print_trees(Console(file=io.StringIO(), width=150), mine, reference, divergence)


@pytest.mark.parametrize(
    ("change", "place"),
    [
        ({"more": 1}, "$: unknown key 'more'"),
        ({"camera": {"at": [0, 0, 0]}}, "$.camera: object missing required field"),
        ({"background": [0, 0]}, "$.background: expected array of length >= 3"),
        ({"mapped": [0, 0, "none"]}, "$.mapped[2]: invalid enum value 'none'"),
        ({"counts": {}}, "$.counts: object missing required field box_tests"),
    ],
)
def test_what_is_no_record_is_refused_with_the_place(change: dict[str, object], place: str) -> None:
    document = plain(ball_record())
    assert isinstance(document, dict)
    with pytest.raises(Malformed, match=re.escape(place)):
        convert(document | change, Record)
    camera = document["camera"] | {"more": 1}
    with pytest.raises(Malformed, match=r"\$\.camera: unknown key 'more'; known are from, at"):
        convert(document | {"camera": camera}, Record)


def test_a_scene_whose_name_is_no_text_can_be_inspected(tmp_path: Path) -> None:
    data = as_text(replace(ball_record(), scene="NAME")).encode().replace(b"NAME", b"b\xff.nff")
    (tmp_path / "made.json").write_bytes(data)
    program = tmp_path / "inspect-mine"
    program.write_text(f'#!/bin/sh\nwhile [ "$1" != --json ]; do shift; done\ncp "{tmp_path}/made.json" "$2"\n')
    program.chmod(0o755)
    found = inspect(program, InspectOptions("b.nff", "1", "2", 8))
    assert found.record is not None
    assert "b\ufffd.nff" in page_html(found.record)
