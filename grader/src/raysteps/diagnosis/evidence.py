"""What was seen of a step that is not right."""

import hashlib
import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import groupby
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from raysteps.course.manifest import ImageCase, Step
from raysteps.images.compare import TOLERANCE, Pixels, is_flat, pixel_differences
from raysteps.judge.answers import Answer, PlainlyWrong
from raysteps.judge.bvhs import BVH
from raysteps.judge.functions import Case, Function, functions_of
from raysteps.judge.hidden_tests import make_cases, reference_lines
from raysteps.judge.octrees import OCTREE
from raysteps.judge.plan import Plan
from raysteps.judge.protocol import ProtocolError
from raysteps.judge.statistics import DECILES, RatioProblem, UnevenProblem
from raysteps.judge.worker import Ask, Reply, TimeBudget, ask_worker, reference_answers
from raysteps.sandbox.task import TaskResult
from raysteps.toolchain.kit_artifacts import BuiltKit

# What a program answers to the fixed cases of a step. They are drawn from a word of their own: so they say nothing
# about the seed of a grade, and what a known mistake answers to them is computed once.

_SEED = "diagnosis"
_MAX_CHARACTERS = 6000  # of an answer; of a longer one its hash will do


@dataclass(frozen=True)
class WrongAnswer:
    """A wrong answer. `problem` is what the judge finds wrong; not `known`: it was never asked. `boxes`: of a tree.
    `spread`: how many of the numbers drawn by chance fell into each bar, where that is the problem, and whether they go
    round. `times`: how many times what they should be the numbers are, where they are drawn by chance or means.
    `plainly_wrong`: the problem does not tell how it is wrong."""

    line: str
    problem: str
    known: bool = True
    boxes: int = 0
    spread: tuple[int, ...] = ()
    goes_round: bool = False
    times: tuple[float, ...] = ()
    plainly_wrong: bool = False


WrongAnswers: TypeAlias = Mapping[
    str, Mapping[int, WrongAnswer]
]  # by function, then by number of the case; only what is not right


@dataclass(frozen=True)
class Questions:
    """To one function, with what the reference answers."""

    function: Function
    cases: Sequence[Case]
    right: Sequence[str]


def _right_answers(kit: BuiltKit, function: str, cases: Sequence[Case]) -> list[str]:
    def ask(stdin: bytes, _seconds: float) -> TaskResult:
        return reference_answers(kit, stdin)

    return reference_lines(ask, cases, function)


def questions_of(kit: BuiltKit, step: Step, plan: Plan, names: Collection[str]) -> dict[str, Questions]:
    """By function, in the order of the step; the same for everybody."""
    found = {}
    for function in plan.functions:
        if function.name in names:
            cases = make_cases(step, function, _SEED)
            known = functions_of(step.number)[function.name]
            found[function.name] = Questions(known, cases, _right_answers(kit, function.name, cases))
    return found


def _kept(line: str) -> str:
    """What is kept of an answer."""
    return line if len(line) <= _MAX_CHARACTERS else "#" + hashlib.sha256(line.encode()).hexdigest()[:32]


def _said(
    function: Function, case: Case, right: str, reply: Reply, before: Mapping[str, WrongAnswer]
) -> WrongAnswer | None:
    """None for a right answer."""
    if not reply.asked:
        return WrongAnswer("", "", known=False)
    if reply.outcome != "ok":
        return WrongAnswer("", reply.outcome)
    if reply.line == right:
        return None
    line = _kept(reply.line)
    if line in before:
        return before[line]
    problem = case.verdict(function.answer, right, reply.line).problem
    if not problem:
        return None
    spread = tuple(problem.histogram.counts) if isinstance(problem, UnevenProblem) else ()
    goes_round = isinstance(problem, UnevenProblem) and problem.goes_round
    times = problem.times if isinstance(problem, RatioProblem) else ()
    boxes, plainly_wrong = _boxes(function, reply.line), isinstance(problem, PlainlyWrong)
    return WrongAnswer(line, str(problem), True, boxes, spread, goes_round, times, plainly_wrong)


