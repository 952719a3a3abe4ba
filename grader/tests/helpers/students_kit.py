"""A students' kit with all steps, which is built once for the tests that need it."""

from pathlib import Path

import pytest

from raysteps.course.manifest import Step
from raysteps.release.build_release import write_release
from raysteps.toolchain.kit_artifacts import BuiltKit


@pytest.fixture(scope="session")
def students_kit(kit: BuiltKit, steps: list[Step], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Whoever asks for it writes the steps first: they are as the test before left them. All such tests are of the
    group "students_kit", so that they share it."""
    folder = tmp_path_factory.mktemp("course") / "kit"
    write_release(kit, steps, "Graphics 101", folder)
    return folder
