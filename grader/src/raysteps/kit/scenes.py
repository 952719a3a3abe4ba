"""Scenes that the generator makes when they are needed."""

import sys
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.process import run
from raysteps.kit.project import Project


def generated(project: Project, kind: str, size: int) -> Path:
    """The generated scene of that kind and size, made once."""
    path = project.build / "scenes" / f"{kind}-{size}.nff"
    if not path.is_file():
        path.parent.mkdir(parents=True, exist_ok=True)
        script = project.scenes / "generate.py"
        outcome = run([sys.executable, script, kind, "--size", str(size), "-o", path], seconds=300)
        if outcome.code != 0:
            raise GraderFault(f"the scene {kind} cannot be made: {outcome.stderr.strip()}")
    return path
