"""The lists of releases of an update that was interrupted: what it wrote until then is no student's."""

from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.common.files import write_bytes
from raysteps.common.marks import mark
from raysteps.students.listing import Release, parse

FOLDER = ".raysteps/unfinished"


def begin(root: Path, *lists: bytes) -> None:
    """Before the first file is written: the list that was there, which goes, and the one that comes."""
    for data in lists:
        write_bytes(root / FOLDER / f"{mark(data)[:16]}.json", data)


def is_there(root: Path) -> bool:
    """Whether an update was interrupted."""
    return (root / FOLDER).is_dir()


def begun(root: Path) -> list[Release]:
    """Those of an update that did not come to its end. One that cannot be read says nothing: then a file that it wrote
    counts as the student's, which loses nothing."""
    found = []
    for path in sorted((root / FOLDER).glob("*.json")):
        try:
            found.append(parse(path.read_bytes(), str(path)))
        except (OSError, UsageError):
            continue
    return found


def end(root: Path) -> None:
    """After the last file is written."""
    folder = root / FOLDER
    if is_there(root):
        for path in [*folder.glob("*.json"), *folder.glob(".*.json.*")]:
            path.unlink()
        if not any(folder.iterdir()):
            folder.rmdir()
