"""Reads a results.json of ours back."""

import json
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault, UsageError
from raysteps.results.document import validate

_MAX_BYTES = 64 << 20
_WANTED = "expected is a results.json as `./raysteps grade` writes it"


def _unread(error: OSError) -> str:
    if isinstance(error, FileNotFoundError):
        return "is not there"
    return "is a folder" if isinstance(error, IsADirectoryError) else f"cannot be read: {error.strerror}"


def _broken(error: Exception) -> str:
    """Where, and not what a parser of JSON was about to expect there."""
    if not isinstance(error, json.JSONDecodeError):
        return "is not JSON"
    if not error.doc.strip():
        return "is empty"
    return f"is not JSON, or only a part of it (line {error.lineno}, column {error.colno})"


def read_results(path: Path) -> dict[str, Any]:
    """The document; anything else than raysteps/results/v1 is refused."""
    try:
        if path.stat().st_size > _MAX_BYTES:
            raise UsageError(f"{path}: is too large for a results.json")
        document = json.loads(path.read_bytes())
    except OSError as error:
        raise UsageError(f"{path}: {_unread(error)}; {_WANTED}") from error
    except (ValueError, RecursionError) as error:
        raise UsageError(f"{path}: {_broken(error)}; {_WANTED}") from error
    try:
        validate(document)
    except GraderFault as error:
        raise UsageError(f"{path}: is not a results.json of this kit; {error}") from error
    assert isinstance(document, dict)
    return document