def _boxes(function: Function, line: str) -> int:
    """How many a tree has; 0 for what is no tree."""
    if function.answer not in (OCTREE, BVH):
        return 0
    try:
        return len(function.answer.parse(line).nodes)
    except (ProtocolError, ArithmeticError, ValueError):
        return 0


def collect_wrong_answers(
    questions: Mapping[str, Questions], ask: Ask, seconds: float, mistakes: Collection[WrongAnswers] = ()
) -> WrongAnswers:
    """Asks a program. `seconds`: the limit of one run of its worker. `mistakes`: what others answered to the same; who
    answers as one of them has the same problem, and nobody has to judge that again."""
    budget = TimeBudget(seconds, len(questions))
    heard: dict[str, dict[int, WrongAnswer]] = {}
    for name, known in questions.items():
        replies = ask_worker(ask, known.cases, budget).replies
        before = _by_line(mistakes, name, len(known.cases))
        asked = zip(known.cases, known.right, replies, before, strict=True)
        said = [_said(known.function, *one) for one in asked]
        heard[name] = {number: one for number, one in enumerate(said) if one is not None}
    return heard


def _by_line(mistakes: Collection[WrongAnswers], function: str, cases: int) -> list[dict[str, WrongAnswer]]:
    """The wrong answers to each case of a function."""
    found: list[dict[str, WrongAnswer]] = [{} for _ in range(cases)]
    for answers in mistakes:
        for number, one in answers.get(function, {}).items():
            if one.line:
                found[number][one.line] = one
    return found


Mask = npt.NDArray[np.bool_]


def differing(one: Pixels, other: Pixels, tolerance: int = TOLERANCE) -> Mask:
    """The pixels in which two pictures of one size are not the same."""
    mask: Mask = pixel_differences(one, other) > tolerance
    return mask


@dataclass(frozen=True)
class Picture:
    """A student's picture beside the reference's, of one size."""

    case: ImageCase
    mine: Pixels
    reference: Pixels

    @cached_property
    def wrong(self) -> Mask:
        return differing(self.mine, self.reference)

    @property
    def is_wrong(self) -> bool:
        return float(self.wrong.mean()) > self.case.max_wrong

    @property
    def says_something(self) -> bool:
        """A picture of one colour may have any cause."""
        return not is_flat(self.mine) or is_flat(self.reference)


def _is_constant(questions: Questions, mine: Mapping[int, WrongAnswer]) -> bool:
    """Whether one answer to everything would be wrong and right in the same cases, with the same wrong answers."""
    lines = {one.line for one in mine.values()}
    if len(lines) != 1 or any(not line or line.startswith("#") for line in lines):
        return False
    (line,) = lines
    answer = questions.function.answer
    rest = [
        pair for number, pair in enumerate(zip(questions.cases, questions.right, strict=True)) if number not in mine
    ]
    return all(not case.verdict(answer, right, line).problem for case, right in rest)


@dataclass(frozen=True)
class Evidence:
    """`questions` and `answers` are of the functions that were asked, `pictures` are those that came out. `right`: the
    functions that the judge found right; `right_apart`: those that are right where the reference's stand for the wrong
    ones before them."""

    questions: Mapping[str, Questions]
    answers: WrongAnswers
    pictures: Mapping[str, Picture]
    right: Collection[str] = ()
    right_apart: Collection[str] = ()

    @cached_property
    def constant(self) -> Collection[str]:
        """The functions that give one answer whatever they are asked, as a stub does that nobody marked as one."""
        return {name for name, mine in self.answers.items() if _is_constant(self.questions[name], mine)}

    @property
    def is_wrong(self) -> bool:
        """Whether there is anything to explain."""
        return any(self.answers.values()) or any(picture.is_wrong for picture in self.pictures.values())


# Whether two wrong answers are wrong in the same way.

