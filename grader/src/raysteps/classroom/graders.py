"""What grades one submission; the class does not know how that is done."""

import importlib
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Protocol, cast

from raysteps.common.errors import GraderFault
from raysteps.sandbox.isolation import Isolation
from raysteps.submission.intake import Submission

Say = Callable[[str], None]
KIT_GRADER = "raysteps.classroom.kit_grader:make"


class Grader(Protocol):
    """Ready to grade. `fingerprint` is the kit's."""

    fingerprint: str
    isolation: Isolation

    def grade(self, submission: Submission, settings: Mapping[str, Any], out: Path, say: Say) -> None:
        """Writes out/results.json and the pictures that it names."""


def make_grader(name: str, *, require_sandbox: bool, say: Say) -> Grader:
    """From `module:function`. A name, because it must reach other processes and machines."""
    found = re.fullmatch(r"([A-Za-z_][\w.]*):([A-Za-z_]\w*)", name)
    if found is None:
        raise GraderFault(f"{name!r} does not name a grader; expected module:function")
    try:
        make = getattr(importlib.import_module(found[1]), found[2])
    except (ImportError, AttributeError) as error:
        raise GraderFault(f"the grader {name} cannot be had: {error}") from error
    return cast(Grader, make(require_sandbox=require_sandbox, say=say))
