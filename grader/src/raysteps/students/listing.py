""".raysteps/release.json: which files of a students' repository are the kit's, and how they were."""

import hashlib
import json
from dataclasses import asdict, dataclass
from pathlib import Path, PurePosixPath
from typing import Any, Literal

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.schemas import complaint, read_schema

PLACE = ".raysteps/release.json"
_MOST_BYTES = 16 << 20

Owner = Literal["kit", "student"]


@dataclass(frozen=True)
class Listed:
    """One file. Those that the student writes are the student's from the first day on."""

    path: str
    mark: str
    owner: Owner = "kit"
    executable: bool = False


@dataclass(frozen=True)
class Release:
    """What a course has given out."""

    course: str
    kit: str  # fingerprint of the kit that it was made from
    steps: tuple[str, ...]
    files: tuple[Listed, ...]

    def by_path(self) -> dict[str, Listed]:
        return {file.path: file for file in self.files}


def mark(data: bytes) -> str:
    """The same for a text whatever ends its lines: git may change that on Windows."""
    text = data if b"\0" in data else data.replace(b"\r\n", b"\n")
    return hashlib.sha256(text).hexdigest()


def encoded(release: Release) -> bytes:
    """The document; one that breaks its schema is the kit's fault."""
    document = {"schema": "raysteps/release/v1", **asdict(release)}
    document["steps"], document["files"] = list(release.steps), [asdict(file) for file in release.files]
    problem = complaint(document, read_schema("raysteps.students", "release.schema.json"))
    if problem:
        raise GraderFault(f"release.json would break its schema: {problem}")
    return (json.dumps(document, indent=1, ensure_ascii=False) + "\n").encode()


def _is_inside(path: str) -> bool:
    place = PurePosixPath(path)
    return not place.is_absolute() and ".." not in place.parts and "\\" not in path and ":" not in path


def parse(data: bytes, where: str) -> Release:
    """What somebody says is a release."""
    try:
        document: Any = json.loads(data[:_MOST_BYTES])
    except (ValueError, RecursionError) as error:
        raise UsageError(f"{where}: is not JSON; expected the list of a release's files") from error
    problem = complaint(document, read_schema("raysteps.students", "release.schema.json"))
    if problem:
        raise UsageError(f"{where}: is not the list of a release's files: {problem}")
    files = tuple(Listed(**file) for file in document["files"])
    outside = [file.path for file in files if not _is_inside(file.path)]
    if outside:
        raise UsageError(f"{where}: lists {outside[0]}, which would lie outside of the folder")
    return Release(document["course"], document["kit"], tuple(document["steps"]), files)


def read_release(folder: Path) -> Release | None:
    """None where the folder is no release."""
    path = folder / PLACE
    try:
        data = path.read_bytes()
    except OSError:
        return None
    return parse(data, str(path))
