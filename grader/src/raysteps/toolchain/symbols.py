"""What an object file offers and what it asks for, by `nm`."""

import re
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.process import run

_SECONDS = 60
_MAX_OUTPUT = 64 << 20
_KIND_AND_PLACE = re.compile(r" [A-Za-z]( [0-9a-f]*)*\s*$")


@dataclass(frozen=True)
class Symbols:
    """Linker names."""

    defined: frozenset[str]  # all that is defined and visible from outside
    wanted: frozenset[str]  # undefined


def parse_symbols(text: str) -> Symbols:
    """The output of `nm --extern-only --format=posix`, of an object or an archive."""
    defined, wanted = set(), set()
    for line in text.splitlines():
        words = line.split()
        if len(words) < 2 or len(words[1]) != 1:
            continue
        name, kind = words[0], words[1]
        if kind in "Uwv":
            wanted.add(name)
        else:
            defined.add(name)
    return Symbols(frozenset(defined), frozenset(wanted))


_NOT_OF_A_LIBRARY = re.compile(r"_Z(?:T[VIST])?N?K?(?!9__gnu_cxx|10__cxxabi)[0-9]")


def of_somebody(name: str) -> bool:
    """Whether a linker name is of a C++ function or class that is neither the compiler's nor the standard library's."""
    return _NOT_OF_A_LIBRARY.match(name) is not None


def nm_arguments() -> tuple[str, ...]:
    return ("--extern-only", "--format=posix")


def parse_readable(plain: str, readable: str) -> dict[str, str]:
    """Linker names and how C++ writes them, of two outputs of nm for the same symbols in the same order."""
    lists = [[_KIND_AND_PLACE.sub("", line) for line in text.splitlines()] for text in (plain, readable)]
    return dict(zip(*lists, strict=False))


def readable_names(nm: str, path: Path) -> dict[str, str]:
    """Linker names of one of the kit's own objects, and how C++ writes them."""
    words = [nm, *nm_arguments(), "--defined-only", "--no-sort"]
    plain, readable = (
        run([*words, *option, path], seconds=_SECONDS, cap=_MAX_OUTPUT).stdout for option in ((), ("--demangle",))
    )
    return parse_readable(plain, readable)


def symbols_of(nm: str, path: Path) -> Symbols:
    """Of one of the kit's own files."""
    outcome = run([nm, *nm_arguments(), path], seconds=_SECONDS, cap=_MAX_OUTPUT)
    if outcome.code != 0:
        raise GraderFault(f"{path}: its symbols cannot be read: {outcome.stderr}")
    return parse_symbols(outcome.stdout)
