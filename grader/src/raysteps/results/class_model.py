"""What is known of a class that was graded: these classes are the form raysteps/class/v1 of class.json."""

from dataclasses import dataclass, field
from typing import Annotated, ClassVar, Literal

from msgspec import Meta

from raysteps.common.documents import OPTIONAL, Amount, Count, Text
from raysteps.results.model import EarlierSubmission, Lateness, Settings
from raysteps.results.statuses import NOT_TAKEN_STATUS


@dataclass
class Student:
    """Of a submission, as the roster names them; what it does not say is empty."""

    id: str
    name: str
    email: str


@dataclass
class NotedStudent(Student):
    """With what there is to say."""

    note: str


@dataclass
class StepPoints:
    """What a submission got for a step."""

    points: Amount
    max: Amount
    status: str


@dataclass
class EarlierResult:
    """That counted until the last run gave another one."""

    run: int
    status: Literal["graded", "unreadable", "fault"]
    points: Amount | None
    # Whether something else had been handed in until then, or the same was graded otherwise; null where a kit that did
    # not keep what was handed in graded one of them.
    resubmitted: bool | None = field(default=None, metadata=OPTIONAL)


@dataclass
class HumanReview:
    """What people did with a submission."""

    automatic: Amount | None = None  # the points as the grader gave them
    changes: list[str] = field(default_factory=list)  # of points, in words
    look_again: list[str] = field(default_factory=list)  # what of them rests on a result that has changed since
    comments: Count = 0
    requests: Count = 0  # for a regrade
    open_requests: Count = 0
    read: bool = False  # somebody has read the code as it is now


@dataclass(kw_only=True)
class GradedSubmission:
    """How one submission stands."""

    FORMER_KEYS: ClassVar = ("inconsistent",)

    name: Text
    entry: Text
    students: list[Student]
    status: Literal["graded", "unreadable", "fault", "not-graded"]
    points: Amount | None  # after what people changed, without regard to lateness
    max: Amount | None  # without the bonus
    run: int | None  # that gave this result
    steps: dict[str, StepPoints]
    mistakes: dict[str, list[Text]] = field(default_factory=dict, metadata=OPTIONAL)  # by step: their titles
    seconds: Amount | None = field(default=None, metadata=OPTIONAL)  # that grading it took
    final: Amount | None  # what lateness leaves of the points
    late: Lateness | None
    submitted_at: str  # with a time zone; empty when it is not known
    submitted_from: Literal["", "roster", "files"]
    outdated: bool  # has an earlier result: what is there now is not graded yet
    before: EarlierResult | None
    earlier: list[EarlierSubmission] = field(default_factory=list, metadata=OPTIONAL)  # the oldest first
    isolation: str  # what kept the code apart from the machine
    fault: str
    note: str
    # Why: one sentence for all where nothing could be read, else one for each step whose file was not taken.
    not_taken: list[str] = field(default_factory=list, metadata=OPTIONAL)
    results: str | None  # path of results.json
    review: HumanReview = field(default_factory=HumanReview, metadata=OPTIONAL)

    @property
    def automatic_points(self) -> float | None:
        """As the grader gave them."""
        return self.points if self.review.automatic is None else self.review.automatic

    @property
    def unread_steps(self) -> set[str]:
        """The ids of the steps whose files were not taken."""
        if self.status == "unreadable":
            return set(self.steps)
        return {line.partition(": ")[0] for line in self.not_taken} & self.steps.keys()

    def shown_status(self, step: str) -> str:
        """For the eye: a step that was not taken is not started in the results, unless somebody gave points for it."""
        result = self.steps[step]
        return NOT_TAKEN_STATUS if step in self.unread_steps and not result.points else result.status

    @property
    def why_unread(self) -> list[str]:
        """Where nothing could be read; the note may say what to do about it."""
        return [*self.not_taken, *filter(None, [self.note])]


@dataclass
class RunCounts:
    """How many results a run gave."""

    graded: Count = 0
    unreadable: Count = 0
    fault: Count = 0


@dataclass
class ClassRun:
    """One grading of the class."""

    number: Annotated[int, Meta(ge=1)]
    started_at: str
    ended_at: str
    state: Literal["running", "complete", "interrupted"]
    kit: str  # its fingerprint
    folder: str  # where the submissions were
    shard: Annotated[str, Meta(pattern="^[0-9]+/[0-9]+$")]
    reused: Count  # results that did not have to be made anew
    settings: Settings
    results: RunCounts


@dataclass
class GradedStep:
    """A step that was graded."""

    id: str
    title: str
    points: Amount
    bonus: bool


@dataclass
class MistakeCount:
    """A known mistake, and how many made it."""

    step: Text
    title: Text
    submissions: Annotated[int, Meta(ge=1)]


@dataclass
class PointsChange:
    """What the last run changed."""

    name: str
    before: Amount | None
    after: Amount | None
    resubmitted: bool | None = field(default=None, metadata=OPTIONAL)  # else the same was graded otherwise

    @property
    def why(self) -> str:
        """The end of a sentence; nothing where it is not known."""
        if self.resubmitted is None:
            return ""
        return "; handed in again" if self.resubmitted else "; the same submission, with another kit, seed or option"


@dataclass
class ClassStatistics:
    """Of the points after lateness; those that could not be read do not count."""

    graded: Count
    mean: Amount | None
    median: Amount | None


@dataclass(kw_only=True)
class ClassResults:
    """A class after its last run; lists without a word name submissions."""

    FORMER_KEYS: ClassVar = ("inconsistent",)

    schema: Literal["raysteps/class/v1"]
    course: str = field(default="", metadata=OPTIONAL)  # its title and term
    run: ClassRun  # the last one
    runs: Annotated[list[ClassRun], Meta(min_length=1)]
    steps: list[GradedStep]
    late_policy: str | None  # the text of the TOML file
    submissions: list[GradedSubmission]
    students_without_submission: list[NotedStudent]
    students_with_several: list[NotedStudent]
    submissions_without_student: list[str]  # empty when there is no roster
    not_graded: list[str]  # yet, because the run was interrupted or a shard is missing
    faults: list[str]
    unreadable: list[str]
    changed: list[PointsChange]
    outdated: list[str]  # with an earlier result: what is there now is not graded yet
    mistakes: list[MistakeCount]  # the most common first
    gone: list[str]  # graded earlier, but no longer in the folder
    ignored: list[str]  # in the folder, but no submissions
    unknown_extensions: list[str]  # ids in the late policy that nobody has
    statistics: ClassStatistics
