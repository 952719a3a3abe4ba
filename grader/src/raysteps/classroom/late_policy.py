"""The late policy: a TOML file with the deadline, and what lateness costs."""

import json
import math
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import date, datetime, time, timedelta
from typing import Any

import jsonschema

from raysteps.classroom.names import folded
from raysteps.common.errors import UsageError
from raysteps.common.schemas import read_schema


@dataclass(frozen=True)
class LatePolicy:
    """When work is due, and how much each day that has begun after that takes from its points."""

    deadline: datetime
    percent_per_day: float
    grace: timedelta = timedelta()
    max_days: int | None = None  # what is later than that gets nothing
    extensions: Mapping[str, datetime] = field(default_factory=dict)  # by folded student id


def _plain(value: Any) -> Any:
    """As JSON would hold it; `nan` and `inf` become words, because they are numbers of no use here."""
    if isinstance(value, dict):
        return {key: _plain(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [_plain(inner) for inner in value]
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return value.isoformat() if isinstance(value, (datetime, date, time)) else value


def _line_of(text: str, path: list[str]) -> int:
    """The line that sets a key: the longest part of its path that is found, 1 for the whole file."""
    found, table = 1, [""]
    depth = 0
    for number, line in enumerate(text.splitlines(), start=1):
        header = re.match(r"\s*\[([^\[\]]+)\]", line)
        setting = re.match(r"\s*((?:\"[^\"]*\"|'[^']*'|[\w-]+)(?:\s*\.\s*(?:\"[^\"]*\"|'[^']*'|[\w-]+))*)\s*=", line)
        if header is not None:
            table = [header[1].strip()]
        words = table if header is not None else [*table, setting[1]] if setting is not None else []
        parts = [part.strip("\"'") for word in words for part in re.findall(r"\"[^\"]*\"|'[^']*'|[\w-]+", word) if part]
        if parts and len(parts) > depth and parts == path[: len(parts)]:
            found, depth = number, len(parts)
    return found


def _complaint(error: jsonschema.ValidationError) -> tuple[list[str], str]:
    """The key that is wrong, and what is wrong with it."""
    path = [str(part) for part in error.absolute_path]
    schema: Any = error.schema
    instance: Any = error.instance
    if error.validator == "required":
        missing = next(key for key in schema["required"] if key not in instance)
        return path, f"expected the key `{missing}`, {schema['properties'][missing].get('description', '')}".rstrip(
            ", "
        )
    if error.validator == "additionalProperties":
        unknown = next(key for key in instance if key not in schema["properties"])
        return [*path, unknown], f"`{unknown}` is no key of a late policy; they are {', '.join(schema['properties'])}"
    expected = schema.get("description") or error.message
    return path, f"`{'.'.join(path)}`: expected {expected}, found {json.dumps(instance)}"


def parse_late_policy(text: str, name: str) -> LatePolicy:
    """Reads the text of a late policy; `name` stands in messages."""
    try:
        table = _plain(tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise UsageError(f"{name}: is not TOML: {error}") from error
    schema = read_schema("raysteps.classroom", "late_policy.schema.json")
    problem = jsonschema.exceptions.best_match(jsonschema.Draft202012Validator(schema).iter_errors(table))
    if problem is not None:
        while problem.parent is not None:  # the branch of an `anyOf` says less than the whole
            problem = problem.parent
        path, words = _complaint(problem)
        raise UsageError(f"{name}:{_line_of(text, path)}: {words}")
    deadline = _moment(table["deadline"], f"{name}:{_line_of(text, ['deadline'])}")
    extensions: dict[str, datetime] = {}
    for student, value in table.get("extensions", {}).items():
        where = f"{name}:{_line_of(text, ['extensions', student])}"
        extended = _moment(value, where) if isinstance(value, str) else deadline + timedelta(days=value)
        if extended < deadline:
            raise UsageError(f"{where}: `extensions.{student}` ends before the deadline")
        if extensions.setdefault(folded(student), extended) is not extended:
            raise UsageError(f"{where}: `extensions.{student}` stands there twice, in upper and lower case")
    return LatePolicy(
        deadline,
        float(table["percent_per_day"]),
        timedelta(minutes=table.get("grace_minutes", 0)),
        int(table["max_days"]) if "max_days" in table else None,
        extensions,
    )


def _moment(text: str, where: str) -> datetime:
    try:
        return datetime.fromisoformat(text)
    except ValueError as error:
        raise UsageError(f"{where}: {text} is no date and time: {error}") from error
