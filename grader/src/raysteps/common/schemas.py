"""JSON schemas of forms that others have made."""

import json
from functools import cache
from importlib.resources import files
from typing import Any

import jsonschema


@cache
def read_schema(package: str, place: str) -> object:
    """The schema in a file of a package."""
    schema: object = json.loads(files(package).joinpath(*place.split("/")).read_text(encoding="utf-8"))
    return schema


@cache
def _validator(text: str) -> Any:
    """Of a schema that is one itself: to see that costs more than to check a document."""
    schema = json.loads(text)
    kind = jsonschema.validators.validator_for(schema)
    kind.check_schema(schema)
    return kind(schema)


def complaint(document: object, schema: object) -> str:
    """Where and how a document breaks a schema; nothing when it does not."""
    error = jsonschema.exceptions.best_match(_validator(json.dumps(schema)).iter_errors(document))
    return "" if error is None else f"{error.json_path}: {error.message[:300]}"
