"""The kit compiled for the page: framework, tests and steps as objects, and the headers of each step for later."""

import hashlib
import itertools
import json
import os
import posixpath
import re
import shlex
import tempfile
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import write_bytes
from raysteps.common.platform import processor_count
from raysteps.course.manifest import Step, course_steps, read_all_steps
from raysteps.course.project import Project
from raysteps.play.packages import CATCH2, fetch_header, written_once
from raysteps.play.web_clang import INPUT, OUTPUT, WebClang
from raysteps.toolchain.build_kit import read_given_tests, tested_functions
from raysteps.toolchain.catch2 import TestOutcome, parse_report
from raysteps.toolchain.cmake import release_tree

# Folders by the names that the compiler knows them by, here and in the page.
_KIT, _LIBRARIES, _PARTS, _WORK = "/kit", "/libraries", "/parts", "/work"
_OWN_FOLDERS = ("framework", ".", "framework/absent")  # the last has the headers of steps that a students' kit lacks
_INCLUDES = (*(f"-I{posixpath.normpath(f'{_KIT}/{name}')}" for name in _OWN_FOLDERS), "-isystem", _LIBRARIES)
_WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Wno-unused-parameter")
# As RAYSTEPS_STUDENTS_OPTIONS in cmake/compiler.cmake: a variable that was given no value is wrong each time.
_OWN = (*_WARNINGS, "-ftrivial-auto-var-init=pattern")
_QUIET = "-w"  # the native build warns about what it compiles, too
# Catch2 2 for a system without signals, where nobody optimises what runs for a moment.
_TESTING = (_QUIET, "-DCATCH_CONFIG_NO_POSIX_SIGNALS", "-DCATCH_CONFIG_COLOUR_NONE")
_MAIN = "-Dmain="
_WEB = "framework/web"
_EXCEPTIONS = f"{_WEB}/exceptions.cpp"  # which all programs need
_PAGE_MAIN, _FIGURES_MAIN = f"{_WEB}/main.cpp", f"{_WEB}/figures_main.cpp"
_AHEAD = "web/ahead"  # what is compiled with some headers of core/, under their names
# Of a student's step, for which somebody waits: -O2 takes a sixth longer, and the pictures take no less.
_OWN_LEVEL = "-O1"
_TEST_MAIN, _RAYTRACE = f"{_MAIN}test_main", (_QUIET, f"{_MAIN}raytrace_main")
# Libraries that are headers only: the folder or file of each, and where packages put it.
_HEADERS = {
    "glm": ("glm",),
    "catch2/catch.hpp": ("catch2/catch.hpp",),
    "stb_image.h": ("stb_image.h", "stb/stb_image.h"),
    "stb_image_write.h": ("stb_image_write.h", "stb/stb_image_write.h"),
}
_USUAL_FOLDERS = ("/usr/include", "/usr/local/include", "/opt/homebrew/include")
MAX_AT_ONCE = min(4, processor_count())  # each takes some 300 MB
# What many sources include is read once, in a quarter of the time, as by cmake/precompiled.cmake. What a student writes
# is compiled as if there were none.
_COMMON = "algorithm cmath filesystem functional map memory optional sstream string variant vector core/scene.hpp"
_KIT_HEADERS = "".join(f"#include <{header}>\n" for header in _COMMON.split())
_PORTABLE = ("-fno-pch-timestamp", "-fpch-instantiate-templates")  # the same for the same headers, wherever they lie
_MOST_LISTS = 4  # of headers that one source may have read
_TEST_HEADERS = "#include <testing/testing.hpp>\n"


@dataclass(frozen=True)
class Source:
    """A file of the kit and how CMake compiles it, as far as that is not the machine's own."""

    path: str  # from the root
    words: tuple[str, ...] = ()


@dataclass(frozen=True)
class ObjectRequest:
    """An object that is to be made."""

    source: Source
    level: str = "-O2"
    flags: tuple[str, ...] = (_QUIET,)
    headers: str = ""  # that are precompiled


def _own(path: str) -> ObjectRequest:
    """What only the page has, so that no other compiler warns about it."""
    return ObjectRequest(Source(path), flags=(*_WARNINGS, "-Werror"), headers=_KIT_HEADERS)


def _words_of(entry: Mapping[str, str]) -> list[str]:
    return shlex.split(entry["command"], posix=os.name != "nt") if "command" in entry else list(entry["arguments"])


def _folders(words: Sequence[str]) -> list[str]:
    joined = re.findall(r"(?:^|\0)(?:-I|-isystem\0|/I|-external:I|/external:I)\0?([^\0]+)", "\0".join(words))
    return [folder.strip('"') for folder in joined]


