"""The visible tests of a step, run so that a crash in one of them does not hide the rest, and those of functions that
are not written yet stand aside.
"""

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain

from raysteps.common.text import join_and, printable, shorten
from raysteps.course.manifest import Step
from raysteps.course.stubs import called_functions, unfinished_functions
from raysteps.images.render import exit_words, not_in_time
from raysteps.results.model import HiddenResult, ImageResult, StepResult, TestResult
from raysteps.sandbox.task import Output, Sandbox, TaskResult, Word
from raysteps.toolchain.catch2 import THREW, CutReport, TestOutcome, parse_cut_report, parse_report
from raysteps.toolchain.compile import Program
from raysteps.toolchain.limits import StepLimits

_MAX_STOPS = 3  # tests that are waited for, besides those of functions that were not among them
_NEXT_TO_NOTHING = 0.02  # of the time that all tests have, for those before the one that took the rest
_TOO_MUCH_MEMORY = (
    "The test needed more memory than a program may have here. Does a list or a recursion grow without end?"
)
_NOT_RUN = (
    f"This test was not run: {_MAX_STOPS} tests or more before it ran out of time or memory, one of the same function "
    "among them."
)
FIND_THE_LINE = "A debugger stops at the line; docs/where-students-work.md says how to start one."
_SPECIAL = re.compile(r'([\\,\["])')


def _run(
    sandbox: Sandbox, program: Program, limits: StepLimits, most: float, only: str | None = None, *, tools: bool = False
) -> TaskResult:
    words: tuple[Word, ...] = ("-r", "xml", "-d", "yes", "-o", Output("report"))
    if only is not None:
        words += (_SPECIAL.sub(r"\\\1", only),)
    return sandbox.run(replace(program.task(words, limits.of_program(most)), tools=tools))


def _complete(ran: TaskResult, names: Iterable[str]) -> list[TestOutcome] | None:
    """A report that holds exactly the expected test cases, from a program that ended as reports do."""
    cases = parse_report(ran.outputs.get("report", b""))
    ended = not (ran.outcome.timed_out or ran.stopped or ran.outcome.code < 0)
    if not ended or cases is None or sorted(case.name for case in cases) != sorted(names):
        return None
    return cases


def _result(case: TestOutcome) -> TestResult:
    if case.passed:
        return TestResult(case.name, True)
    if case.failure is None:
        return TestResult(case.name, False, "The test failed without an assertion.", outcome="wrong")
    failure = case.failure
    return TestResult(
        case.name,
        False,
        failure.notes,
        failure.expected,
        failure.got,
        failure.location,
        "wrong",
    )


def _result_alone(ran: TaskResult, name: str, *, sooner: bool) -> TestResult:
    cases = _complete(ran, [name])
    if cases is not None:
        return _result(cases[0])
    if ran.hung:
        return _hung(name, ran.outcome.seconds, sooner=sooner)
    return TestResult(
        name, False, _why_cut_short(ran), outcome="crashed", limit="memory" if ran.stopped == "memory" else ""
    )


def _hung(name: str, seconds: float, *, sooner: bool) -> TestResult:
    said = not_in_time("The test", seconds, sooner=sooner)
    return TestResult(name, False, said, outcome="timeout", limit="less-time" if sooner else "time")


_EXIT_CALLED = "exit() was called"  # as framework/testing/main.cpp says it


def _why_cut_short(ran: TaskResult) -> str:
    """What ended the program in the middle of a test, and how to find it."""
    if ran.stopped == "memory":
        return _TOO_MUCH_MEMORY
    words = ran.outcome.signal_words
    if words is not None:
        return f"The program crashed in the middle of the test ({words}). {FIND_THE_LINE}"
    ended = "The program ended in the middle of the test"
    if ran.outcome.stderr.rstrip().endswith(_EXIT_CALLED):
        return f"{ended}: {_EXIT_CALLED}. {FIND_THE_LINE}"
    return f"{ended}, with {exit_words(ran.outcome)}. {FIND_THE_LINE}"


