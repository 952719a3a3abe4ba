"""The grader of a class: the kit of this machine, with its strongest sandbox."""

import os
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from raysteps.course.mutants import read_mutants
from raysteps.course.project import here
from raysteps.diagnosis.mutant_fingerprints import mutant_fingerprints
from raysteps.grading.pipeline import grade_submission
from raysteps.judge.plan import read_plan
from raysteps.results.model import Settings
from raysteps.sandbox.detect import find_sandbox
from raysteps.submission.load import Submission
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.kit_artifacts import ProgressCallback


class KitGrader:
    """Grades as `grade` does."""

    def __init__(self, *, require_sandbox: bool, say: ProgressCallback) -> None:
        self._sandbox = find_sandbox(require=require_sandbox)
        self._kit = build_kit(here(), say)
        self.fingerprint = self._kit.fingerprint
        self.isolation = self._sandbox.isolation

    def learn(self, steps: Sequence[str], say: ProgressCallback) -> None:
        """What the known mistakes answer: each process that grades would be silent about it."""
        project = self._kit.project
        for step in (step for step in self._kit.steps if step.id in steps):
            mutant_fingerprints(self._kit, step, read_plan(project, step), read_mutants(project, step), say)

    def grade(self, submission: Submission, settings: Settings, out: Path, say: ProgressCallback) -> None:
        with suppress(OSError):
            os.utime(self._kit.folder)  # kits that were not used for long are deleted when another one is built
        grade_submission(self._kit, submission, settings, self._sandbox, out, say)


def make(*, require_sandbox: bool, say: ProgressCallback) -> KitGrader:
    """As `jobs.make_grader` expects it."""
    return KitGrader(require_sandbox=require_sandbox, say=say)