def _one_by_one(file: Path) -> list[Path]:
    """The sources that CMake has put together (cmake/unity.cmake), or the file itself."""
    if file.parent.name != "Unity":
        return [file]
    return [Path(name) for name in re.findall(r'^#include "(.+)"$', file.read_text("utf-8"), re.MULTILINE)]


class Sources:
    """What CMake has found, so that nothing is listed twice: from its list of commands."""

    def __init__(self, project: Project) -> None:
        tree = release_tree(project)
        with tree.locked():
            tree.configure(again=True)  # only a build looks for new sources by itself
        self._root = project.root.resolve()
        text = (tree.folder / "compile_commands.json").read_text(encoding="utf-8")
        entries = [(Path(entry["file"]), _words_of(entry)) for entry in json.loads(text)]
        self._entries = [(path, words) for file, words in entries for path in _one_by_one(file)]

    def of(self, target: str) -> list[Source]:
        """The sources of one of CMake's targets, none where there is no such target."""
        mark = f"CMakeFiles/{target}.dir/"
        found = [(path, words) for path, words in self._entries if any(mark in word for word in words)]
        return [Source(self._inside(path), self._words(words)) for path, words in found]

    def _inside(self, path: Path) -> str:
        return path.resolve().relative_to(self._root).as_posix()

    def _words(self, words: Sequence[str]) -> tuple[str, ...]:
        defined = [
            f"-D{word[2:]}" for word in words if re.match(r"[-/]D\w", word) and not word[2:].startswith("NDEBUG")
        ]
        return tuple(defined)

    def folders_of_others(self) -> list[Path]:
        """Where libraries' headers were found."""
        found = dict.fromkeys(folder for _, words in self._entries for folder in _folders(words))
        outside = [Path(folder) for folder in found if not Path(folder).resolve().is_relative_to(self._root)]
        fetched = [self._root / "build" / "release" / "_deps" / name for name in ("glm-src", "catch2-src", "stb-src")]
        return [*outside, *fetched, *map(Path, _USUAL_FOLDERS)]


_OF_CORE = re.compile(r'#include "core/(\w+\.hpp)"')
_ASKED = re.compile(r"""include\s*\(?\s*[<"]([^">]+)[">]""")  # by #include and by __has_include


def dependencies_of(root: Path, made_of: str) -> list[str]:
    """Files of the kit, from its root, on which a result depends: those that the compiler has read, as it writes them
    for Make, and all names below which it may have looked for what these include, found or not."""
    paths = made_of.partition(":")[2].replace("\\\n", " ").split()
    read = [posixpath.relpath(path, _KIT) for path in paths if path.startswith(f"{_KIT}/")]
    names = set(read)
    for name in read:
        folders = (posixpath.dirname(name), *_OWN_FOLDERS)
        asked = _ASKED.findall((root / name).read_text("utf-8"))
        names.update(posixpath.normpath(f"{folder}/{one}") for folder in folders for one in asked)
    return sorted(names)


def _digest(*words: str) -> str:
    return hashlib.sha256("\0".join(words).encode()).hexdigest()


def headers_path(step: Step) -> str:
    """Where the first lines of the step's source stand by themselves."""
    return f"{_WORK}/headers-{step.number}.hpp"


@dataclass(frozen=True)
class Parts:
    """Files by their paths, and which of them belong together."""

    files: dict[str, bytes]
    objects: dict[str, list[str]]


