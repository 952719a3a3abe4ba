"""A single case in a file, to be asked again: cases/NN-function.json beside results.json."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from raysteps.common.errors import UsageError
from raysteps.common.files import write_json
from raysteps.common.schemas import complaint, read_schema
from raysteps.common.text import printable
from raysteps.results.case_places import FOLDER

SCHEMA = "raysteps/case/v1"
_LARGEST = 1 << 20  # bytes


@dataclass(frozen=True)
class CaseFile:
    """`line` is what the worker reads; the words are what people read, as it was when the file was written."""

    step: str
    function: str
    kind: str
    seed: int
    line: str
    problem: str
    given: str
    expected: str
    actual: str


def write_case(path: Path, case: CaseFile) -> None:
    write_json(path, {"schema": SCHEMA, **asdict(case)})


def _refuse(path: Path, problem: str) -> UsageError:
    return UsageError(f"{path}: {problem}; expected a case as `check` writes it, such as {FOLDER}/02-closest-hit.json")


def read_case(path: Path) -> CaseFile:
    """Anything may stand in a file that somebody names."""
    try:
        with path.open("rb") as file:
            data = file.read(_LARGEST + 1)
        if len(data) > _LARGEST:
            raise _refuse(path, "too large")
        document: Any = json.loads(data.decode("utf-8"))
    except IsADirectoryError as error:
        raise _refuse(path, "a folder; name a file in it") from error
    except OSError as error:
        raise _refuse(path, f"cannot be read ({error.strerror or error})") from error
    except (ValueError, RecursionError) as error:
        raise _refuse(path, f"not JSON ({error})") from error
    problem = complaint(document, read_schema("raysteps.judge", "case.schema.json"))
    if problem:
        raise _refuse(path, problem)
    del document["schema"]
    texts = {key: printable(value) for key, value in document.items() if key != "seed"}
    return CaseFile(seed=document["seed"], **texts)
