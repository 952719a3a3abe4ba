"""What explains a step that is not right, in words."""

import re
import struct
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from raysteps.common.text import join_and, join_some
from raysteps.course.manifest import Step
from raysteps.course.mutants import read_mutants
from raysteps.course.stubs import placed_tokens
from raysteps.diagnosis.evidence import Evidence, Picture, Questions, collect_wrong_answers, differing, questions_of
from raysteps.diagnosis.matching import match, name_mistakes, shows_in
from raysteps.diagnosis.mutant_fingerprints import learned_fingerprints, mutant_fingerprints
from raysteps.diagnosis.pixel_regions import Terms, findings
from raysteps.diagnosis.transforms import BEFORE, TransformedPicture, in_words, transformation_of
from raysteps.images.compare import Pixels
from raysteps.images.render import reference_picture
from raysteps.judge.plan import Plan
from raysteps.judge.worker import Ask
from raysteps.results.model import USED_WITHOUT_VALUE, Diagnosis, StepResult
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback

_MAX = 2


def _before(kit: BuiltKit, step: Step, picture: Picture) -> Mapping[str, Pixels]:
    """The picture of an earlier step, by what it means when it comes out of this one."""
    if step.index not in BEFORE:
        return {}
    name, earlier = BEFORE[step.index]
    return {name: Terms(kit, step.index, picture).at_step(earlier)}


_HAS_SOME = 0.25  # of the pixels that the step changes in a picture: so many are right


def _is_elsewhere(kit: BuiltKit, step: Step, pictures: Mapping[str, Picture], seen_in: Collection[str]) -> bool:
    """Whether what the step adds is missing in these pictures, and to be seen in another one."""
    for name, picture in pictures.items():
        for before in _before(kit, step, picture).values() if name not in seen_in else ():
            added = differing(before, picture.reference)
            if (added & ~differing(picture.mine, picture.reference)).sum() > _HAS_SOME * added.sum():
                return True
    return False


_OF_VECTORS = {
    "negative": "normals-reversed",
    "red-and-blue-swapped": "axes-exchanged",
    "channels-permuted": "axes-exchanged",
}


# What moves one picture moves all of them.
_OF_ALL_PICTURES = {"shifted-by-one", "shifted-by-half"}


def _name(changed: TransformedPicture, step: Step, picture: Picture) -> str:
    """Where colours are directions, another order of the channels is another order of the axes."""
    shows_vectors = step.index == 1 or "normals" in picture.case.args
    return _OF_VECTORS.get(changed.id, changed.id) if shows_vectors else changed.id


def transformations(
    kit: BuiltKit, step: Step, pictures: Mapping[str, Picture], every_one: Mapping[str, Picture]
) -> Iterator[Diagnosis]:
    """Each once, with all pictures that it explains. What is missing in some of `every_one` only has another cause than
    what is missing wherever it should be."""
    found: dict[tuple[str, str], list[str]] = {}
    for name, picture in pictures.items():
        changed = transformation_of(picture, _before(kit, step, picture))
        if changed is not None:
            found.setdefault((_name(changed, step, picture), changed.detail), []).append(name)
    found = {key: seen for key, seen in found.items() if key[0] not in _OF_ALL_PICTURES or len(seen) == len(pictures)}
    for (name, detail), seen_in in sorted(found.items(), key=lambda item: -len(item[1]))[:_MAX]:
        found_one = in_words(name, detail, seen_in)
        is_before = step.index in BEFORE and name == BEFORE[step.index][0]
        has_another_cause = is_before and _is_elsewhere(kit, step, every_one, seen_in)
        yield replace(found_one, cause="") if has_another_cause else found_one


# A variable that was given no value. GCC fills it with bytes that show (RAYSTEPS_STUDENTS_OPTIONS in
# cmake/compiler.cmake): as a float that is a number which nobody means, and what is added to it does not change it.

_FILL = b"\xfe"
_NO_FLOAT = abs(float(struct.unpack("<f", 4 * _FILL)[0]))
_DIGITS = 1e-5  # of it that are told
_NO_WHOLE_NUMBERS = {str(struct.unpack(f"<{kind}", struct.calcsize(f"<{kind}") * _FILL)[0]) for kind in "iIqQ"}
_NUMBER = re.compile(r"(?<![\w.])-?\d{1,40}(?:\.\d{1,40})?(?:e[+-]?\d{1,3})?(?![\w.])")
_MAX_READ = 10_000  # characters of one answer


def _has_no_value(text: str) -> bool:
    """Whether one of its numbers is what fills such a variable, perhaps with the other sign."""
    numbers = _NUMBER.findall(text[:_MAX_READ])
    return any(number in _NO_WHOLE_NUMBERS or abs(abs(float(number)) / _NO_FLOAT - 1.0) < _DIGITS for number in numbers)


