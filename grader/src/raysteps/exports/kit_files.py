"""The files of the kit that another machine needs for grading."""

import os
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from raysteps.common.errors import GraderFault
from raysteps.kit.git_listing import places
from raysteps.kit.project import Project

_FILES = ("CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "raysteps")
_FOLDERS = ("cmake", "framework", "grader", "scenes", "solutions", "steps")
_LEFT_OUT = (("grader", "tests"),)
_TOOLS = {"__pycache__", "build"}
_TOOL_ENDINGS = (".egg-info", ".pyc")


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


def kit_files(project: Project) -> list[KitFile]:
    """Sorted by place; links are not followed."""
    root = project.root
    listed = {*places(root, _FOLDERS), *map(PurePosixPath, _FILES)}
    found = [KitFile(place, root / place) for place in sorted(listed) if _belongs(place)]
    files = [file for file in found if file.source.is_file() and not file.source.is_symlink()]
    there = {file.place.parts[0] for file in files}
    missing = [name for name in (*_FILES, *_FOLDERS) if name not in there and name not in ("LICENSE", "README.md")]
    if missing:
        raise GraderFault(f"{root}: {', '.join(missing)} is missing, so this is no whole kit")
    return files