def run_tests(
    sandbox: Sandbox,
    program: Program,
    tests: Mapping[str, Sequence[str]],
    limits: StepLimits,
    say: Callable[[str], None] = lambda text: None,
) -> list[TestResult]:
    """All test cases, each with the functions that it tests, in one process; when that ends badly, each in a process of
    its own. The one in which that process was stopped is not run again, if it had as good as all of the time. After
    some that were stopped, only those of functions that were not among these are run. `say` hears of waits."""
    ran = _run(sandbox, program, limits, limits.seconds)
    together = _complete(ran, tests)
    if together is not None:
        found = {case.name: _result(case) for case in together}
        return [found[name] for name in tests]
    known: dict[str, TestResult] = {}
    if ran.was_stopped:
        seconds, limits = limits.seconds, limits.after_a_stop()
        cut = _cut_short(ran, tests, seconds)
        if cut is not None:
            known = {case.name: _result(case) for case in cut.ended}
            known[cut.running] = _hung(cut.running, seconds, sooner=False)
            limits = limits.after_a_stop()
        say(f"{'a test was' if known else 'the tests were'} stopped; each of the others runs by itself now")
    results: list[TestResult] = []
    hung: list[set[str]] = [set(tests[name]) for name, result in known.items() if result.limit]
    for name, functions in tests.items():
        if name in known:
            results.append(known[name])
            continue
        if len(hung) >= _MAX_STOPS and any(one.issuperset(functions) for one in hung):
            results.append(TestResult(name, False, _NOT_RUN, outcome="timeout", limit="not-run"))
            continue
        alone = _run(sandbox, program, limits, limits.seconds, name)
        results.append(_result_alone(alone, name, sooner=limits.is_impatient))
        if results[-1].limit:
            hung.append(set(functions))
            limits = limits.after_a_stop()
            say(f"stopped: {name}")
    return results


def _cut_short(ran: TaskResult, names: Collection[str], seconds: float) -> CutReport | None:
    """What a process tells that ran out of processor time in one test; None where others had a share in it."""
    cut = parse_cut_report(ran.outputs.get("report", b"")) if ran.stopped == "cpu" else None
    if cut is None or not cut.after <= _NEXT_TO_NOTHING * seconds:  # which is no number, if a test told none
        return None
    told = [*(case.name for case in cut.ended), cut.running]
    return cut if len(set(told)) == len(told) and set(told) <= set(names) else None


def limits_after(tests: Iterable[TestResult], limits: StepLimits) -> StepLimits:
    """For what runs after them: where one was stopped, two programs were, that of all together and its own."""
    return limits.after_a_stop().after_a_stop() if any(test.limit for test in tests) else limits


def known_to_hang(tests: Iterable[TestResult], functions: Mapping[str, Sequence[str]]) -> set[str]:
    """Functions for which the step's whole time was not enough, in a test of nothing else."""
    hung = [functions[test.name] for test in tests if test.limit == "time"]
    return {names[0] for names in hung if len(names) == 1}


# The line at which a step crashes or hangs, by a program of the step that was compiled with sanitizers.

# A program may say anything, so each line is read in a time that grows with its length and no faster.
_MAX_LINE = 2000  # of those that are searched for words
_MAX_CAUSE = 4000  # characters of a report beside its stacks
_MAX_FRAMES = 50  # of a stack, in the student's files
_SLOWER = 5  # times as long as without
_SECONDS_OF_A_HANG = 4.0  # of work: its stack is printed ten times within the first three
_ALL_MEMORY_MB = 64 << 20  # of addresses: a sanitizer reserves terabytes, and watches by itself what is used
_HEAD = re.compile(
    r"==\d+== *ERROR: AddressSanitizer:? (?P<error>.*)|.*: runtime error: (?P<undefined>.*)|thrown: (?P<thrown>.*)"
    r"|(?P<running>still at work:)|(?P<stuck>not returned:)"
)
_FRAME = re.compile(r"\s*#\d+ 0x[0-9a-f]+ in ")
_RULE = re.compile(r"Assertion '(.*)' failed")
_ACCESS = re.compile(r"\b(READ|WRITE) (?:of size|memory access)")
_BROKEN_RULES = {
    "size()": "asks a list for an element beyond its end",
    "empty()": "asks an empty list for an element",
    "engaged": "asks an optional for a value that it does not have",
    "pointer()": "follows a null pointer",
}
_CAUSES = {
    r"stack-overflow": "calls itself without an end",
    r"stack-use-after": "{uses} a variable that is gone",
    r"use-after-free": "{uses} memory that was given back: an object that is gone, or a list that has moved since",
    r"underflow|overflow.*(?:to the left|bytes before)": "{uses} an element before the beginning of a list or an array",
    r"overflow": "{uses} an element beyond the end of a list or an array",
    r"(?:SEGV|BUS).*zero page": "follows a null pointer",
    r"SEGV|BUS": "follows a pointer that points nowhere",
    r"FPE": "divides a whole number by 0",
    r"-free|dealloc": "gives back memory that is not its own, or gives it back twice",
    r"allocation-size|out-of-memory|rss limit": "asks for more memory than there is",
}


