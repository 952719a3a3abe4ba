"""Puts one kit folder together from what CMake built."""

import shutil
from pathlib import Path

from raysteps.common.files import write_bytes, write_json
from raysteps.common.systems import executable
from raysteps.kit.description import Description
from raysteps.kit.linking import (
    dynamic_list,
    interpreter_of,
    library_flags,
    library_name,
    link,
    link_placeholder,
    precompile,
    version_script,
)
from raysteps.kit.manifest import Step
from raysteps.kit.project import Project
from raysteps.kit.symbols import readable_names, symbols_of
from raysteps.kit.test_list import list_tests

_NOT_FOR_STEPS = "t_stats"  # the counters: a step is counted, it does not count
_FOLDERS = ("answers", "bin", "include", "parts", "pictures", "placeholders", "rest", "steps")


class Assembly:
    """Makes bin/, include/, steps/ and facts.json."""

    def __init__(self, project: Project, steps: list[Step], folder: Path, description: Description) -> None:
        self._project = project
        self._steps = steps
        self._folder = folder
        self._description = description
        self._objects: dict[str, Path] = {}
        self._kept: dict[str, list[str]] = {}  # linker names of the functions of each step
        self._core_names: set[str] = set()  # what every step may ask for
        for part in _FOLDERS:
            (folder / part).mkdir()
        self._core = self._copy(description.libraries["core"])
        self._others = [self._copy(description.libraries[name]) for name in ("testing", "render", "io")]
        self._others += description.catch2

    def run(self) -> None:
        """Everything, in order."""
        self._copy_headers()
        if self._description.compiler_version.startswith("GNU"):
            for step in self._steps:
                precompile(self._description, self._folder / "include", step.id)
        if self._description.seal is not None:
            defined = symbols_of(self._description.seal.nm, self._core).defined
            self._core_names = {name for name in defined if _NOT_FOR_STEPS not in name}
        for step in self._steps:
            self._add_step(step)
        self._write_known()
        raytrace = [self._copy(path) for path in self._description.raytrace]
        worker = [self._copy(path) for path in self._description.worker]
        more = [path if ".so" in path.suffixes else self._copy(path) for path in self._description.wide]
        for kind, objects in (("raytrace", raytrace), ("worker", worker)):
            self._link_reference(kind, [*objects, *more] if kind == "raytrace" else objects)
            for step in self._steps:
                self._add_program(f"{kind}-isolated-{step.number}", objects, [step])
        tests: dict[str, dict[str, list[str]]] = {}
        for at, step in enumerate(self._steps, start=1):
            self._add_program(f"raytrace-cumulative-{step.number}", raytrace, self._steps[:at])
            objects = [self._copy(path) for path in self._description.tests[step.number]]
            self._link_reference(f"test-{step.number}", objects)
            self._add_program(f"test-isolated-{step.number}", objects, [step])
            cases = list_tests(executable(self._folder / "bin" / f"test-{step.number}"))
            tests[step.id] = {name: sorted(tags) for name, tags in cases.items()}
        tools = self._description.seal
        loader = None if tools is None else interpreter_of(tools.readelf, self._folder / "bin" / "raytrace")
        write_json(self._folder / "facts.json", {"interpreter": loader, "tests": tests})

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

    def _add_step(self, step: Step) -> None:
        built = self._description.steps[step.number]
        copied = self._objects[step.number] = self._copy(built)
        steps = self._folder / "steps"
        tools = self._description.seal
        if tools is None:
            shutil.copyfile(built, steps / f"{step.number}.o")
            return
        kept = self._kept[step.number] = Path(f"{built}.keep").read_text("utf-8").split()
        exports = steps / f"{step.number}.map"
        write_bytes(exports, version_script(kept))
        link(self._description, [*library_flags(step.number), exports, copied], steps / library_name(step.number))
        names = readable_names(tools.nm, self._objects[step.number])
        write_json(steps / f"{step.number}.names.json", {name: names[name] for name in kept})
        earlier = [other.number for other in self._steps if other.index <= step.index]
        allowed = self._core_names.union(*(self._kept[number] for number in earlier))
        write_json(steps / f"{step.number}.allowed.json", sorted(allowed))
        write_bytes(steps / f"{step.number}.dynamic", dynamic_list(sorted(allowed)))
        link_placeholder(self._description, kept, self._folder / "placeholders" / library_name(step.number))

    def _link_reference(self, name: str, objects: list[Path]) -> None:
        parts = [*objects, *self._objects.values(), *self._others, self._core]
        link(self._description, parts, executable(self._folder / "bin" / name))

    def _add_program(self, name: str, objects: list[Path], mine: list[Step]) -> None:
        """Linked with placeholders where steps are libraries, so that nothing is linked for a submission; else a list
        of what to link."""
        numbers = [step.number for step in mine]
        parts = [*objects, *(path for number, path in self._objects.items() if number not in numbers)]
        if self._description.seal is None:
            others = [*parts, *self._others, self._core]
            names = [path.relative_to(self._folder) if path.is_relative_to(self._folder) else path for path in others]
            write_bytes(
                self._folder / "rest" / f"{name}.txt", "".join(f"{path.as_posix()}\n" for path in names).encode()
            )
            return
        libraries = [self._folder / "placeholders" / library_name(number) for number in numbers]
        whole: list[str | Path] = ["-Wl,--whole-archive", self._core, "-Wl,--no-whole-archive"]
        shown = f"-Wl,--dynamic-list={self._folder / 'steps' / f'{numbers[-1]}.dynamic'}"
        words: list[str | Path] = [*parts, *whole, *self._others, "-Wl,--no-as-needed", *libraries, shown]
        link(self._description, words, self._folder / "bin" / name)
