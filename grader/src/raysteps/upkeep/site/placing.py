"""Puts a new site in the place of an older one. What else lies there, such as a history, stays."""

import json
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.common.files import write_json

_LIST = ".raysteps-site.json"
_SCHEMA = "raysteps/site/v1"


def _files(folder: Path) -> list[str]:
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())


def _listed(out: Path) -> list[str] | None:
    """The files that an older site wrote; none where there is no older site."""
    try:
        document = json.loads((out / _LIST).read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return None
    if not isinstance(document, dict) or document.get("schema") != _SCHEMA:
        return None
    names = [Path(str(name)) for name in document.get("files", [])]
    return [name.as_posix() for name in names if not name.is_absolute() and ".." not in name.parts]


def check_place(out: Path) -> None:
    """A usage error unless it is a new or an empty folder, or an older site."""
    if out.is_file() or (out.is_dir() and any(out.iterdir()) and _listed(out) is None):
        raise UsageError(f"{out}: holds something else; expected a new or an empty folder, or an older site")


def put(new: Path, out: Path) -> None:
    """Moves the files of `new`, on the same disk, to `out`. Called again, it finishes what was interrupted."""
    out.mkdir(parents=True, exist_ok=True)
    old, files = _listed(out) or [], _files(new)
    strange = [name for name in files if name not in old and (out / name).exists()]
    if strange:
        raise UsageError(f"{out / strange[0]}: is not of an older site, and the new one has such a file; take it away")
    write_json(out / _LIST, {"schema": _SCHEMA, "files": sorted({*old, *files})})
    for name in old:
        (out / name).unlink(missing_ok=True)
    for name in files:
        (out / name).parent.mkdir(parents=True, exist_ok=True)
        (new / name).replace(out / name)
    for room in sorted({parent for name in old for parent in Path(name).parents}, reverse=True):
        if (out / room).is_dir() and not any((out / room).iterdir()):
            (out / room).rmdir()
    write_json(out / _LIST, {"schema": _SCHEMA, "files": files})
