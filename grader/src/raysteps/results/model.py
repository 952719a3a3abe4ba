"""What came of a grading: these classes are the form raysteps/results/v1 of results.json."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Annotated, ClassVar, Literal, Self

from msgspec import Meta

from raysteps import __version__
from raysteps.common.documents import OPTIONAL, Amount, Count, Share, Text
from raysteps.results.statuses import NOT_TAKEN, STATUS_WORDS, Status, StatusWords
from raysteps.sandbox.task import Isolation

SAME_POINTS = 0.005  # how far apart they may be: they are written in hundredths

# How an instructor wants a submission to be graded.

Feedback = Literal["full", "diagnosis", "score"]  # how much a student is told about the hidden part


@dataclass(frozen=True)
class Settings:
    """Together with the kit and the submission this fixes a grade."""

    feedback: Feedback = "full"
    limits: dict[str, Amount] = field(default_factory=dict)  # changes by name, see toolchain.limits
    only: tuple[str, ...] = ()  # step ids; all steps when there are none
    seed: int = 1


# What people add to a result: comments, points that they changed, and answers to students who asked.

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


# What was seen of a step, of a picture and of the whole.

Termination = Literal["ok", "wrong", "crashed", "timeout"]
Limit = Literal["", "time", "less-time", "memory", "not-run"]


@dataclass
class TestResult:
    """One visible test case."""

    __test__ = False  # not a test class for pytest

    name: Text
    passed: bool
    message: str = ""
    expression: str = ""
    expanded: str = ""
    location: str = ""
    outcome: Termination = "ok"
    weight: Amount = field(default=1.0, metadata=OPTIONAL)  # among the tests of the step
    waits_for: str = field(default="", metadata=OPTIONAL)  # a function that is not written yet
    limit: Limit = field(default="", metadata=OPTIONAL)  # that ended it; "less-time": than the step gives


@dataclass(frozen=True)
class Work:
    """What a picture cost, as `raytrace --stats` counts it: tests, and the structure that it built; no clock."""

    rays: Count
    surface_tests: Count
    box_tests: Count
    boxes: Count
    references: Count  # entries in the lists of the structure; a surface may stand in several
    bytes: Count

    @property
    def surfaces_per_ray(self) -> float:
        return self.surface_tests / self.rays if self.rays else 0.0

    @property
    def boxes_per_ray(self) -> float:
        return self.box_tests / self.rays if self.rays else 0.0

    @property
    def tests_per_ray(self) -> float:
        """A test of a surface and a test of a box weigh alike."""
        return (self.surface_tests + self.box_tests) / self.rays if self.rays else 0.0


@dataclass
class ImageResult:
    """One picture; paths are relative to the folder of results.json."""

    name: Text
    scene: str
    passed: bool
    max_wrong: Share
    wrong_share: Share | None = None
    max_share: Annotated[float, Meta(gt=0)] | None = None
    share_tested: Amount | None = None  # surfaces tested per ray, as a share of the scene's surfaces
    # Where few objects may be tested: what the program counted, and the same of the reference.
    work: Work | None = field(default=None, metadata=OPTIONAL)
    reference_work: Work | None = field(default=None, metadata=OPTIONAL)
    message: str = ""
    mine: str | None = None
    reference: str | None = None
    difference: str | None = None
    large: str | None = field(
        default=None, metadata=OPTIONAL
    )  # the same scene by the same program, only to be looked at
    seconds: Amount = 0.0
    outcome: Termination = "ok"
    share: Share = field(default=0.0, metadata=OPTIONAL)  # of its points; 0 where it passed in older kits
    waits_for: str = field(default="", metadata=OPTIONAL)  # a function that is not written yet
    noisy: bool = field(default=False, metadata=OPTIONAL)  # judged by mean light: a share that is wrong is of its parts

    @property
    def earned(self) -> float:
        return 1.0 if self.passed else self.share


@dataclass
class CaseGroup:
    """One kind of hidden cases of a function, such as `origin inside`. `share`: how much of it was right, parts of
    answers included."""

    FORMER_KEYS: ClassVar = ("undecided", "wasteful")

    name: str
    cases: Count
    right: Count
    share: Share = field(default=0.0, metadata=OPTIONAL)


@dataclass
class Histogram:
    """How many numbers fell into each of some equal parts of their range, and how many should, on average."""

    over: Text  # what the numbers are, as in "points around the middle, side by side"
    counts: list[Count]
    expected: list[Amount]


@dataclass
class HiddenResult:
    """What the judge saw of one function (in seeded cases) or of one hidden scene."""

    name: Text
    kind: Literal["function", "picture"]
    share: Share  # of this item's points that were earned, from 0 to 1
    weight: Amount = 1.0  # among the hidden items of the step
    wrong_share: Share | None = None  # of the pixels of a scene
    groups: list[CaseGroup] = field(default_factory=list)
    message: str = ""  # what is wrong, without the input
    given: str = ""  # the input of the first wrong case, in words and numbers
    expected: str = ""
    actual: str = ""
    spares_nothing: bool = field(default=False, metadata=OPTIONAL)  # a tree or a search: every ray tests most objects
    case: str = ""  # file with that input, for `replay`; relative to the folder of results.json
    seconds: Amount = 0.0
    outcome: Termination = "ok"
    waits_for: str = field(default="", metadata=OPTIONAL)  # a function that is not written yet
    histogram: Histogram | None = field(default=None, metadata=OPTIONAL)  # of samples of another density

    @property
    def passed(self) -> bool:
        return self.share >= 1


USED_WITHOUT_VALUE = "used-without-value"  # the id of a finding: a function uses a variable that was never set


@dataclass
class Diagnosis:
    """What explains a wrong answer or picture: a known mistake, a picture that was turned or recoloured, or where it is
    wrong and in what."""

    kind: Literal["mistake", "transformation", "finding"]
    id: Annotated[
        str, Meta(pattern=r"^[a-z0-9]+(-[a-z0-9]+)*$")
    ]  # of the mistake in mutants.toml, or what happened to the picture, such as `upside-down`
    title: Text  # ends the sentence "this is what you get when ..."; a sentence of its own for a finding
    sees: str = ""
    cause: str = ""
    hint: str = ""
    seen_in: list[str] = field(default_factory=list)  # functions and pictures that it explains
    alike: list[str] = field(default_factory=list)  # titles of mistakes that cannot be told from it here


@dataclass
class Integration:
    """Whether the step works together with the student's right steps before it."""

    passed: bool
    message: str = ""


