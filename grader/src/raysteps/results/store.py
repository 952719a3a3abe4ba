"""results.json: checked against its schema, then written."""

import json
import re
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import write_json
from raysteps.common.schemas import complaint, read_schema


def validate(document: Any) -> None:
    """A document against the schema is the kit's fault."""
    problem = complaint(document, read_schema("raysteps.results", "results.schema.json"))
    if problem:
        raise GraderFault(f"results.json would break its schema: {problem}")


def write_document(document: dict[str, Any], folder: Path) -> Path:
    """Checks and writes FOLDER/results.json."""
    validate(document)
    path = folder / "results.json"
    write_json(path, document)
    return path


# Reads a results.json of ours back.

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


# Where hidden cases that went wrong are kept, below the folder of results.json.

FOLDER = "cases"


def place_of(number: str, function: str) -> str:
    """One file for each function of a step."""
    name = re.sub(r"[^a-z0-9]+", "-", function.lower()).strip("-")
    return f"{FOLDER}/{number}-{name}.json"
