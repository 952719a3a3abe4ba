"""Tables of the kit in TOML, each with a schema. A bad one is the kit's fault."""

import tomllib
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault
from raysteps.common.schemas import complaint, read_schema


def read_text(path: Path) -> str:
    """The file as text."""
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise GraderFault(f"{path}: cannot be read: {error}") from error


def parse_table(text: str, path: Path, what: str, package: str, schema: str) -> dict[str, Any]:
    """`what` the file should be, such as `a plan of hidden cases`, and the schema that says how it looks."""
    try:
        table = tomllib.loads(text)
    except ValueError as error:
        raise GraderFault(f"{path}: not {what}: {error}") from error
    problem = complaint(table, read_schema(package, schema))
    if problem:
        raise GraderFault(f"{path}: not {what}: {problem}")
    return table
