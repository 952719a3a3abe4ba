"""What the last check of each step said; `build/check` holds the last check only, perhaps of another step."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from raysteps.common.files import write_json
from raysteps.kit.cpp_tokens import tokens
from raysteps.kit.project import Project
from raysteps.results.model import Results, StepResult

_SCHEMA = "raysteps/progress/v1"


@dataclass(frozen=True)
class LastCheck:
    """Of one step: what it was checked with, and what came out."""

    code: str  # see code_mark
    status: str
    points: float
    max: float
    summary: str = ""


def code_mark(source: bytes) -> str:
    """Changes with the code; not with comments and white space."""
    words = "\0".join(tokens(source.decode("utf-8", "replace")))
    return hashlib.sha256(words.encode()).hexdigest()[:32]


def _place(project: Project) -> Path:
    return project.build / "progress.json"


def _summary(result: StepResult) -> str:
    """How many of each kind are right, in a few words."""
    kinds = (("tests", result.tests), ("pictures", result.images), ("hidden", result.hidden))
    return ", ".join(f"{name} {sum(item.passed for item in items)}/{len(items)}" for name, items in kinds if items)


def recall(project: Project) -> dict[str, LastCheck]:
    """By step id. A file that cannot be read is as good as none: the next check writes it anew."""
    try:
        table = json.loads(_place(project).read_text(encoding="utf-8"))
        if table["schema"] != _SCHEMA:
            return {}
        return {str(step): LastCheck(**entry) for step, entry in table["steps"].items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return {}


def remember(project: Project, results: Results, sources: Mapping[str, bytes]) -> None:
    """Keeps what came of a check, beside what is known of the other steps."""
    known = recall(project)
    for result in results.steps:
        if result.id in sources:
            mark = code_mark(sources[result.id])
            known[result.id] = LastCheck(mark, result.status, result.points, result.max, _summary(result))
    write_json(_place(project), {"schema": _SCHEMA, "steps": {step: asdict(last) for step, last in known.items()}})
