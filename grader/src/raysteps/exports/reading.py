"""Reads a results.json of ours back."""

import json
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault, UsageError
from raysteps.grading.results import validate

_MAX_BYTES = 64 << 20


def read_results(path: Path) -> dict[str, Any]:
    """The document; anything else than raysteps/results/v1 is refused."""
    try:
        if path.stat().st_size > _MAX_BYTES:
            raise UsageError(f"{path}: is too large for a results.json")
        document = json.loads(path.read_bytes())
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror or error}") from error
    except (ValueError, RecursionError) as error:
        raise UsageError(f"{path}: is not JSON: {error}") from error
    try:
        validate(document)
    except GraderFault as error:
        raise UsageError(f"{path}: is not a results.json of this kit; {error}") from error
    assert isinstance(document, dict)
    return document
