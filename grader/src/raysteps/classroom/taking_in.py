"""Reads the submissions of a class, one at a time."""

import errno
import os
from dataclasses import dataclass, replace
from pathlib import Path

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.text import printable
from raysteps.kit.manifest import Step
from raysteps.submission.intake import Submission, take_in

# What a submission cannot bring about: then this machine cannot read it, and nobody's points may depend on that.
_OF_THIS_MACHINE = {
    *(errno.EACCES, errno.EPERM, errno.EIO, errno.ENOENT, errno.ESTALE),
    *(errno.EMFILE, errno.ENFILE, errno.ENOMEM),
}


@dataclass(frozen=True)
class TakenIn:
    """A submission under its safe name. One that could not be read has no sources, and a note for each step."""

    submission: Submission
    unreadable: bool = False


def take_in_as(name: str, path: Path, steps: list[Step]) -> TakenIn:
    """What the student packed badly is the student's; what this machine cannot read is a GraderFault."""
    try:
        if not path.exists() or (path.is_dir() and not os.access(path, os.R_OK | os.X_OK)):
            raise GraderFault(f"{path}: is not there any more, or must not be read")
        return TakenIn(replace(take_in(path, steps), name=name))
    except UsageError as error:
        cause: BaseException | None = error
        while cause is not None:
            if isinstance(cause, OSError) and cause.errno in _OF_THIS_MACHINE:
                raise GraderFault(f"the submission cannot be read: {error}") from error
            cause = cause.__cause__
        # Where the submission lies is nobody's business but the instructor's.
        reason = printable(str(error).removeprefix(f"{path}: "))
        notes = {step.id: f"Nothing was taken from this submission: {reason}" for step in steps}
        return TakenIn(Submission(name, {}, notes), unreadable=True)
    except GraderFault:
        raise
    except Exception as error:  # whatever it is, it is the fault of one submission, and the class goes on
        raise GraderFault(f"the submission cannot be read: {type(error).__name__}: {error}") from error