class WebKit:
    """Compiles into a cache: an object is made anew when something that it may depend on has changed."""

    def __init__(self, project: Project, clang: WebClang, say: Callable[[str], None] = lambda text: None) -> None:
        self._project = project
        self._clang = clang
        self._say = say
        self._sources = Sources(project)
        self.steps = read_all_steps(project)
        self._shown = course_steps(project)
        self.model = "reference" if project.has_reference else "stub"
        self._cache = clang.cache
        self._used: set[Path] = set()
        self._made_before: dict[ObjectRequest, Path] = {}
        self._header_marks: dict[str, str] = {}
        self._turn = threading.Lock()  # to compile headers, which several sources wait for

    @property
    def used(self) -> list[Path]:
        """What the kit took from the cache or put there so far."""
        return [*self._used, self.libraries]

    def _header(self, name: str) -> Path:
        """The folder or file of a library, where it is installed."""
        places = [folder / place for folder in self._sources.folders_of_others() for place in _HEADERS[name]]
        found = next((place for place in places if place.exists()), None)
        if found is None and name.startswith("catch2/"):
            found = self._cache / "packages" / CATCH2.folder / "catch.hpp"
            self._used.add(found.parent)
            if not found.is_file():
                fetch_header(CATCH2, found, self._say)
        if found is None:
            raise UsageError(f"{name}: its headers are not where CMake found them; is the library installed?")
        return found

    @cached_property
    def libraries(self) -> Path:
        """The headers of GLM, Catch2 and stb by themselves: beside them lie those of this system. The
        folder's name changes with every byte of them."""
        content: dict[str, bytes] = {}
        for name in _HEADERS:
            found = self._header(name)
            for path in sorted(found.rglob("*")) if found.is_dir() else [found]:
                if path.is_file():
                    content[(Path(name) / path.relative_to(found)).as_posix()] = path.read_bytes()
        return written_once(self._cache, "libraries", content)

    @cached_property
    def _places(self) -> dict[str, Path]:
        objects = self._cache / "objects"
        objects.mkdir(parents=True, exist_ok=True)
        return {_KIT: self._project.root, _LIBRARIES: self.libraries, _PARTS: objects, "/usr": self._clang.system}

    @cached_property
    def _common_mark(self) -> str:
        """Of what every source may read: the compiler's files and libraries."""
        return _digest(self._clang.wasm.parent.parent.name, self.libraries.name)

    def _name(self, path: Path) -> str:
        return path.relative_to(self._project.root).as_posix()

    def _header_mark(self, name: str) -> str:
        if name not in self._header_marks:
            path = self._project.root / name
            self._header_marks[name] = _digest(path.read_text("utf-8")) if path.is_file() else "none"
        return self._header_marks[name]

    def _place(self, mark: str, ending: str) -> Path:
        return self._cache / "objects" / f"{mark[:24]}.{ending}"

    @cached_property
    def _commands(self) -> dict[tuple[str, bool], list[str]]:
        return {
            (level, header): self._clang.compile_command(level, [], header=header)
            for level, header in itertools.product(("-O2", "-O1", "-Oz"), (False, True))
        }

    def _made(self, wanted: ObjectRequest) -> Path:
        """The object."""
        source = wanted.source
        words = [*self._commands[wanted.level, False], *_INCLUDES, *source.words, *wanted.flags]
        if wanted.headers:
            words += ["-include-pch", f"{_PARTS}/{self._precompiled(wanted).name}"]
        text = (self._project.root / source.path).read_text("utf-8")
        return self._compiled("o", words, f"{_KIT}/{source.path}", text)

    def _precompiled(self, wanted: ObjectRequest) -> Path:
        """The headers of a source, as the compiler keeps them in memory. Their text has to stay beside that."""
        defined = [flag for flag in wanted.flags if flag.startswith("-D") and not flag.startswith(_MAIN)]
        words = [*self._commands[wanted.level, True], *_INCLUDES, _QUIET, *defined, *_PORTABLE]
        text = self._kept("hpp", wanted.headers)
        with self._turn:
            if not text.is_file():
                write_bytes(text, wanted.headers.encode())
            return self._compiled("pch", words, f"{_PARTS}/{text.name}", wanted.headers)

    def _compiled(self, ending: str, words: Sequence[str], path: str, text: str) -> Path:
        """What the compiler makes of a source with this text: anew when the text has changed, or a header that it read
        before, or where one is now that would have been found before. A students' kit has other headers than the whole
        one: what was made of several is kept."""
        listed = self._kept("headers", self._common_mark, path, text, *words)
        lists = listed.read_text("utf-8").split("\n\n") if listed.is_file() else []
        found = (self._by_headers(listed, names, ending) for names in lists)
        target = next((one for one in found if one.is_file()), None)
        if target is None:
            with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
                if path.startswith(f"{_WORK}/"):
                    (Path(folder) / Path(path).name).write_text(text, encoding="utf-8", newline="\n")
                named = {INPUT: path, OUTPUT: f"{_WORK}/made"}
                more = ["-dependency-file", f"{_WORK}/read", "-MT", "made"]
                command = [*(named.get(word, word) for word in words), *more]
                self._clang.make(command, {**self._places, _WORK: Path(folder)})
                names = "\n".join(dependencies_of(self._project.root, (Path(folder) / "read").read_text("utf-8")))
                others = [one for one in lists if one != names]
                write_bytes(listed, "\n\n".join([names, *others][:_MOST_LISTS]).encode())
                target = self._by_headers(listed, names, ending)
                write_bytes(target, (Path(folder) / "made").read_bytes())
        self._used.add(target.with_suffix(""))
        return target

    def _by_headers(self, listed: Path, names: str, ending: str) -> Path:
        """Where what was made with headers of these names lies."""
        marks = [f"{name} {self._header_mark(name)}" for name in names.splitlines()]
        return self._place(_digest(listed.stem, *marks), ending)

    @cached_property
    def _wanted(self) -> dict[str, list[ObjectRequest]]:
        """What is to be made, by the name of the part that it belongs to. `kit` is what programs take what they need
        from; `figures` is the site's."""
        of = self._sources.of
        libraries = [one for name in ("core", "io", "render", "absent") for one in of(f"raysteps-{name}")]
        paths = sorted((self._project.root / _WEB).glob("*.cpp"))
        own = [self._name(path) for path in paths]
        beside = (_EXCEPTIONS, _PAGE_MAIN, _FIGURES_MAIN)
        inspect = [*of("inspect-app"), *of("raysteps-inspect-recorded"), *of("raysteps-inspect")]
        parts = {
            "web": [
                _own(_PAGE_MAIN),
                *(
                    ObjectRequest(source, flags=(_QUIET,) if source in inspect else _RAYTRACE, headers=_KIT_HEADERS)
                    for source in of("raytrace-app")
                ),
                *(ObjectRequest(source, "-Oz", (*_TESTING, _TEST_MAIN)) for source in of("raysteps-testing")),
            ],
            "exceptions": [_own(_EXCEPTIONS)],
            "inspect": [ObjectRequest(source, headers=_KIT_HEADERS) for source in inspect],
            "figures": [_own(_FIGURES_MAIN)],
            "kit": [
                *(ObjectRequest(source, headers=_KIT_HEADERS) for source in libraries),
                *(_own(name) for name in own if name not in beside),
            ],
        }
        for step in self.steps:
            model = of(f"step-{step.number}-{self.model}-raw")
            parts[f"step-{step.number}"] = [ObjectRequest(source, headers=_KIT_HEADERS) for source in model]
        for step in self._shown:
            tests = of(f"test-{step.number}-objects")
            parts[f"test-{step.number}"] = [ObjectRequest(source, "-O1", _TESTING, _TEST_HEADERS) for source in tests]
        if not all(parts.values()):
            raise GraderFault("CMake's list of commands lacks parts of the kit")
        return parts

    def _objects(self, names: Iterable[str]) -> dict[str, list[Path]]:
        """Those of these parts. What is in several parts is compiled once."""
        parts = {name: self._wanted[name] for name in names}
        wanted = [one for one in dict.fromkeys(itertools.chain(*parts.values())) if one not in self._made_before]
        _ = self._commands, self._places, self._common_mark  # before several ask for them at once
        with ThreadPoolExecutor(MAX_AT_ONCE) as pool:
            jobs = {pool.submit(self._made, one): one for one in wanted}
            for done, job in enumerate(as_completed(jobs), 1):
                self._made_before[jobs[job]] = job.result()
                self._say(f"compiling the kit for the page (once): {done} of {len(jobs)}")
        return {name: [self._made_before[one] for one in some] for name, some in parts.items()}

    # What the page is given.

    @cached_property
    def _archive(self) -> Path:
        """The framework: a program takes from it what it needs."""
        objects = self._objects(["kit"])["kit"]
        target = self._kept("a", *(path.name for path in objects))
        if not target.is_file():
            with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
                places = {**self._places, _WORK: Path(folder)}
                self._clang.make(["ar", "rcs", f"{_WORK}/kit.a", *(f"{_PARTS}/{one.name}" for one in objects)], places)
                write_bytes(target, (Path(folder) / "kit.a").read_bytes())
        return target

    def _kept(self, ending: str, *marks: str) -> Path:
        place = self._place(_digest(*marks), ending)
        self._used.add(place.with_suffix(""))
        return place

    def parts(self) -> Parts:
        """All objects, by the paths that the linker in the page knows them by."""
        named = self._objects(name for name in self._wanted if name != "figures") | {"kit": [self._archive]}
        found = {f"{_PARTS}/{path.name}": path for some in named.values() for path in some}
        return Parts(
            {name.lstrip("/"): path.read_bytes() for name, path in found.items()},
            {name: [f"{_PARTS}/{path.name}" for path in some] for name, some in named.items()},
        )

    def step_command(self) -> list[str]:
        """How a student's step is compiled."""
        return [*self._commands[_OWN_LEVEL, False], *_INCLUDES, *_OWN, "-fno-caret-diagnostics"]

    def headers_text(self, step: Step, includes: str) -> str:
        """What is compiled ahead of a source with these first lines. What it adds to them brings names of namespace
        compiled_ahead only: a header that is missing is missed in the page as everywhere."""
        contracts = sorted((self._project.steps / step.id).glob("*.hpp"))
        names = [name for path in contracts for name in _OF_CORE.findall(path.read_text("utf-8"))]
        ahead = [name for name in names if (self._project.root / "framework" / _AHEAD / name).is_file()]
        return "".join([includes, *(f'#include "{_AHEAD}/{name}"\n' for name in ahead)])

    def headers(self, step: Step, text: str) -> Path:
        """This text, as the compiler keeps it in memory."""
        return self._compiled("pch", self.headers_command(), headers_path(step), text)

    def headers_command(self) -> list[str]:
        """How these are compiled; the page does it, too, when a student includes something else."""
        return [*self._commands[_OWN_LEVEL, True], *_INCLUDES, *_OWN, *_PORTABLE]

    def _linked(self, *names: str) -> Path:
        """A program of these parts and of what they need of the framework."""
        parts = self._objects([*names, "kit"]) | {"kit": [self._archive]}
        inputs = [path for some in parts.values() for path in some]
        target = self._kept("wasm", *(path.name for path in inputs))
        if not target.is_file():
            with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
                places = {**self._places, _WORK: Path(folder)}
                words: list[str] = []
                for word in self._clang.link_command():
                    words += [f"{_PARTS}/{path.name}" for path in inputs] if word == INPUT else [word]
                self._clang.make([f"{_WORK}/made" if word == OUTPUT else word for word in words], places)
                write_bytes(target, (Path(folder) / "made").read_bytes())
        return target

    @property
    def _model(self) -> list[str]:
        """The parts of every step, and what they need in a browser."""
        return ["exceptions", *(f"step-{step.number}" for step in self.steps)]

    @cached_property
    def _program(self) -> Path:
        """With all visible tests; every step is the model's."""
        return self._linked("web", *self._model, *(f"test-{step.number}" for step in self._shown))

    def figures(self) -> Path:
        """A program of the live figures alone; every step is the model's."""
        return self._linked("figures", *self._model)

    def _ran(self, words: Sequence[str], options: Mapping[str, str], scene: Path | None = None) -> dict[str, Path]:
        """The files that one run of the reference's program makes, by their endings; `options` name them."""
        content = "" if scene is None else scene.read_text("utf-8")
        targets = {made: self._kept(made, self._program.name, *words, content) for made in options}
        if not all(target.is_file() for target in targets.values()):
            with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
                (Path(folder) / "scene.nff").write_text(content, encoding="utf-8")
                named = [word for made, option in options.items() for word in (option, f"{_WORK}/{made}")]
                said = self._clang.program(self._program, [*words, *named], {_WORK: Path(folder)})
                if said.code != 0:
                    raise GraderFault(f"the reference fails in the page's program: {said.stderr.strip()}")
                for made, target in targets.items():
                    write_bytes(target, (Path(folder) / made).read_bytes())
        return targets

    @cached_property
    def _outcomes(self) -> list[TestOutcome]:
        cases = parse_report(self._ran(["test", "-r", "xml"], {"xml": "-o"})["xml"].read_bytes())
        if not cases or not all(case.passed for case in cases):
            failed = next((case.name for case in cases or () if not case.passed), "all")
            raise GraderFault(f"the reference fails its own tests in the page's program: {failed}")
        return cases

    def tests(self, step: Step) -> Mapping[str, Sequence[str]]:
        """The visible tests, each with the functions that it tests."""
        if not self._project.has_reference:
            return read_given_tests(self._project)[step.id]
        own = [case for case in self._outcomes if step.id in case.tags]
        return {case.name: tested_functions(step, case.name, case.tags) for case in own}

    def _drawn(self, scene: Path, args: Sequence[str], options: Mapping[str, str]) -> dict[str, Path]:
        words = ["raytrace", f"{_WORK}/scene.nff", *args, "--threads", "1", "--quiet"]
        return self._ran(words, options, scene)

    def picture(self, scene: Path, args: Sequence[str]) -> Path:
        """The reference's, as raytrace writes it."""
        return self._drawn(scene, args, {"ppm": "-o"})["ppm"]

    def noisy_picture(self, scene: Path, args: Sequence[str]) -> tuple[Path, Path]:
        """Likewise, and its `--estimates`."""
        made = self._drawn(scene, args, {"ppm": "-o", "estimates": "--estimates"})
        return made["ppm"], made["estimates"]
