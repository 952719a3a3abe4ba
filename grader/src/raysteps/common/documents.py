"""Documents whose form is that of a dataclass: what does not fit is refused, with the place where it does not."""

import codecs
import re
import tomllib
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from pathlib import Path
from typing import Annotated, Any, TypeVar

import msgspec
from msgspec import Meta

from raysteps.common.errors import GraderFault, UsageError, reason
from raysteps.common.files import readable_json
from raysteps.common.text import MAX_FOUND, nearest, shorten

T = TypeVar("T")

_MAX = 2**63 - 1
Count = Annotated[int, Meta(ge=0, le=_MAX)]
# a whole number is written again as it was read
Amount = Annotated[int, Meta(ge=0, le=_MAX)] | Annotated[float, Meta(ge=0, le=float(_MAX))]
Share = Annotated[int, Meta(ge=0, le=1)] | Annotated[float, Meta(ge=0, le=1)]
Text = Annotated[str, Meta(min_length=1)]

OPTIONAL = {"optional": True}  # metadata of a field that older kits did not write


def former_keys(kind: object) -> Collection[str]:
    """What older kits wrote and nobody reads any more: FORMER_KEYS of a dataclass, or of an object of it."""
    keys: Collection[str] = getattr(kind, "FORMER_KEYS", ())
    return keys


_MAX_CHARACTERS = 300  # of what is told of a stranger's file


class Malformed(ValueError):
    """What is wrong with a document, and where."""

    def __init__(self, problem: str, place: str = "") -> None:
        super().__init__(shorten(f"{place}: {problem}" if place else problem, _MAX_CHARACTERS))
        self.problem, self.place = problem, place


def _position(data: bytes, error: msgspec.DecodeError) -> str:
    told = re.search(r"byte (\d+)", str(error))
    at = int(told[1]) if told is not None else len(data)
    line, column = data.count(b"\n", 0, at) + 1, at - data.rfind(b"\n", 0, at)
    return f"line {line}, column {column}"


def _refuse_unknown(told: Iterable[object], known: Collection[str], place: str) -> None:
    for name in told:
        if name not in known:
            raise Malformed(f"unknown key {name!r}; known are {', '.join(known)}", place)


def _children(
    told: object, found: object, place: str, *, complete: bool, extra: bool
) -> Iterator[tuple[object, object, str]]:
    """What was told beside what was made of it; a key too many or too few ends it."""
    if is_dataclass(found) and isinstance(told, dict):
        known = {field.name: field for field in fields(found)}
        if not extra:
            former = former_keys(found)
            _refuse_unknown([name for name in told if name not in former], known, place)
        for name, field in known.items():
            if name in told:
                yield told[name], getattr(found, name), f"{place}.{name}"
            elif complete and not field.metadata:
                raise Malformed(f"{name!r} is missing", place)
    elif isinstance(found, dict) and isinstance(told, dict):
        _refuse_unknown(told, found, place)
        yield from ((told[name], value, f"{place}.{name}") for name, value in found.items())
    elif isinstance(found, (list, tuple)) and isinstance(told, (list, tuple)):
        yield from ((told[at], value, f"{place}[{at}]") for at, value in enumerate(found))


_WITHOUT_KEYS = (str, int, float, type(None))


def _check_keys(told: object, found: object, place: str, *, complete: bool, extra: bool) -> None:
    for child in _children(told, found, place, complete=complete, extra=extra):
        if not isinstance(child[1], _WITHOUT_KEYS):
            _check_keys(*child, complete=complete, extra=extra)


def convert(document: object, kind: type[T], *, complete: bool = False, extra: bool = False) -> T:
    """A document as JSON or TOML gives it. `complete` says that nothing may be left out, whether or not it has a
    default; `extra`, that there may be keys which nobody knows."""
    try:
        made = msgspec.convert(document, kind)
    except msgspec.ValidationError as error:
        what, _, place = str(error).replace("`", "").partition(" - at ")
        raise Malformed(f"{what[0].lower()}{what[1:]}", place or "$") from error
    except UnicodeError as error:
        raise Malformed("holds half a character") from error
    _check_keys(document, made, "$", complete=complete, extra=extra)
    return made


