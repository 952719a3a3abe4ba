"""The kit as it grades: framework, references and tests, built once and only read from then on."""

import atexit
import errno
import hashlib
import json
import os
import shutil
import tempfile
import threading
import time
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Literal, TypeAlias

from raysteps.common.platform import executable
from raysteps.course.manifest import Step, earlier, up_to
from raysteps.course.project import Project
from raysteps.toolchain.limits import StepLimits, limits_of
from raysteps.toolchain.link import (
    Description,
    RemoteParts,
    library_name,
    link,
    with_local_symbols,
    with_redirected_calls,
)

Kind = Literal["raytrace", "worker", "test"]
ProgressCallback = Callable[[str], None]
_EVERY = 5.0  # seconds


def rate_limited(say: ProgressCallback) -> ProgressCallback:
    """Says at most every few seconds what changes all the time, from the first few on."""
    said = time.monotonic()

    def tell(text: str) -> None:
        nonlocal said
        if time.monotonic() > said + _EVERY:
            said = time.monotonic()
            say(text)

    return tell


Tests = Mapping[str, Mapping[str, Sequence[str]]]  # by step: its visible tests, each with the functions that it tests


# Links what is needed of a kit when it is needed: programs that ask steps in another process, and the boxes that these
# are in. Nothing of a student's is in the first, and nothing of a reference's in the second. And programs that load
# steps themselves, for code that nothing has to be kept from.


_SANITIZERS = "-fsanitize=address,undefined"
# Without vptr, which asks for names that a step may not ask for, and null, in which g++ 12 gives false alarms; a true
# null access still stops at the address sanitizer. Each call is told of, to see which of them does not return.
_CAREFUL = ("-O1", "-g", "-fno-omit-frame-pointer", "-D_GLIBCXX_ASSERTIONS", "-finstrument-functions")
_SANITIZED = (*_CAREFUL, _SANITIZERS, "-fno-sanitize=vptr,null")

Replaced: TypeAlias = frozenset[str]  # linker names of functions of one step
NONE_REPLACED: Replaced = frozenset()
_NOT_OFFERED = "raysteps_not_offered"  # see framework/remote/home.cpp


def function_name(shown: str) -> str:
    """As step.toml calls a function that C++ writes like this, with its arguments."""
    return shown.partition("(")[0].removeprefix("raysteps::")


def linker_names_of(functions: Collection[str], shown: Mapping[str, str]) -> Replaced:
    """Linker names of these functions, as step.toml calls them, among those that `shown` writes as C++ does."""
    return frozenset(name for name, text in shown.items() if function_name(text) in functions)


def _replaced_suffix(replaced: Replaced) -> str:
    """At the end of a name: what is not in it."""
    return f"-but-{hashlib.sha256(' '.join(sorted(replaced)).encode()).hexdigest()[:16]}" if replaced else ""


