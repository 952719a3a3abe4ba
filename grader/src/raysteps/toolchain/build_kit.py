"""Builds the kit for grading, into a folder named by its fingerprint."""

import hashlib
import json
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import TypeVar

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_bytes, write_json
from raysteps.common.platform import executable, processor_count
from raysteps.course.manifest import Step, course_manifests, kit_steps, read_all_steps, read_steps, up_to
from raysteps.course.project import Project
from raysteps.course.stubs import included, pristine_stub
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Input, Limits, Output, Task
from raysteps.toolchain.catch2 import list_tests
from raysteps.toolchain.cmake import release_tree, what_failed
from raysteps.toolchain.compile import readable_names, symbols_of
from raysteps.toolchain.fingerprint import fingerprint
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgramLinker, ProgressCallback, Tests, linker_names_of
from raysteps.toolchain.link import (
    Description,
    dynamic_list,
    interpreter_of,
    library_flags,
    library_name,
    link,
    link_placeholder,
    precompile,
    read_description,
    version_script,
)

# The visible tests, as the reference ran them: a students' kit cannot ask it again.


def given_tests(project: Project) -> Path:
    return project.given / "tests.json"


def write_given_tests(project: Project, tests: Tests) -> None:
    write_json(given_tests(project), tests)


def read_given_tests(project: Project) -> Tests:
    path = given_tests(project)
    try:
        tests: Tests = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise GraderFault(f"{path}: expected the list of the tests; take it from a fresh copy of the kit") from error
    return tests


def tested_functions(step: Step, name: str, tags: Sequence[str]) -> list[str]:
    """The functions that a test is about: of those among its tags the one that its name begins with, where there is."""
    functions = [tag for tag in tags if tag in step.functions]
    return [function for function in functions if name.startswith(f"{function}:")] or functions


# How much longer the reference takes on this machine than on the one for which the limits were chosen.

_PROBE = ("--step", "5", "--size", "640x480", "--threads", "1", "--quiet")
_PROBE_SCENE = "lessons/many-spheres.nff"
_PROBE_SECONDS = 1.0  # of processor time; no machine is called faster
_PROBES = 3  # the quickest counts: others may use the machine, too


def _slowness(project: Project, folder: Path) -> float:
    program, scene = Input(executable(folder / "bin" / "raytrace"), "raytrace"), project.root / "scenes" / _PROBE_SCENE
    task = Task((program, Input(scene, "scene.nff"), *_PROBE, "-o", Output("picture")), Limits(600, 600))
    took = []
    for _ in range(_PROBES):
        ran = LimitsOnly().run(task)
        if ran.outcome.code != 0:
            raise GraderFault(f"the reference does not draw {_PROBE_SCENE}: {ran.outcome.stderr.strip()}")
        took.append(ran.cpu_seconds)
        if ran.cpu_seconds <= _PROBE_SECONDS:
            break
    return round(max(1.0, min(took) / _PROBE_SECONDS), 2)


# Puts one kit folder together from what CMake built.

T = TypeVar("T")
U = TypeVar("U")

_COMPILERS = 4  # and linkers at a time; each takes some hundred megabytes
_NOT_FOR_STEPS = "t_stats"  # the counters: a step is counted, it does not count
_FOLDERS = ("answers", "bin", "include", "parts", "pictures", "placeholders", "precompiled", "rest", "steps")


def _several_at_a_time(work: Callable[[T], U], items: Iterable[T]) -> list[U]:
    with ThreadPoolExecutor(min(_COMPILERS, processor_count())) as pool:
        return list(pool.map(work, items))


def up_to_last(project: Project, graded: Sequence[Step]) -> list[Step]:
    """Steps of which more than the reference is needed to grade these: what is asked in a box may be any before it."""
    return [step for step in read_all_steps(project) if step.index <= graded[-1].index]


