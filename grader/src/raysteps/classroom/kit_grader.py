"""The grader of a class: the kit of this machine, with its strongest sandbox."""

import os
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from raysteps.classroom.jobs import ProgressCallback
from raysteps.course.project import here
from raysteps.grading.options import Settings
from raysteps.grading.pipeline import grade_submission
from raysteps.sandbox.detect import find_sandbox
from raysteps.submission.load import Submission
from raysteps.toolchain.build_kit import build_kit


class KitGrader:
    """Grades as `grade` does."""

    def __init__(self, *, require_sandbox: bool, say: ProgressCallback) -> None:
        self._sandbox = find_sandbox(require=require_sandbox)
        self._kit = build_kit(here(), say)
        self.fingerprint = self._kit.fingerprint
        self.isolation = self._sandbox.isolation

    def grade(self, submission: Submission, settings: Mapping[str, Any], out: Path, say: ProgressCallback) -> None:
        wanted = Settings(
            seed=settings["seed"],
            only=tuple(settings["only"]),
            feedback=settings["feedback"],
            limits=settings["limits"],
        )
        with suppress(OSError):
            os.utime(self._kit.folder)  # kits that were not used for long are deleted when another one is built
        grade_submission(self._kit, submission, wanted, self._sandbox, out, say)


def make(*, require_sandbox: bool, say: ProgressCallback) -> KitGrader:
    """As `graders.make_grader` expects it."""
    return KitGrader(require_sandbox=require_sandbox, say=say)
