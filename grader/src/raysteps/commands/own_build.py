"""What a student is told when a program that is made of the own steps does not build."""

import re

from raysteps.common.process import Outcome
from raysteps.common.text import printable
from raysteps.grading.build_messages import compile_message, errors_in, is_of_a_linker, link_message
from raysteps.kit.building import what_failed
from raysteps.kit.manifest import Step, read_steps
from raysteps.kit.project import Project
from raysteps.sandbox.task import Ran

_FAILED = re.compile(r"^FAILED: .*$", re.MULTILINE)
_USUAL = "It does not build: "


def _failed_step(steps: list[Step], said: str) -> Step | None:
    """The first whose own file has an error, else the one at which the build stopped: its error is in a header."""
    with_errors = (step for step in steps if errors_in(said, step.file))
    stopped = "\n".join(_FAILED.findall(said)).replace("\\", "/")
    return next(with_errors, None) or next((step for step in steps if step.path.as_posix() in stopped), None)


def why_own_steps_do_not_build(project: Project, outcome: Outcome) -> str:
    """The first error in a file of the student's with the lines around it, as `check` shows it."""
    said = printable(outcome.stdout + outcome.stderr)
    ran = Ran(Outcome(outcome.code, outcome.timed_out, "", said, outcome.seconds), {}, outcome.seconds, "")
    step = _failed_step(read_steps(project), said)
    if step is not None:
        source = (project.steps / step.path).read_text(encoding="utf-8", errors="replace")
        return f"step {step.number} does not build: {compile_message(step, source, ran).removeprefix(_USUAL)}"
    if is_of_a_linker(said):
        return f"your steps do not build: {link_message(ran).removeprefix(_USUAL)}"
    return f"your steps do not build:\n{what_failed(outcome)}"
