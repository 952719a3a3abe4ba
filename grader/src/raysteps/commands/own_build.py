"""What a student is told when a program that is made of the own steps does not build."""

import re

from raysteps.common.process import Outcome
from raysteps.common.text import printable
from raysteps.grading.build_messages import (
    compile_message,
    errors_in,
    is_of_a_linker,
    link_message,
    missing_message,
    missing_name,
    undefined_message,
)
from raysteps.kit.building import what_failed
from raysteps.kit.manifest import Step, read_steps
from raysteps.kit.project import Project
from raysteps.sandbox.task import Ran

_FAILED = re.compile(r"^FAILED: .*$", re.MULTILINE)
_USUAL = "It does not build: "


def _failed_step(steps: list[Step], said: str) -> Step | None:
    """The first whose own file has an error, else the one at which the build stopped: its error is in a header. Where
    a file of the kit fails as well, it is the kit's."""
    with_errors = [step for step in steps if errors_in(said, step.file)]
    failed = [line.replace("\\", "/") for line in _FAILED.findall(said)]
    stopped = [next((step for step in steps if step.path.as_posix() in line), None) for line in failed]
    return next(iter(with_errors or ([] if None in stopped else stopped)), None)


def _not_linked(steps: list[Step], said: str, ran: Ran) -> str:
    """Something that a header asks for, or a helper that was declared and forgotten."""
    missing = missing_name(said)
    if missing is None:
        return f"your steps do not build: {link_message(ran).removeprefix(_USUAL)}"
    name, line = missing
    bare = name.partition("(")[0].rpartition("::")[2].strip()
    owner = next((step for step in steps if bare in step.functions), None)
    step = owner or next((step for step in steps if step.file in line), None)
    why = (missing_message if owner else undefined_message)((name,)).removeprefix(_USUAL)
    return f"{f'step {step.number} does not build' if step else 'your steps do not build'}: {why}"


def why_own_steps_do_not_build(project: Project, outcome: Outcome) -> str:
    """The first error in a file of the student's with the lines around it, as `check` shows it."""
    if outcome.timed_out:
        return f"your steps do not build: it was stopped after {outcome.seconds:.0f} s"
    said = printable(outcome.stdout + outcome.stderr)
    ran = Ran(Outcome(outcome.code, outcome.timed_out, "", said, outcome.seconds), {}, outcome.seconds, "")
    steps = read_steps(project)
    step = _failed_step(steps, said)
    if step is not None:
        source = (project.steps / step.path).read_text(encoding="utf-8", errors="replace")
        return f"step {step.number} does not build: {compile_message(step, source, ran).removeprefix(_USUAL)}"
    if is_of_a_linker(said):
        return _not_linked(steps, said, ran)
    return f"your steps do not build:\n{what_failed(outcome)}"