class KitBuilder:
    """Makes bin/, include/, steps/ and facts.json."""

    def __init__(self, project: Project, graded: list[Step], folder: Path, description: Description) -> None:
        self._project = project
        self._steps = read_all_steps(project)
        self._graded = graded  # those that may be handed in; the reference stands for the others
        self._up_to_last = up_to_last(project, graded)
        self._folder = folder
        self._description = description
        self._objects: dict[str, Path] = {}
        self._kept: dict[str, dict[str, str]] = {}  # linker names of each step's functions, and how C++ writes them
        self._core_names: set[str] = set()  # what every step may ask for
        for part in _FOLDERS:
            (folder / part).mkdir()
        self._boxes = ProgramLinker(folder, description) if description.remote is not None else None
        self._core = self._copy(description.libraries["core"])
        self._others = [self._copy(description.libraries[name]) for name in ("testing", "render", "io")]
        self._others += description.catch2
        self._others += [self._copy(path) for path in description.absent]

    def run(self, say: ProgressCallback) -> None:
        """Everything, in order."""
        self._copy_headers()
        if self._description.compiler_version.startswith("GNU"):
            self._precompile(say)
        if self._boxes is not None:
            self._boxes.copy_parts([step.number for step in self._up_to_last])
        if self._description.seal is not None:
            core = self._core if self._boxes is None else self._boxes.core
            defined = symbols_of(self._description.seal.nm, core).defined
            self._core_names = {name for name in defined if _NOT_FOR_STEPS not in name}
        for step in self._steps:
            self._copy_step(step)
        _several_at_a_time(self._add_step, self._steps)
        self._write_known()
        self._write_rest("libraries", [*self._others, self._core])
        tests = self._add_programs(say) if self._project.has_reference else self._add_own_programs(say)
        tools = self._description.seal
        loader = None if tools is None else interpreter_of(tools.readelf, next((self._folder / "bin").iterdir()))
        if self._project.has_reference:
            say("measuring how fast the reference is here")
        slowness = _slowness(self._project, self._folder) if self._project.has_reference else 1.0
        write_json(self._folder / "facts.json", {"interpreter": loader, "slowness": slowness, "tests": tests})

    def _precompile(self, say: ProgressCallback) -> None:
        def one(step: Step) -> None:
            say(f"compiling the headers of step {step.number} for later")
            headers = included(pristine_stub(self._project, step))
            if headers:
                precompile(
                    self._description, self._folder / "include", headers, self._folder / "precompiled", step.file
                )

        _several_at_a_time(one, self._graded)

    def _add_programs(self, say: ProgressCallback) -> Tests:
        """Around each step by itself, and around all up to one."""
        raytrace = [self._copy(path) for path in self._description.raytrace]
        worker = [self._copy(path) for path in self._description.worker]
        more = [path if ".so" in path.suffixes else self._copy(path) for path in self._description.wide]
        self._write_rest("raytrace", raytrace)
        self._write_rest("worker", worker)
        _several_at_a_time(lambda one: self._link_reference(*one), [("raytrace", raytrace + more), ("worker", worker)])
        tests = {step.number: self._copy_tests(step) for step in self._graded}

        def add(step: Step) -> dict[str, list[str]]:
            say(f"linking the programs of step {step.number}")
            self._link_reference(f"test-{step.number}", tests[step.number])
            listed = list_tests(executable(self._folder / "bin" / f"test-{step.number}"))
            together = up_to(step, self._graded)
            if not self._add_remote(together):
                self._add_plain(raytrace, worker, tests[step.number], together)
            return {name: tested_functions(step, name, tags) for name, tags in listed.items()}

        return dict(zip([step.id for step in self._graded], _several_at_a_time(add, self._graded), strict=True))

    def _copy_tests(self, step: Step) -> list[Path]:
        objects = [self._copy(path) for path in self._description.tests[step.number]]
        self._write_rest(f"test-{step.number}", objects)
        return objects

    def _add_remote(self, up_to: list[Step]) -> bool:
        """Programs that ask the last step, and those that ask all of them; none where one of them cannot be asked."""
        numbers = [step.number for step in up_to]
        if self._boxes is None or not all(self._boxes.can_be_asked(number) for number in numbers):
            return False
        last = numbers[-1]
        for kind in ("raytrace", "worker", f"test-{last}"):
            self._boxes.home(kind, [last], self._folder)
        self._boxes.home("raytrace", numbers, self._folder)
        self._boxes.box([last], self._folder)
        self._boxes.box(numbers, self._folder)
        return True

    def _add_plain(self, raytrace: list[Path], worker: list[Path], tests: list[Path], up_to: list[Step]) -> None:
        """Programs that load the steps."""
        last = up_to[-1]
        self._add_program(f"raytrace-isolated-{last.number}", raytrace, [last])
        self._add_program(f"worker-isolated-{last.number}", worker, [last])
        self._add_program(f"test-isolated-{last.number}", tests, [last])
        self._add_program(f"raytrace-cumulative-{last.number}", raytrace, up_to)

    def _add_own_programs(self, say: ProgressCallback) -> Tests:
        """In a students' kit: all steps up to one are the student's, and those after it are stubs."""
        raytrace = [self._copy(path) for path in self._description.raytrace]
        tests = {step.number: self._copy_tests(step) for step in self._up_to_last}

        def add(step: Step) -> None:
            say(f"linking the programs of step {step.number}")
            own = [other for other in self._up_to_last if other.index <= step.index]
            self._add_program(f"raytrace-cumulative-{step.number}", raytrace, own)
            self._add_program(f"test-cumulative-{step.number}", tests[step.number], own)

        _several_at_a_time(add, self._up_to_last)
        return read_given_tests(self._project)

    def _write_known(self) -> None:
        """Every name that the kit defines, to tell what is not for a step from what is nowhere."""
        tools = self._description.seal
        if tools is not None:
            libraries = [path for path in (self._core, *self._others) if path.suffix == ".a"]
            names = set().union(*(symbols_of(tools.nm, path).defined for path in libraries), *self._kept.values())
            write_json(self._folder / "steps" / "known.json", sorted(names))

    def _copy(self, path: Path) -> Path:
        parts = self._folder / "parts"
        target = parts / f"{len(list(parts.iterdir())):03d}-{path.name}"
        shutil.copyfile(path, target)
        return target

    def _copy_headers(self) -> None:
        include = self._folder / "include"
        for header in self._project.root.glob("framework/core/*.hpp"):
            write_bytes(include / "core" / header.name, header.read_bytes())
        for step in self._steps:
            for header in (self._project.steps / step.id).glob("*.hpp"):
                write_bytes(include / "steps" / step.id / header.name, header.read_bytes())

    def _copy_step(self, step: Step) -> None:
        built = self._description.steps[step.number]
        copied = self._objects[step.number] = self._folder / "parts" / "references" / f"{step.number}.o"
        copied.parent.mkdir(exist_ok=True)
        shutil.copyfile(built, copied)
        if self._description.seal is not None:
            names = readable_names(self._description.seal.nm, copied)
            self._kept[step.number] = {name: names[name] for name in Path(f"{built}.keep").read_text("utf-8").split()}

    def _add_step(self, step: Step) -> None:
        """The reference's, as a library where there are such."""
        steps, copied = self._folder / "steps", self._objects[step.number]
        if self._description.seal is None:
            shutil.copyfile(copied, steps / f"{step.number}.o")
            return
        kept = list(self._kept[step.number])
        exports = steps / f"{step.number}.map"
        write_bytes(exports, version_script(kept))
        link(self._description, [*library_flags(step.number), exports, copied], steps / library_name(step.number))
        write_json(steps / f"{step.number}.names.json", self._kept[step.number])
        earlier = [self._kept[other.number] for other in self._steps if other.index <= step.index]
        allowed = self._core_names.union(*earlier).difference(
            *(linker_names_of(step.barred_functions, shown) for shown in earlier)
        )
        write_json(steps / f"{step.number}.allowed.json", sorted(allowed))
        write_bytes(steps / f"{step.number}.dynamic", dynamic_list(sorted(allowed)))
        link_placeholder(self._description, kept, self._folder / "placeholders" / library_name(step.number))

    def _link_reference(self, name: str, objects: list[Path]) -> None:
        parts = [*objects, *self._objects.values(), *self._others, self._core]
        link(self._description, parts, executable(self._folder / "bin" / name))

    def _write_rest(self, name: str, parts: list[Path]) -> None:
        """What is linked later, by name."""
        names = [path.relative_to(self._folder) if path.is_relative_to(self._folder) else path for path in parts]
        write_bytes(self._folder / "rest" / f"{name}.txt", "".join(f"{path.as_posix()}\n" for path in names).encode())

    def _add_program(self, name: str, objects: list[Path], mine: list[Step]) -> None:
        """Linked with placeholders where steps are libraries, so that nothing is linked for a submission; else a list
        of what to link."""
        numbers = [step.number for step in mine]
        parts = [*objects, *(path for number, path in self._objects.items() if number not in numbers)]
        if self._description.seal is None:
            self._write_rest(name, [*parts, *self._others, self._core])
            return
        libraries = [self._folder / "placeholders" / library_name(number) for number in numbers]
        whole: list[str | Path] = ["-Wl,--whole-archive", self._core, "-Wl,--no-whole-archive"]
        shown = [f"-Wl,--dynamic-list={self._folder / 'steps' / f'{number}.dynamic'}" for number in numbers]
        words: list[str | Path] = [*parts, *whole, *self._others, "-Wl,--no-as-needed", *libraries, *shown]
        link(self._description, words, self._folder / "bin" / name)


