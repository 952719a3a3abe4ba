"""Numbers that only a mistake makes: no unit, no end, no number at all. Each is told, and none is a fault of ours."""

import io
import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from inspect_records import ball_record
from rich.console import Console

from raysteps.inspector.divergence import find_divergence
from raysteps.inspector.pixel_page import page_html
from raysteps.inspector.programs import InspectOptions, inspect
from raysteps.inspector.records import Record
from raysteps.inspector.side_by_side import print_trees

Change = Callable[[Record], None]


def _no_window(record: Record) -> None:
    record["frame"] |= {"half_width": "nan", "forward": ["nan", "nan", "nan"]}


def _lost_hit(record: Record) -> None:
    record["ray"]["hit"] |= {"position": ["nan", "nan", "nan"], "normal": ["nan", "nan", "nan"], "distance": "nan"}
    record["ray"]["lights"][0]["rays"][0] |= {"origin": ["nan", "nan", "nan"], "limit": "nan"}
    record["ray"]["color"] = record["color"] = ["nan", "nan", "nan"]


def _normal_of_any_length(record: Record) -> None:
    """The cosine is 900: to the power of 300 that is more than a number can hold."""
    record["ray"]["lights"][0] |= {"r_v": 900.0, "specular": ["inf", "inf", "inf"]}


def _endless_ray(record: Record) -> None:
    record["ray"]["bounces"][0] |= {"direction": ["inf", 0, 0], "origin": ["-inf", 0, 0]}


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
        record["ray"]["hit"]["fill"]["shine"] = 300
    change(mine)
    divergence = find_divergence(mine, reference)
    assert (divergence.function if divergence else None) == function
    drawn = re.search(r'id="data">(.*?)</script>', page_html(mine, reference, divergence), re.DOTALL)
    assert drawn is not None
    assert json.loads(drawn[1], parse_constant=pytest.fail)["mine"]["rays"]
    print_trees(Console(file=io.StringIO(), width=150), mine, reference, divergence)


def test_a_scene_whose_name_is_no_text_can_be_inspected(tmp_path: Path) -> None:
    record: dict[str, Any] = ball_record() | {"scene": "NAME"}
    data = json.dumps(record).encode().replace(b"NAME", b"b\xff.nff")
    (tmp_path / "made.json").write_bytes(data)
    program = tmp_path / "inspect-mine"
    program.write_text(f'#!/bin/sh\nwhile [ "$1" != --json ]; do shift; done\ncp "{tmp_path}/made.json" "$2"\n')
    program.chmod(0o755)
    found = inspect(program, InspectOptions("b.nff", "1", "2", 8))
    assert found.record is not None
    assert "b\ufffd.nff" in page_html(found.record)