def _mean(items: Sequence[tuple[float, float]]) -> float:
    """Of pairs of a weight and a share."""
    weight = sum(weight for weight, _ in items)
    return sum(weight * share for weight, share in items) / weight if weight else 0.0


@dataclass
class StepResult:
    """What became of one step."""

    FORMER_KEYS: ClassVar = ("inconsistent",)

    id: Annotated[str, Meta(pattern=r"^[0-9]{2}-[a-z0-9-]+$")]
    status: Status
    points: Amount
    max: Amount
    bonus: bool
    tests: list[TestResult] = field(default_factory=list)
    images: list[ImageResult] = field(default_factory=list)
    hidden: list[HiddenResult] = field(default_factory=list)
    diagnoses: list[Diagnosis] = field(default_factory=list)  # the likeliest first
    build_log: str = ""  # all that the compiler said
    cumulative: Integration = field(default_factory=lambda: Integration(False))
    messages: list[str] = field(default_factory=list)
    not_taken: str = field(default="", metadata=OPTIONAL)  # why nothing that was handed in could be read as this step
    review: Review | None = field(default=None, metadata=OPTIONAL)  # what a person added; `points` are those that count

    @property
    def shown(self) -> StatusWords:
        """The status as people read it: what was handed in and could not be read is not called a step that nobody has
        begun."""
        return NOT_TAKEN if self.not_taken and self.status == "not-started" else STATUS_WORDS[self.status]

    @property
    def share_of_tests(self) -> float:
        """How much of what all visible tests are worth was earned."""
        return _mean([(test.weight, float(test.passed)) for test in self.tests])

    @property
    def share_of_images(self) -> float:
        """Each visible picture counts the same."""
        return _mean([(1.0, image.earned) for image in self.images])

    @property
    def share_of_hidden(self) -> float:
        return _mean([(item.weight, item.share) for item in self.hidden])


