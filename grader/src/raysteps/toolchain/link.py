"""Links the kit's own programs: those of the reference, and those that lack a student's steps."""

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TypeVar

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_bytes
from raysteps.common.process import run
from raysteps.toolchain.description import Description

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


def link_placeholder(description: Description, names: Sequence[str], library: Path) -> None:
    """A library with these functions and nothing in them, for programs to be linked with."""
    source = library.with_suffix(".s")
    lines = [f".globl {name}\n.type {name}, @function\n{name}:\n" for name in names]
    write_bytes(source, (".text\n" + "".join(lines) + '.section .note.GNU-stack,"",%progbits\n').encode())
    link(description, ["-shared", f"-Wl,-soname,{library.name}", source], library)
    source.unlink()


def precompile(description: Description, include: Path, step: str) -> None:
    """The step's contract as g++ keeps it in memory. It is taken where a file includes the contract first, as all stubs
    do, and saves half of the time; whatever else a file does, it is compiled as if there were none."""
    folders: list[str | Path] = ["-I", include]
    for folder in description.more_includes:
        folders += ["-isystem", folder]
    for header in (include / "steps" / step).glob("*.hpp"):
        words = [description.compiler, *description.compile_flags, *folders, "-w", "-x", "c++-header", header]
        _run([*words, "-o", f"{header}.gch"])


def interpreter_of(readelf: str, program: Path) -> str:
    """The dynamic loader that the program asks for."""
    found = re.search(r"\]\s+(/\S+)", _run([readelf, "-p", ".interp", program]))
    if found is None:
        raise GraderFault(f"{program} names no dynamic loader")
    return found.group(1)
