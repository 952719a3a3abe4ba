"""The formats of other systems, as schemas; nothing is written that breaks its own."""

import json
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any, Literal

import jsonschema

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import write_bytes

Format = Literal["gradescope", "classroom50", "github-legacy", "autolab", "prairielearn"]


@cache
def _schema(name: Format) -> Any:
    path = files("raysteps.exports").joinpath("schemas", f"{name}.schema.json")
    return json.loads(path.read_text(encoding="utf-8"))


def validate(document: Any, name: Format) -> None:
    """A document against the schema is the kit's fault."""
    try:
        jsonschema.validate(document, _schema(name))
    except jsonschema.ValidationError as error:
        raise GraderFault(f"the {name} result would break its schema: {error.json_path}: {error.message}") from error


def encoded(document: Any) -> bytes:
    """As it is written."""
    return (json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n").encode()


def write(document: Any, name: Format, path: Path) -> None:
    """Checks, then writes."""
    validate(document, name)
    write_out(path, encoded(document))


def write_out(path: Path, data: bytes) -> None:
    """Writes a file that somebody named, or says why not."""
    try:
        write_bytes(path, data)
    except OSError as error:
        raise UsageError(f"{path}: cannot be written: {error.strerror or error}") from error
