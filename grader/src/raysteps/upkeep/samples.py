"""The two sample submissions, made from the solutions so that they never drift."""

import tomllib
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_if_changed
from raysteps.kit.manifest import Step
from raysteps.kit.project import Project
from raysteps.kit.stubs import stub_for, without_markers


def _solved(project: Project, step: Step) -> str:
    return without_markers((project.solutions / step.path).read_text(encoding="utf-8"))


def _with_mistake(source: str, mistake: dict[str, Any]) -> str:
    find = str(mistake["find"])
    if source.count(find) != 1:
        raise GraderFault(f"grader/samples/partial.toml: '{find}' must occur exactly once in {mistake['step']}")
    return source.replace(find, str(mistake["replace"]))


def sample_files(project: Project, steps: list[Step]) -> dict[Path, str]:
    """Path and content of every file of the samples."""
    plan = tomllib.loads((project.samples / "partial.toml").read_text(encoding="utf-8"))
    mistakes = {str(mistake["step"]): mistake for mistake in plan["mistakes"]}
    files: dict[Path, str] = {}
    for step in steps:
        solved = _solved(project, step)
        files[project.samples / "complete" / "steps" / step.path] = solved
        if step.id in mistakes:
            partial = _with_mistake(solved, mistakes[step.id])
        else:
            partial = solved if step.id in plan["solved"] else stub_for(project, step)
        files[project.samples / "partial" / "steps" / step.path] = partial
    return files


def outdated_samples(project: Project, steps: list[Step]) -> list[Path]:
    """The sample files that differ from what the solutions make."""
    return [
        path
        for path, text in sample_files(project, steps).items()
        if not path.is_file() or path.read_bytes() != text.encode()
    ]


def write_samples(project: Project, steps: list[Step]) -> list[Path]:
    """Writes all samples; returns what changed."""
    return [path for path, text in sample_files(project, steps).items() if write_if_changed(path, text.encode())]
