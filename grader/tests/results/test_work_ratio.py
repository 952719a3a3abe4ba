"""What a picture cost, and how it compares with the reference."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from export_documents import document, step_result
from page_results import of_older_kit
from rich.console import Console

from raysteps.common.text import mean, size
from raysteps.course.manifest import Step
from raysteps.images.render import read_work
from raysteps.report.terminal import print_details
from raysteps.results.model import Results, StepResult, Work
from raysteps.results.work_ratio import NoWorkRatio, WorkRatio, work_ratio_of

_STATS: dict[str, Any] = {
    "schema": "raysteps/stats/v1",
    "rays": {"eye": 10, "eye_hit": 7, "shadow": 4, "reflect": 3, "refract": 2},
    "surface_tests": 38,
    "box_tests": 190,
    "structure": {"boxes": 5, "references": 20, "bytes": 600},
}


def test_the_statistics_of_a_picture() -> None:
    work = read_work(json.dumps(_STATS).encode())
    assert work == Work(rays=19, surface_tests=38, box_tests=190, boxes=5, references=20, bytes=600)
    assert (work.surfaces_per_ray, work.boxes_per_ray, work.tests_per_ray) == (2, 10, 12)
    assert Work(0, 1, 1, 1, 1, 1).tests_per_ray == 0


@pytest.mark.parametrize(
    "change",
    [
        {"surface_tests": -1},
        {"surface_tests": 1.5},
        {"surface_tests": True},
        {"box_tests": 2**63},
        {"box_tests": "9"},
        {"structure": None},
        {"structure": {"boxes": 1}},
        {"rays": [1, 2]},
    ],
)
def test_what_a_program_makes_up_is_no_work(change: dict[str, Any]) -> None:
    assert read_work(json.dumps({**_STATS, **change}).encode()) is None


@pytest.mark.parametrize("text", [b"", b"[]", b"{", b"\xff", b"[" * 100_000, b"9" * 10_000])
def test_nor_is_what_cannot_be_read(text: bytes) -> None:
    assert read_work(text) is None


def _step(step: Step, *works: tuple[int, int]) -> StepResult:
    """A step; of each picture surface and box tests. The reference has 10 tests per ray."""
    result = step_result(step)
    for image, (surfaces, boxes) in zip(result.images, works, strict=True):
        image.work = Work(100, surfaces, boxes, 9, 20, 4000)
    return result


def test_surfaces_and_boxes_weigh_alike_and_pictures_are_averaged_as_factors(steps: list[Step]) -> None:
    octree = steps[5]
    work_ratio = work_ratio_of(_step(octree, (1900, 100), (100, 1900), (250, 250), (1, 499)), octree.limited_pictures)
    assert isinstance(work_ratio, WorkRatio)
    assert list(work_ratio.pictures.values()) == [2, 2, 0.5, 0.5]
    assert work_ratio.relative == 1
    assert (work_ratio.bytes, work_ratio.reference_bytes) == (16000, 12000)


def test_only_the_pictures_of_the_manifest_count(steps: list[Step]) -> None:
    made = _step(steps[5], (600, 400), (300, 200), (3000, 2000), (300, 200))
    work_ratio = work_ratio_of(made, steps[5].limited_pictures[:2])
    assert isinstance(work_ratio, WorkRatio)
    assert work_ratio.pictures == {"strands-octree": 1, "slivers-octree": 0.5}
    assert work_ratio.bytes == 8000


def _why(result: StepResult, *expected: str) -> str:
    work_ratio = work_ratio_of(result, expected)
    assert isinstance(work_ratio, NoWorkRatio)
    return work_ratio.reason


def test_why_there_is_nothing_to_compare(steps: list[Step]) -> None:
    octree = steps[5]
    right = [(300, 700)] * 4
    half = step_result(octree, share=0.5)
    assert _why(half) == "pictures inside-octree and tetrahedra-octree are not right"
    assert _why(_step(octree, *right[1:], (0, 5))) == "picture tetrahedra-octree: no test of a surface was counted"
    assert _why(_step(octree, (9, 0), *right[1:])).startswith("picture strands-octree: no test of a box was counted")
    assert _why(_step(octree, *right), "other") == "picture other is not in the results"
    assert _why(replace(_step(octree, *right), status="not-started")) == "not started"
    assert _why(step_result(steps[0])) == "no picture has counters"


def test_a_right_picture_that_cost_too_much_is_not_called_wrong(steps: list[Step]) -> None:
    result = _step(steps[5], *[(300, 700)] * 4)
    result.images[1].passed, result.images[1].wrong_share = False, 0.0
    assert _why(result) == "picture slivers-octree is right, but the work that was counted did not pass"


def test_results_of_older_kits_have_no_counters(steps: list[Step]) -> None:
    result = _step(steps[5], *[(300, 700)] * 4)
    result.images[2].work = None
    assert _why(result) == "picture inside-octree has no counters, as when an older kit graded it; grade it again"
    assert of_older_kit(document([result])).steps[0].images[0].work is None


def test_the_report_says_what_the_pictures_cost(steps: list[Step], capsys: pytest.CaptureFixture[str]) -> None:
    results = Results.of("ann", [step_result(steps[0]), step_result(steps[5])])
    print_details(Console(width=200), results, steps, Path("out"), lambda case: case)
    first, octree = capsys.readouterr().out.split("06-octree")
    assert "per ray" not in first
    assert octree.count("per ray 5.0 surfaces and 15.0 boxes tested; the reference: 3.0 and 7.0\n") == 4
    assert octree.count("20 entries in 9 boxes, 4.0 kB; the reference: 20 in 9, 3.0 kB\n") == 4


def test_numbers_are_short() -> None:
    assert [mean(value) for value in (0.25, 8.34, 1234.5)] == ["0.25", "8.3", "1234"]
    assert [size(value) for value in (900, 420_000, 7_500_000, 137_400_000)] == ["0.9 kB", "420 kB", "7.5 MB", "137 MB"]
