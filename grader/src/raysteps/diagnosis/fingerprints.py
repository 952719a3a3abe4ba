"""What the known mistakes of a step answer and draw, as it is kept in the built kit."""

import io
import json
import zipfile
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from raysteps.common.files import write_bytes
from raysteps.diagnosis.answers import Answers, Said
from raysteps.programs.pictures import Pixels

_FACTS = "answers"


@dataclass(frozen=True)
class Fingerprint:
    """Of one mistake: its wrong answers, and its pictures by name where it makes any."""

    answers: Answers
    pictures: Mapping[str, Pixels]


Known: TypeAlias = Mapping[str, Fingerprint]  # by the name of the form of a mistake


def write_known(path: Path, known: Known) -> None:
    """One file, complete or not there."""
    answers = {
        mistake: {
            function: {str(number): asdict(said) for number, said in wrong.items()}
            for function, wrong in fingerprint.answers.items()
        }
        for mistake, fingerprint in known.items()
    }
    arrays: dict[str, Any] = {_FACTS: np.frombuffer(json.dumps(answers).encode(), dtype=np.uint8)}
    for mistake, fingerprint in known.items():
        arrays |= {f"{mistake}/{name}": pixels for name, pixels in fingerprint.pictures.items()}
    data = io.BytesIO()
    np.savez_compressed(data, **arrays)
    write_bytes(path, data.getvalue())


def read_known(path: Path) -> Known | None:
    """None where there is no such file, or none that can be read."""
    try:
        with np.load(path, allow_pickle=False) as arrays:
            answers = json.loads(arrays[_FACTS].tobytes())
            pictures = {tuple(key.split("/", 1)): arrays[key] for key in arrays.files if key != _FACTS}
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None
    return {
        mistake: Fingerprint(
            {
                function: {int(number): Said(**said) for number, said in wrong.items()}
                for function, wrong in functions.items()
            },
            {name: pixels for (owner, name), pixels in pictures.items() if owner == mistake},
        )
        for mistake, functions in answers.items()
    }
