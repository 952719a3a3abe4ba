"""results.json: checked, then written; and read again."""

import re
from pathlib import Path

from raysteps.common.documents import Malformed, checked, parse, plain
from raysteps.common.errors import GraderFault, UsageError, reason
from raysteps.common.files import write_json
from raysteps.results.model import Results

RESULTS = "results.json"  # where a submission's results are kept
REPORT = "report.html"  # the page of a results.json, beside it


def validate(results: Results) -> None:
    """A result that is not of the form of its class is the kit's fault."""
    checked(results, "results.json")


def write_results(results: Results, folder: Path) -> Path:
    """Checks and writes FOLDER/results.json; GraderFault says why it cannot be written."""
    validate(results)
    path = folder / RESULTS
    try:
        write_json(path, plain(results))
    except OSError as error:
        raise GraderFault(f"{folder}: the results cannot be written: {reason(error)}") from error
    return path


# Reads a results.json of ours back.

_MAX_BYTES = 64 << 20
_WANTED = "expected a results.json as checking or grading writes it"


def _unread(error: OSError) -> str:
    if isinstance(error, FileNotFoundError):
        return "is not there"
    return "is a folder" if isinstance(error, IsADirectoryError) else f"cannot be read: {reason(error)}"


def parse_results(data: bytes) -> Results:
    """The results in the bytes of a results.json; Malformed says what is wrong with them."""
    return parse(data, Results, complete=True)


def stored_results(text: object) -> Results | None:
    """The results that the database of a class keeps; None where it has none, or a kit of another form wrote them.
    Anything may stand in a column."""
    try:
        return parse(text.encode(), Results) if isinstance(text, str) else None
    except ValueError:  # Malformed, or half a character
        return None


def read_results(path: Path) -> Results:
    """The results in a file; anything else than raysteps/results/v1 is refused."""
    try:
        if path.stat().st_size > _MAX_BYTES:
            raise UsageError(f"{path}: is too large for a results.json")
        return parse_results(path.read_bytes())
    except OSError as error:
        raise UsageError(f"{path}: {_unread(error)}; {_WANTED}") from error
    except Malformed as error:
        raise UsageError(f"{path}: {error}; {_WANTED}") from error


# Where hidden cases that went wrong are kept, below the folder of results.json.

CASES_FOLDER = "cases"


def case_path(number: str, function: str) -> str:
    """One file for each function of a step."""
    name = re.sub(r"[^a-z0-9]+", "-", function.lower()).strip("-")
    return f"{CASES_FOLDER}/{number}-{name}.json"