_ABSOLUTE = 2e-4
_RELATIVE = 2e-3
_MAX_WORDS = 2000
_WORDS_ONLY = 0.25  # of the weight of an answer with the same numbers
_TELLING_WORDS = 0.45  # where they say how it is wrong, and not only that it is: too little to name a mistake by
_SAME_WORDS_OF_CHANCE = 0.9  # of answers by chance: whoever turns a frame otherwise has other numbers for one mistake
_TURNED = 0.8  # of the weight of the same number
_DIRECTION = 3  # numbers in a row that are turned: a whole direction, whatever stands beside it
_FLAGS = frozenset({"0", "1"})
_MOSTLY = 0.6
_REMEMBERED = 1 << 12  # answers: each is compared with those of all mistakes


def _close(one: str, other: str) -> bool:
    """Whether two words of answers are the same, or nearly the same number."""
    if one == other:
        return True
    try:
        a, b = float(one), float(other)
    except ValueError:
        return False
    if math.isnan(a) or math.isnan(b):
        return math.isnan(a) and math.isnan(b)
    return abs(a - b) <= _ABSOLUTE + _RELATIVE * max(abs(a), abs(b)) < math.inf


@lru_cache(maxsize=_REMEMBERED)
def _wrong_words(right_line: str, line: str) -> tuple[bool, ...]:
    """Which words of an answer are not the reference's; all of them where it has more words or fewer."""
    rights, words = right_line.split(), line.split()
    if len(rights) != len(words):
        return (True,) * len(words)
    return tuple(not _close(*pair) for pair in zip(rights, words, strict=True))


def _agreement(right_line: str, mistake_line: str, my_line: str) -> float:
    """Of the words that are wrong in one of the two, the share in which they are the same. Opposite signs count less:
    who takes the wrong end of a sphere turns its normal in one way or the other. Without any word that is the same they
    count nothing: light that is taken away is not light that is added. Nor beside a number that keeps its sign, as of a
    direction that is turned in part, where fewer than three are turned in a row."""
    mistakes, mines = mistake_line.split(), my_line.split()
    if not len(mistakes) == len(mines) <= _MAX_WORDS:
        return 0.0
    both = zip(_wrong_words(right_line, mistake_line), _wrong_words(right_line, my_line), strict=True)
    wrong = [theirs or mine for theirs, mine in both]
    runs = groupby(range(len(mines)), key=wrong.__getitem__)
    worth = [one for is_wrong, run in runs if is_wrong for one in _worth([(mistakes[i], mines[i]) for i in run])]
    if not worth:
        return 1.0
    return sum(worth) / len(worth) if max(worth) == 1.0 else 0.0


def _worth(run: Sequence[tuple[str, str]]) -> list[float]:
    """Of words that stand side by side, and are all wrong."""
    has_same_sign = any(_keeps_sign(*pair) for pair in run)
    worth: list[float] = []
    for is_turned, stretch in groupby(run, lambda pair: _is_turned(*pair)):
        pairs = list(stretch)
        counts = is_turned and (len(pairs) >= _DIRECTION or not has_same_sign)
        turned = _TURNED if counts else 0.0
        worth += [1.0 if _close(*pair) else _TURNED if set(pair) == _FLAGS else turned for pair in pairs]
    return worth


def _keeps_sign(mistake: str, mine: str) -> bool:
    """Whether it is the same number. A word is none, and what may be a flag says nothing of signs."""
    return _is_number(mine) and mine not in _FLAGS and _close(mistake, mine) and not _is_turned(mistake, mine)


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _is_turned(mistake: str, mine: str) -> bool:
    """Whether it is the same number with the other sign, as 0 is of itself."""
    return _close(mistake.removeprefix("-") if mistake.startswith("-") else f"-{mistake}", mine)


@lru_cache(maxsize=_REMEMBERED)
def _parsed(answer: Answer[Any], line: str) -> list[Any]:
    """The value; none where it cannot be read."""
    try:
        return [answer.parse(line)]
    except (ProtocolError, ArithmeticError, ValueError):
        return []


