"""What goes to a process that grades, and what comes back: plain JSON, so that it may run on any machine."""

import base64
import importlib
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, Protocol, cast

from raysteps.common.documents import Malformed, convert, plain
from raysteps.common.errors import GraderFault
from raysteps.common.schemas import complaint, read_schema
from raysteps.results.model import Results
from raysteps.sandbox.task import Isolation
from raysteps.submission.load import Submission

Document = dict[str, Any]


@dataclass(frozen=True)
class Job:
    """One submission to grade. `grader` names the function that makes the grader, as `module:function`."""

    submission: Submission
    settings: Mapping[str, Any]
    grader: str
    kit: str  # fingerprint that the grader must have
    require_sandbox: bool = False
    run: str = ""  # uid of the run, by which its jobs can be stopped

    def to_json(self) -> Document:
        sources = {step: base64.b64encode(data).decode() for step, data in self.submission.sources.items()}
        return {
            "schema": "raysteps/class-job/v1",
            "name": self.submission.name,
            "sources": sources,
            "notes": dict(self.submission.notes),
            "remarks": dict(self.submission.remarks),
            "settings": dict(self.settings),
            "grader": self.grader,
            "kit": self.kit,
            "require_sandbox": self.require_sandbox,
            "run": self.run,
        }

    @staticmethod
    def from_json(document: Document) -> "Job":
        _check(document, "job")
        sources = {step: base64.b64decode(text, validate=True) for step, text in document["sources"].items()}
        return Job(
            Submission(document["name"], sources, document["notes"], document["remarks"]),
            document["settings"],
            document["grader"],
            document["kit"],
            document["require_sandbox"],
            document["run"],
        )


@dataclass(frozen=True)
class Answer:
    """What became of a job. A fault has no results."""

    name: str
    status: Literal["graded", "fault"]
    results: Results | None = None
    pictures: Mapping[str, bytes] = field(default_factory=dict)  # and cases; by path below the folder of results.json
    fault: str = ""
    details: str = ""
    seconds: float = 0.0
    worker: str = ""

    def to_json(self) -> Document:
        pictures = {path: base64.b64encode(data).decode() for path, data in self.pictures.items()}
        return {
            "schema": "raysteps/class-answer/v1",
            "name": self.name,
            "status": self.status,
            "document": plain(self.results),
            "pictures": pictures,
            "fault": self.fault,
            "details": self.details,
            "seconds": self.seconds,
            "worker": self.worker,
        }

    @staticmethod
    def from_json(document: Document) -> "Answer":
        _check(document, "answer")
        pictures = {path: base64.b64decode(text, validate=True) for path, text in document["pictures"].items()}
        words = (document[key] for key in ("fault", "details", "seconds", "worker"))
        try:
            told = document["document"]
            results = convert(told, Results, complete=True) if told is not None else None
        except Malformed as error:
            fault = f"results.json is not of its form: {error}"
            return Answer(
                document["name"], "fault", fault=fault, seconds=document["seconds"], worker=document["worker"]
            )
        return Answer(document["name"], document["status"], results, pictures, *words)


def _check(document: Any, kind: str) -> None:
    problem = complaint(document, read_schema("raysteps.classroom", "messages.schema.json", kind))
    if problem:
        raise GraderFault(f"a {kind} breaks its schema: {problem}")


# What grades one submission; the class does not know how that is done.

ProgressCallback = Callable[[str], None]
KIT_GRADER = "raysteps.classroom.kit_grader:make"


class Grader(Protocol):
    """Ready to grade. `fingerprint` is the kit's."""

    fingerprint: str
    isolation: Isolation

    def grade(self, submission: Submission, settings: Mapping[str, Any], out: Path, say: ProgressCallback) -> None:
        """Writes out/results.json and the pictures that it names."""


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
