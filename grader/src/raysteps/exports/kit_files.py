"""The files of the kit that another machine needs for grading."""

import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from raysteps.common.errors import GraderFault
from raysteps.common.process import run
from raysteps.kit.project import Project

_FILES = ("CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "raysteps")
_FOLDERS = ("cmake", "framework", "grader", "scenes", "solutions", "steps")
_LEFT_OUT = (("grader", "tests"),)
_TOOLS = {"__pycache__", "build"}
_TOOL_ENDINGS = (".egg-info", ".pyc")
_GIT_SECONDS = 60
_GIT_OUTPUT = 16 << 20


@dataclass(frozen=True)
class KitFile:
    """A file and its place in the kit."""

    place: PurePosixPath
    source: Path

    @property
    def executable(self) -> bool:
        return os.access(self.source, os.X_OK)


def _belongs(place: PurePosixPath) -> bool:
    parts = place.parts
    if len(parts) == 1:
        return parts[0] in _FILES
    if parts[0] not in _FOLDERS or any(parts[: len(folder)] == folder for folder in _LEFT_OUT):
        return False
    return not any(part in _TOOLS or part.startswith(".") or part.endswith(_TOOL_ENDINGS) for part in parts)


def tracked_places(root: Path) -> list[PurePosixPath] | None:
    """What git tracks, and new files that it does not ignore; None where there is no git."""
    if not (root / ".git").exists():
        return None
    command: list[str | Path] = ["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    try:
        outcome = run(command, seconds=_GIT_SECONDS, cap=_GIT_OUTPUT)
    except OSError:
        return None
    if outcome.code != 0:
        return None
    return [PurePosixPath(name) for name in outcome.stdout.split("\0") if name]


def _from_folders(root: Path) -> Iterator[PurePosixPath]:
    for name in _FILES:
        yield PurePosixPath(name)
    for folder in _FOLDERS:
        for path in (root / folder).rglob("*"):
            yield PurePosixPath(path.relative_to(root).as_posix())


def kit_files(project: Project) -> list[KitFile]:
    """Sorted by place; links are not followed."""
    root = project.root
    places = tracked_places(root)
    if places is None:
        places = list(_from_folders(root))
    found = [KitFile(place, root / place) for place in sorted(set(places)) if _belongs(place)]
    files = [file for file in found if file.source.is_file() and not file.source.is_symlink()]
    there = {file.place.parts[0] for file in files}
    missing = [name for name in (*_FILES, *_FOLDERS) if name not in there and name not in ("LICENSE", "README.md")]
    if missing:
        raise GraderFault(f"{root}: {', '.join(missing)} is missing, so this is no whole kit")
    return files