class ProgramLinker:
    """Works in the folder of a kit: takes parts that were copied there, and keeps what it has linked."""

    def __init__(self, folder: Path, description: Description) -> None:
        self._folder = folder
        self._description = description

    @property
    def _remote(self) -> RemoteParts:
        assert self._description.remote is not None
        return self._description.remote

    def _part(self, path: Path) -> Path:
        return self._folder / "remote" / path.parent.name / path.name

    def copy_parts(self, numbers: Collection[str]) -> None:
        """Of the build folder, which changes while a kit is in use. `numbers`: of the steps that are asked."""
        parts = self._remote
        groups = (parts.stand_ins, parts.services)
        asked = [path for group in groups for number, path in group.items() if number in numbers]
        for path in (*parts.wire, parts.home, parts.box, parts.core, *parts.later.values(), *asked):
            self._part(path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, self._part(path))

    @property
    def core(self) -> Path:
        """The library that a step in a box may ask for."""
        return self._part(self._remote.core)

    def can_be_asked(self, number: str) -> bool:
        """A course's own step, of which the kit knows nothing, cannot."""
        return number in self._remote.stand_ins

    def _all_parts(self, kind: str) -> list[str]:
        return (self._folder / "rest" / f"{kind}.txt").read_text("utf-8").splitlines()

    def home(self, kind: str, own: Sequence[str], folder: Path, replaced: Replaced = NONE_REPLACED) -> Path:
        """The program that asks the steps `own`; all others are the reference's, and so are the `replaced` functions of
        the last. `kind` is as in rest/KIND.txt. Linked into `folder` where the kit may not be written to."""
        name = f"{kind}-beside-{'-'.join(own)}{_replaced_suffix(replaced)}"
        return self._linked(name, lambda room: self._home_parts(kind, own, room, replaced), folder)

    def _home_parts(self, kind: str, own: Sequence[str], room: Path, replaced: Replaced) -> list[str | Path]:
        parts = self._remote
        objects = [*self._without(own, kind), *self._reference_of(own[-1], room, replaced)]
        objects += [self._shown(self._part(parts.stand_ins[number]), replaced, room) for number in own]
        # Of a later step a box learns nothing, whatever it asks.
        asked = [number for number in parts.services if number < own[-1] and number not in own]
        asked += own[-1:] if replaced else []
        objects += [word for number in asked for word in self._service(number, own, room)]
        objects += [*(self._part(path) for path in parts.wire), self._part(parts.home)]
        return [*objects, *(self._folder / line for line in self._all_parts("libraries"))]

    def box(self, own: Sequence[str], folder: Path, replaced: Replaced = NONE_REPLACED) -> Path:
        """The box of these steps, which lacks their libraries. What calls a `replaced` function in it asks home."""
        name = f"box-{'-'.join(own)}{_replaced_suffix(replaced)}"
        return self._linked(name, lambda room: self._box_parts(own, room, replaced), folder)

    def _box_parts(self, own: Sequence[str], room: Path, replaced: Replaced) -> list[str | Path]:
        parts = self._remote
        objects: list[str | Path] = [self._part(parts.box), *(self._part(path) for path in parts.wire)]
        objects += [self._part(parts.services[number]) for number in own]
        objects += [
            self._part(path) for number, path in parts.stand_ins.items() if number < own[-1] and number not in own
        ]
        if replaced:
            objects.append(self._shown(self._part(parts.stand_ins[own[-1]]), self._others(own[-1], replaced), room))
        objects += [self._part(path) for number, path in parts.later.items() if number > own[-1]]
        return [*objects, *self._loading(own, self.core)]

    def _loading(self, own: Sequence[str], core: Path) -> list[str | Path]:
        """What makes a program load these steps and show them the core."""
        words: list[str | Path] = ["-Wl,--whole-archive", core, "-Wl,--no-whole-archive", "-Wl,--no-as-needed"]
        words += [self._folder / "placeholders" / library_name(number) for number in own]
        return [*words, *(f"-Wl,--dynamic-list={self._folder / 'steps' / f'{number}.dynamic'}" for number in own)]

    def alone(self, name: str, kind: str, own: Sequence[str], folder: Path, replaced: Replaced = NONE_REPLACED) -> Path:
        """The program of that name that loads the steps `own`; all others are the reference's, and so are the
        `replaced` functions of the last."""

        def parts(room: Path) -> list[str | Path]:
            objects = [*self._without(own, kind), *self._reference_of(own[-1], room, replaced)]
            *libraries, core = (self._folder / line for line in self._all_parts("libraries"))
            return [*self._description.more_sources, *objects, *libraries, *self._loading(own, core)]

        return self._linked(name + _replaced_suffix(replaced), parts, folder)

    def _without(self, own: Sequence[str], kind: str) -> list[str | Path]:
        """The program's objects and all references but these steps'."""
        objects: list[str | Path] = [self._folder / line for line in self._all_parts(kind)]
        references = (self._folder / "parts" / "references").iterdir()
        return objects + [path for path in references if path.stem not in own]

    def _names(self, number: str, kind: Literal["names", "allowed"]) -> Replaced:
        return frozenset(json.loads((self._folder / "steps" / f"{number}.{kind}.json").read_text("utf-8")))

    def _others(self, number: str, replaced: Replaced) -> Replaced:
        """The functions of a step that are not replaced."""
        return self._names(number, "names") - replaced

    def _service(self, number: str, own: Sequence[str], room: Path) -> list[str | Path]:
        """What answers the box of the steps `own` for this one: nothing that none of them may call."""
        path = self._part(self._remote.services[number])
        barred = self._others(number, NONE_REPLACED.union(*(self._names(one, "allowed") for one in own)))
        tools = self._description.seal
        if not barred or tools is None:
            return [path]
        return with_redirected_calls(tools, path, barred, _NOT_OFFERED, room / f"{path.parent.name}-{path.name}")

    def _reference_of(self, number: str, room: Path, replaced: Replaced) -> list[Path]:
        """What the reference has of a step that is handed in: the replaced functions."""
        path = self._folder / "parts" / "references" / f"{number}.o"
        return [self._shown(path, self._others(number, replaced), room)] if replaced else []

    def _shown(self, path: Path, hidden: Replaced, room: Path) -> Path:
        """The object, or a copy of it that does not show these names."""
        tools = self._description.seal
        if not hidden or tools is None:
            return path
        return with_local_symbols(
            tools, path, hidden, room / f"{path.parent.name}-{path.stem}{_replaced_suffix(hidden)}.o"
        )

    def _linked(self, name: str, parts: Callable[[Path], list[str | Path]], folder: Path) -> Path:
        """Under its name once it is whole: several may want it at the same time. `parts` has a room for copies."""
        program = self._folder / "bin" / name
        if program.is_file():
            return program
        try:
            with tempfile.TemporaryDirectory(prefix=".new-", dir=self._folder / "bin") as new:
                link(self._description, parts(Path(new)), Path(new) / name)
                return (Path(new) / name).rename(program)
        except OSError as error:
            if error.errno not in (errno.EACCES, errno.EPERM, errno.EROFS):
                raise
            link(self._description, parts(folder), folder / name)
            return folder / name


