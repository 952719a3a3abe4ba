"""What the reference leaves behind for students: its pictures, and the names of its tests."""

from pathlib import Path

from raysteps.kit.built_kit import BuiltKit
from raysteps.kit.given_tests import write_given_tests
from raysteps.kit.manifest import Step
from raysteps.kit.project import Project
from raysteps.programs.given_pictures import write_given
from raysteps.programs.rendering import reference_picture, reference_work


def write_all_given(kit: BuiltKit, steps: list[Step], folder: Path) -> None:
    """Writes folder/reference/."""
    target = Project(folder)
    for step in steps:
        for case in step.images:
            scene = kit.project.root / case.scene
            pixels = reference_picture(kit, scene, case.args)
            work = reference_work(kit, scene, case.args) if case.max_share is not None else None
            write_given(target, step, case, scene, pixels, work)
    tests = {step.id: {name: sorted(tags) for name, tags in kit.tests[step.id].items()} for step in steps}
    write_given_tests(target, tests)
