"""Tells one state of the kit from another."""

import hashlib
import re
from collections.abc import Collection, Iterator
from pathlib import Path

from raysteps.course.project import Project

# Folders, and which of their files count: what an editor leaves beside them does not, nor do a student's own steps,
# nor the packages that change no grade.
GRADING = (
    "classroom", "common", "course", "diagnosis", "grading", "images", "judge", "results", "sandbox", "submission",
    "toolchain",
)  # fmt: skip
_SOURCES = {
    "framework": r".*\.(hpp|cpp|cmake|txt)",
    "cmake": r".*\.cmake",
    "scenes": r".*\.(nff|pbrt|py)",
    "solutions": r"[0-9]{2}-[a-z0-9-]+/[a-z_]+\.(cpp|toml|py)",
    "steps": r"[0-9]{2}-[a-z0-9-]+/(step\.toml|\w+\.hpp|\w+_test\.cpp)",
    "grader/stubs": r".*\.cpp",
    "reference": r".*\.(png|json)",
    "grader/src": rf"raysteps/({'|'.join(GRADING)})/.*\.(py|json)",
}


PROGRAM_FOLDERS = ("framework", "cmake", "scenes", "solutions", "steps")  # what programs are built from


def kit_files(project: Project, folders: Collection[str] = tuple(_SOURCES)) -> Iterator[Path]:
    """Those in these folders that count."""
    for name in folders:
        folder, pattern = project.root / name, _SOURCES[name]
        for path in sorted(folder.rglob("*")):
            counts = re.fullmatch(pattern, path.relative_to(folder).as_posix()) and not path.name.startswith(".")
            if counts and path.is_file():
                yield path


def fingerprint(project: Project) -> str:
    """Changes with everything that a grade depends on in the repository; not with a student's own steps."""
    digest = hashlib.sha256()
    for path in (project.root / "CMakeLists.txt", project.root / "CMakePresets.json", *kit_files(project)):
        data = path.read_bytes()
        digest.update(f"{path.relative_to(project.root).as_posix()}\0{len(data)}\0".encode())
        digest.update(data)
    return digest.hexdigest()[:16]