def parse(data: bytes, kind: type[T], *, complete: bool = False) -> T:
    """The same of the bytes of a JSON file. Only strict JSON is taken: no NaN, nothing beyond the range of numbers."""
    data = data.removeprefix(codecs.BOM_UTF8)
    if not data.strip():
        raise Malformed("is empty")
    try:
        document = msgspec.json.decode(data)
    except msgspec.DecodeError as error:
        raise Malformed(f"is not JSON, or only a part of it ({_position(data, error)})") from error
    except (UnicodeDecodeError, RecursionError) as error:
        raise Malformed("is not JSON") from error
    return convert(document, kind, complete=complete)


def plain(document: object) -> object:
    """The document as dictionaries and lists."""
    return msgspec.to_builtins(document)


def checked(document: T, name: str) -> T:
    """The document. One that is not of the form of its class is the kit's fault."""
    try:
        convert(plain(document), type(document))
    except Malformed as error:
        raise GraderFault(f"{name} would not be of its form: {error}") from error
    return document


def as_text(document: object) -> str:
    """The document as it is written to a file."""
    return readable_json(plain(document))


# TOML that people write: where in it something is wrong.

_KEY = r"(?:\"[^\"]*\"|'[^']*'|[\w-]+)"
_HEADER = re.compile(r"\s*(\[\[?)([^\[\]]+)\]")
_SETTING = re.compile(rf"\s*({_KEY}(?:\s*\.\s*{_KEY})*)\s*=")
_LONG_TEXT = re.compile(r"(\"\"\"|\'\'\').*?\1", re.DOTALL)


@dataclass(frozen=True)
class _Line:
    """One that names something: a key, or a table whose lines follow."""

    number: int
    text: str
    table: str  # in which it stands, or which it begins; the third of `[[images]]` is `images.2`
    key: str | None

    @property
    def path(self) -> list[str]:
        named = self.table if self.key is None else f"{self.table}.{self.key}"
        return [part.strip("\"'") for part in re.findall(_KEY, named)]

    @property
    def place(self) -> str:
        return f"{self.number}:{len(self.text) - len(self.text.lstrip()) + 1}"


def _named_lines(text: str) -> Iterator[_Line]:
    """Lines of a text in three quotes name nothing, whatever they look like."""
    text = _LONG_TEXT.sub(lambda found: '""' + "\n" * found[0].count("\n"), text)
    table, times = "", dict[str, int]()
    for number, line in enumerate(text.split("\n"), start=1):
        header, setting = _HEADER.match(line), _SETTING.match(line)
        if header is not None:
            table = header[2].strip()
            if header[1] == "[[":
                times[table] = times.get(table, -1) + 1
                table = f"{table}.{times[table]}"
            yield _Line(number, line, table, None)
        elif setting is not None:
            yield _Line(number, line, table, setting[1])


def place_in_toml(text: str, path: Sequence[str]) -> str:
    """`LINE:COLUMN` of a key: of the longest part of its path that is found, 1:1 for the whole file."""
    found, depth = "1:1", 0
    for line in _named_lines(text):
        parts = line.path
        if depth < len(parts) <= len(path) and parts == list(path[: len(parts)]):
            found, depth = line.place, len(parts)
    return found


