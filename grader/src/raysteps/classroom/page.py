"""Makes the page of a class anew from what a grading left."""

import json
import sqlite3
from pathlib import Path

from raysteps.classroom.database import FILE as DATABASE
from raysteps.classroom.database import ClassDatabase
from raysteps.classroom.reading import reading
from raysteps.classroom.report import Document, class_document
from raysteps.common.errors import UsageError
from raysteps.common.schemas import complaint, read_schema
from raysteps.reports.class_report import write_class_report

_FACTS = "class.json"


def class_source(place: Path) -> Path | None:
    """What the class is read from, when the place is a class: its folder, its database or its class.json."""
    if place.name in (DATABASE, _FACTS) and place.is_file():
        return place
    return next((place / name for name in (DATABASE, _FACTS) if (place / name).is_file()), None)


def _from_database(path: Path) -> Document:
    with reading(path) as connection:
        try:
            return class_document(ClassDatabase(path.parent, connection))
        except sqlite3.Error as error:
            raise UsageError(
                f"{path}: cannot be read as the database of a class: {error}; if an older kit wrote it, "
                "run grade-class with --resume"
            ) from error


def _from_facts(path: Path) -> Document:
    try:
        document: Document = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError) as error:
        raise UsageError(f"{path}: cannot be read as JSON: {error}") from error
    problem = complaint(document, read_schema("raysteps.classroom", "class.schema.json"))
    if problem:
        raise UsageError(f"{path}: is not a class.json of this kit: {problem}")
    return document


def remake_class_page(source: Path) -> Path:
    """class.html beside the source."""
    document = _from_database(source) if source.suffix == Path(DATABASE).suffix else _from_facts(source)
    try:
        return write_class_report(document, source.parent)
    except OSError as error:
        raise UsageError(f"{source.parent}: class.html cannot be written: {error.strerror or error}") from error
