"""Which checks need not run again on this machine: those that passed on the same bytes, with the same tools.

A stamp is a file in build/stamps/, written when a check has passed. It holds a digest of everything that the check can
depend on: files of the repository by their contents, and the machine: interpreter, packages, tools, settings. Files are
named too generously rather than too narrowly; what names none depends on all of them.
"""

import ast
import hashlib
import importlib.metadata
import json
import os
import platform
import re
import shutil
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from itertools import pairwise
from pathlib import Path, PurePosixPath

from raysteps.common.files import write_json
from raysteps.course.project import Project
from raysteps.course.tracked_files import places
from raysteps.toolchain.fingerprint import fingerprint

Belongs = Callable[[str], bool]  # whether a file counts, by its place in the repository

_PROGRAMS = (
    "ar", "bwrap", "c++", "cc", "ccache", "chromium", "clang", "clang++", "cmake", "git", "g++", "ld", "make", "ninja",
    "node", "povray", "sqlite3", "wine", "x86_64-w64-mingw32-g++-posix", "xdotool", "Xvfb", "zip",
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
        for place in map(PurePosixPath.as_posix, places(self._project.root)):
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

    def digests(self, checks: Mapping[str, Belongs]) -> dict[str, str]:
        """Of checks by name: of the machine, and of all files whose place belongs."""
        if not checks:
            return {}  # the machine is not asked before its packages are installed
        files, start = self.files(), [machine_mark(), str(self._project.root)]
        found: dict[Belongs, str] = {}
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

    def keep(self, checks: Mapping[str, Belongs], before: Mapping[str, str]) -> None:
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


# What a Python file depends on, told from its source, too generously rather than too narrowly.
#
# Modules: what it imports, and what that imports, wherever in the file; modules that it names in a text, as for another
# process. A file that names the package itself, or reads its sources, depends on all of it. Texts: the documents, where
# a module names one. All other files of the repository - steps, solutions, scenes, framework, data - count always.

_SOURCES, _TOOLS, _TESTS = "grader/src/", "tools/", "grader/tests/"
_COMMON = ("grader/tests/conftest.py",)
_WHOLE = re.compile(r"grader/src(/.*)?|src|tools|(.*/)?\*\.py")
_WHOLE_IN_TESTS = re.compile(r"(\./)?raysteps|grader(/.*)?")
_TEXTS = re.compile(r"[\w./*{}-]*\.md|docs(/[\w./*-]*)?|(.*/)?README(\.md)?")
_DOTTED = re.compile(r"(raysteps|tools)(\.\w+)+")
_READS_ALL = places.__module__
# They read all files too, but nothing that a check tells hangs on it: the name of the built kit's folder, and stamps.
# What is meant to test them counts all files.
_NOT_FOLLOWED = {fingerprint.__module__, __name__}


def is_text(place: str) -> bool:
    """A document, or a picture in one."""
    return place.endswith(".md") or place.startswith("docs/")


def is_code(place: str) -> bool:
    """A Python file that is followed by its imports."""
    return place.endswith(".py") and place.startswith((_SOURCES, _TOOLS, _TESTS))


@dataclass
class Inputs:
    """Of one Python file, or several."""

    code: set[str] = field(default_factory=set)  # places of Python files
    whole: bool = False  # the package and the tests, all of them
    texts: bool = False

    def belongs(self, place: str) -> bool:
        """Whether a file of the repository counts."""
        if is_code(place):
            return place in self.code or (self.whole and place.startswith((_SOURCES, _TOOLS)))
        return self.texts or not is_text(place)


@dataclass(frozen=True)
class _Module:
    named: frozenset[str]  # modules, as far as they exist
    whole: bool
    texts: bool


class Sources:
    """The Python files of the repository."""

    def __init__(self, project: Project, files: Iterable[str]) -> None:
        self._root = project.root
        self._places = {_name_of(place): place for place in files if is_code(place)}
        self._read = cache(self._module)

    def tests(self) -> list[str]:
        """Places of the files with tests."""
        found = (place for place in self._places.values() if place.startswith(_TESTS))
        return sorted(place for place in found if PurePosixPath(place).name.startswith("test_"))

    def of_test(self, place: str) -> Inputs:
        """A file with tests, and what pytest loads before it."""
        return self._inputs([_name_of(name) for name in (place, *_COMMON)])

    def of_modules(self, *names: str) -> Inputs:
        """Modules of the package."""
        return self._inputs(list(names))

    def places_of(self, *names: str) -> set[str]:
        """The files of modules, without what they import."""
        return {self._places[name] for name in names}

    def _inputs(self, names: list[str]) -> Inputs:
        inputs, waiting, known = Inputs(), list(names), set()
        while waiting:
            name = waiting.pop()
            if name in known:
                continue
            known.add(name)
            place, module = self._places[name], self._read(name)
            inputs.code.add(place)
            if name in _NOT_FOLLOWED and not any(
                _is_test_of(name, self._places[first], self._read(first)) for first in names
            ):
                continue
            inputs.whole |= module.whole or name == _READS_ALL
            inputs.texts |= module.texts or name == _READS_ALL
            waiting += module.named
            waiting += [above for above in _above(name) if above in self._places]
        if inputs.whole:
            inputs.texts = True
        return inputs

    def _module(self, name: str) -> _Module:
        place = self._places[name]
        tree = ast.parse((self._root / place).read_text(encoding="utf-8"))
        documented = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
        package = name if place.endswith("/__init__.py") else name.rpartition(".")[0]
        named: set[str] = set()
        words: set[str] = set()
        whole = False
        for node in ast.walk(tree):
            match node:
                case ast.Import():
                    named |= {alias.name for alias in node.names}
                    whole |= not named.isdisjoint({"raysteps", "tools"})
                case ast.ImportFrom(module=module, level=0) if module:
                    named |= {module, *(f"{module}.{alias.name}" for alias in node.names)}
                case ast.List(elts=parts) | ast.Tuple(elts=parts) | ast.Set(elts=parts) | ast.Call(args=parts):
                    values = [str(part.value) for part in parts if isinstance(part, ast.Constant)]
                    if isinstance(node, ast.Call) and ast.unparse(node.func).endswith("import_module"):
                        named |= {f"{package}.{value}".lstrip(".") for value in values}
                    whole |= "grader" in values or ("-m", "raysteps") in pairwise(values)
                case ast.Constant(value=str(text)) if id(node) not in documented:
                    words.add(text)
                case _:
                    continue
        for word in words:
            named |= {found[0] for found in _DOTTED.finditer(word)}
            if re.fullmatch(r"\w+\.py", word):
                named.add(f"{package}.{word.removesuffix('.py')}".lstrip("."))  # beside it, as keeper.py
            if word.startswith("raysteps.") and word.endswith("."):  # the rest of the name is made when it runs
                named |= {one for one in self._places if one.startswith(word)}
            whole |= bool(_WHOLE.fullmatch(word))
            whole |= place.startswith(_TESTS) and bool(_WHOLE_IN_TESTS.fullmatch(word))
        texts = any(_TEXTS.fullmatch(word) for word in words)
        return _Module(frozenset(one for one in named if one in self._places), whole, texts)


def _is_test_of(name: str, place: str, module: _Module) -> bool:
    return place.startswith(_TESTS) and name in module.named


def _name_of(place: str) -> str:
    """raysteps.course.stubs, tools.lint; a test is known by its own name alone, wherever it lies, but in a package."""
    name = place.removeprefix(_SOURCES).removeprefix(_TESTS).removesuffix(".py").removesuffix("/__init__")
    if place.startswith(_TESTS) and not name.startswith("hostile/"):
        name = name.rpartition("/")[2]
    return name.replace("/", ".")


def _above(name: str) -> Iterator[str]:
    while "." in name:
        name = name.rpartition(".")[0]
        yield name
