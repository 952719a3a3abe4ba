"""Stamps of checks: what passed on the same bytes, with the same tools, is not run again on this machine.

A stamp is a file in build/stamps/, written when a check has passed. It holds a digest of everything that the check can
depend on: files of the repository by their contents, and the machine: interpreter, packages, tools, settings. Files are
named too generously rather than too narrowly; what names none depends on all of them.
"""

import hashlib
import importlib.metadata
import json
import os
import platform
import re
import shutil
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path, PurePosixPath

from raysteps.common.files import write_json
from raysteps.course.project import Project
from raysteps.course.tracked_files import places

Belongs = Callable[[str], bool]  # whether a file counts, by its place in the repository

_TOOLS = (
    "ar", "bwrap", "c++", "cc", "ccache", "chromium", "clang", "clang++", "cmake", "git", "g++", "ld", "make", "ninja",
    "node", "povray", "sqlite3", "wine", "x86_64-w64-mingw32-g++-posix", "xdotool", "Xvfb", "zip",
)  # fmt: skip
_SETTINGS = re.compile(r"(CMAKE|RAYSTEPS|PYTEST|CXX|CPP|CC|LD|CFLAGS|LDFLAGS|TMPDIR|LANG|LC|TZ)(_.*|FLAGS)?")
_NO_SETTINGS = ("CMAKE_CXX_COMPILER_LAUNCHER", "CMAKE_BUILD_PARALLEL_LEVEL", "PYTEST_CURRENT_TEST")
_PACKAGES = Path("/var/lib/dpkg/status")


def _digest(value: object) -> str:
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()


@cache
def machine_mark() -> str:
    """Changes with the interpreter, any installed package, the usual tools, and settings that reach them."""
    tools = []
    for name in _TOOLS:
        found = shutil.which(name)
        status = None if found is None else Path(found).resolve().stat()
        tools.append((name, found, status and (status.st_size, status.st_mtime_ns)))
    packages = sorted(f"{one.metadata['Name']} {one.version}" for one in importlib.metadata.distributions())
    settings = {
        name: value for name, value in os.environ.items() if _SETTINGS.fullmatch(name) and name not in _NO_SETTINGS
    }
    system = hashlib.sha256(_PACKAGES.read_bytes()).hexdigest() if _PACKAGES.is_file() else ""
    user = os.geteuid() if hasattr(os, "geteuid") else 0
    return _digest([sys.version, platform.platform(), os.cpu_count(), user, tools, packages, settings, system])


class Stamps:
    """Nothing is looked up when all is to be `fresh`; what passes is kept all the same."""

    def __init__(self, project: Project, *, fresh: bool = False) -> None:
        self._project = project
        self._folder = project.build / "stamps"
        self._fresh = fresh
        self._marks: dict[tuple[str, int, int], str] = {}

    def files(self) -> dict[str, str]:
        """All files of the repository as they are now, with marks of their contents: what git tracks, and new files
        that it does not ignore."""
        found = {}
        for place in map(PurePosixPath.as_posix, places(self._project.root)):
            path = self._project.root / place
            if _is_made(place) or not path.is_file():
                continue
            status = path.stat()
            known = (place, status.st_mtime_ns, status.st_size)
            if known not in self._marks:
                self._marks[known] = hashlib.sha256(path.read_bytes()).hexdigest()
            found[place] = self._marks[known]
        return found

    def digest(self, name: str, belongs: Belongs) -> str:
        """Of the machine, and of all files whose place `belongs`."""
        files = {place: mark for place, mark in self.files().items() if belongs(place)}
        return _digest([name, machine_mark(), str(self._project.root), files])

    def has_passed(self, name: str, digest: str) -> bool:
        """Whether the check passed with just this."""
        try:
            return not self._fresh and json.loads(self._path(name).read_text("utf-8"))["inputs"] == digest
        except (OSError, ValueError, KeyError, TypeError):
            return False

    def keep(self, name: str, digest: str, belongs: Belongs) -> None:
        """After the check has passed; not where a file was changed meanwhile, since nobody knows what it saw."""
        if self.digest(name, belongs) == digest:
            write_json(self._path(name), {"check": name, "inputs": digest})

    def _path(self, name: str) -> Path:
        return self._folder / f"{re.sub(r'[^a-z0-9]+', '-', name.lower()).strip('-')[:80]}.stamp.json"


def _is_made(place: str) -> bool:
    """Where git does not say what is made."""
    return place.startswith(("build/", ".venv/", ".git/", "grades/")) or "__pycache__" in place