@dataclass
class Timing:
    """Seconds on the clock and of all processors, for the whole submission."""

    seconds: Amount = 0.0
    cpu_seconds: Amount = 0.0


@dataclass
class PointSum:
    """Of several steps."""

    points: Amount
    max: Amount

    @classmethod
    def of(cls, steps: Sequence[StepResult]) -> Self:
        return cls(round(sum(step.points for step in steps), 2), round(sum(step.max for step in steps), 2))


@dataclass
class Total:
    """Points count everything, max counts the steps without the bonus."""

    points: Amount
    max: Amount
    bonus: PointSum

    @classmethod
    def of(cls, steps: Sequence[StepResult], extra: float = 0.0) -> Self:
        """`extra`: what a person gave or took for the submission as a whole."""
        points = max(0.0, round(PointSum.of(steps).points + extra, 2))
        regular = PointSum.of([step for step in steps if not step.bonus])
        return cls(points, regular.max, PointSum.of([step for step in steps if step.bonus]))


@dataclass(frozen=True)
class Lateness:
    """`points` is what is left; the points of the results stay as they are."""

    days: Count
    percent: Annotated[int, Meta(ge=0, le=100)] | Annotated[float, Meta(ge=0, le=100)]
    points: Amount
    deadline: str
    words: str  # the sum in words


@dataclass(frozen=True)
class HandIn:
    """What the grading of a class knows of a submission beside its steps."""

    students: list[str]  # their names, as the roster has them
    submitted_at: str  # with a time zone; empty when it is not known
    by_file: bool  # nobody but the time of a file says when
    late: Lateness | None  # none where there is no late policy


@dataclass(frozen=True)
class EarlierStep:
    """What a step got when something else was handed in."""

    points: Amount
    status: Status


@dataclass(frozen=True)
class EarlierSubmission:
    """What was handed in before, and what came of it the last time that it was graded."""

    submitted_at: str  # with a time zone; empty when it is not known
    by_file: bool  # nobody but the time of a file says when
    graded_at: str
    points: Amount
    steps: dict[str, EarlierStep]
    same_grading: bool  # by the same kit, hidden cases and options as the submission of these results
    number: Count = field(default=0, metadata=OPTIONAL)  # of all that were handed in, from 1; only the last are kept


@dataclass(kw_only=True)
class Results:
    """All steps of one submission. Nothing here tells the seed: whoever has it can make the hidden cases."""

    FORMER_KEYS: ClassVar = ("inconsistent", "seed")

    schema: Literal["raysteps/results/v1"]
    submission: Text
    kit: str  # fingerprint of the kit that graded
    version: str = field(default="", metadata=OPTIONAL)  # of that kit
    course: str = field(default="", metadata=OPTIONAL)  # its title and term
    handed_in: HandIn | None = field(default=None, metadata=OPTIONAL)
    review: Review | None = field(default=None, metadata=OPTIONAL)  # what a person added to the whole submission
    earlier: list[EarlierSubmission] = field(default_factory=list, metadata=OPTIONAL)  # the oldest first
    isolation: Isolation
    timing: Timing
    total: Total
    steps: list[StepResult]

    def __post_init__(self) -> None:
        amount = Counter(step.id for step in self.steps)
        twice = [name for name, times in amount.items() if times > 1]
        if twice:  # a page would show one of them, and count both
            raise ValueError(f"several steps are called {twice[0]}")

    @classmethod
    def of(
        cls,
        submission: str,
        steps: list[StepResult],
        kit: str = "",
        isolation: Isolation | None = None,
        timing: Timing | None = None,
    ) -> Self:
        """What this kit has just graded."""
        return cls(
            schema="raysteps/results/v1",
            submission=submission,
            kit=kit,
            version=__version__,
            isolation=isolation or Isolation(),
            timing=timing or Timing(),
            total=Total.of(steps),
            steps=steps,
        )
