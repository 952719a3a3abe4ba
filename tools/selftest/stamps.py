"""Which checks need not run again on this machine: those that passed on the same bytes, with the same tools.

A stamp is a file in build/stamps/, written when a check has passed. It holds a digest of everything that the check can
depend on: files of the repository by their contents, and the machine: interpreter, packages, tools, settings. Which
files those are is told by inputs.py.
"""

import hashlib
import importlib.metadata
import json
import os
import platform
import re
import shutil
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from functools import cache
from pathlib import Path, PurePosixPath

from raysteps.common.files import write_json
from raysteps.course.project import Project
from raysteps.course.tracked_files import list_files

FileFilter = Callable[[str], bool]  # whether a file counts, by its place in the repository

_PROGRAMS = (
    "ar", "bwrap", "c++", "cc", "ccache", "chromium", "chromium-headless-shell", "clang", "clang++", "cmake", "git",
    "g++", "ld", "make", "ninja", "node", "povray", "sqlite3", "wine", "x86_64-w64-mingw32-g++-posix", "xdotool",
    "Xvfb", "zip",
)  # fmt: skip
_SETTINGS = re.compile(r"(CMAKE|RAYSTEPS|PYTEST|CXX|CPP|CC|LD|CFLAGS|LDFLAGS|TMPDIR|LANG|LC|TZ)(_.*|FLAGS)?")
_NO_SETTINGS = ("CMAKE_CXX_COMPILER_LAUNCHER", "CMAKE_BUILD_PARALLEL_LEVEL", "PYTEST_CURRENT_TEST")
_PRINTED = (1, 2)
_PACKAGES = Path("/var/lib/dpkg/status")


def _digest(value: object) -> str:
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()


@cache
def machine_mark() -> str:
    """Changes with the interpreter, any installed package, the usual tools, and settings that reach them."""
    tools = []
    for name in _PROGRAMS:
        found = shutil.which(name)
        status = None if found is None else Path(found).resolve().stat()
        tools.append((name, found, status and (status.st_size, status.st_mtime_ns)))
    installed = importlib.metadata.distributions()  # the kit itself may stand there twice, once it was set up
    packages = sorted({f"{one.metadata['Name']} {one.version}" for one in installed})
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
        that it does not ignore, but for one that this program itself prints to."""
        found = {}
        own = list(_printed_to())
        for place in map(PurePosixPath.as_posix, list_files(self._project.root)):
            path = self._project.root / place
            if _is_made(place) or not path.is_file():
                continue
            status = path.stat()
            if any(os.path.samestat(status, one) for one in own):
                continue
            known = (place, status.st_mtime_ns, status.st_size)
            if known not in self._marks:
                self._marks[known] = hashlib.sha256(path.read_bytes()).hexdigest()
            found[place] = self._marks[known]
        return found

    def digests(self, checks: Mapping[str, FileFilter]) -> dict[str, str]:
        """Of checks by name: of the machine, and of all files whose place belongs."""
        if not checks:
            return {}  # the machine is not asked before its packages are installed
        files, start = self.files(), [machine_mark(), str(self._project.root)]
        found: dict[FileFilter, str] = {}
        for belongs in checks.values():
            if belongs not in found:
                found[belongs] = _digest([place + mark for place, mark in files.items() if belongs(place)])
        return {name: _digest([name, *start, found[belongs]]) for name, belongs in checks.items()}

    def has_passed(self, name: str, digest: str) -> bool:
        """Whether the check passed with just this."""
        try:
            return not self._fresh and json.loads(self._path(name).read_text("utf-8"))["inputs"] == digest
        except (OSError, ValueError, KeyError, TypeError):
            return False

    def keep(self, checks: Mapping[str, FileFilter], before: Mapping[str, str]) -> None:
        """After these checks have passed; `before`: their digests as they began. Not where a file was changed
        meanwhile, since nobody knows what it saw."""
        for name, digest in self.digests(checks).items():
            if before[name] == digest:
                write_json(self._path(name), {"check": name, "inputs": digest})

    def _path(self, name: str) -> Path:
        return self._folder / f"{re.sub(r'[^a-z0-9]+', '-', name.lower()).strip('-')[:80]}.stamp.json"


def _printed_to() -> Iterator[os.stat_result]:
    """Where stdout and stderr go: `test > test.log` changes that file all the time."""
    for file in _PRINTED:
        with suppress(OSError):
            yield os.fstat(file)


def _is_made(place: str) -> bool:
    """Where git does not say what is made."""
    return place.startswith(("build/", ".venv/", ".git/", "grades/")) or "__pycache__" in place
