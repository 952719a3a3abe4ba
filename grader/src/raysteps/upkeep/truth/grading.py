"""Grades one round: one submission made of the entrants of all steps."""

import tempfile
from collections.abc import Collection
from pathlib import Path

from raysteps.grading.one import grade_one
from raysteps.grading.settings import Settings
from raysteps.kit.built_kit import BuiltKit
from raysteps.sandbox.open_air import OpenAir
from raysteps.submission.intake import Submission
from raysteps.upkeep.truth.rounds import Round
from raysteps.upkeep.truth.verdicts import Seen


def grade_round(kit: BuiltKit, handed_in: Round, *, seed: int, only: Collection[str]) -> list[Seen]:
    """Of the steps that the round grades, those in `only`. The kit's own files need no sandbox, and nobody reads the
    smallest wrong cases."""
    graded = tuple(step for step in handed_in.graded if step in only)
    if not graded:
        return []
    sources = {entrant.step: entrant.source.encode() for entrant in handed_in.entrants}
    settings = Settings(seed=seed, only=graded, feedback="diagnosis", jobs=1)
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        submission = Submission("truth", sources, {})
        results = {result.id: result for result in grade_one(kit, submission, settings, OpenAir(), Path(folder)).steps}
    return [Seen(entrant, results[entrant.step]) for entrant in handed_in.entrants if entrant.step in results]
