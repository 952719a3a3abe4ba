"""The formats of other systems, as schemas; nothing is written that breaks its own."""

import json
import shutil
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any, Literal

import jsonschema

from raysteps.common.errors import GraderFault, UsageError, reason
from raysteps.common.files import encoded, write_out

Format = Literal["gradescope", "classroom50", "github-legacy", "autolab", "prairielearn"]


@cache
def _validator(name: Format) -> Any:
    """Of a schema that is one itself: to see that costs more than to check a document."""
    text = files("raysteps.exports").joinpath("schemas", f"{name}.schema.json").read_text(encoding="utf-8")
    schema = json.loads(text)
    kind = jsonschema.validators.validator_for(schema)
    kind.check_schema(schema)
    return kind(schema)


def validate(document: object, name: Format) -> None:
    """A document against the schema is the kit's fault."""
    error = jsonschema.exceptions.best_match(_validator(name).iter_errors(document))
    if error is not None:
        problem = f"{error.json_path}: {error.message[:300]}"
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