@dataclass
class _Report:
    """What a sanitizer says, and the place in the student's files that is nearest to it."""

    kind: str  # "error", "undefined", "thrown", "running" or "stuck"
    text: str
    said: list[str] = field(default_factory=list)
    frames: list["_Frame"] = field(default_factory=list)  # in the student's files, the innermost first

    @property
    def place(self) -> str:
        """The innermost; where a recursion has no end, the innermost that calls itself, and not what it called last."""
        functions = [frame.function for frame in self.frames]
        endless = "stack-overflow" in self.text
        again = (frame.place for frame in self.frames if endless and functions.count(frame.function) > 1)
        return next(again, self.frames[0].place if self.frames else "")


@dataclass(frozen=True)
class _Frame:
    function: str
    file: str
    line: int

    @property
    def place(self) -> str:
        return f"{self.file}, line {self.line}, in {self.function}"


def _reports(said: str, files: Collection[str]) -> Iterator[_Report]:
    names = "|".join(map(re.escape, files))
    place = re.compile(rf"[ /\\](?P<file>{names}):(?P<line>\d+)(?::\d*)*\s*\Z")
    report, in_stack = None, False
    for line in said.splitlines():
        head = _HEAD.match(line)
        if head is not None:
            if report is not None:
                yield report
            kind = head.lastgroup or ""
            report, in_stack = _Report(kind, head[kind]), True
        elif report is not None:
            start = _FRAME.match(line) if in_stack and len(report.frames) < _MAX_FRAMES else None
            at = place.search(line, start.end()) if start is not None else None
            if start is not None and at is not None:
                function = _function_name(line[start.end() : at.start("file")].partition(" ")[0])
                report.frames.append(_Frame(function, at["file"], int(at["line"])))
            in_stack = in_stack and not (report.said and "#" in report.said[-1] and "#" not in line)
            report.said.append(line)
    if report is not None:
        yield report


def _function_name(text: str) -> str:
    """Without what it takes and gives, and without the namespaces around it."""
    name = text.replace("(anonymous namespace)::", "").replace("raysteps::", "")
    name = shorten(printable(re.split(r"[(<\[]", name)[0].split(" ")[-1]), 100)
    return "a lambda" if name == "operator" else name or "a function"


def _cause(report: _Report, said: str, thrown: str) -> str:
    if report.kind != "error":
        return report.text if report.kind == "undefined" else f"throws {report.text}"
    lines = (line for line in said.splitlines() if len(line) < _MAX_LINE)
    rule = next(filter(None, map(_RULE.search, lines)), None)
    if report.text.startswith("ABRT"):
        if rule is not None:
            known = next((words for part, words in _BROKEN_RULES.items() if part in rule[1]), "")
            return known or f"breaks a rule of the standard library: {rule[1]}"
        return f"throws {thrown}, and nobody catches it" if thrown else "ends the program with abort()"
    text = " ".join([report.text, *(line for line in report.said if "#" not in line)])[:_MAX_CAUSE]
    access = _ACCESS.search(text)
    uses = {"READ": "reads", "WRITE": "writes"}[access[1]] if access else "uses"
    words = next((words for pattern, words in _CAUSES.items() if re.search(pattern, text)), report.text.split(" ")[0])
    return words.replace("{uses}", uses)


def has_crashed(test: TestResult) -> bool:
    """Whether it was ended by the system, or by an exception; not where it waits for what is not written."""
    return not test.waits_for and (test.outcome == "crashed" or test.expanded.startswith(THREW))


def has_hung(test: TestResult) -> bool:
    """Whether it was stopped in the middle."""
    return not test.waits_for and test.outcome == "timeout" and test.limit != "not-run"


def crash_line(said: str, files: Collection[str], *, threw: bool) -> str:
    """Where in these files a program crashed (`threw`: threw), and why, by what its sanitizers said; nothing where
    they do not say it."""
    reports = [report for report in _reports(said, files) if report.place]
    thrown = [report for report in reports if report.kind == "thrown"]
    last = [report for report in reports if report.kind == ("thrown" if threw else "undefined")][-1:]
    for report in [*(report for report in reports if report.kind == "error"), *last]:
        cause = _cause(report, said, thrown[-1].text if thrown else "")
        return f"{report.place}: {shorten(printable(cause), 300)}."
    return ""


