"""JSON schemas of the kit's documents, for programs of others: made from the classes that the kit reads them with."""

from collections.abc import Mapping
from pathlib import Path
from typing import get_args

import msgspec

from raysteps.classroom.leaderboard import Leaderboard
from raysteps.common.files import write_json
from raysteps.inspector.model import Record
from raysteps.judge.counterexamples import CaseFile
from raysteps.results.class_model import ClassResults
from raysteps.results.model import Results
from raysteps.updater.release_list import Release
from tools.bench.model import Numbers

DOCUMENTS: Mapping[str, type] = {
    "results": Results,
    "class": ClassResults,
    "leaderboard": Leaderboard,
    "case": CaseFile,
    "inspect": Record,
    "release": Release,
    **{f"bench-{kind.name}": kind for kind in get_args(Numbers)},
}


def schema_of(kind: type) -> dict[str, object]:
    """No object of ours takes a key that it does not know, but for the list of a release; each says its form."""
    schema = msgspec.json.schema(kind)
    for made in schema["$defs"].values():
        if "properties" in made:
            made["additionalProperties"] = kind is Release
            made["required"] = [key for key in made["properties"] if key == "schema" or key in made.get("required", [])]
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


def write_schemas(folder: Path) -> list[Path]:
    """NAME.schema.json of each document."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = {folder / f"{name}.schema.json": kind for name, kind in DOCUMENTS.items()}
    for path, kind in paths.items():
        write_json(path, schema_of(kind))
    return list(paths)