_KEPT = 3
_IN_USE_SECONDS = 1800  # a class touches its kit for each submission


def build_kit(project: Project, say: ProgressCallback = lambda text: None, *, of_all_parts: bool = False) -> BuiltKit:
    """The kit of the repository as it is now; built when there is none yet. `of_all_parts`: for its makers, with every
    step that can be graded, whatever parts course.toml chooses."""
    steps, every = read_steps(project), kit_steps(project)
    chosen = every if of_all_parts else steps
    for _ in range(3):
        mark = fingerprint(project)
        whole = folder = project.build / "kit" / mark
        if chosen != every and not _is_built(whole):  # one of fewer parts is sooner there
            folder = whole.with_name(f"{mark}-{'-'.join(str(part) for part in sorted({step.part for step in steps}))}")
        is_built = _is_built(folder)
        if not is_built:
            _build(project, chosen, folder, say)
        if is_built or fingerprint(project) == mark:
            with suppress(OSError):  # of a kit that may only be read, as in an image
                os.utime(folder)
            _forget_old(folder.parent)
            return _load(project, chosen, folder)
    raise GraderFault("the kit's sources keep changing while it is built")


def _is_built(folder: Path) -> bool:
    return (folder / "kit.json").is_file()


def _load(project: Project, steps: list[Step], folder: Path) -> BuiltKit:
    description = read_description(folder / "kit.json")
    table = json.loads((folder / "facts.json").read_text(encoding="utf-8"))
    worth = course_manifests(project)  # built alike, and graded otherwise
    own = f"-{hashlib.sha256(repr(sorted(worth.items())).encode()).hexdigest()[:8]}" if worth else ""
    mark = f"{folder.name.partition('-')[0]}{own} {description.compiler_version}"
    return BuiltKit(project, folder, mark, steps, description, table["tests"], table["interpreter"], table["slowness"])