def hang_line(said: str, files: Collection[str]) -> str:
    """The innermost function of these files that did not return between the samples, and its lines in them."""
    reports = list(_reports(said, files))
    stuck = next((report.frames[0] for report in reports if report.kind == "stuck" and report.frames), None)
    if stuck is None:
        return ""
    samples = [report.frames for report in reports if report.kind == "running"]
    own = ([frame.line for frame in frames if frame.function == stuck.function][:1] for frames in samples)
    lines = sorted(set(chain.from_iterable(own))) or [stuck.line]
    words = f"line {lines[0]}" if len(lines) == 1 else f"lines {lines[0]} to {lines[-1]}"
    return f"{stuck.file}, {words}, in {stuck.function}: still at work when it was stopped."


_GUESS = re.compile(r"\((SIG[A-Z]{2,5}): [^():]{1,100}\)")


def tell_crash_line(
    sandbox: Sandbox, sanitized: Program, test: TestResult, limits: StepLimits, files: Collection[str]
) -> bool:
    """Runs a test that crashed or hung once more, and says beside its message where that was, if anybody can tell."""
    slower = 1 if test.limit == "memory" else _SLOWER  # what has no end comes to none with more time
    seconds = _SECONDS_OF_A_HANG if test.outcome == "timeout" else slower * limits.seconds
    patient = replace(limits, seconds=seconds, memory_mb=_ALL_MEMORY_MB)
    ran = _run(sandbox, sanitized, patient, patient.seconds, test.name, tools=True)
    if test.outcome == "timeout":
        found = hang_line(ran.outcome.stderr, files)
    else:
        found = crash_line(ran.outcome.stderr, files, threw=test.outcome != "crashed")
    if found:
        known = _GUESS.sub(r"(\1)", test.message.removesuffix(FIND_THE_LINE).strip(), count=1)
        test.message = f"{known}\n{found}".strip()
    return bool(found)


# What waits for functions that are not written yet.


def not_written_yet(functions: Sequence[str]) -> str:
    """In words."""
    return f"Not written yet: {join_and(functions)}."


def _missing(step: Step, functions: Sequence[str], unfinished: Sequence[str], called: Collection[str]) -> str:
    """The function for which these wait: one of them, or one before them that the source calls."""
    first = min((step.functions.index(name) for name in functions), default=0)
    needed = [*(name for name in unfinished if name in functions), *(n for n in step.functions[:first] if n in called)]
    return needed[0] if needed else ""


def mark_waiting(
    result: StepResult,
    step: Step,
    tests: Mapping[str, Sequence[str]],
    source: str,
    *,
    replaced: bool = False,
) -> list[str]:
    """Where a RAYSTEPS_TODO is left, what failed says what it waits for, and such tests come last. `tests`: the
    functions of each; `replaced`: the reference's functions stood in for those that are not written. Returns the
    functions that something waits for."""
    unfinished = unfinished_functions(source, step)
    called = set() if replaced else called_functions(source, unfinished)
    for test in result.tests:
        missing = "" if test.passed else _missing(step, tests[test.name], unfinished, called)
        if missing:
            test.waits_for, test.message = missing, f"It waits for {missing}, not written yet."
            test.expression = test.expanded = test.location = ""
    aside = [(test.waits_for, *tests[test.name]) for test in result.tests if test.waits_for]
    waiting = [name for name in unfinished if any(name in names for names in aside)]
    written = [name for name in unfinished if name not in waiting]
    for item in result.hidden:
        if item.kind == "function" and not item.passed:
            item.waits_for = _missing(step, [item.name], unfinished, called)
    pictures: list[ImageResult | HiddenResult] = [*result.images]
    pictures += [item for item in result.hidden if item.kind == "picture"]
    mark_waiting_pictures(pictures, waiting)
    result.tests.sort(key=lambda test: bool(test.waits_for))
    if waiting:
        result.messages.append(not_written_yet(waiting))
    if waiting and replaced:
        result.messages.append("Your functions after it are tried with the reference's in its place.")
    if written:
        line = "that line" if len(written) == 1 else "these lines"
        result.messages.append(f"RAYSTEPS_TODO is still in: {join_and(written)}. The tests pass: delete {line}.")
    return waiting


def mark_waiting_pictures(pictures: Sequence[ImageResult | HiddenResult], waiting: Sequence[str]) -> None:
    """Those that do not pass say what they wait for, if anything is waited for."""
    for picture in pictures:
        if waiting and not picture.passed:
            picture.waits_for, picture.message = waiting[0], f"It waits for {waiting[0]}, not written yet."
