"""The command `test`: everything that shows the kit works."""

import argparse
import sys
from pathlib import Path

from rich.console import Console

from raysteps.course.manifest import read_steps
from raysteps.course.project import Project
from raysteps.course.stubs import outdated_stubs
from raysteps.toolchain.cmake import BuildTree
from tools.figures.command import out_of_date as old_figures
from tools.grade_audit import check_truth
from tools.lint import TIDY, lint_checks
from tools.mistake_pages import out_of_date
from tools.selftest.checks import Check, Report, run_checks
from tools.selftest.debian import CACHE, PAGES, WINDOW, install
from tools.selftest.programs import (
    asan_checks,
    build,
    clang_checks,
    command,
    program_checks,
    same_pictures,
    use_compiler_cache,
)
from tools.selftest.windows_build import windows_checks
from tools.test_submissions import outdated_samples

# Checks of what is generated, of the grader's Python, and of the grades.

_PYTEST_SECONDS = 2400
_PAIRS = 40


def _stubs(project: Project) -> Report:
    names = [path.relative_to(project.root).as_posix() for path in outdated_stubs(project, read_steps(project))]
    text = "these stubs differ from what the solutions generate (./raysteps dev stubs makes them anew): "
    return Report("failed", text + ", ".join(names)) if names else Report("passed")


def _samples(project: Project) -> Report:
    names = [path.relative_to(project.root).as_posix() for path in outdated_samples(project, read_steps(project))]
    text = "these samples differ from what the solutions make (./raysteps dev samples makes them anew): "
    return Report("failed", text + ", ".join(names)) if names else Report("passed")


def _truth(project: Project, console: Console, *, pairs: int) -> Report:
    code = check_truth(project, console, lambda text: None, pairs=pairs)
    return Report("failed", "its table and lines stand above") if code else Report("passed")


def _mistakes(project: Project) -> Report:
    old = out_of_date(project, lambda text: None)
    text = "these differ from what the catalogue makes (./raysteps dev mistakes makes them anew): "
    return Report("failed", text + ", ".join(old)) if old else Report("passed")


def _figures(project: Project) -> Report:
    old = old_figures(project, lambda text: None)
    text = "these are not what the kit draws (./raysteps figures makes them anew): "
    return Report("failed", text + ", ".join(old)) if old else Report("passed")


def python_checks(project: Project) -> list[Check]:
    python = Path(sys.executable)
    generator = project.scenes / "generate.py"
    return [
        Check("stubs match the solutions", lambda: _stubs(project)),
        Check("samples match the solutions", lambda: _samples(project)),
        Check("generated scenes match the generator", lambda: command([python, generator, "--check"], project.root)),
        *lint_checks(project, ("python", "scripts", "cpp")),
        Check("pytest, with grading from end to end", lambda: run_pytest(project, "not slow")),
    ]


def run_pytest(project: Project, marked: str) -> Report:
    spread = ["-n", "auto", "--dist", "loadgroup"]  # a group is for tests that would make something costly twice
    words: list[str | Path] = [sys.executable, "-m", "pytest", "-q", "--tb", "short", *spread, "-m", marked]
    return command(words, project.root / "grader", _PYTEST_SECONDS)


def grade_checks(project: Project, console: Console, *, full: bool) -> list[Check]:
    pairs = _PAIRS if full else 0
    name = "grades are true: stubs, references, known mistakes, other ways" + (", pairs of mistakes" if full else "")
    return [
        Check(name, lambda: _truth(project, console, pairs=pairs)),
        Check("pages of mistakes match the catalogue", lambda: _mistakes(project)),
        Check("figures of the handouts are up to date", lambda: _figures(project)),
    ]


_SLOW = "pytest, hostile submissions and packages for other systems"


def _packages(project: Project) -> Report:
    """Before anything is configured; tests that need what cannot be had are skipped."""
    wanted = (*PAGES, *WINDOW)
    installed = install(wanted)
    install(CACHE)  # by itself: apt-get installs nothing of a list with an unknown package; it only saves time
    use_compiler_cache(project)
    return Report("passed") if installed else Report("skipped", f"install: {' '.join(wanted)}")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """How much is tested."""
    parser.add_argument("--full", action="store_true", help="also what needs more: sanitizers, clang, fuzzing")


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """All checks, or all that need no more than the basic tools."""
    full: bool = arguments.full
    tree = BuildTree(project, "dev", project.build / "dev", project.steps)
    checks = [Check("a browser and a window system for the tests", lambda: _packages(project))]
    checks += [Check("build everything, warnings are errors", lambda: build(tree, [])), *program_checks(tree)]
    checks.append(Check("all structures give the same picture", lambda: same_pictures(project, tree)))
    checks += grade_checks(project, console, full=full)
    checks += python_checks(project)
    if full:
        checks.append(Check(_SLOW, lambda: run_pytest(project, "slow")))
        checks += asan_checks(project) + clang_checks(project) + lint_checks(project, (TIDY,))
        checks += windows_checks(project, tree)
    else:
        more = Report("skipped", "run: ./raysteps test --full")
        names = (_SLOW, "sanitizers", "build everything with clang", "fuzz-readers for 60 s", "clang-tidy", "Windows")
        checks += [Check(name, lambda: more) for name in names]
    return run_checks(checks, console)
