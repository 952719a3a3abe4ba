"""How a step is compiled and what programs are linked from, as CMake says in kit.json; and the commands made of it."""

import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_bytes
from raysteps.common.process import run

# kit.json.

_KNOWN_TO_COMPILER = ("/usr/include", "/usr/local/include")


@dataclass(frozen=True)
class SealTools:
    """The programs that tell what is in an object. Where they are, a step becomes a library that shows its own
    functions only; elsewhere it is linked like any object."""

    nm: str
    readelf: str
    objcopy: str


def _words(values: list[object]) -> list[str]:
    return [str(value) for value in values if str(value)]


def _paths(values: list[object]) -> list[Path]:
    return [Path(value) for value in _words(values)]


@dataclass(frozen=True)
class RemoteParts:
    """What a program is linked from whose steps are asked in another process, and the box that they are in."""

    wire: list[Path]
    home: Path
    box: Path
    core: Path  # what a step in a box may ask for
    stand_ins: dict[str, Path]  # by number: of a step that is in the box, or asked by it
    services: dict[str, Path]
    later: dict[str, Path]  # for a box in which the step must not be

    @classmethod
    def of(cls, table: dict[str, Any]) -> "RemoteParts":
        """The part of kit.json."""

        def by_number(name: str) -> dict[str, Path]:
            return {number: Path(path) for number, path in table[name].items()}

        return cls(
            wire=_paths(table["wire"]),
            home=Path(table["home"]),
            box=Path(table["box"]),
            core=Path(table["core"]),
            stand_ins=by_number("stand_ins"),
            services=by_number("services"),
            later=by_number("later"),
        )


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
    remote: RemoteParts | None = None  # none where steps are no libraries, and in a students' kit
    more_sources: Sequence[Path] = ()  # compiled into programs when they are linked
    driver: str = "gnu"  # or "msvc": whose words the compiler takes

    @property
    def is_msvc(self) -> bool:
        return self.driver == "msvc"

    @property
    def more_includes(self) -> list[Path]:
        """Folders of libraries' headers that the compiler does not look into by itself."""
        return [folder for folder in self.system_includes if str(folder) not in _KNOWN_TO_COMPILER]


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
            seal=None if seal is None else SealTools(*(str(seal[tool]) for tool in ("nm", "readelf", "objcopy"))),
            steps={number: Path(object_file) for number, object_file in table["steps"].items()},
            libraries={name: Path(library) for name, library in table["libraries"].items()},
            catch2=_paths(table["catch2"]),
            raytrace=_paths(table["raytrace"]),
            wide=_paths(table["wide"]),
            worker=_paths(table["worker"]),
            absent=_paths(table["absent"]),
            tests={number: _paths(objects) for number, objects in table["tests"].items()},
            remote=None if table.get("remote") is None else RemoteParts.of(table["remote"]),
            driver=str(table.get("driver", "gnu")),
        )
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise GraderFault(f"{path}: not what CMake writes for the grader: {error}") from error


# How compilers are spoken to: those that take the words of GCC, and Microsoft's.

Word = TypeVar("Word")


def include_words(description: Description, own: Word, others: Sequence[Word]) -> list[str | Word]:
    """Where headers are looked for: the kit's, and those of libraries."""
    words: list[str | Word] = ["-I", own]
    for folder in others:
        words += ["-I" if description.is_msvc else "-isystem", folder]
    return words


def compile_words(description: Description, source: Word, target: Word) -> list[str | Word]:
    """The end of a command that makes an object."""
    return ["-c", source, "-Fo:" if description.is_msvc else "-o", target]


def link_words(description: Description, parts: Sequence[str | Word], target: Word) -> list[str | Word]:
    """A whole command that makes a program. Microsoft's compiler hands on to the linker what comes after -link."""
    if description.is_msvc:
        return [description.compiler, "-nologo", *parts, "-Fe:", target, "-link", *description.link_flags]
    return [description.compiler, *description.link_flags, *parts, "-o", target]


_SECONDS = 300


