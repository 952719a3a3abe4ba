"""What the kit keeps to itself, text by text, and from where each is."""

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from raysteps.kit.manifest import read_all_steps
from raysteps.kit.project import Project
from raysteps.kit.stubs import pristine_stub, solution_regions

Texts = Iterator[tuple[str, str]]

_IMPORT = re.compile(r"^(?:from|import) (?:[^(\n]*\([^)]*\)|.*)$", re.M)


def _files(project: Project, folder: Path, pattern: str) -> Texts:
    for path in sorted(folder.glob(pattern)):
        yield path.relative_to(project.root).as_posix(), path.read_text(encoding="utf-8")


def solution_code(project: Project) -> Texts:
    """Regions by where they stand, and whole files that are alternatives or tell how the judge asks."""
    for step in read_all_steps(project):
        name = f"solutions/{step.path.as_posix()}"
        for region in solution_regions((project.root / name).read_text(encoding="utf-8")):
            yield f"{name}:{region.line} ({region.name or 'a helper'})", "\n".join(region.body)
    yield from _files(project, project.solutions, "*/alternatives/*.cpp")
    yield from _files(project, project.solutions, "*/worker.cpp")


def _strings(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for part in value.values():
            yield from _strings(part)
    elif isinstance(value, list):
        for part in value:
            yield from _strings(part)


def mistakes(project: Project) -> Texts:
    """The texts of the known mistakes, and the code before and after."""
    for origin, text in _files(project, project.solutions, "*/mutants.toml"):
        tables = tomllib.loads(text)["mutants"]  # an id is the name of a picture, too, and says nothing
        yield from (
            (origin, part) for one in tables for key, value in one.items() if key != "id" for part in _strings(value)
        )


def hidden_cases(project: Project) -> Texts:
    """The kinds of cases and how many there are, line by line."""
    for origin, text in _files(project, project.solutions, "*/cases.toml"):
        yield from ((origin, line) for line in text.splitlines() if line.startswith('"'))


def own_judges(project: Project) -> Texts:
    """Those of steps that an instructor added."""
    yield from _files(project, project.solutions, "*/judge.py")


def judge_modules(project: Project) -> Texts:
    """What draws the hidden cases and knows the answers, without its imports: they are like those of any module."""
    package = project.root / "grader" / "src" / "raysteps"
    for pattern in ("judge/**/*.py", "commands/inspect/expected.py"):
        for origin, text in _files(project, package, pattern):
            yield origin, _IMPORT.sub("", text)


def public_names(project: Project) -> set[str]:
    """Names in what students include: nobody who uses them has seen a solution."""
    texts = [pristine_stub(project, step) for step in read_all_steps(project)]
    rooms = (project.steps.glob("*/*.hpp"), (project.root / "framework").rglob("*.?pp"))
    texts += [path.read_text(encoding="utf-8", errors="replace") for room in rooms for path in room]
    return {word for text in texts for word in re.findall(r"\w+", text)}
