"""Writes limits into manifests, and leaves all else as it stands: comments, order and layout."""

import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_if_changed
from raysteps.upkeep.calibration.gate import plain
from raysteps.upkeep.calibration.scenes import Table

_NAMES = {"images": "name", "twins": "of", "random_scenes": "name"}
_LIMIT = re.compile(r"^(max_wrong[ \t]*=[ \t]*)[^ \t\r\n#]+", re.M)


def _name_of(block: str) -> tuple[str, str] | None:
    """Which table a part of a manifest is, from one line with a bracket to the next."""
    header = re.match(r"\[\[(\w+)\]\]", block)
    if header is None or header[1] not in _NAMES:
        return None
    table: dict[str, Any] = tomllib.loads(block)[header[1]][0]
    return header[1], str(table[_NAMES[header[1]]])


def with_limits(text: str, limits: Mapping[tuple[Table, str], float]) -> str:
    """The manifest with these limits in the tables of these names."""
    blocks = re.split(r"^(?=\[)", text, flags=re.M)
    left = {(str(table), name): value for (table, name), value in limits.items()}
    for place, block in enumerate(blocks):
        value = left.pop(name, None) if (name := _name_of(block)) is not None else None
        if value is None:
            continue
        blocks[place], times = _LIMIT.subn(rf"\g<1>{plain(value)}", block)
        if times != 1:
            raise GraderFault(f"{name}: expected one line max_wrong = ..., found {times}")
    if left:
        raise GraderFault(f"no table for {', '.join(' '.join(name) for name in left)}")
    return "".join(blocks)


def write_limits(path: Path, limits: Mapping[tuple[Table, str], float]) -> bool:
    """Whether the file changed."""
    return write_if_changed(path, with_limits(path.read_text(encoding="utf-8"), limits).encode())
