"""results.json: checked against its schema, then written."""

from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault
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
