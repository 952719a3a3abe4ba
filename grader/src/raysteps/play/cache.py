"""The page's cache: what this page and the last one that was another are made of stays, for who goes back."""

import hashlib
import json
import shutil
import tempfile
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path

from raysteps.common.files import write_json

_RECORD = "used.json"


def clear(cache: Path, used: Iterable[Path]) -> None:
    """Removes the rest from the folders in which `used` lie, folders or files; these are named without their ending,
    and all of such a name belong together."""
    now = sorted({path.relative_to(cache).as_posix() for path in used})
    record = cache / _RECORD
    lists = json.loads(record.read_text("utf-8")) if record.is_file() else []
    if lists[:1] != [now]:
        lists = [now, *lists[:1]]
        write_json(record, lists)
    kept = {name for some in lists for name in some} | {record.stem}
    for folder in {(cache / name).parent for name in kept}:
        for path in folder.iterdir():
            name = path.relative_to(cache).as_posix()
            is_kept = any(f"{name}.".startswith(f"{one}.") or one.startswith(f"{name}/") for one in kept)
            if is_kept or path.name.startswith("."):  # somebody is writing it
                continue
            with suppress(OSError):  # on Windows somebody may have it open
                shutil.rmtree(path) if path.is_dir() else path.unlink()


def written_once(cache: Path, name: str, content: Mapping[str, bytes]) -> Path:
    """A folder of these files, by their paths. Its name changes with every byte, so it never has to be changed."""
    digest = hashlib.sha256()
    for path, data in sorted(content.items()):
        digest.update(f"{path}\0{len(data)}\0".encode() + data)
    folder = cache / f"{name}-{digest.hexdigest()[:12]}"
    if not folder.is_dir():
        cache.mkdir(parents=True, exist_ok=True)
        new = Path(tempfile.mkdtemp(prefix=".new-", dir=cache))
        try:
            new.chmod(0o755)
            for path, data in content.items():
                (new / path).parent.mkdir(parents=True, exist_ok=True)
                (new / path).write_bytes(data)
            new.rename(folder)
        except OSError:
            if not folder.is_dir():  # or else another command was quicker
                raise
        finally:
            shutil.rmtree(new, ignore_errors=True)
    return folder
