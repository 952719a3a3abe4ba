"""Which of a student's own steps are still to be written, for commands that need them."""

import re
from collections.abc import Sequence

from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step, read_steps
from raysteps.course.project import Project
from raysteps.course.stubs import unfinished_functions

_LAST_PICTURE = 8  # step 09 draws the same


def _left_in(project: Project, step: Step) -> list[str]:
    path = project.steps / step.path
    return unfinished_functions(path.read_text(encoding="utf-8", errors="replace"), step) if path.is_file() else []


def unfinished(project: Project, upto: int) -> list[tuple[Step, list[str]]]:
    """Steps up to this one, and their functions that nobody has written yet. Of bonus steps and trees only this one
    counts: pictures can do without."""
    steps = [step for step in read_steps(project) if step.index <= upto]
    needed = [step for step in steps if step.index == upto or not (step.bonus or step.is_about_a_tree)]
    return [(step, left) for step in needed if (left := _left_in(project, step))]


def last_written(project: Project) -> int:
    """The last step whose picture the student's own steps can draw; 0 while step 01 is not written."""
    last = 0
    for step in read_steps(project):
        if step.index <= _LAST_PICTURE and not _left_in(project, step):
            last = step.index
        elif not (step.bonus or step.is_about_a_tree):
            break
    return last


def usual_step(project: Project) -> int:
    """Of a picture that names none, as raytrace has it."""
    return min(_LAST_PICTURE, read_steps(project)[-1].index)


def wanted_step(project: Project, words: Sequence[str]) -> int:
    """Of the picture with these words; refuses what is no step."""
    if "--step" not in words:
        return usual_step(project)
    word = next(iter(words[words.index("--step") + 1 :]), "")
    last = read_steps(project)[-1].index
    if not re.fullmatch("[0-9]{1,2}", word) or not 1 <= int(word) <= last:
        raise UsageError(f"--step: expected a whole number from 1 to {last}, found '{word}'")
    return int(word)


def as_far_as_written(project: Project, words: Sequence[str]) -> tuple[list[str], str]:
    """What to add to the words of a picture that names no step, the last one that is written, and what to say of it."""
    more: list[str] = []
    said = ""
    if "--step" not in words:
        last = last_written(project)
        if last == 0:
            return [], ""
        if last < usual_step(project):
            said = f"--step {last}, the last that your steps can draw"
            more = ["--step", str(last)]
    return [*more, *without_tree(project, wanted_step(project, [*words, *more]), words)], said


def without_tree(project: Project, step: int, words: Sequence[str]) -> list[str]:
    """What to add to the words of a picture so that it needs no tree that nobody has written yet."""
    steps = [one for one in read_steps(project) if one.index < step and one.is_about_a_tree]
    missing = step <= _LAST_PICTURE and any(_left_in(project, one) for one in steps)
    return ["--accel", "none"] if missing and "--accel" not in words else []


def _elsewhere(project: Project) -> str:
    return "the right picture with --impl reference" if project.has_reference else "the right pictures in reference/"


def advice(project: Project, upto: int) -> str:
    """What to say of a picture of that step; empty when all that it needs is written."""
    left = unfinished(project, upto)
    if not left:
        return ""
    first = left[0][0].index
    if first == 1:
        return f"your steps are not started; see {_elsewhere(project)}"
    return (
        f"this picture of step {upto:02} is not complete, as your steps reach {first - 1:02}; --step {first - 1} shows "
        f"what you have, and what it should be is {_elsewhere(project)}"
    )
