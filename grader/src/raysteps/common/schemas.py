"""JSON schemas that lie beside the code."""

import json
from functools import cache
from importlib.resources import files
from typing import Any

import jsonschema


@cache
def read_schema(package: str, place: str, part: str = "") -> Any:
    """The schema in a file of a package, or one of the parts under its `$defs`."""
    schema = json.loads(files(package).joinpath(*place.split("/")).read_text(encoding="utf-8"))
    return {"$schema": schema["$schema"], "$ref": f"#/$defs/{part}", "$defs": schema["$defs"]} if part else schema


@cache
def _validator(text: str) -> Any:
    """Of a schema that is one itself: to see that costs more than to check a document."""
    schema = json.loads(text)
    kind = jsonschema.validators.validator_for(schema)
    kind.check_schema(schema)
    return kind(schema)


def complaint(document: Any, schema: Any) -> str:
    """Where and how a document breaks a schema; nothing when it does not."""
    error = jsonschema.exceptions.best_match(_validator(json.dumps(schema)).iter_errors(document))
    return "" if error is None else f"{error.json_path}: {error.message[:300]}"
