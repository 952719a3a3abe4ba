"""Reads who is to be ranked: a graded class, or results.json files."""

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from raysteps.classroom.database import FILE, LATEST
from raysteps.classroom.reading import reading
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.schemas import complaint, read_schema
from raysteps.exports.reading import read_results
from raysteps.results.document import validate

Document = Mapping[str, Any]
_WANTED = "expected the folder of a graded class, its class.json or class.sqlite, or a results.json"
_WHY_NOT = {
    "fault": "not graded, because of a fault of the grader",
    "unreadable": "nothing could be taken from it",
}
_QUERY = (
    "SELECT submissions.name, results.status, results.document FROM submissions LEFT JOIN results "  # noqa: S608
    f"ON results.submission = submissions.id AND run = ({LATEST}) WHERE scope = 'here' ORDER BY entry"
)


@dataclass(frozen=True)
class Entered:
    """One submission; without a document, why there is none."""

    name: str
    document: Document | None
    why: str = ""
    source: str = ""


def _without(name: str, status: str | None) -> Entered:
    return Entered(name, None, _WHY_NOT.get(status or "", "not graded yet"))


def _of_database(path: Path) -> list[Entered]:
    """Results of the kit that graded then: what this one cannot read is nobody's fault."""
    entered = []
    with reading(path) as connection:
        for row in connection.execute(_QUERY):
            if row["status"] != "graded":
                entered.append(_without(row["name"], row["status"]))
                continue
            document = json.loads(row["document"])
            try:
                validate(document)
                entered.append(Entered(row["name"], document))
            except GraderFault:
                entered.append(Entered(row["name"], None, "graded by a kit of another form; grade it again"))
    return entered


def _of_class(path: Path, facts: Document) -> list[Entered]:
    """class.json, and the results.json files that it names."""
    problem = complaint(facts, read_schema("raysteps.classroom", "class.schema.json"))
    if problem:
        raise UsageError(f"{path}: is not a class.json of this kit: {problem}")
    home = path.parent.resolve()
    entered = []
    for one in facts["submissions"]:
        if one["status"] != "graded":
            entered.append(_without(one["name"], one["status"]))
            continue
        place = (home / one["results"]).resolve()
        if not place.is_relative_to(home):
            raise UsageError(f"{path}: names {one['results']}, which lies outside of its folder")
        entered.append(Entered(one["name"], read_results(place)))
    return entered


def _is_class(path: Path) -> Document | None:
    """What a file holds, when that is a class.json."""
    try:
        facts = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return None  # read_results says what is wrong
    return facts if isinstance(facts, dict) and facts.get("schema") == "raysteps/class/v1" else None


def _of_place(place: Path) -> list[Entered]:
    path = place
    if place.is_dir():
        names = (FILE, "class.json", "results.json")
        path = next((place / name for name in names if (place / name).is_file()), place)
        if path == place:
            raise UsageError(f"{place}: holds none of {', '.join(names)}; {_WANTED}")
    if not path.exists():
        raise UsageError(f"{place}: is not there; {_WANTED}")
    if path.suffix == Path(FILE).suffix:
        return _of_database(path)
    facts = _is_class(path)
    if facts is not None:
        return _of_class(path, facts)
    document = read_results(path)
    return [Entered(document["submission"], document, source=str(place))]


def read_entries(places: Sequence[Path]) -> list[Entered]:
    """All of all places. Where two are called alike, the place tells them apart."""
    entered = [replace(one, source=one.source or str(place)) for place in places for one in _of_place(place)]
    seen = Counter(one.name for one in entered)
    return [replace(one, name=f"{one.name} ({one.source})") if seen[one.name] > 1 else one for one in entered]