# What the compiler can tell; of glm's vectors it says nothing. GCC takes parts of a std::optional for such variables.
_WARNED = re.compile(
    r"(?<![^/\\\n])(?P<file>[\w.-]{1,80}):(?P<line>\d{1,7}):\d{1,7}: (?:warning: (?:variable )?|note: )"
    r"'(?!std::)(?:[\w{}]{1,80}(?:::|\.(?!std::))){0,9}(?P<name>[A-Za-z_]\w{0,80})' "
    r"(?:(?:is|may be) (?:used )?uninitialized|was (?P<declared>declared) here)",
)
# What the source shows: `bool found;`, at the beginning of a statement. An object of a class begins as the class says.
_BUILT_IN = {"bool", "char", "short", "int", "long", "unsigned", "signed", "float", "double"}
_PLAIN = _BUILT_IN | {"Color", "mat3", "mat4", "size_t", "ptrdiff_t"}
_PLAIN |= {f"{kind}vec{size}" for kind in ("", "b", "d", "i", "u") for size in (2, 3, 4)}
_PLAIN |= {f"{sign}int{size}_t" for sign in ("", "u") for size in (8, 16, 32, 64)}
_INSIDE = [":", ":"]
_IS_NAME = re.compile(r"[A-Za-z_]\w*")


@dataclass(frozen=True)
class UninitializedVariable:
    """A variable that is declared without a value. `function`: the outermost that it is in, as the source calls it."""

    name: str
    place: str
    function: str = ""

    def __str__(self) -> str:
        return f"`{self.name}` ({self.place})"


def _declared(statement: list[str]) -> list[str]:
    """The names in the words of a statement `bool a, b`; none where it is another, or one of them has a value."""
    at = 0
    while statement[at + 1 : at + 3] == _INSIDE:
        at += 3
    if at >= len(statement) or statement[at] not in _PLAIN:
        return []
    while at + 1 < len(statement) and {statement[at], statement[at + 1]} <= _BUILT_IN:  # unsigned long
        at += 1
    names, signs = statement[at + 1 :: 2], statement[at + 2 :: 2]
    return [*names] if set(signs) <= {","} and all(map(_IS_NAME.fullmatch, names)) else []


def uninitialized_variables(source: str, file: str) -> list[UninitializedVariable]:
    """In the functions of a source. What lies in a class or outside of all is 0, or set where an object is made."""
    source = source.replace("\r\n", "\n")
    found, statement, scopes = [], list[str](), list[str]()
    line, seen = 1, 0  # where the statement begins
    for text, start in placed_tokens(source):
        if not statement:
            line, seen = line + source.count("\n", seen, start), start
        if text not in (";", "{", "}"):
            statement.append(text)
            continue
        if text == ";" and scopes and scopes[-1]:
            function = next(filter(None, scopes))
            found += [UninitializedVariable(name, f"{file}:{line}", function) for name in _declared(statement)]
        if text == "{":
            scopes.append(_scope(statement, scopes))
        elif text == "}" and scopes:
            scopes.pop()
        statement = []
    return found


def _scope(head: list[str], scopes: Sequence[str]) -> str:
    """What a brace after these words begins: the name of a function, or nothing for a class or namespace."""
    if set(head) & {"struct", "class", "union", "enum", "namespace"} and ")" not in head:
        return ""
    if "(" not in head or (scopes and scopes[-1]):
        return scopes[-1] if scopes else ""
    end = head.index("(")
    begin = end - 1
    while begin >= 3 and head[begin - 2 : begin] == _INSIDE:
        begin -= 3
    return "".join(head[max(begin, 0) : end])


_PERHAPS = "perhaps-without-value"
_OF_GLM = "Look for a declaration without a value: `glm::vec3 sum;` holds anything, `glm::vec3 sum(0.0F);` begins at 0."
_MAX_NAMED = 3


def _warned(step: Step, log: str) -> UninitializedVariable | None:
    """The variable and its place, where it is declared if that is told."""
    found = [one for one in _WARNED.finditer(log) if one["file"] in step.files]
    one = next((one for one in found if one["declared"]), found[0] if found else None)
    return None if one is None else UninitializedVariable(one["name"], f"{one['file']}:{one['line']}")


def used_without_value(
    step: Step, result: StepResult, about: Mapping[str, Sequence[str]], unset: Sequence[UninitializedVariable]
) -> Iterator[Diagnosis]:
    """That some function used such a variable: by what it gave. `about`: the functions of each test; `unset`: what may
    be meant."""
    said = [(about.get(one.name, ()), one.expression, one.expanded) for one in result.tests if not one.passed]
    said += [((one.name,), one.expected, one.actual) for one in result.hidden if not one.passed]
    seen = {name for names, right, got in said if _has_no_value(got) and not _has_no_value(right) for name in names}
    names = [name for name in step.functions if name in seen]
    if names:
        meant = [*filter(None, [_warned(step, result.build_log)])] or unset[:_MAX_NAMED]
        title = f"In {join_and(names)} a variable is used that was given no value: numbers like -1.7e+38 come of that."
        where = f"where {'they are' if len(meant) > 1 else 'it is'} declared"
        hint = f"Give {join_and(list(map(str, meant)))} a value {where}." if meant else _OF_GLM
        yield Diagnosis("finding", USED_WITHOUT_VALUE, title, hint=hint, seen_in=names)


