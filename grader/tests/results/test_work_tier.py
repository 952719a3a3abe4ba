"""Which tier a tree reaches, by counted work."""

from dataclasses import replace
from pathlib import Path

import pytest
from export_documents import step_result
from rich.console import Console

from raysteps.course.manifest import Step
from raysteps.report.terminal import print_details
from raysteps.results.model import Results, StepResult, Work
from raysteps.results.work_ratio import work_tier

pytestmark = pytest.mark.portable


@pytest.fixture
def octree(steps: list[Step]) -> Step:
    """With tiers at 90, 30 (half way, by factors), 10.2 and 9.8 tests per ray."""
    step = steps[5]
    first, *others = step.images
    return replace(step, images=(replace(first, paper_tests=90.0), *others))


def _work(tests: int, boxes: int) -> Work:
    return Work(rays=100, surface_tests=tests, box_tests=boxes, boxes=1, references=1, bytes=1)


def _result(step: Step, tests: int, boxes: int) -> StepResult:
    result = step_result(step)
    for image in result.images:
        image.work, image.reference_work = _work(tests, boxes), _work(400, 600)
    return result


@pytest.mark.parametrize(
    ("tests", "boxes", "name"),
    [
        (9000, 1, "not yet the paper's 64 boxes, which ask each surface once"),
        (8500, 500, "the paper's 64 boxes"),
        (2500, 501, "the paper's 64 boxes"),
        (2500, 500, "a good tree"),
        (421, 600, "a good tree"),
        (420, 600, "as good as the reference"),
        (381, 600, "as good as the reference"),
        (380, 600, "better than the reference"),
    ],
)
def test_surfaces_and_boxes_decide_alike(octree: Step, tests: int, boxes: int, name: str) -> None:
    tier = work_tier(_result(octree, tests, boxes), octree)
    assert tier is not None
    assert (tier.name, tier.picture) == (name, octree.images[0].name)
    assert tier.tests_per_ray == (tests + boxes) / 100


def test_what_is_wrong_or_was_not_counted_wins_nothing(octree: Step, steps: list[Step]) -> None:
    wrong = _result(octree, 100, 100)
    wrong.images[0].passed = False
    assert work_tier(wrong, octree) is None
    uncounted = _result(octree, 100, 100)
    uncounted.images[0].work = None
    assert work_tier(uncounted, octree) is None
    assert work_tier(_result(octree, 100, 0), octree) is None, "boxes that were not asked by box.hit"
    assert work_tier(step_result(steps[0]), steps[0]) is None


def test_only_steps_about_trees_have_tiers_and_the_paper_is_worse_than_good(steps: list[Step]) -> None:
    for step in steps:
        cases = [case for case in step.images if case.paper_tests is not None]
        assert len(cases) == step.is_about_a_tree, step.id


def test_it_is_printed(octree: Step, capsys: pytest.CaptureFixture[str]) -> None:
    results = Results.of("ann", [_result(octree, 380, 600)])
    print_details(Console(width=200), results, [octree], Path("out"), lambda case: case)
    text = capsys.readouterr().out
    assert "  tree     better than the reference: 9.8 tests per ray in strands-octree\n" in text
    assert "the paper's 64 boxes 90.0, a good tree 30.0, as good as the reference 10.2, better than" in text