def _forget_old(kits: Path) -> None:
    """Keeps the kits that were used last, and those that may be in use."""
    built = []
    for kit in kits.iterdir():
        with suppress(FileNotFoundError):  # another process may forget it, too
            if _is_built(kit):
                built.append((kit.stat().st_mtime, kit))
    for used, kit in sorted(built)[:-_KEPT]:
        if time.time() - used > _IN_USE_SECONDS:
            shutil.rmtree(kit, ignore_errors=True)


def _build(project: Project, graded: list[Step], folder: Path, say: ProgressCallback) -> None:
    what = f"building the framework{', the references' if project.has_reference else ''} and the tests"
    say(what)
    folder.parent.mkdir(parents=True, exist_ok=True)
    tree = release_tree(project)
    with tree.locked(say), tempfile.TemporaryDirectory(prefix=".new-", dir=folder.parent) as name:
        if _is_built(folder):
            return  # somebody else was faster
        targets = ["kit", *(f"kit-{step.number}" for step in up_to_last(project, graded))]
        outcome = tree.build(targets, lambda far: say(f"{what}: {far}"))
        if outcome.code != 0:
            raise GraderFault("the kit's own programs do not build:\n" + what_failed(outcome))
        for left in folder.parent.glob(".new-*"):  # by builds that were killed: this one has the lock
            if left != Path(name):
                shutil.rmtree(left, ignore_errors=True)
        new = Path(name) / "kit"
        new.mkdir()
        description = read_description(tree.folder / "kit.json")
        KitBuilder(project, graded, new, description).run(say)
        shutil.copyfile(tree.folder / "kit.json", new / "kit.json")
        shutil.rmtree(folder, ignore_errors=True)
        new.rename(folder)
