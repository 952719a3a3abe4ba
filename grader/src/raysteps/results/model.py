"""What came of a grading; `to_json` gives the form raysteps/results/v1."""

from dataclasses import asdict, dataclass, field
from typing import Any, Literal

from raysteps import __version__
from raysteps.results.work_ratio import Work
from raysteps.sandbox.task import Isolation

Status = Literal["passed", "partial", "failed", "not-started", "does-not-build", "crashed", "timeout"]
Termination = Literal["ok", "wrong", "crashed", "timeout"]


@dataclass
class TestResult:
    """One visible test case."""

    __test__ = False  # not a test class for pytest

    name: str
    passed: bool
    message: str = ""
    expression: str = ""
    expanded: str = ""
    location: str = ""
    outcome: Termination = "ok"


@dataclass
class ImageResult:
    """One picture; paths are relative to the folder of results.json."""

    name: str
    scene: str
    passed: bool
    max_wrong: float
    wrong_share: float | None = None
    max_share: float | None = None
    share_tested: float | None = None
    work: Work | None = None  # where few objects may be tested: what the program counted
    reference_work: Work | None = None
    message: str = ""
    mine: str | None = None
    reference: str | None = None
    difference: str | None = None
    seconds: float = 0.0
    outcome: Termination = "ok"


@dataclass
class CaseGroup:
    """One kind of hidden cases of a function, such as `origin inside`; all must be right."""

    name: str
    cases: int
    right: int
    undecided: int = 0  # not right, but perhaps it would be: never asked, or the answer is too large to be read
    wasteful: int = 0  # not right only because it spares no work

    @property
    def decided(self) -> int:
        """Cases in which the judge saw what the function does."""
        return self.cases - self.undecided


@dataclass
class HiddenResult:
    """What the judge saw of one function (in seeded cases) or of one hidden scene."""

    name: str
    kind: Literal["function", "picture"]
    share: float  # of this item's points that were earned, from 0 to 1
    weight: float = 1.0  # among the hidden items of the step
    wrong_share: float | None = None  # of the pixels of a scene
    groups: list[CaseGroup] = field(default_factory=list)
    message: str = ""  # what is wrong, without the input
    given: str = ""  # the input of the first wrong case, in words and numbers
    expected: str = ""
    actual: str = ""
    case: str = ""  # file with that input, for `replay`; relative to the folder of results.json
    seconds: float = 0.0
    outcome: Termination = "ok"

    @property
    def passed(self) -> bool:
        return self.share >= 1


@dataclass
class Diagnosis:
    """What explains a wrong answer or picture: a known mistake, a picture that was turned or recoloured, or where it is
    wrong and in what."""

    kind: Literal["mistake", "transformation", "finding"]
    id: str  # of the mistake in mutants.toml, or what happened to the picture, such as `upside-down`
    title: str  # ends the sentence "this is what you get when ..."; a sentence of its own for a finding
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


@dataclass
class StepResult:
    """What became of one step."""

    id: str
    status: Status
    points: float
    max: float
    bonus: bool
    tests: list[TestResult] = field(default_factory=list)
    images: list[ImageResult] = field(default_factory=list)
    hidden: list[HiddenResult] = field(default_factory=list)
    inconsistent: list[str] = field(default_factory=list)  # claims of the program that the judge did not see
    diagnoses: list[Diagnosis] = field(default_factory=list)  # the likeliest first
    build_log: str = ""  # all that the compiler said
    cumulative: Integration = field(default_factory=lambda: Integration(False))
    messages: list[str] = field(default_factory=list)


@dataclass
class Timing:
    """Seconds on the clock and of all processors, for the whole submission."""

    seconds: float = 0.0
    cpu_seconds: float = 0.0


@dataclass
class Results:
    """All steps of one submission."""

    submission: str
    steps: list[StepResult]
    seed: int = 0
    kit: str = ""  # fingerprint of the kit that graded
    isolation: Isolation = field(default_factory=Isolation)
    timing: Timing = field(default_factory=Timing)

    def to_json(self) -> dict[str, Any]:
        """The document: max counts the steps without the bonus, points count everything."""
        regular = [step for step in self.steps if not step.bonus]
        bonus = [step for step in self.steps if step.bonus]
        return {
            "schema": "raysteps/results/v1",
            "submission": self.submission,
            "kit": self.kit,
            "version": __version__,
            "seed": self.seed,
            "isolation": asdict(self.isolation),
            "timing": asdict(self.timing),
            "inconsistent": any(step.inconsistent for step in self.steps),
            "total": {
                "points": round(sum(step.points for step in self.steps), 2),
                "max": round(sum(step.max for step in regular), 2),
                "bonus": {
                    "points": round(sum(step.points for step in bonus), 2),
                    "max": round(sum(step.max for step in bonus), 2),
                },
            },
            "steps": [asdict(step) for step in self.steps],
        }
