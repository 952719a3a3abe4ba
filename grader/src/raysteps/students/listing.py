""".raysteps/release.json: which files of a students' repository are the kit's, and how they were."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Literal

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.marks import mark
from raysteps.common.schemas import complaint, read_schema
from raysteps.students import paths

__all__ = ["PLACE", "Listed", "Owner", "Release", "encoded", "mark", "parse", "read_release"]

PLACE = ".raysteps/release.json"
_FORM = "raysteps/release/v1"
_MOST_BYTES = 16 << 20

Owner = Literal["kit", "student"]


@dataclass(frozen=True)
class Listed:
    """One file. Those that the student writes are the student's from the first day on."""

    path: str
    mark: str
    owner: Owner = "kit"
    executable: bool = False

    def is_at(self, path: Path) -> bool:
        """Whether the file is there as it was released. Nobody looks behind a link; OSError where it cannot be read."""
        return not path.is_symlink() and mark(path.read_bytes()) == self.mark


@dataclass(frozen=True)
class Release:
    """What a course has given out."""

    course: str
    kit: str  # fingerprint of the kit that it was made from
    steps: tuple[str, ...]
    files: tuple[Listed, ...]

    def by_path(self) -> dict[str, Listed]:
        return {file.path: file for file in self.files}


def encoded(release: Release) -> bytes:
    """The document; one that breaks its schema is the kit's fault, a file that no repository may have the course's."""
    document = {"schema": _FORM, **asdict(release)}
    document["steps"], document["files"] = list(release.steps), [asdict(file) for file in release.files]
    problem = complaint(document, read_schema("raysteps.students", "release.schema.json"))
    if problem:
        raise GraderFault(f"release.json would break its schema: {problem}")
    wrong = paths.complaint(file.path for file in release.files)
    if wrong:
        raise UsageError(f"the release {wrong}. Give the file another name")
    return (json.dumps(document, indent=1, ensure_ascii=False) + "\n").encode()


def _listed(file: dict[str, Any]) -> Listed:
    return Listed(file["path"], file["mark"], file["owner"], file["executable"])


def parse(data: bytes, where: str) -> Release:
    """What somebody says is a release. Keys that nobody knows are of a later kit, and may stand there."""
    try:
        document: Any = json.loads(data[:_MOST_BYTES])
    except (ValueError, RecursionError) as error:
        raise UsageError(f"{where}: is not JSON; expected the list of a release's files") from error
    form = document.get("schema") if isinstance(document, dict) else None
    if isinstance(form, str) and form.startswith("raysteps/release/") and form != _FORM:
        raise UsageError(
            f"{where}: is a list of the form {form}, and this kit reads {_FORM}. Let the newer kit do the update: "
            "unpack it, and in its own folder type\n  python raysteps update --into YOUR-REPOSITORY"
        )
    problem = complaint(document, read_schema("raysteps.students", "release.schema.json"))
    if problem:
        raise UsageError(f"{where}: is not the list of a release's files: {problem}")
    files = tuple(_listed(file) for file in document["files"])
    wrong = paths.complaint(file.path for file in files)
    if wrong:
        raise UsageError(f"{where}: {wrong}")
    return Release(document["course"], document["kit"], tuple(document["steps"]), files)


def read_release(folder: Path) -> Release | None:
    """None where the folder is no release."""
    path = folder / PLACE
    try:
        data = path.read_bytes()
    except OSError:
        return None
    return parse(data, str(path))
