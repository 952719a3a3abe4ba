"""The manifests agree with each other, with the sources and with the design."""

import re

import pytest

from raysteps.common.errors import GraderFault, UsageError
from raysteps.course.manifest import Step, choose, read_step
from raysteps.course.project import Project

pytestmark = pytest.mark.portable


def test_points_sum_to_100_and_a_bonus_of_20(steps: list[Step]) -> None:
    assert [step.points for step in steps] == [10, 20, 15, 10, 15, 20, 10, 10, 10]
    assert [step.bonus for step in steps] == [False] * 7 + [True] * 2


def test_every_step_has_three_hints_and_pictures(steps: list[Step]) -> None:
    for step in steps:
        assert len(step.hints) == 3, step.id
        assert step.images, step.id
        assert len({image.name for image in step.images}) == len(step.images)


def test_files_that_manifests_name_exist(project: Project, steps: list[Step]) -> None:
    for step in steps:
        assert (project.steps / step.path).is_file()
        for image in step.images:
            assert (project.root / image.scene).is_file(), image.scene
            assert re.fullmatch(r"[a-z0-9-]+", image.name)


@pytest.mark.parametrize("name", ["02", "2", "02-intersection"])
def test_a_step_has_three_names(steps: list[Step], name: str) -> None:
    assert [step.id for step in choose(steps, [name])] == ["02-intersection"]


def test_no_name_is_every_step_and_order_is_kept(steps: list[Step]) -> None:
    assert choose(steps, []) == steps
    assert [step.number for step in choose(steps, ["5", "01", "5"])] == ["01", "05"]


@pytest.mark.parametrize("name", ["0", "10", "02-", "intersection", "²", "-1"])
def test_an_unknown_step_is_refused(steps: list[Step], name: str) -> None:
    with pytest.raises(UsageError, match="there is no step"):
        choose(steps, [name])


def test_a_bad_manifest_is_the_kits_fault(project: Project) -> None:
    with pytest.raises(GraderFault):
        read_step(project.root / "CMakeLists.txt")
