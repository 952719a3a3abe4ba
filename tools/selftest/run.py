"""The command `test`: everything that shows the kit works."""

import argparse
import json
import re
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from raysteps.common import process
from raysteps.common.platform import processor_count
from raysteps.common.text import shorten
from raysteps.course.manifest import kit_steps
from raysteps.course.project import Project
from raysteps.course.stubs import outdated_stubs
from raysteps.toolchain.cmake import BuildTree
from tools.figures.command import out_of_date as old_figures
from tools.grade_audit import check_truth, forget_answers
from tools.lint import TIDY, lint_checks
from tools.mistake_pages import out_of_date
from tools.selftest.checks import UNCHANGED, Check, Report, run_checks
from tools.selftest.inputs import EVERY_TEXT, Sources
from tools.selftest.programs import (
    CACHE,
    LINES,
    PAGES,
    WINDOW,
    asan_checks,
    build_check,
    command,
    fuzz_checks,
    install,
    program_checks,
    same_pictures_check,
    use_caches,
    windows_checks,
)
from tools.selftest.stamps import FileFilter, Stamps
from tools.test_submissions import outdated_samples

# Checks of what is generated, of the grader's Python, and of the grades.

_PYTEST_SECONDS = 4800
_NO_TESTS = 5  # the exit code of pytest when no test in the files has the marks
_PAIRS = 40


def _up_to_date(old: Sequence[str], text: str) -> Report:
    """`old`: files that are not what a command makes; `text` says which command."""
    return Report("failed", f"{text}: {', '.join(old)}") if old else Report("passed")


def _stubs(project: Project) -> Report:
    names = [path.relative_to(project.root).as_posix() for path in outdated_stubs(project, kit_steps(project))]
    text = "these stubs differ from what the solutions generate (./raysteps dev stubs makes them anew)"
    return _up_to_date(names, text)


def _samples(project: Project) -> Report:
    names = [path.relative_to(project.root).as_posix() for path in outdated_samples(project, kit_steps(project))]
    text = "these samples differ from what the solutions make (./raysteps dev samples makes them anew)"
    return _up_to_date(names, text)


def _truth(project: Project, console: Console, *, pairs: int) -> Report:
    code = check_truth(project, console, lambda text: None, pairs=pairs)
    return Report("failed", "its table and lines stand above") if code else Report("passed")


def _mistakes(project: Project) -> Report:
    text = "these differ from what the catalogue makes (./raysteps dev mistakes makes them anew)"
    return _up_to_date(out_of_date(project, lambda text: None), text)


def _figures(project: Project) -> Report:
    text = "these are not what the kit draws (./raysteps figures makes them anew)"
    return _up_to_date(old_figures(project, lambda text: None), text)


def python_checks(project: Project, inputs: Callable[..., FileFilter]) -> list[Check]:
    python = Path(sys.executable)
    generator = project.scenes / "generate.py"
    stubs, samples = inputs(outdated_stubs.__module__), inputs(outdated_samples.__module__)
    return [
        *lint_checks(project, ("python", "scripts", "cpp")),
        Check("stubs match the solutions", lambda: _stubs(project), stubs, beside=True),
        Check("samples match the solutions", lambda: _samples(project), samples, beside=True),
        Check(
            "generated scenes match the generator",
            lambda: command([python, generator, "--check"], project.root),
            lambda place: place.startswith("scenes/"),
            beside=True,
        ),
    ]


_QUICK, _SLOW = "not slow", "slow"  # marks
_SLOW_TESTS = "hostile submissions and packages for other systems"


def _not_seen(folder: Path, inputs: Mapping[str, FileFilter]) -> dict[str, set[str]]:
    """Documents that were opened for files of tests that are not taken to read them: they would not run again when one
    changes."""
    found: dict[str, set[str]] = {}
    for path in (folder / "d" / "documents").glob("*.json"):  # read_documents.py of the tests writes them
        for file, documents in json.loads(path.read_text("utf-8")).items():
            place = f"grader/{file}"
            missed = {document for document in documents if place in inputs and not inputs[place](document)}
            if missed:
                found.setdefault(place, set()).update(missed)
    return found


@dataclass(frozen=True)
class _PytestRun:
    """How one run ended, and what it left: files with tests that failed, and documents that nobody knew of."""

    outcome: process.Outcome
    wrong: set[str]
    unknown: dict[str, set[str]]

    @property
    def ended(self) -> bool:
        """Whether all tests were run."""
        code = self.outcome.code
        return not self.outcome.timed_out and (code in (0, _NO_TESTS) or (code == 1 and bool(self.wrong)))


def _pytest(
    project: Project, files: Sequence[str], marks: Sequence[str], inputs: Mapping[str, FileFilter]
) -> _PytestRun:
    """Of these files, none of them being all."""
    spread = ["-n", str(processor_count() + 1)]  # one more than processors: tests wait for programs, which are many
    spread += ["--dist", "loadgroup", "--no-loadscope-reorder"]  # groups make something costly once; slow ones first
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        words: list[str | Path] = [sys.executable, "-P", "-m", "pytest", "-q", "--tb", "short", *spread]
        words += ["-m", " or ".join(marks), "-o", f"cache_dir={folder}", *files]
        outcome = process.run(words, seconds=_PYTEST_SECONDS, cwd=project.root / "grader")
        failed = Path(folder) / "v" / "cache" / "lastfailed"  # the names of tests; pytest writes it where there are any
        named = json.loads(failed.read_text("utf-8")) if failed.is_file() else ()
        return _PytestRun(outcome, {name.partition("::")[0] for name in named}, _not_seen(Path(folder), inputs))


