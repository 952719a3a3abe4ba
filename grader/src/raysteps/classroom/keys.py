"""When two gradings are the same one."""

import hashlib
import json
from collections.abc import Mapping
from typing import Any

from raysteps.submission.intake import Submission

_TIMES = ("timing", "seconds")


def submission_key(submission: Submission, kit: str, settings: Mapping[str, Any]) -> str:
    """Of everything that a result depends on: what was handed in, the kit, and how it was asked to grade."""
    sources = {step: hashlib.sha256(data).hexdigest() for step, data in submission.sources.items()}
    parts = [submission.name, sources, submission.notes, submission.remarks, kit, dict(settings)]
    text = json.dumps(parts, sort_keys=True, ensure_ascii=True)
    return hashlib.sha256(text.encode()).hexdigest()


def without_times(document: Any) -> Any:
    """A copy of a results.json without what a clock said: the rest is the same whenever it is graded."""
    if isinstance(document, dict):
        return {key: without_times(value) for key, value in document.items() if key not in _TIMES}
    return [without_times(value) for value in document] if isinstance(document, list) else document
