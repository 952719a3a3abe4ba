"""The machine code of the references, which no box may hold."""

import re
import subprocess
from itertools import pairwise
from pathlib import Path

from raysteps.toolchain.kit_artifacts import BuiltKit

_LEAST = 32  # bytes of machine code that are nobody else's by chance
# Made alike wherever a type is used: constructors, destructors, and the way out of a function for an exception.
_OF_A_COMPILER = re.compile(r"[CD]\dE[vO]|\.cold$")
_OWN = re.compile(r"_ZN?K?8raysteps")  # not a template of the standard library, which many programs make alike
_SYMBOL = re.compile(r"^\s*\d+:\s+([0-9a-f]+)\s+(\d+)\s+FUNC\s+\w+\s+\w+\s+(\d+)\s+(\S+)", re.MULTILINE)
_SECTION = re.compile(r"^\s*\[\s*(\d+)\]\s+(\.text\S*)\s+PROGBITS\s+\S+\s+([0-9a-f]+)", re.MULTILINE)
_RELOCATIONS = re.compile(r"section '\.rela(\.text\S*)'.*?\n(.*?)(?:\n\n|\Z)", re.DOTALL)


def _readelf(option: str, path: Path) -> str:
    return subprocess.run(["readelf", "-W", option, path], capture_output=True, text=True, check=True).stdout


def _machine_code(path: Path) -> dict[str, list[bytes]]:
    """Of each function of an object, what no linker changes."""
    data = path.read_bytes()
    sections = {number: (name, int(offset, 16)) for number, name, offset in _SECTION.findall(_readelf("-S", path))}
    changed: dict[str, list[int]] = {}
    for name, lines in _RELOCATIONS.findall(_readelf("-r", path)):
        changed[name] = [int(line.split()[0], 16) for line in lines.splitlines() if re.match(r"[0-9a-f]{12}", line)]
    found: dict[str, list[bytes]] = {}
    for start, size, section, name in _SYMBOL.findall(_readelf("-s", path)):
        if section not in sections:
            continue
        part, offset = sections[section]
        first, last = int(start, 16), int(start, 16) + int(size)
        places = [first - 4, *sorted(at for at in changed.get(part, []) if first <= at < last), last]
        pieces = [data[offset + a + 4 : offset + b] for a, b in pairwise(places) if b - a - 4 >= _LEAST]
        found[name] = pieces
    return found


def reference_code(kit: BuiltKit) -> dict[str, bytes]:
    """Pieces of all references' functions, each under the step's number, the function's name and the piece's place."""
    return {
        f"{step.number} {name} {place}": piece
        for step in kit.steps
        for name, pieces in _machine_code(kit.folder / "parts" / "references" / f"{step.number}.o").items()
        if _OWN.match(name) and not _OF_A_COMPILER.search(name)
        for place, piece in enumerate(pieces)
    }