def run_pytest(project: Project, stamps: Stamps, marks: Sequence[str]) -> Report:
    """The tests with any of these marks, of all files that are not as they were when they passed. All in one run, in
    which no processor waits for the last slow test of the one half before the other begins."""
    sources = Sources(project, stamps.files())
    inputs = {place: sources.of_test(place).belongs for place in sources.tests()}
    names = {place: [f"{mark}: {place}" for mark in marks] for place in inputs}
    digests = stamps.digests({name: inputs[place] for place in names for name in names[place]})
    changed = [place for place in names if not all(stamps.has_passed(name, digests[name]) for name in names[place])]
    if not changed:
        return Report("passed", UNCHANGED)
    files = {place: place.removeprefix("grader/") for place in changed}
    ran = _pytest(project, [*files.values()] if len(changed) < len(inputs) else [], marks, inputs)
    right = [place for place, file in files.items() if ran.ended and file not in ran.wrong and place not in ran.unknown]
    stamps.keep({name: inputs[place] for place in right for name in names[place]}, digests)
    return _told(ran, len(inputs) - len(changed), len(inputs))


def _told(ran: _PytestRun, same: int, files: int) -> Report:
    """`same` of the files were as before."""
    outcome = ran.outcome
    if not ran.ended or ran.wrong:
        output = (outcome.stdout + outcome.stderr)[-6000:]
        return Report("failed", f"it ran longer than {_PYTEST_SECONDS} s\n{output}" if outcome.timed_out else output)
    told = re.findall(r"^(\d.*?) in \d.*$", outcome.stdout, re.MULTILINE)[-1:]  # the last line of a run
    told += [f"{same} of {files} files are as before"] if same else []
    told += [
        f"{place} will run again, since it reads {shorten(', '.join(sorted(read)), 200)}, "
        "which its source does not name"
        for place, read in sorted(ran.unknown.items())
    ]
    return Report("passed", "; ".join(told))


def grade_checks(project: Project, console: Console, inputs: Callable[..., FileFilter], *, full: bool) -> list[Check]:
    pairs = _PAIRS if full else 0
    name = "grades are true: stubs, references, known mistakes, other ways" + (", pairs of mistakes" if full else "")
    return [
        Check(name, lambda: _truth(project, console, pairs=pairs), inputs(check_truth.__module__)),
        Check(
            "pages of mistakes match the catalogue",
            lambda: _mistakes(project),
            inputs(out_of_date.__module__, texts=True),
            beside=True,
        ),
        Check(
            "figures of the handouts are up to date",
            lambda: _figures(project),
            inputs(old_figures.__module__, texts=True),
            beside=True,
        ),
    ]


_CHECKS = ("checks", "programs", "run")


def _packages() -> Report:
    """Before anything is configured; tests that need what cannot be had are skipped."""
    installed = any(install((browser, *WINDOW)) for browser in PAGES)
    install(CACHE)  # by itself: apt-get installs nothing of a list with an unknown package; it only saves time
    use_caches()
    return Report("passed") if installed else Report("skipped", f"install: {' '.join((PAGES[-1], *WINDOW))}")


class _Inputs:
    """Of checks that use the kit's programs: what is no document and no test; of Python what these modules import."""

    def __init__(self, sources: Sources) -> None:
        self._sources = sources
        self._own = sources.places_of(*(f"{__package__}.{name}" for name in _CHECKS))

    def __call__(self, *modules: str, texts: bool = False) -> FileFilter:
        inputs = self._sources.of_modules(*modules)
        inputs.code |= self._own
        if texts:
            inputs.texts.add(EVERY_TEXT)
        return lambda place: not place.startswith("grader/tests/") and inputs.belongs(place)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """How much is tested."""
    parser.add_argument("--full", action="store_true", help="also what needs more: sanitizers, clang, fuzzing")
    parser.add_argument(
        "--fresh", action="store_true", help="also what passed before and depends on nothing that changed"
    )


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """All checks, or all that need no more than the basic tools; `--fresh`: also those that would pass as before."""
    full, fresh = bool(arguments.full), bool(arguments.fresh)
    tree = BuildTree(project, "dev", project.build / "dev", project.steps, (LINES,))
    stamps = Stamps(project, fresh=fresh)
    if fresh:
        forget_answers(project)
    inputs = _Inputs(Sources(project, stamps.files()))
    checks = [Check("a browser and a window system for the tests", _packages)]
    checks.append(build_check("build everything, warnings are errors", tree, [], inputs))
    checks += [
        *python_checks(project, inputs),
        *program_checks(tree, inputs),
        same_pictures_check(project, tree, inputs),
    ]
    checks += grade_checks(project, console, inputs, full=full)
    marks = [_QUICK, *([_SLOW] if full else [])]
    name = f"pytest, with grading from end to end{f', {_SLOW_TESTS}' if full else ''}"
    checks.append(Check(name, lambda: run_pytest(project, stamps, marks)))
    if full:
        more = [*fuzz_checks(project, inputs), *asan_checks(project, inputs), *windows_checks(project, tree, inputs)]
        more += lint_checks(project, (TIDY,))
        checks += sorted(more, key=lambda check: check.beside)  # builds first, each on the whole machine
    else:
        later = Report("skipped", "run: ./raysteps test --full")
        names = ("sanitizers and clang", "fuzz-readers", "clang-tidy", "Windows")
        checks += [Check(name, lambda: later) for name in (_SLOW_TESTS, *names)]
    return run_checks(checks, console, stamps)