def warned_of(step: Step, result: StepResult) -> Iterator[Diagnosis]:
    """That the compiler warns of such a variable. It may err, so what is seen of the step comes before it."""
    warned = _warned(step, result.build_log)
    if warned:
        title = f"{warned} may be used before it was given a value, as the compiler warns."
        yield Diagnosis("finding", _PERHAPS, title, hint="Give it a value where it is declared.")


def asked_about(unset: Sequence[UninitializedVariable]) -> Iterator[Diagnosis]:
    """Whether such variables are set later, which nobody can see from outside: a bool is right half of the time."""
    if unset:
        named = join_some(list(map(str, unset)), _MAX_NAMED)
        is_one = len(unset) == 1
        title = f"{named} {'is' if is_one else 'are'} declared without a value."
        hint = f"Is {'it' if is_one else 'each'} set on every way to where it is read?"
        yield Diagnosis("finding", _PERHAPS, title, hint=hint)


_MAX_SECONDS = 4.0  # of one run of a student's worker: it has answered as many cases before


@dataclass(frozen=True)
class Diagnostician:
    """Knows the kit and one step of it; `ask` is none where the kit has no judge."""

    kit: BuiltKit
    step: Step
    plan: Plan | None
    ask: Ask | None
    say: ProgressCallback = lambda text: None

    def diagnose(
        self,
        result: StepResult,
        mine: Mapping[str, Pixels],
        unfinished: Collection[str],
        spoilt_functions: Collection[str] = (),
        source: str = "",
    ) -> list[Diagnosis]:
        """The likeliest first. `mine`: the visible pictures that came out; `unfinished`: functions that are stubs;
        `spoilt_functions`: those that are better than they look, since they call one that is wrong."""
        pictures = self._pictures(mine) if not unfinished else {}
        questions = self._questions(result, unfinished, spoilt_functions)
        known = learned_fingerprints(self.kit, self.step) if questions else {}
        mistakes = [one.answers for one in known.values()]
        answers = collect_wrong_answers(questions, self.ask, _MAX_SECONDS, mistakes) if self.ask is not None else {}
        passed = {item.name for item in result.hidden if item.kind == "function" and item.passed}
        apart = passed & set(spoilt_functions)
        named, spoilt = self._mistakes(Evidence(questions, answers, pictures, passed - apart, apart))
        open_ = {
            name: picture
            for name, picture in pictures.items()
            if picture.is_wrong and picture.says_something and name not in spoilt
        }
        found = list(transformations(self.kit, self.step, open_, pictures))
        told = {name for one in found for name in one.seen_in}
        rest = {name: picture for name, picture in open_.items() if name not in told}
        unset = [one for one in uninitialized_variables(source, self.step.file) if one.function not in passed]
        first = list(used_without_value(self.step, result, self.kit.tests.get(self.step.id, {}), unset))
        perhaps = [] if first else list(warned_of(self.step, result)) or list(asked_about(unset))
        return [*first, *named, *found, *perhaps, *findings(self.kit, self.step, rest)]

    def _mistakes(self, evidence: Evidence) -> tuple[list[Diagnosis], set[str]]:
        """Known mistakes, and the pictures that they spoil."""
        mutants = read_mutants(self.kit.project, self.step)
        if not mutants or not evidence.is_wrong:
            return [], set()
        known = mutant_fingerprints(self.kit, self.step, self.plan, mutants, self.say)
        forms = [(name, form) for mutant in mutants for name, form in mutant.choices().items()]
        matches = [match(form, known[name], evidence) for name, form in forms]
        named = name_mistakes(matches)
        spoilt = {
            name
            for one in named
            for name, picture in evidence.pictures.items()
            if name in one.explains or shows_in(known[one.mutant.id].pictures.get(name), picture)
        }
        return [one.diagnosis() for one in named], spoilt

    def _pictures(self, mine: Mapping[str, Pixels]) -> dict[str, Picture]:
        found = {}
        for case in self.step.images:
            if case.is_noisy:
                continue  # chance differs more than mistakes do: functions tell them
            reference = reference_picture(self.kit, self.kit.project.root / case.scene, case.args)
            if case.name in mine and mine[case.name].shape == reference.shape:
                found[case.name] = Picture(case, mine[case.name], reference)
        return found

    def _questions(
        self, result: StepResult, unfinished: Collection[str], spoilt: Collection[str]
    ) -> dict[str, Questions]:
        """To the functions that the judge found wrong; to all where it found none. A function may call those before it:
        what comes after one that is a stub says nothing about itself."""
        if self.plan is None:
            return {}
        judged = [item for item in result.hidden if item.kind == "function"]
        hung = {item.name for item in judged if item.outcome == "timeout"}
        wrong = {item.name for item in judged if not item.passed or item.name in spoilt}
        wrong = wrong or {item.name for item in judged}
        names = self.step.functions
        first_stub = min((names.index(name) for name in unfinished), default=len(names))
        return questions_of(self.kit, self.step, self.plan, (wrong - hung) & set(names[:first_stub]))
