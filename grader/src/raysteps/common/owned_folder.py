"""A folder that a command writes anew, in the place of what it wrote there before: a list in it says which files are
its own, and what else lies there, such as a history, stays."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from raysteps.common.errors import UsageError
from raysteps.common.files import content_hash, write_json


def _files(folder: Path) -> list[str]:
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())


@dataclass(frozen=True)
class OwnedFolder:
    """One kind of them. `what` names it; with `marked` the list tells the files' content, too, and a file that somebody
    changed is refused rather than lost."""

    what: str
    list_name: str
    schema: str
    marked: bool = False

    def _list(self, out: Path) -> dict[str, Any] | None:
        try:
            document = json.loads((out / self.list_name).read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError):
            return None
        return document if isinstance(document, dict) and document.get("schema") == self.schema else None

    def _listed(self, out: Path) -> list[str] | None:
        """The files that were written before; none where none were."""
        document = self._list(out)
        names = [Path(str(name)) for name in document.get("files", [])] if document else []
        inside = [name.as_posix() for name in names if not name.is_absolute() and ".." not in name.parts]
        return None if document is None else inside

    def check(self, out: Path) -> None:
        """A usage error unless it is a new or an empty folder, or an older one of the kind, which nobody changed."""
        names = self._listed(out)
        if out.is_file() or (out.is_dir() and any(out.iterdir()) and names is None):
            raise UsageError(f"{out}: holds something else; expected a new or an empty folder, or an older {self.what}")
        marks = (self._list(out) or {}).get("marks", {})
        for name in names or ():
            path = out / name
            if name in marks and path.is_file() and content_hash(path.read_bytes()) != marks[name]:
                raise UsageError(
                    f"{path}: was changed since the {self.what} was written and would be lost; take it away"
                )

    def put(self, new: Path, out: Path, last: str = "") -> None:
        """Moves the files of `new`, on the same disk, to `out`, and `last` of all that one. Called again, it finishes
        what was interrupted."""
        out.mkdir(parents=True, exist_ok=True)
        old, files = self._listed(out) or [], _files(new)
        strange = [name for name in files if name not in old and (out / name).exists()]
        if strange:
            raise UsageError(
                f"{out / strange[0]}: is not of an older {self.what}, and the new one has such a file; take it away"
            )
        marks = {"marks": {name: content_hash((new / name).read_bytes()) for name in files}} if self.marked else {}
        write_json(out / self.list_name, {"schema": self.schema, "files": sorted({*old, *files})})
        for name in old:
            (out / name).unlink(missing_ok=True)
        for name in sorted(files, key=lambda name: name == last):
            (out / name).parent.mkdir(parents=True, exist_ok=True)
            (new / name).replace(out / name)
        for room in sorted({parent for name in old for parent in Path(name).parents}, reverse=True):
            if (out / room).is_dir() and not any((out / room).iterdir()):
                (out / room).rmdir()
        write_json(out / self.list_name, {"schema": self.schema, "files": files, **marks})