_first_asks = threading.Lock()


@cache
def _new_room() -> Path:
    room = Path(tempfile.mkdtemp(prefix="raysteps-kept-"))  # open to this user only
    atexit.register(shutil.rmtree, room, ignore_errors=True)
    return room


def _own_room() -> Path:
    """One for this process, whichever thread asks first."""
    with _first_asks:
        return _new_room()


@dataclass(frozen=True)
class BuiltKit:
    """Lives in build/kit/FINGERPRINT. `tests` holds each step's visible test cases."""

    project: Project
    folder: Path
    fingerprint: str
    steps: list[Step]
    description: Description
    tests: Tests
    interpreter: str | None  # the dynamic loader of this system; none where steps are no libraries
    slowness: float = 1.0  # of this machine: programs may run so many times as long
    boxed: bool = True  # whether steps are asked in boxes, where there are any

    def limits_of(self, step: Step, changes: Mapping[str, float] | None = None) -> StepLimits:
        """On this machine. `changes`: what a course says instead, by name."""
        return limits_of(step, changes or {}, self.slowness)

    @property
    def include(self) -> Path:
        """The headers that a student's file may include: core/ and the steps' contracts."""
        return self.folder / "include"

    def kept(self, kind: Literal["pictures", "answers"], name: str) -> Path:
        """Something of the reference, kept from run to run: a picture, or answers to the judge. What a kit lacks that
        may only be read, as in an image, is kept as long as this process runs."""
        path = self.folder / kind / name
        return path if path.is_file() or os.access(path.parent, os.W_OK) else _own_room() / kind / name

    @property
    def has_reference(self) -> bool:
        """In a students' kit stubs stand where the reference's steps would."""
        return self.project.has_reference

    def handed_in_up_to(self, step: Step) -> list[Step]:
        """What is loaded where steps are tried together. In a students' kit those of all parts before it, too: nothing
        else stands there."""
        if self.has_reference:
            return up_to(step, self.steps)
        return [*earlier(step, self.steps), step]

    def reference(self, kind: Kind, step: Step | None = None) -> Path:
        """A program in which every step is the reference's."""
        return executable(self.folder / "bin" / (f"test-{step.number}" if step is not None else kind))

    def functions(self, step: Step) -> dict[str, str]:
        """Linker names of the step's functions, and how C++ writes them; empty where steps are no libraries."""
        path = self.folder / "steps" / f"{step.number}.names.json"
        names: dict[str, str] = json.loads(path.read_text("utf-8")) if path.is_file() else {}
        return names

    def linker_names(self, step: Step, functions: Collection[str]) -> Replaced:
        """Of these functions of the step, as step.toml calls them."""
        return linker_names_of(functions, self.functions(step))

    def exports(self, step: Step) -> Path:
        """The linker's version script with the names of the functions."""
        return self.folder / "steps" / f"{step.number}.map"

    def known(self) -> frozenset[str]:
        """All names of the kit."""
        return frozenset(json.loads((self.folder / "steps" / "known.json").read_text(encoding="utf-8")))

    def allowed(self, step: Step) -> frozenset[str]:
        """The kit's names that the step may ask for: core's, and the functions of steps up to it but the barred."""
        names = json.loads((self.folder / "steps" / f"{step.number}.allowed.json").read_text(encoding="utf-8"))
        return frozenset(names)

    def in_one_process(self) -> "BuiltKit":
        """The kit for one's own steps and for those of its catalogues: nothing has to be kept from them, and a program
        that loads them is several times as fast as one that asks. What comes of it is the same."""
        return replace(self, boxed=False)

    def sanitized(self) -> "BuiltKit":
        """The kit for finding the line at which one's own steps crash: these, and nothing else, are compiled with
        sanitizers. A compiler that has none cannot link its programs."""
        known = self.description
        described = replace(
            known,
            compile_flags=[*known.compile_flags, *_SANITIZED],
            link_flags=[*known.link_flags, _SANITIZERS],
            more_sources=[self.project.root / "framework" / "testing" / "crash_report.cpp"],
        )
        return replace(self, description=described, boxed=False)

    def _linker(self) -> ProgramLinker | None:
        return ProgramLinker(self.folder, self.description) if self.description.remote is not None else None

    def boxes(self, steps: Collection[Step]) -> ProgramLinker | None:
        """What asks these steps in another process; none where programs load them."""
        linker = self._linker() if self.boxed else None
        return linker if linker is not None and all(linker.can_be_asked(step.number) for step in steps) else None

    def program(
        self, kind: Kind, step: Step, folder: Path, *, together: bool = False, replaced: Replaced = NONE_REPLACED
    ) -> Path:
        """A program that lacks the student's library of this step (`together`: of all up to it). Linked into `folder`
        where the kit lacks it and may not be written to."""
        name = self._program_name(kind, step, together=together)
        name += "-sanitized" if self.description.more_sources else ""
        if (self.folder / "bin" / name).is_file() and not replaced:
            return self.folder / "bin" / name
        linker = ProgramLinker(self.folder, self.description)
        own = [other.number for other in self.handed_in_up_to(step)] if together else [step.number]
        return linker.alone(name, f"test-{step.number}" if kind == "test" else kind, own, folder, replaced)

    @staticmethod
    def _program_name(kind: Kind, step: Step, *, together: bool) -> str:
        return f"{kind}-{'cumulative' if together else 'isolated'}-{step.number}"

    def reference_step(self, step: Step) -> Path:
        """The reference's step as a submission's is built: a library, or elsewhere an object."""
        library = self.folder / "steps" / library_name(step.number)
        return library if library.is_file() else self.folder / "steps" / f"{step.number}.o"

    def rest(self, kind: Kind, step: Step, *, together: bool = False) -> list[Path]:
        """Where steps are no libraries: all that a program is linked from beside the student's objects."""
        name = self._program_name(kind, step, together=together)
        lines = (self.folder / "rest" / f"{name}.txt").read_text("utf-8").splitlines()
        return [*self.description.more_sources, *(self.folder / line for line in lines)]
