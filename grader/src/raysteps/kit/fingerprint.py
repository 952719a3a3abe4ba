"""Tells one state of the kit from another."""

import hashlib
import re
from collections.abc import Iterator
from pathlib import Path

from raysteps.kit.project import Project

_SOURCES = ("framework", "cmake", "scenes", "solutions", "steps", "grader/src")
_LEFT_OUT = re.compile(r"__pycache__|\.egg-info|\.pyc$|\.tmp$")


def _files(project: Project) -> Iterator[Path]:
    yield project.root / "CMakeLists.txt"
    yield project.root / "CMakePresets.json"
    stubs = re.compile(r"steps/[0-9]{2}-[a-z0-9-]+/(?!.*_test\.cpp$).*(\.cpp|\.md)$")
    for name in _SOURCES:
        for path in sorted((project.root / name).rglob("*")):
            relative = path.relative_to(project.root).as_posix()
            if path.is_file() and not _LEFT_OUT.search(relative) and not stubs.match(relative):
                yield path


def fingerprint(project: Project) -> str:
    """Changes with everything that a grade depends on in the repository; not with a student's own steps."""
    digest = hashlib.sha256()
    for path in _files(project):
        data = path.read_bytes()
        digest.update(f"{path.relative_to(project.root).as_posix()}\0{len(data)}\0".encode())
        digest.update(data)
    return digest.hexdigest()[:16]
