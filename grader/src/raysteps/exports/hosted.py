"""The part of each autograder that runs on the other system's machine: grade, convert, write."""

import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from raysteps.common.errors import GraderFault, RaystepsError, UsageError, reason, reason_and_place
from raysteps.common.files import write_bytes, write_out
from raysteps.common.process import Outcome, run
from raysteps.common.text import clean, harmless_log, number, shorten
from raysteps.course.manifest import Step, choose, read_steps
from raysteps.course.project import Project
from raysteps.exports.autolab import as_lines, to_autolab
from raysteps.exports.formats import remove, validate, write
from raysteps.exports.github import (
    BODY,
    FOLDER,
    output_line,
    release_body,
    release_files,
    to_classroom50,
    to_legacy,
)
from raysteps.exports.gradescope import Visibility, not_graded, submitters, to_gradescope
from raysteps.exports.items import summary, wrapped
from raysteps.exports.prairielearn import not_gradable, to_prairielearn
from raysteps.results.model import Results, StepResult
from raysteps.results.store import RESULTS, read_results
from raysteps.sandbox.task import read_regular
from raysteps.submission.load import load_submission, without_place

# Grades one submission on the machine of another system.

_GRADED = (0, 1, 3)  # all passed, checks failed, some step does not build


class NotGraded(Exception):
    """The grader could not do its work; nobody's points are touched."""


@dataclass(frozen=True)
class Options:
    """What the instructor chose when the autograder was made."""

    seconds: float
    steps: tuple[str, ...] = ()
    words: tuple[str, ...] = ()  # for `grade`
    echo: bool = False  # whether what `grade` says is passed on; only where no student reads it


def nothing_handed_in(steps: Sequence[Step], why: str) -> Results:
    """Results for a submission in which no step could be found."""
    results = [
        StepResult(id=step.id, status="not-started", points=0.0, max=step.points, bonus=step.bonus, messages=[why])
        for step in steps
    ]
    return Results.of("submission", results)


def _complaint(outcome: Outcome) -> str:
    """What the kit said last about why it gave up."""
    said = [line for line in outcome.stderr.splitlines() if line.startswith("raysteps: ")]
    why = shorten(clean(said[-1].removeprefix("raysteps: ")), 300) if said else ""
    return why or f"the grader ended with exit code {outcome.code}"


def grade_here(project: Project, submission: Path, steps: list[Step], options: Options, work: Path) -> Results:
    """Runs the kit's `grade` in a process of its own and reads what it wrote to the folder."""
    chosen = choose(steps, list(options.steps))
    if not os.access(submission, os.R_OK):
        raise NotGraded(f"there is no submission at {submission}, or it cannot be read")
    try:
        load_submission(submission, steps)
    except UsageError as error:
        why = clean(without_place(error, submission))
        return nothing_handed_in(chosen, f"Nothing to grade was found in what was handed in: it {why}.")
    words: list[str | Path] = [sys.executable, "-P", "-m", "raysteps", "grade", submission.resolve(), "--out", work]
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
        return read_results(work / RESULTS)
    except UsageError as error:
        raise GraderFault(f"grade left no results: {error}") from error


def by_id(steps: Sequence[Step]) -> Mapping[str, Step]:
    """For looking up what the manifests say."""
    return {step.id: step for step in steps}


_GIT_SECONDS = 30
_MAX_GIT_FILE, _MAX_PACKED = 1 << 12, 1 << 24
_MAX_REFERENCES = 5  # that git itself follows
_COMMIT, _SHORT = re.compile("[0-9a-f]{40}(?:[0-9a-f]{24})?"), 40
_REFERENCE, _ELSEWHERE = re.compile(r"ref: (refs/\S+)"), re.compile("gitdir: (.+)")
_MADE = re.compile(r"^committer .* ([0-9]{1,12}) [+-][0-9]{4}$", re.M)

Deliver = Callable[[Results, Mapping[str, Step], Path], None]


def _grade(project: Project, submission: Path, options: Options, deliver: Deliver) -> str:
    """Grades and delivers; returns why not, if not."""
    try:
        steps = read_steps(project)
        with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
            work = Path(folder)
            results = grade_here(project, submission, steps, options, work)
            deliver(results, by_id(steps), work)
    except (RaystepsError, NotGraded, OSError, subprocess.SubprocessError) as error:
        print(f"raysteps: {harmless_log(clean(reason_and_place(error)))}", file=sys.stderr)
        return reason_and_place(error)
    return ""


def gradescope(project: Project, root: Path, options: Options, hidden: Visibility) -> int:
    """ROOT/submission to ROOT/results/results.json, as in Gradescope's container."""
    path = root / "results" / "results.json"
    names = submitters(root / "submission_metadata.json")

    def deliver(results: Results, steps: Mapping[str, Step], work: Path) -> None:
        write(to_gradescope(results, steps, hidden=hidden, names=names, folder=work), "gradescope", path)

    why = _grade(project, root / "submission", options, deliver)
    if why:
        write(not_graded(why), "gradescope", path)
    return GraderFault.exit_code if why else 0


def prairielearn(project: Project, root: Path, options: Options) -> int:
    """ROOT/student to ROOT/results/results.json, as in PrairieLearn's container. The script that calls this ends with 0
    after a fault, too: PrairieLearn reads nothing otherwise."""
    path = root / "results" / "results.json"

    def deliver(results: Results, steps: Mapping[str, Step], work: Path) -> None:
        write(to_prairielearn(results, steps, work), "prairielearn", path)

    why = _grade(project, root / "student", options, deliver)
    if why:
        write(not_gradable(why), "prairielearn", path)
    return GraderFault.exit_code if why else 0