# What is mostly meant where a line is not TOML: by what the reader of TOML says, and the text behind the =.
_CURVED = "\u2018-\u201f"
_ADVICE = (
    ("Unclosed array", "", "the ] that ends the list is missing, or a comma in it"),
    ("", r"$", "nothing stands behind the ="),
    ("", rf"[^\"']*[{_CURVED}]", 'these quotes are curved; straight ones are meant: "'),
    (
        "Unescaped|Invalid hex",
        "",
        "in double quotes a \\ is written twice, in single quotes, '...', once",
    ),
    ("Unterminated string|Illegal character", "[\"']", "the quote that ends it is missing"),
    ("", r"(?i:true|false)$", "true and false are written in small letters"),
    ("", r"(?:\d{4}-\d\d-\d\d[T ])?\d\d?:\d\d(?!:)", "a time is written with its seconds: 2026-11-20T23:59:00+01:00"),
    ("", r"\d{4}-\d\d-\d\d(?:[T ]\d\d:\d\d:\d\d(?:Z|[-+]\d\d:\d\d)?)?$", "there is no such day or time"),
    ("", r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d:\d\d", "behind a time stand Z or the hours and minutes to UTC, as in +01:00"),
    ("", r"\d\d?[./-]\d\d?[./-]\d\d|\d{4}[./-]\d\d?[./-]\d", "a day is written as 2026-11-20"),
    ("", r"0\d+$", "a number does not begin with 0"),
    ("", r"[-+]?\d+,\d+$", "numbers have a point, as in 2.5"),
    ("", r"[^\W\d]|[./~]\D|\d+ *[-,] *\d+$", 'text stands in quotes: {key} = "{value}"'),
    ("", r"[-+.]?\d+(?![-\d])", "a number stands alone, such as 10 or 2.5"),
)
_NO_EQUALS = re.compile(r"\s*([A-Za-z0-9][\w-]*)\s*[:\s]\s*[^\s=][^=]*$")


def _is_toml(line: str) -> bool:
    try:
        tomllib.loads(line)
    except tomllib.TOMLDecodeError:
        return False
    return True


def _advice(what: str, line: str) -> str:
    """The end of a sentence, or nothing. `what` the reader says was sometimes found out lines later."""
    setting = _SETTING.match(line)
    if setting is None:
        unequal = _NO_EQUALS.match(line)
        return f"; between a key and its value stands =, as in {unequal[1]} = ..." if unequal is not None else ""
    value = line[setting.end() :].strip()
    if not value.startswith(("'", '"')):
        value = re.sub(r"\s#.*", "", value).strip()
    found = (words for said, text, words in _ADVICE if re.match(said, what) and re.match(text, value))
    told = next(found, "") if what == "Unclosed array" or not _is_toml(line) else ""
    told = told.replace("{key}", setting[1]).replace("{value}", value.replace('"', "'"))
    return f"; {shorten(told, _MAX_CHARACTERS)}" if told else ""


def _said_twice(text: str) -> tuple[int, str] | None:
    """The number of the first line with a key that stands above already, and the key."""
    seen = set[tuple[str, str]]()
    for line in _named_lines(text):
        if line.key is not None:
            key = line.key.strip("\"'")
            if (line.table, key) in seen:
                return line.number, key
            seen.add((line.table, key))
    return None


def _table_twice(line: str, text: str) -> str:
    """What to do about a table that stands above already, in one form or another; nothing where the line is none."""
    header = _HEADER.match(line)
    if header is None:
        return ""
    name = header[2].strip()
    forms = {found[1] for found in map(_HEADER.match, text.split("\n")) if found and found[2].strip() == name}
    if "[[" in forms:
        return f"[{name}] and [[{name}]] both stand there; write [[{name}]] each time"
    if re.search(rf"(?m)^\s*{re.escape(name)}\s*=", text):
        return f"{name} stands there twice, as a line and as a table; keep one of them"
    return f"the table [{name}] stands there twice; put all of its lines below the first"


def _not_toml(text: str, error: tomllib.TOMLDecodeError) -> str:
    """`LINE:COLUMN: is not TOML: why; what to write instead`."""
    what, _, _ = str(error).partition(" (at ")
    told = re.search(r"\(at line (\d+), column (\d+)\)", str(error))
    lines = text.split("\n")
    twice = _said_twice(text) if what.startswith("Cannot overwrite") else None
    if twice is not None:
        return f"{twice[0]}:1: is not TOML: {twice[1]} stands there twice; keep one of them"
    line, column = (int(told[1]), int(told[2])) if told is not None else (len(lines), len(lines[-1]) + 1)
    wrong = lines[min(line, len(lines)) - 1]
    table = _table_twice(wrong, text) if re.match("Cannot (overwrite|declare)", what) else ""
    if table:
        return f"{line}:1: is not TOML: {table}"
    return f"{line}:{column}: is not TOML: {what[:1].lower()}{what[1:]}{_advice(what, wrong)}"


def read_toml(text: str, name: str) -> dict[str, Any]:
    """What a person wrote, as a table; `name` is that of the file."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise UsageError(f"{name}:{_not_toml(text, error)}") from error


# Tables of the kit in TOML. A bad one is the kit's fault.


def read_text(path: Path) -> str:
    """The file as text."""
    try:
        return path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise GraderFault(f"{path}: cannot be read: {reason(error)}") from error


def table_of_kit(text: str, path: Path) -> dict[str, Any]:
    """The file as a table."""
    try:
        return read_toml(text, str(path))
    except UsageError as error:
        raise GraderFault(str(error)) from error


_STEP_DOWN = re.compile(r"\.([^.\[\]]+)|\[(\d+|\.\.\.)\]")
_SOME_ENTRY = "..."  # of a table whose keys are free: which one, msgspec does not tell


def _at(document: Any, path: Sequence[str]) -> Any:
    for name in path:
        document = document[int(name)] if isinstance(document, list) else document[name]
    return document


def _changed(document: Any, path: Sequence[str], value: object) -> Any:
    """The document with another value at that path."""
    if not path:
        return value
    if isinstance(document, list):
        return [_changed(it, path[1:], value) if str(at) == path[0] else it for at, it in enumerate(document)]
    return {**document, path[0]: _changed(document[path[0]], path[1:], value)}


def _malformed(document: object, kind: type[object]) -> Malformed:
    """What is wrong with it: nothing, where the problem is empty."""
    try:
        convert(document, kind)
    except Malformed as error:
        return error
    return Malformed("")


def _path_of(document: object, kind: type[object], error: Malformed) -> list[str]:
    """The keys that lead to what is wrong, as far as they can be told: a key can be made of anything."""
    path = list[str]()
    for key, number in _STEP_DOWN.findall(error.place):
        name, here = key or number, _at(document, path)
        if name == _SOME_ENTRY and isinstance(here, dict):
            alone = {one: _changed(document, path, {one: it}) for one, it in here.items()}
            name = next((one for one, it in alone.items() if str(_malformed(it, kind)) == str(error)), "")
            document = alone.get(name, document)
        if not (isinstance(here, list) or (isinstance(here, dict) and name in here)):
            break
        path.append(name)
    return path


_KINDS = {"int": "a whole number", "float": "a number", "str": "text", "array": "a list", "object": "a table"}
_KIND_NAME = re.compile(r"\b(?:int|float|str|array|object)\b")
_OR_NOTHING = " | null"
_MISSING = re.compile("object missing required field (.*)")


def _misspelled(document: object, path: Sequence[str], kind: type[object], problem: str) -> str:
    """The problem; a key that is missing where one much like it stands, and is nothing else's, is that one."""
    missing, found = _MISSING.fullmatch(problem), _at(document, path)
    other = nearest(missing[1], found) if missing is not None and isinstance(found, dict) else None
    if missing is None or other is None:
        return problem
    unfit = _malformed(_changed(document, path, {**found, other: ...}), kind)  # which no key takes that is read
    if unfit.place.endswith(f".{other}"):
        return problem
    return f"unknown key '{other}'; did you mean {missing[1]}?"


def _in_words(problem: str, found: object, path: Sequence[str], expected: Mapping[str, str]) -> str:
    """What is wrong there. `expected`: by key, what may stand behind it."""
    missing = _MISSING.fullmatch(problem)
    if missing is not None:
        return f"{missing[1]} is missing"
    if problem.startswith("unknown key"):
        return problem
    names = [name for name in path if not name.isdecimal()]
    words = expected.get(names[-1]) if names else None
    if words is None:
        words = problem.partition(", got ")[0].removeprefix("expected ").removesuffix(_OR_NOTHING)
        words = words.replace("of length >= 1", "that is not empty").replace(">=", "of at least").replace(" | ", " or ")
        words = _KIND_NAME.sub(lambda kind: _KINDS[kind[0]], words)
    name = f"{names[-1]}: " if names else ""
    return f"{name}expected {words}; found {shorten(repr(found), MAX_FOUND)}"


def parse_table(text: str, path: Path, what: str, kind: type[T], expected: Mapping[str, str] | None = None) -> T:
    """`what` the file should be, such as `a plan of hidden cases`."""
    table = table_of_kit(text, path)
    try:
        return convert(table, kind)
    except Malformed as error:
        keys = _path_of(table, kind, error)
        problem = _misspelled(table, keys, kind, error.problem)
        unknown = re.match("unknown key '([^']*)'", problem)
        place = place_in_toml(text, [*keys, *([unknown[1]] if unknown else [])])
        told = _in_words(problem, _at(table, keys), keys, expected or {})
        raise GraderFault(f"{path}:{place}: not {what}: {told}") from error
