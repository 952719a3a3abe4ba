"""What goes to a process that grades, and what comes back: plain JSON, so that it may run on any machine."""

import importlib
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal, Protocol, TypeVar, cast

from msgspec import Meta

from raysteps.common.documents import Amount, Malformed, Text, convert, plain
from raysteps.common.errors import GraderFault
from raysteps.results.model import Results, Settings
from raysteps.sandbox.task import Isolation
from raysteps.submission.load import Submission
from raysteps.toolchain.kit_artifacts import ProgressCallback


@dataclass(frozen=True)
class Job:
    """One submission to grade. `grader` names the function that makes the grader, as `module:function`."""

    submission: Submission
    settings: Settings
    grader: Annotated[str, Meta(pattern=r"^[A-Za-z_][A-Za-z0-9_.]*:[A-Za-z_][A-Za-z0-9_]*$")]
    kit: str  # fingerprint that the grader must have
    require_sandbox: bool = False
    run: str = ""  # uid of the run, by which its jobs can be stopped


GAVE_UP = "the grader gave up after"  # so a fault begins that --resume does not wait for again


def gave_up(seconds: float) -> str:
    """The fault of a grader that was ended from outside."""
    return f"{GAVE_UP} {seconds:.0f} s; look at the submission by hand"


_FILE = r"^(pictures(/[A-Za-z0-9_-][A-Za-z0-9._-]*){1,3}\.png|cases/[a-z0-9-]+\.json)$"


@dataclass(frozen=True)
class JobResult:
    """What became of a job. A fault has no results."""

    name: Text
    status: Literal["graded", "fault"]
    results: Results | None = None
    # And cases; by path below the folder of results.json.
    pictures: Mapping[Annotated[str, Meta(pattern=_FILE)], bytes] = field(default_factory=dict)
    fault: str = ""
    details: str = ""
    seconds: Amount = 0.0
    worker: str = ""

    def __post_init__(self) -> None:
        if (self.results is None) != (self.status == "fault") or bool(self.fault) != (self.status == "fault"):
            raise ValueError("results without a fault, or a fault without results, expected")


def to_line(message: Job | JobResult) -> bytes:
    """As it is sent."""
    return json.dumps(plain(message)).encode() + b"\n"


Message = TypeVar("Message", Job, JobResult)


def from_line(line: bytes, kind: type[Message]) -> Message:
    """What was sent."""
    try:
        return convert(json.loads(line), kind, complete=True)
    except Malformed as error:
        raise GraderFault(f"this is no {kind.__name__}: {error}") from error


# What grades one submission; the class does not know how that is done.

KIT_GRADER = "raysteps.classroom.kit_grader:make"


class Grader(Protocol):
    """Ready to grade. `fingerprint` is the kit's."""

    fingerprint: str
    isolation: Isolation

    def learn(self, steps: Sequence[str], say: ProgressCallback) -> None:
        """What takes long once, before a submission has to wait for it: of these steps."""

    def grade(self, submission: Submission, settings: Settings, out: Path, say: ProgressCallback) -> None:
        """Writes out/results.json and the pictures that it names."""


SAME_KIT = (  # what to do where two machines differ
    "install the same version of the kit, and the same compiler, on every machine, and give all the same course.toml: "
    "its points count as part of the kit (RAYSTEPS_COURSE names a file that all can read)"
)


def make_grader(name: str, *, require_sandbox: bool, say: ProgressCallback) -> Grader:
    """From `module:function`. A name, because it must reach other processes and machines."""
    found = re.fullmatch(r"([A-Za-z_][\w.]*):([A-Za-z_]\w*)", name)
    if found is None:
        raise GraderFault(f"{name!r} does not name a grader; expected module:function")
    try:
        make = getattr(importlib.import_module(found[1]), found[2])
    except (ImportError, AttributeError) as error:
        raise GraderFault(f"the grader {name} cannot be had: {error}") from error
    return cast(Grader, make(require_sandbox=require_sandbox, say=say))
