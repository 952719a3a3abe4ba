"""The command `replay`: one hidden case, asked again."""

import argparse
import json
import os
import re
import tempfile
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import GraderFault, StudentBuildError, UsageError
from raysteps.common.platform import own_command
from raysteps.common.text import printable, shorten
from raysteps.course.manifest import Step, read_steps
from raysteps.course.project import Project
from raysteps.grading.build_messages import link_message, why_not_built
from raysteps.judge.counterexamples import LONGEST, CaseFile, read_case
from raysteps.judge.decode_case import decode_inputs
from raysteps.judge.functions import Case, Function, functions_of
from raysteps.judge.protocol import ProtocolError
from raysteps.judge.worker import (
    Ask,
    JudgedCase,
    TimeBudget,
    ask_student,
    ask_worker,
    judge_reply,
    uncached_reference_answers,
)
from raysteps.report.terminal import progress
from raysteps.report.wording import check_command
from raysteps.sandbox.detect import find_sandbox
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Sandbox
from raysteps.submission.load import load_submission
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.compile import StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit


def _find(project: Project, path: Path) -> Path:
    """As it was typed, or below the results of `check`, which prints the short form."""
    below = project.build / "check" / path
    return below if not path.exists() and below.is_file() else path


_MAX_BYTES = 64 << 20  # of a results.json


def _inside(parts: list[Any], name: str) -> list[Any]:
    """What the lists of that name hold; anything may stand in a file."""
    lists = [part.get(name) for part in parts if isinstance(part, dict)]
    return [one for found in lists if isinstance(found, list) for one in found]


def _refuse_what_is_gone(path: Path) -> None:
    """Each check writes its cases anew, and clears those that are right now."""
    if not os.path.lexists(path):
        found = re.match(r"[0-9]{2}(?=-)", path.name)
        again = check_command(found[0]) if found else f"{own_command()} check"
        raise UsageError(
            f"{path}: is not there: a check clears the cases of the one before, and writes those that are wrong now. "
            f"Type `{again}`, and then the command that it names, if there is one"
        )


def _refuse_what_is_no_case(path: Path) -> None:
    """Another document of the kit, above all the results.json beside the cases, or none of it."""
    try:
        with path.open("rb") as file:
            document = json.loads(file.read(_MAX_BYTES))
    except (OSError, ValueError, RecursionError):
        return  # what read_case said is right
    schema = str(document.get("schema")) if isinstance(document, dict) else ""
    if schema.startswith("raysteps/case/"):
        return
    if not schema.startswith("raysteps/results/"):
        found = (
            f"it is JSON of another kind ({printable(shorten(schema, 60))})"
            if schema.startswith("raysteps/")
            else "it is other JSON"
        )
        raise UsageError(f"{path}: {found}; expected the file of one hidden case, such as cases/02-closest-hit.json")
    items = _inside(_inside([document], "steps"), "hidden")
    cases = [str(item["case"]) for item in items if isinstance(item, dict) and item.get("case")]
    named = "".join(f"\n  {path.parent / case}" for case in cases)
    raise UsageError(
        f"{path}: this is a results.json; replay wants the file of one hidden case. "
        + (f"It names:{printable(named)}" if cases else "It names none: all were right, or none were asked")
    )


def _read(project: Project, path: Path) -> tuple[CaseFile, Step, Case]:
    try:
        file = read_case(path)
    except UsageError:
        _refuse_what_is_gone(path)
        _refuse_what_is_no_case(path)
        raise
    steps = read_steps(project)
    step = next((step for step in steps if step.id == file.step), None)
    if step is None:
        raise UsageError(f"{path}: step: expected one of {', '.join(step.id for step in steps)}, found '{file.step}'")
    if file.function not in step.functions:
        raise UsageError(f"{path}: function: expected one of {', '.join(step.functions)}, found '{file.function}'")
    try:
        return file, step, Case(file.function, file.kind, decode_inputs(_function(step, file), file.line))
    except ProtocolError as error:
        raise UsageError(f"{path}: line: {error}") from error


def _function(step: Step, file: CaseFile) -> Function:
    return functions_of(step.number)[file.function]


def _student(kit: BuiltKit, step: Step, source: bytes, sandbox: Sandbox, folder: Path) -> Ask:
    """Builds the step between steps of the reference."""
    build, limits = StudentBuild(kit, sandbox, folder), kit.limits_of(step)
    compiled = build.compile(step, source, limits)
    if compiled.binary is None:
        raise StudentBuildError(why_not_built(kit, step, compiled, source.decode("utf-8", "replace")))
    program, ran = build.program("worker", step, {step.number: compiled.binary}, limits)
    if program is None:
        raise StudentBuildError(link_message(ran) if ran is not None else "It does not build.")
    return ask_student(sandbox, program, limits)


def _ask(kit: BuiltKit, step: Step, path: Path, case: Case, student: Ask) -> JudgedCase:
    """The reference is asked as well: a case may have been written by hand."""
    reply = ask_worker(student, [case], TimeBudget(step.seconds, 1)).replies[0]
    expected = ask_worker(lambda cases, _: uncached_reference_answers(kit, cases), [case], TimeBudget(60, 1)).replies[0]
    try:
        return judge_reply(functions_of(step.number)[case.function], case, expected.line, reply)
    except GraderFault as error:
        raise UsageError(f"{path}: line: the reference has no right answer to it: {error}") from error


def _print(console: Console, file: CaseFile, judged: JudgedCase) -> int:
    verdict = judged.verdict
    console.print(f"[bold]{escape(file.step)}[/bold] {escape(file.function)}, a case of '{escape(file.kind)}'")
    words = (("given", judged.case.given()), ("expected", verdict.expected), ("got", verdict.actual))
    for label, text in words:
        console.print(f"  {label:<9} {escape(shorten(text, LONGEST))}", highlight=False)
    if not verdict.problem:
        console.print("[green]now right[/green], asked by itself")
        console.print(
            "Is your code as it was? Then it answers otherwise after other questions: does the function keep something "
            "from one call to the next, as in a `static` variable?",
            style="dim",
        )
        return 0
    before = f" (before: {file.problem})" if file.problem and file.problem != verdict.problem else ""
    console.print(f"[red]still wrong[/red]: {escape(verdict.problem + before)}")
    return 1


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which case, and whose steps."""
    parser.add_argument("case", metavar="CASE", type=Path, help="a file that a report names, in cases/")
    parser.add_argument("--submission", type=Path, metavar="PATH", help="whose steps: a folder, zip or tar (your own)")


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Asks the case again, of one's own steps or of a submission."""
    return replay(project, arguments.case, arguments.submission, console)


def replay(project: Project, path: Path, submission: Path | None, console: Console) -> int:
    """One's own steps run in the open, as for `check`; a submission in the sandbox, as for `grade`."""
    path = _find(project, path)
    file, step, case = _read(project, path)
    sandbox = LimitsOnly() if submission is None else find_sandbox()
    taken = load_submission(submission or project.steps, read_steps(project))
    if step.id not in taken.sources:
        raise UsageError(taken.notes.get(step.id) or f"{submission or project.steps}: {step.file} is not there")
    with console.status("starting") as status, tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        kit = build_kit(project, progress(console, status))
        if submission is None:
            kit = kit.in_one_process()
        status.update(f"building step {step.number}")
        student = _student(kit, step, taken.sources[step.id], sandbox, Path(folder))
        judged = _ask(kit, step, path, case, student)
    return _print(console, file, judged)
