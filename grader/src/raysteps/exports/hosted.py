"""Grades one submission on the machine of another system."""

import os
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.process import Outcome, run
from raysteps.common.text import clean, number, shorten
from raysteps.exports.reading import read_results
from raysteps.kit.manifest import Step, choose
from raysteps.kit.project import Project
from raysteps.results.model import Results, StepResult
from raysteps.submission.intake import ARCHIVE_ENDINGS, take_in

_GRADED = (0, 1, 3)  # all passed, checks failed, some step does not build
_MOST_FILES = 200


class NotGraded(Exception):
    """The grader could not do its work; nobody's points are touched."""


@dataclass(frozen=True)
class Options:
    """What the instructor chose when the autograder was made."""

    seconds: float
    steps: tuple[str, ...] = ()
    words: tuple[str, ...] = ()  # for `grade`
    echo: bool = False  # whether what `grade` says is passed on; only where no student reads it


def _one_archive(folder: Path) -> Path | None:
    """The archive in a folder that holds one and no steps: a student who zipped what was to be dropped in."""
    files = [path for path, _ in zip(sorted(folder.iterdir()), range(_MOST_FILES), strict=False)]
    archives = [path for path in files if path.name.lower().endswith(ARCHIVE_ENDINGS) and path.is_file()]
    return archives[0] if len(archives) == 1 and not archives[0].is_symlink() else None


def find_submission(path: Path, steps: list[Step]) -> Path:
    """The folder or archive to grade; UsageError says what is wrong with what was handed in."""
    if not os.access(path, os.R_OK):
        raise NotGraded(f"there is no submission at {path}, or it cannot be read")
    try:
        take_in(path, steps)
    except UsageError:
        archive = _one_archive(path) if path.is_dir() else None
        if archive is None:
            raise
        take_in(archive, steps)
        return archive
    return path


def nothing_handed_in(steps: Sequence[Step], why: str) -> dict[str, Any]:
    """Results for a submission in which no step could be found."""
    results = [
        StepResult(id=step.id, status="not-started", points=0.0, max=step.points, bonus=step.bonus, messages=[why])
        for step in steps
    ]
    return Results("submission", results).to_json()


def _complaint(outcome: Outcome) -> str:
    """What the kit said last about why it gave up."""
    said = [line for line in outcome.stderr.splitlines() if line.startswith("raysteps: ")]
    why = shorten(clean(said[-1].removeprefix("raysteps: ")), 300) if said else ""
    return why or f"the grader ended with exit code {outcome.code}"


def grade_here(project: Project, submission: Path, steps: list[Step], options: Options, work: Path) -> dict[str, Any]:
    """Runs the kit's `grade` in a process of its own and reads what it wrote to the folder."""
    chosen = choose(steps, list(options.steps))
    try:
        found = find_submission(submission, steps)
    except UsageError as error:
        why = str(error).replace(f"{submission}: ", "")
        return nothing_handed_in(chosen, f"Nothing to grade was found in what was handed in: {clean(why)}")
    words: list[str | Path] = [sys.executable, "-P", "-m", "raysteps", "grade", found.resolve(), "--out", work]
    # One step at a time: a container has less than one processor, and says it has all of its machine's.
    words += ["--jobs", "1", *options.words]
    outcome = run(words, seconds=options.seconds, cwd=project.root)
    if options.echo:
        print(clean(outcome.stdout + outcome.stderr, 200_000), file=sys.stderr, flush=True)
    if outcome.timed_out:
        minutes = number(options.seconds / 60)
        unit = "minute" if minutes == "1" else "minutes"
        raise NotGraded(f"grading took more than {minutes} {unit}; some step may run without an end.")
    if outcome.code not in _GRADED:
        raise NotGraded(_complaint(outcome))
    try:
        return read_results(work / "results.json")
    except UsageError as error:
        raise GraderFault(f"grade left no results: {error}") from error


def by_id(steps: Sequence[Step]) -> Mapping[str, Step]:
    """For looking up what the manifests say."""
    return {step.id: step for step in steps}
