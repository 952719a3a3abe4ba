"""JSON schemas of the kit's documents, for programs of others: made from the classes that the kit reads them with."""

from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import get_args, get_type_hints

import msgspec

from raysteps.classroom.leaderboard import Leaderboard
from raysteps.common.documents import former_keys
from raysteps.common.files import write_json
from raysteps.desk.said import AnnotationFile
from raysteps.exports.similar_pairs import Similarity
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
    "similarity": Similarity,
    "annotations": AnnotationFile,
    "case": CaseFile,
    "inspect": Record,
    "release": Release,
    **{f"bench-{kind.name}": kind for kind in get_args(Numbers)},
}


def _classes(kind: object, known: set[type]) -> Iterator[type]:
    """The dataclasses that a type is made of."""
    if isinstance(kind, type) and is_dataclass(kind) and kind not in known:
        known.add(kind)
        yield kind
        for inner in get_type_hints(kind).values():
            yield from _classes(inner, known)
    for inner in get_args(kind):
        yield from _classes(inner, known)


def schema_of(kind: type) -> dict[str, object]:
    """No object of ours takes a key that it does not know, but for the list of a release. Required is what the kit
    always writes: all but what older kits did not. What only older kits wrote may be anything."""
    schema = msgspec.json.schema(kind)
    classes = list(_classes(kind, set()))
    optional = {(made.__name__, one.name) for made in classes for one in fields(made) if one.metadata}
    former = {made.__name__: former_keys(made) for made in classes}
    for name, form in schema["$defs"].items():
        if "properties" in form:
            form["additionalProperties"] = kind is Release
            form["required"] = [key for key in form["properties"] if (name, key) not in optional]
            form["properties"] |= {key: {"deprecated": True} for key in former.get(name, ())}
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


def write_schemas(folder: Path) -> list[Path]:
    """NAME.schema.json of each document."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = {folder / f"{name}.schema.json": kind for name, kind in DOCUMENTS.items()}
    for path, kind in paths.items():
        write_json(path, schema_of(kind))
    return list(paths)
