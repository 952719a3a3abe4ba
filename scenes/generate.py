#!/usr/bin/env python3
"""Makes procedural scenes of any size: NFF, and pbrt's format for those with meshes.

python scenes/generate.py KIND [--size N] [--seed S] -o FILE.nff
python scenes/generate.py --check     are the committed scenes what this program makes?
python scenes/generate.py --update    make the committed scenes anew
"""

import argparse
import os
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

from generators import KINDS, make

COMMITTED = Path(__file__).resolve().parent / "generated"


@dataclass(frozen=True)
class Entry:
    """A committed scene, as generated/list.toml records it."""

    file: str
    kind: str
    size: int
    seed: int

    def text(self) -> str:
        return make(self.kind, self.size, self.seed)


def entries() -> list[Entry]:
    with (COMMITTED / "list.toml").open("rb") as stream:
        return [Entry(**scene) for scene in tomllib.load(stream)["scenes"]]


def write(path: Path, text: str) -> None:
    """All or nothing: under a temporary name first, then renamed."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        temporary.write_bytes(text.encode("ascii"))
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def difference(entry: Entry) -> str:
    """What is wrong with the committed file, or an empty string."""
    path = COMMITTED / entry.file
    if not path.is_file():
        return "is missing"
    found = path.read_bytes().splitlines()
    expected = entry.text().encode("ascii").splitlines()
    for number, (left, right) in enumerate(zip(found, expected, strict=False), start=1):
        if left != right:
            return f"line {number}: expected '{right.decode()}', found '{left.decode(errors='replace')}'"
    return "" if len(found) == len(expected) else f"expected {len(expected)} lines, found {len(found)}"


def check() -> int:
    """0 when every committed scene is what the generator makes, else 1."""
    wrong = {entry.file: difference(entry) for entry in entries()}
    listed = {entry.file for entry in entries()}
    wrong |= {path.name: "is not in list.toml" for path in COMMITTED.iterdir() if path.suffix in (".nff", ".pbrt") and path.name not in listed}
    wrong = {name: text for name, text in wrong.items() if text}
    for name, text in sorted(wrong.items()):
        print(f"scenes/generated/{name}: {text}", file=sys.stderr)
    if not wrong:
        print(f"{len(listed)} generated scenes are up to date")
    return 1 if wrong else 0


def parser() -> argparse.ArgumentParser:
    sizes = ", ".join(f"{name} {kind.size} (1 to {kind.largest})" for name, kind in KINDS.items())
    about = "Makes procedural scenes of any size: NFF, and pbrt's format for those with meshes."
    result = argparse.ArgumentParser(prog="generate.py", description=about)
    result.add_argument("kind", metavar="KIND", nargs="?", choices=tuple(KINDS), help=", ".join(KINDS))
    result.add_argument("--size", type=int, metavar="N", help=f"default and range: {sizes}")
    result.add_argument("--seed", type=int, metavar="S", default=1, help="default: 1; same seed, same scene")
    result.add_argument("-o", "--output", type=Path, metavar="FILE.nff", help="where the scene goes")
    mode = result.add_mutually_exclusive_group()
    mode.add_argument("--check", action="store_true", help="compare scenes/generated with what would be made")
    mode.add_argument("--update", action="store_true", help="make the scenes of scenes/generated anew")
    return result


def main(arguments: list[str] | None = None) -> int:
    line = parser()
    options = line.parse_args(arguments)
    if options.check or options.update:
        if options.kind is not None or options.output is not None or options.size is not None:
            line.error("--check and --update take no KIND, --size or -o")
        if options.check:
            return check()
        for entry in entries():
            write(COMMITTED / entry.file, entry.text())
        return 0
    if options.kind is None:
        line.error(f"expected a KIND, one of: {', '.join(KINDS)}")
    if options.output is None:
        line.error("expected -o FILE.nff")
    kind = KINDS[options.kind]
    size = kind.size if options.size is None else options.size
    if not 1 <= size <= kind.largest:
        line.error(f"expected --size from 1 to {kind.largest} for {options.kind}, found {size}")
    try:
        write(options.output, make(options.kind, size, options.seed))
    except OSError as error:
        print(f"generate.py: cannot write {options.output}: {error.strerror}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
