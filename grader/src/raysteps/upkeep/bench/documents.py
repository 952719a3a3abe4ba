"""What a benchmark leaves behind: JSON in build/bench, checked against its schema."""

import json
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import write_json
from raysteps.common.schemas import complaint, read_schema
from raysteps.kit.project import Project

NAMES = ("boxes", "grading", "render", "scale", "threads", "parse", "loop")


def _checked(name: str, document: Any, where: str) -> Any:
    problem = complaint(document, read_schema("raysteps.upkeep.bench", "bench.schema.json", name))
    if problem:
        raise GraderFault(f"{where}: not what `bench {name}` writes: {problem}")
    return document


def place_of(project: Project, name: str) -> Path:
    """Where `bench NAME` puts its numbers."""
    return project.build / "bench" / f"{name}.json"


def keep(project: Project, name: str, document: Any, console: Console) -> None:
    """Writes build/bench/NAME.json and tells so."""
    path = place_of(project, name)
    write_json(path, _checked(name, document, name))
    console.print(f"Numbers: {escape(str(path))}", soft_wrap=True)


def kept(project: Project, name: str) -> Any | None:
    """What was measured last; nothing when it never was."""
    path = place_of(project, name)
    if not path.is_file():
        return None
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise UsageError(f"{path}: not JSON: {error}; measure again: ./raysteps bench {name}") from error
    return _checked(name, document, str(path))