def _fits(function: Function, case: Case, mistake: str, mine: str) -> bool:
    """Whether the judge would call my answer right if the mistake's were the truth."""
    values = [*_parsed(function.answer, mistake), *_parsed(function.answer, mine)]
    try:
        return len(values) == 2 and not function.answer.problem(case.inputs, *values)
    except (ProtocolError, ArithmeticError, ValueError):
        return False


_TIMES = 2  # as many boxes: a tree of one leaf is not one of a hundred


def _as_many(one: int, other: int) -> bool:
    return max(one, other) <= _TIMES * min(one, other) + 1


_SPREAD = 0.12  # of all numbers: so many may lie in other bars
_SPREAD_OF_CHANCE = 2.0  # deviations of what chance moves there


def _spread_alike(one: Sequence[int], other: Sequence[int], *, goes_round: bool) -> bool:
    """Whether the bars of two histograms are the same, in one order or the other, and of angles from any of them on: a
    frame may be turned or mirrored. The same words are said of points that crowd a little and of points that all lie at
    one place."""
    if not one or not other:
        return len(one) == len(other)
    mine, theirs = (np.array(counts) / max(sum(counts), 1) for counts in (one, other))
    if len(mine) != len(theirs):
        return False
    starts = range(len(theirs) if goes_round else 1)
    turned = (np.roll(way, start) for way in (theirs, theirs[::-1]) for start in starts)
    moved = min(float(np.abs(mine - bars).sum()) / 2 for bars in turned)
    return moved <= _SPREAD + _SPREAD_OF_CHANCE / math.sqrt(max(min(sum(one), sum(other)), 1))


_TIMES_OF_CHANCE = 0.01  # so far may two means or frequencies lie from each other
_TIMES_ALIKE = 0.15  # and farther where they lie far from 1, by so much of that
_TIMES_APART = 3  # of means: near 0 a small gap is a large factor


def _times_alike(one: Sequence[float], other: Sequence[float]) -> bool:
    """Whether numbers are wrong by as much: the same words are said of what lacks a factor and of what has another. A
    hundredth of what it should be is not a thousandth, whichever points were drawn."""
    if len(one) != len(other):
        return False
    if not one:
        return True
    less, more = sorted(sum(map(abs, times)) / len(times) for times in (one, other))
    far = max(abs(times - 1) for times in (*one, *other))
    slack = _TIMES_ALIKE * far + (_TIMES_OF_CHANCE if len(one) < DECILES else 0.0)
    is_near = all(abs(a - b) <= slack for a, b in zip(one, other, strict=True))
    return is_near and more <= _TIMES_APART * less + _TIMES_OF_CHANCE


def answer_similarity(function: Function, case: Case, right: str, mistake: WrongAnswer, mine: WrongAnswer) -> float:
    """From 0 to 1, for two answers that are both wrong. `right`: what the reference answers."""
    if mistake.line == mine.line and mistake.problem == mine.problem:
        return 1.0
    same_problem = mistake.problem == mine.problem
    if not mistake.line or not mine.line:
        return 0.0  # one of them gave no answer
    if function.answer in (OCTREE, BVH):  # everybody divides space in another way
        return 1.0 if same_problem and _as_many(mistake.boxes, mine.boxes) else 0.0
    same_problem = same_problem and _spread_alike(mistake.spread, mine.spread, goes_round=mine.goes_round)
    same_problem = same_problem and _times_alike(mistake.times, mine.times)
    if mistake.line.startswith("#") or mine.line.startswith("#"):
        return 1.0 if same_problem else 0.0
    if mistake.line.startswith("threw") or mine.line.startswith("threw"):
        return 1.0 if same_problem else 0.0
    if function.answer.is_drawn:  # what is wrong with it does not hang on another answer
        return _SAME_WORDS_OF_CHANCE if same_problem else 0.0
    if _fits(function, case, mistake.line, mine.line):
        return 1.0
    if not same_problem:
        return 0.0
    agreement = _agreement(right, mistake.line, mine.line)
    if agreement >= _MOSTLY:
        return agreement
    return _WORDS_ONLY if mine.plainly_wrong else _TELLING_WORDS
