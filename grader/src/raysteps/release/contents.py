"""Which files of the kit students get."""

import re
from collections.abc import Collection
from pathlib import Path, PurePosixPath

from raysteps.common.errors import GraderFault
from raysteps.exports.kit_files import tracked_places
from raysteps.kit.manifest import Step
from raysteps.kit.project import Project
from raysteps.kit.stubs import pristine_stub
from raysteps.release.absent import absent_files
from raysteps.release.packages import package_files

_ROOT = {
    ".clang-format",
    ".editorconfig",
    ".gitattributes",
    ".gitignore",
    "CMakeLists.txt",
    "CMakePresets.json",
    "LICENSE",
    "raysteps",
    "raysteps.cmd",
    "raysteps.py",
}
_FOLDERS = {".devcontainer", ".vscode", "cmake", "framework", "scenes"}
_DOCS = {  # what a student looks up
    "formats.md",
    "inspect.md",
    "maps.md",
    "pages.md",
    "students.md",
    "view.md",
    "watch.md",
    "where-students-work.md",
}
# The framework's own tests need a reference; the judge's worker, the wide trees and the rays of the SPD answer what
# steps ask.
_NOT_FOR_STUDENTS = re.compile(
    r"framework/(wide/.*|io/fuzz/.*|apps/worker.*|apps/spd_report\..*|render/spd\..*|.*_test\.cpp|absent/.*)"
)
_SKIPPED = {"__pycache__", "build", ".venv", ".git"}


def _places(project: Project) -> list[PurePosixPath]:
    """What git knows; without git all that lies there."""
    found = tracked_places(project.root)
    if found is None:
        found = [PurePosixPath(path.relative_to(project.root).as_posix()) for path in project.root.rglob("*")]
    return [place for place in found if not _SKIPPED.intersection(place.parts)]


def _belongs(place: PurePosixPath, steps: Collection[str]) -> bool:
    name, first = place.as_posix(), place.parts[0]
    if len(place.parts) == 1:
        return name in _ROOT
    if _NOT_FOR_STUDENTS.fullmatch(name):
        return False
    if first == "steps":
        return place.parts[1] in steps
    return first in _FOLDERS or (first == "docs" and len(place.parts) == 2 and place.name in _DOCS)


def _readable(path: Path) -> bytes:
    if path.is_symlink():
        raise GraderFault(f"{path}: is a link; expected a file of the kit itself")
    return path.read_bytes()


def _overlay(folder: Path) -> dict[str, bytes]:
    """Files that only a students' kit has, such as its workflow."""
    return {
        path.relative_to(folder).as_posix(): _readable(path) for path in sorted(folder.rglob("*")) if path.is_file()
    }


def kit_contents(project: Project, steps: list[Step], absent: list[Step]) -> dict[str, bytes]:
    """Files by path, without those that are made: pictures, README and the list of all files."""
    chosen = {step.id for step in steps}
    files = {
        place.as_posix(): _readable(project.root / place)
        for place in _places(project)
        if _belongs(place, chosen) and (project.root / place).is_file()
    }
    source = project.root / "grader" / "src"
    files |= {f"grader/src/{path.relative_to(source).as_posix()}": _readable(path) for path in package_files(source)}
    for step in steps:
        stub = pristine_stub(project, step).encode()
        files[f"steps/{step.path.as_posix()}"] = files[f"grader/stubs/{step.path.as_posix()}"] = stub
    files |= absent_files(project, absent)
    workflow = project.root / "course" / "github-workflow.yml"
    if workflow.is_file():
        files[".github/workflows/check.yml"] = _readable(workflow)
    return files | _overlay(Path(__file__).parent / "overlay")
