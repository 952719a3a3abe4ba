"""Checks of what is generated, of the grader's Python, and of the grades."""

import sys
from pathlib import Path

from rich.console import Console

from raysteps.kit.manifest import read_steps
from raysteps.kit.project import Project
from raysteps.kit.stubs import outdated_stubs
from raysteps.upkeep.checks import Check, Report
from raysteps.upkeep.figures.command import out_of_date as old_figures
from raysteps.upkeep.handbook.command import out_of_date
from raysteps.upkeep.samples import outdated_samples
from raysteps.upkeep.selftest_programs import command
from raysteps.upkeep.truth.command import check_truth

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
    grader = project.root / "grader"
    python = Path(sys.executable)
    generator = project.scenes / "generate.py"
    return [
        Check("stubs match the solutions", lambda: _stubs(project)),
        Check("samples match the solutions", lambda: _samples(project)),
        Check("generated scenes match the generator", lambda: command([python, generator, "--check"], project.root)),
        Check("ruff check", lambda: command([python, "-m", "ruff", "check", "."], grader)),
        Check("ruff format", lambda: command([python, "-m", "ruff", "format", "--check", "."], grader)),
        Check("mypy --strict", lambda: command([python, "-m", "mypy"], grader)),
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
