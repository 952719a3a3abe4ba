"""The formats of other systems, as schemas; nothing is written that breaks its own."""

import shutil
from pathlib import Path
from typing import Literal

from raysteps.common.errors import GraderFault, UsageError, reason
from raysteps.common.files import encoded, write_out
from raysteps.common.schemas import complaint, read_schema

Format = Literal["gradescope", "classroom50", "github-legacy", "autolab", "prairielearn"]


def validate(document: object, name: Format) -> None:
    """A document against the schema is the kit's fault."""
    problem = complaint(document, read_schema("raysteps.exports", f"schemas/{name}.schema.json"))
    if problem:
        raise GraderFault(f"the {name} result would break its schema: {problem}")


def write(document: object, name: Format, path: Path) -> None:
    """Checks, then writes."""
    validate(document, name)
    write_out(path, encoded(document))


def remove(path: Path) -> None:
    """What lies where a result is to come, whoever put it there."""
    try:
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        else:
            path.unlink(missing_ok=True)
    except OSError as error:
        raise UsageError(f"{path}: cannot be replaced: {reason(error)}") from error
