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


def complaint(document: Any, schema: Any) -> str:
    """Where and how a document breaks a schema; nothing when it does not."""
    try:
        jsonschema.validate(document, schema)
    except jsonschema.ValidationError as error:
        return f"{error.json_path}: {error.message[:300]}"
    return ""