def autolab(project: Project, handin: Path, options: Options) -> int:
    """Prints what a student may read, and the scores in the last line. After a fault the Makefile prints that line."""

    def deliver(results: Results, steps: Mapping[str, Step], work: Path) -> None:
        lines = to_autolab(results, steps)
        validate(lines, "autolab")
        print(wrapped(summary(results, steps, checks=True)))
        print(as_lines(lines), end="", flush=True)

    return GraderFault.exit_code if _grade(project, handin, options, deliver) else 0


def _git_file(path: Path, cap: int = _MAX_GIT_FILE) -> str:
    return (read_regular(path, cap) or b"").decode("utf-8", "replace").strip()


def _stores(repository: Path) -> tuple[Path, Path]:
    """Git's folder for what is checked out there or around it, and the one that its work trees share."""
    folder = repository.resolve()
    around = next((one for one in (folder, *folder.parents) if (one / ".git").exists()), folder)
    store = around / ".git"
    if store.is_file() and (elsewhere := _ELSEWHERE.fullmatch(_git_file(store))) is not None:
        store = around / elsewhere[1]
    return store, store / _git_file(store / "commondir")


def _checked_out(store: Path, shared: Path) -> str:
    """The commit, as git's own files tell it; something else where they do not."""
    said, packed = _git_file(store / "HEAD"), _git_file(shared / "packed-refs", _MAX_PACKED)
    for _ in range(_MAX_REFERENCES):
        named = _REFERENCE.fullmatch(said)
        if named is None or ".." in said:
            break
        found = re.search(rf"^([0-9a-f]+) {re.escape(named[1])}$", packed, re.M)
        said = _git_file(shared / named[1]) or (found[1] if found is not None else "")
    return said


def _commit_text(objects: Path, commit: str) -> str:
    """Git reads it by a store of its own, because that of a student may name programs that it starts. The store is
    written here, because what git makes depends on its version and on settings."""
    kind = "[extensions]\nobjectFormat = sha256\n" if len(commit) > _SHORT else ""
    version = 1 if kind else 0
    with tempfile.TemporaryDirectory(prefix="raysteps-") as place:
        Path(place, "refs").mkdir()
        for name, text in {
            "HEAD": "ref: refs/heads/main\n",
            "config": f"[core]\nrepositoryformatversion = {version}\nbare = true\n{kind}",
            "objects/info/alternates": f"{objects.as_posix()}\n",
        }.items():
            write_bytes(Path(place, name), text.encode())
        return run(["git", f"--git-dir={place}", "cat-file", "commit", commit], seconds=_GIT_SECONDS).stdout


def submitted_at(repository: Path) -> datetime:
    """When the commit that is checked out there was made; now, where nobody knows. It is the student's clock, or
    whatever the student told git."""
    with suppress(OSError, ValueError, OverflowError):  # what a student wrote may be no path and no time
        store, shared = _stores(repository)
        commit = _checked_out(store, shared)
        text = _commit_text(shared / "objects", commit) if _COMMIT.fullmatch(commit) else ""
        made = _MADE.search(text.partition("\n\n")[0])
        if made is not None:
            return datetime.fromtimestamp(int(made[1]), UTC)
    print("raysteps: no commit says when this was submitted; the result has the time of grading", file=sys.stderr)
    return datetime.now(UTC)


def append_output(text: str, path: Path | None, variable: str = "GITHUB_OUTPUT") -> None:
    """To the file, or to the one that the variable names."""
    place = path or (Path(os.environ[variable]) if os.environ.get(variable) else None)
    if place is None:
        raise UsageError(f"{variable} is not set; say where the output goes with --out FILE")
    try:
        with place.open("a", encoding="utf-8") as file:
            file.write(text)
    except OSError as error:
        raise UsageError(f"{place}: cannot be written: {reason(error)}") from error


def deliver_github(
    results: Results, steps: Mapping[str, Step], out: Path | None, repository: Path, folder: Path, *, legacy: bool
) -> None:
    """result.json of Classroom 50 and what is published with it, or the output of a step of GitHub Classroom and the
    summary of its run. The pictures are in the folder."""
    if legacy:
        result = to_legacy(results, steps)
        validate(result, "github-legacy")
        append_output(output_line(result), out)
        if os.environ.get("GITHUB_STEP_SUMMARY"):
            append_output(release_body(results, steps, (), os.environ), None, "GITHUB_STEP_SUMMARY")
        return
    if out is None:
        raise UsageError("say where the result goes with --out result.json")
    result = to_classroom50(results, steps, os.environ, submitted_at(repository))
    files = release_files(results, steps, folder)
    files[BODY] = release_body(results, steps, files, os.environ).encode()
    for place, data in files.items():
        write_out(out.parent / place, data)
    write(result, "classroom50", out)


def github(project: Project, submission: Path, options: Options, out: Path | None, *, legacy: bool) -> int:
    """Nothing is written when the grader fails: the runner then reports an error, not a score. Nor does anything stay
    that was handed in under those names."""
    if out is not None and not legacy:
        for path in (out, out.parent / BODY, out.parent / FOLDER):
            remove(path)

    def deliver(results: Results, steps: Mapping[str, Step], work: Path) -> None:
        deliver_github(results, steps, out, submission, work, legacy=legacy)

    return GraderFault.exit_code if _grade(project, submission, options, deliver) else 0
