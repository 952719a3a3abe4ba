"""Reads kit.json, which CMake writes: how a step is compiled, and what each program is linked from."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault

_KNOWN_TO_COMPILER = ("/usr/include", "/usr/local/include")


@dataclass(frozen=True)
class SealTools:
    """The programs that tell what is in an object. Where they are, a step becomes a library that shows its own
    functions only; elsewhere it is linked like any object."""

    nm: str
    readelf: str


@dataclass(frozen=True)
class Description:
    """What CMake knows. Steps and tests are named by number, such as `02`."""

    compiler: str
    compiler_version: str
    compile_flags: list[str]
    system_includes: list[Path]
    link_flags: list[str]
    seal: SealTools | None
    steps: dict[str, Path]
    libraries: dict[str, Path]
    catch2: list[Path]
    raytrace: list[Path]
    wide: list[Path]  # what the reference's raytrace is linked with beside that; nothing where Highway is missing
    worker: list[Path]  # nothing in a students' kit
    absent: list[Path]  # stand-ins for steps that the kit does not have
    tests: dict[str, list[Path]]
    driver: str = "gnu"  # or "msvc": whose words the compiler takes

    @property
    def is_msvc(self) -> bool:
        return self.driver == "msvc"

    @property
    def more_includes(self) -> list[Path]:
        """Folders of libraries' headers that the compiler does not look into by itself."""
        return [folder for folder in self.system_includes if str(folder) not in _KNOWN_TO_COMPILER]


def _words(values: list[Any]) -> list[str]:
    return [str(value) for value in values if str(value)]


def _paths(values: list[Any]) -> list[Path]:
    return [Path(value) for value in _words(values)]


def read_description(path: Path) -> Description:
    """A kit.json that cannot be read is the kit's fault."""
    try:
        table = json.loads(path.read_text(encoding="utf-8"))
        seal = table["seal"]
        return Description(
            compiler=str(table["compiler"]),
            compiler_version=str(table["compiler_version"]),
            compile_flags=_words(table["compile_flags"]),
            system_includes=_paths(table["system_includes"]),
            link_flags=_words(table["link_flags"]),
            seal=None if seal is None else SealTools(str(seal["nm"]), str(seal["readelf"])),
            steps={number: Path(object_file) for number, object_file in table["steps"].items()},
            libraries={name: Path(library) for name, library in table["libraries"].items()},
            catch2=_paths(table["catch2"]),
            raytrace=_paths(table["raytrace"]),
            wide=_paths(table["wide"]),
            worker=_paths(table["worker"]),
            absent=_paths(table["absent"]),
            tests={number: _paths(objects) for number, objects in table["tests"].items()},
            driver=str(table.get("driver", "gnu")),
        )
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise GraderFault(f"{path}: not what CMake writes for the grader: {error}") from error