def _run(words: Sequence[str | Path]) -> str:
    outcome = run(words, seconds=_SECONDS)
    if outcome.code != 0:
        raise GraderFault(f"a part of the kit cannot be linked: {outcome.stderr or outcome.stdout}")
    return outcome.stdout


def link(description: Description, objects: Sequence[str | Path], program: Path) -> None:
    """A program, or with the right words among the objects a library."""
    _run(link_words(description, objects, program))


def with_local_symbols(tools: SealTools, path: Path, names: Iterable[str], target: Path) -> Path:
    """A copy of an object that shows none of these names: whoever asks for them gets them from elsewhere."""
    _run([tools.objcopy, *(f"--localize-symbol={name}" for name in sorted(names)), path, target])
    return target


def with_redirected_calls(
    tools: SealTools, path: Path, names: Iterable[str], other: str, target: Path
) -> list[str | Path]:
    """A copy of an object that calls the function `other` in place of these, as words for the linker."""
    aliases = {name: f"{other}_{name}" for name in sorted(names)}
    _run([tools.objcopy, *(f"--redefine-sym={name}={alias}" for name, alias in aliases.items()), path, target])
    return [target, *(f"-Wl,--defsym={alias}={other}" for alias in aliases.values())]


def version_script(names: Sequence[str]) -> bytes:
    """Shows these names of a library and hides all others."""
    shown = "".join(f"        {name};\n" for name in names)
    return f"{{\n    global:\n{shown}    local:\n        *;\n}};\n".encode()


def dynamic_list(names: Sequence[str]) -> bytes:
    """Shows these names of a program to the libraries that it loads, and no others."""
    return ("{\n" + "".join(f"    {name};\n" for name in names) + "};\n").encode()


def library_name(number: str) -> str:
    return f"libstep-{number}.so"


def library_flags(number: str) -> list[str]:
    """Before the version script of a step and its object."""
    return ["-fno-lto", "-shared", "-Wl,-z,now", f"-Wl,-soname,{library_name(number)}", "-Wl,--version-script"]


# A linker that tells what it finds nowhere, by the linker's name, and makes the library all the same: it knows nothing
# of what a box will have.
REPORT_UNDEFINED = ("-pthread", "-Wl,-z,defs", "-Wl,--warn-unresolved-symbols", "-Wl,--no-demangle")
_UNDEFINED = re.compile(r"undefined (?:reference to [`']|symbol: )(?P<name>[^`'\s]+)")


def undefined_symbols(said: str) -> set[str]:
    """What such a linker has told."""
    return {found["name"] for found in _UNDEFINED.finditer(said)}


def link_placeholder(description: Description, names: Sequence[str], library: Path) -> None:
    """A library with these functions and nothing in them, for programs to be linked with."""
    source = library.with_suffix(".s")
    lines = [f".globl {name}\n.type {name}, @function\n{name}:\n" for name in names]
    write_bytes(source, (".text\n" + "".join(lines) + '.section .note.GNU-stack,"",%progbits\n').encode())
    link(description, ["-shared", f"-Wl,-soname,{library.name}", source], library)
    source.unlink()


def precompile(description: Description, include: Path, headers: Sequence[str], folder: Path, file: str) -> None:
    """What a stub includes, most often the contract first, as g++ keeps it in memory: it takes that from `folder` where
    a file begins with the same header, and saves more than half of the time. Messages name `file` as what includes."""
    first = headers[0].strip('<">')
    whole, source = folder / f"{first}.gch", folder / f"{first}.all"
    write_bytes(source, "".join([f'#line 1 "{file}"\n', *(f"#include {header}\n" for header in headers)]).encode())
    words = [description.compiler, *description.compile_flags]
    words += include_words(description, str(include), list(map(str, description.more_includes)))
    _run([*words, "-w", "-x", "c++-header", source, "-o", whole])
    source.unlink()


def interpreter_of(readelf: str, program: Path) -> str:
    """The dynamic loader that the program asks for."""
    found = re.search(r"\]\s+(/\S+)", _run([readelf, "-p", ".interp", program]))
    if found is None:
        raise GraderFault(f"{program} names no dynamic loader")
    return found.group(1)
