"""Which files of the kit students get."""

import re
from collections.abc import Collection
from pathlib import Path, PurePosixPath

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.text import listed
from raysteps.kit.git_listing import places, untracked
from raysteps.kit.manifest import Step
from raysteps.kit.project import Project
from raysteps.kit.stubs import pristine_stub
from raysteps.release.absent import absent_files
from raysteps.release.packages import package_files
from raysteps.students.set_up import is_made_anew

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
    "paper.md",
    "students.md",
    "view.md",
    "watch.md",
    "where-students-work.md",
}
# The framework's own tests need a reference; the judge's worker, the wide trees and the rays of the SPD answer what
# steps ask.
_NOT_FOR_STUDENTS = re.compile(
    r"framework/(wide/.*|io/fuzz/.*|worker/.*|apps/spd_report\..*|render/spd\..*|.*_test\.cpp|absent/.*)"
)
_OF_A_STEP = re.compile(r"steps/[^/]+/(README\.md|step\.toml|[^/]+(\.hpp|_test\.cpp|\.png|\.svg))")
_OVERLAY, _WORKFLOW = "grader/src/raysteps/release/overlay", "course/github-workflow.yml"
_MOST_NAMED = 5
_SKIPPED = {"build", ".venv", ".git"}


def refuse_untracked(root: Path, files: Collection[str]) -> None:
    """Git would have none of them: notes, copies, a solution that somebody kept."""
    new = untracked(root)
    found = sorted(name for name in new if name in files or name == _WORKFLOW or name.startswith(f"{_OVERLAY}/"))
    if found:
        raise UsageError(
            f"{listed(found[:_MOST_NAMED])}: would go out, but git does not know it; `git add` what belongs to the "
            "kit, and take away the rest"
        )


def _is_made(place: PurePosixPath) -> bool:
    """By setting up and trying a kit, wherever it lies."""
    return is_made_anew(place.as_posix()) or not _SKIPPED.isdisjoint(place.parts)


def _belongs(place: PurePosixPath, steps: Collection[str]) -> bool:
    name, first = place.as_posix(), place.parts[0]
    if len(place.parts) == 1:
        return name in _ROOT
    if _NOT_FOR_STUDENTS.fullmatch(name):
        return False
    if first == "steps":
        return place.parts[1] in steps and _OF_A_STEP.fullmatch(name) is not None
    return first in _FOLDERS or (first == "docs" and len(place.parts) == 2 and place.name in _DOCS)


def _readable(path: Path) -> bytes:
    if path.is_symlink():
        raise GraderFault(f"{path}: is a link; expected a file of the kit itself")
    return path.read_bytes()


def _overlay(folder: Path) -> dict[str, bytes]:
    """Files that only a students' kit has, such as its workflow."""
    files = [path for path in sorted(folder.rglob("*")) if path.is_file()]
    named = {path.relative_to(folder): path for path in files}
    return {place.as_posix(): _readable(path) for place, path in named.items() if not _is_made(PurePosixPath(place))}


def kit_contents(project: Project, steps: list[Step], absent: list[Step]) -> dict[str, bytes]:
    """Files by path, without those that are made: pictures, README and the list of all files."""
    chosen = {step.id for step in steps}
    known = [place for place in places(project.root) if not _is_made(place)]
    files = {
        place.as_posix(): _readable(project.root / place)
        for place in known
        if _belongs(place, chosen) and (project.root / place).is_file()
    }
    source = project.root / "grader" / "src"
    files |= {f"grader/src/{path.relative_to(source).as_posix()}": _readable(path) for path in package_files(source)}
    for step in steps:
        stub = pristine_stub(project, step).encode()
        files[f"steps/{step.path.as_posix()}"] = files[f"grader/stubs/{step.path.as_posix()}"] = stub
    files |= absent_files(project, absent)
    workflow = project.root / _WORKFLOW
    if workflow.is_file():
        files[".github/workflows/check.yml"] = _readable(workflow)
    return files | _overlay(project.root / _OVERLAY)
