"""The part of each autograder that runs on the other system's machine: grade, convert, write."""

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault, RaystepsError, UsageError
from raysteps.common.process import run
from raysteps.common.text import clean
from raysteps.exports.autolab import as_lines, to_autolab
from raysteps.exports.formats import remove, validate, write
from raysteps.exports.github import output_line, to_classroom50, to_legacy
from raysteps.exports.gradescope import Visibility, not_graded, submitters, to_gradescope
from raysteps.exports.hosted import NotGraded, Options, by_id, grade_here
from raysteps.exports.prairielearn import not_gradable, to_prairielearn
from raysteps.exports.summary import summary
from raysteps.exports.wording import harmless_log
from raysteps.kit.manifest import Step, read_steps
from raysteps.kit.project import Project

_GIT_SECONDS = 30

Deliver = Callable[[Mapping[str, Any], Mapping[str, Step], Path], None]


def _grade(project: Project, submission: Path, options: Options, deliver: Deliver) -> str:
    """Grades and delivers; returns why not, if not."""
    try:
        steps = read_steps(project)
        with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
            work = Path(folder)
            document = grade_here(project, submission, steps, options, work)
            deliver(document, by_id(steps), work)
    except (RaystepsError, NotGraded, OSError, subprocess.SubprocessError) as error:
        print(f"raysteps: {harmless_log(clean(str(error)))}", file=sys.stderr)
        return str(error)
    return ""


def gradescope(project: Project, root: Path, options: Options, hidden: Visibility) -> int:
    """ROOT/submission to ROOT/results/results.json, as in Gradescope's container."""
    path = root / "results" / "results.json"
    names = submitters(root / "submission_metadata.json")

    def deliver(document: Mapping[str, Any], steps: Mapping[str, Step], work: Path) -> None:
        write(to_gradescope(document, steps, hidden=hidden, names=names), "gradescope", path)

    why = _grade(project, root / "submission", options, deliver)
    if why:
        write(not_graded(why), "gradescope", path)
    return GraderFault.exit_code if why else 0


def prairielearn(project: Project, root: Path, options: Options) -> int:
    """ROOT/student to ROOT/results/results.json, as in PrairieLearn's container."""
    path = root / "results" / "results.json"

    def deliver(document: Mapping[str, Any], steps: Mapping[str, Step], work: Path) -> None:
        write(to_prairielearn(document, steps, work), "prairielearn", path)

    why = _grade(project, root / "student", options, deliver)
    if why:
        text = f"This submission was not graded: {why}\nNo attempt was used up. Please tell your instructors."
        write(not_gradable(text), "prairielearn", path)
    return GraderFault.exit_code if why else 0


def autolab(project: Project, handin: Path, options: Options) -> int:
    """Prints what a student may read, and the scores in the last line; without that line there is no score."""

    def deliver(document: Mapping[str, Any], steps: Mapping[str, Step], work: Path) -> None:
        lines = to_autolab(document, steps)
        validate(lines, "autolab")
        print(summary(document, steps, checks=True))
        print(as_lines(lines), end="", flush=True)

    return GraderFault.exit_code if _grade(project, handin, options, deliver) else 0


def submitted_at(repository: Path) -> datetime:
    """When the commit that is checked out there was made; now, where git does not know. It is the student's clock, or
    whatever the student told git."""
    command: list[str | Path] = [
        "git",
        "-c",
        "safe.directory=*",
        "-C",
        repository,
        "show",
        "-s",
        "--format=%ct",
        "HEAD",
    ]
    try:
        outcome = run(command, seconds=_GIT_SECONDS)
        return datetime.fromtimestamp(int(outcome.stdout), UTC)
    except (OSError, ValueError, OverflowError):
        return datetime.now(UTC)


def append_output(line: str, path: Path | None) -> None:
    """To the file, or to the one that $GITHUB_OUTPUT names."""
    place = path or (Path(os.environ["GITHUB_OUTPUT"]) if os.environ.get("GITHUB_OUTPUT") else None)
    if place is None:
        raise UsageError("GITHUB_OUTPUT is not set; say where the output goes with --out FILE")
    try:
        with place.open("a", encoding="utf-8") as file:
            file.write(line)
    except OSError as error:
        raise UsageError(f"{place}: cannot be written: {error.strerror or error}") from error


def deliver_github(
    document: Mapping[str, Any], steps: Mapping[str, Step], out: Path | None, repository: Path, *, legacy: bool
) -> None:
    """result.json of Classroom 50, or the output of a step of GitHub Classroom."""
    if legacy:
        result = to_legacy(document, steps)
        validate(result, "github-legacy")
        append_output(output_line(result), out)
        return
    if out is None:
        raise UsageError("say where the result goes with --out result.json")
    write(to_classroom50(document, steps, os.environ, submitted_at(repository)), "classroom50", out)


def github(project: Project, submission: Path, options: Options, out: Path | None, *, legacy: bool) -> int:
    """Nothing is written when the grader fails: the runner then reports an error, not a score. Nor does anything stay
    that was handed in under that name."""
    if out is not None and not legacy:
        remove(out)

    def deliver(document: Mapping[str, Any], steps: Mapping[str, Step], work: Path) -> None:
        deliver_github(document, steps, out, submission, legacy=legacy)

    return GraderFault.exit_code if _grade(project, submission, options, deliver) else 0
