"""A folder that a command writes anew, in the place of what it wrote there before: a list in it says which files are
its own, and what else lies there, such as a history, stays."""

import json
import shutil
from collections.abc import Mapping
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
        if not isinstance(document, dict) or document.get("schema") != self.schema:
            return None
        return document if isinstance(document.get("files"), list) else None

    def _listed(self, out: Path) -> list[str] | None:
        """The files that were written before; none where none were. What a link leads out of the folder is not."""
        document = self._list(out)
        if document is None:
            return None
        paths = {str(name): (out / str(name)).resolve() for name in document["files"]}
        return [name for name, path in paths.items() if path.is_relative_to(out.resolve()) and not path.is_dir()]

    def _marks(self, out: Path) -> dict[str, list[str]]:
        """What the content of these files may be: one, or two where writing was interrupted."""
        marks = (self._list(out) or {}).get("marks")
        return {name: mark if isinstance(mark, list) else [mark] for name, mark in dict(marks or {}).items()}

    def check(self, out: Path) -> None:
        """A usage error unless it is a new or an empty folder, or an older one of the kind, which nobody changed."""
        names = self._listed(out)
        if out.is_file() or (out.is_dir() and any(out.iterdir()) and names is None):
            raise UsageError(f"{out}: holds something else; expected a new or an empty folder, or an older {self.what}")
        marks = self._marks(out)
        for name in names or ():
            path = out / name
            if name in marks and path.is_file() and content_hash(path.read_bytes()) not in marks[name]:
                raise UsageError(
                    f"{path}: was changed since the {self.what} was written and would be lost; take it away"
                )

    def put(self, new: Path, out: Path, last: str = "") -> None:
        """Moves the files of `new` to `out`, and `last` of all that one. Called again, it finishes what was
        interrupted."""
        out.mkdir(parents=True, exist_ok=True)
        old, files = self._listed(out) or [], _files(new)
        rooms = {parent.as_posix() for name in files for parent in Path(name).parents}
        strange = [name for name in files if name not in old and (out / name).exists()]
        strange += sorted(name for name in rooms if name not in old and (out / name).is_file())
        if strange:
            raise UsageError(
                f"{out / strange[0]}: is not of an older {self.what}, and the new one has such a file; take it away"
            )
        marks = {name: content_hash((new / name).read_bytes()) for name in files} if self.marked else {}
        before = self._marks(out)
        either = before | {name: [*before.get(name, []), mark] for name, mark in marks.items()}
        self._write(out, sorted({*old, *files}), either)
        for name in old:
            (out / name).unlink(missing_ok=True)
        for name in sorted(files, key=lambda name: name == last):
            (out / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.move(new / name, out / name)
        for room in sorted({parent for name in old for parent in Path(name).parents}, reverse=True):
            if (out / room).is_dir() and not any((out / room).iterdir()):
                (out / room).rmdir()
        self._write(out, files, marks)

    def _write(self, out: Path, files: list[str], marks: Mapping[str, str | list[str]]) -> None:
        document = {"schema": self.schema, "files": files}
        write_json(out / self.list_name, document | ({"marks": dict(marks)} if self.marked else {}))
