"""What people add to a result: comments, points that they changed, and answers to students who asked."""

from dataclasses import dataclass, field
from typing import Literal

from raysteps.common.documents import Amount, Count

Part = Literal["", "tests", "pictures", "hidden", "together"]  # of a step's points; empty for all of them
SinceThen = Literal["", "moved", "gone"]  # what became of a commented line when the code changed


@dataclass(frozen=True)
class Comment:
    """At a line of the step's file; without a line it is about all of the step, or of the submission."""

    author: str
    at: str
    text: str
    line: Count = 0
    first: Count = 0  # number of the first line of the excerpt
    excerpt: list[str] = field(default_factory=list)
    since_then: SinceThen = ""
    line_then: Count = 0  # where it was when the comment was written


@dataclass(frozen=True)
class PointsOverride:
    """For a step or a part of it `points` are those that count. For a whole submission they are added."""

    part: Part
    automatic: Amount  # what the grader gave
    points: float
    reason: str
    author: str
    at: str


@dataclass(frozen=True)
class RegradeRequest:
    """What a student asked, and the answer once there is one."""

    text: str
    author: str
    at: str
    state: Literal["open", "answered"]
    answer: str = ""
    answered_by: str = ""
    answered_at: str = ""


@dataclass(frozen=True)
class Review:
    """All of it for a step, or for a submission as a whole."""

    automatic: Amount  # points before anybody changed them
    overrides: list[PointsOverride] = field(default_factory=list)
    comments: list[Comment] = field(default_factory=list)
    requests: list[RegradeRequest] = field(default_factory=list)
