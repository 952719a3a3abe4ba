"""Grades one round: one submission made of the entrants of all steps."""

import os
import tempfile
from collections.abc import Sequence
from pathlib import Path

from raysteps.grading.one import grade_one
from raysteps.grading.settings import Settings
from raysteps.kit.built_kit import BuiltKit
from raysteps.sandbox.open_air import OpenAir
from raysteps.submission.intake import Submission
from raysteps.upkeep.truth.entrants import Entrant
from raysteps.upkeep.truth.verdicts import Seen


def grade_round(kit: BuiltKit, entrants: Sequence[Entrant], *, seed: int, only: Sequence[str] = ()) -> list[Seen]:
    """The kit's own files need no sandbox. `only`: the steps that are graded."""
    sources = {entrant.step: entrant.source.encode() for entrant in entrants}
    settings = Settings(seed=seed, only=tuple(only), jobs=os.cpu_count() or 1)
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        submission = Submission("truth", sources, {})
        results = {result.id: result for result in grade_one(kit, submission, settings, OpenAir(), Path(folder)).steps}
    return [Seen(entrant, results[entrant.step]) for entrant in entrants if entrant.step in results]
