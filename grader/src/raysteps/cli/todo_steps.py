"""Which of a student's own steps are still to be written, for commands that need them."""

import re
from collections.abc import Sequence
from itertools import pairwise

from raysteps.common.errors import UsageError
from raysteps.common.text import join_and
from raysteps.course.manifest import Step, kit_steps, outside_course, read_steps, steps_words, why_outside
from raysteps.course.project import Project
from raysteps.course.stubs import unfinished_functions

_LAST_PICTURE = 8  # step 09 draws the same
_TREES = {"octree": 6, "bvh": 9}  # as --accel calls them, and the steps that build them


def _left_in(project: Project, step: Step) -> list[str]:
    """Of a file that is not there, all."""
    path = project.steps / step.path
    if not path.is_file():
        return list(step.functions)
    return unfinished_functions(path.read_text(encoding="utf-8", errors="replace"), step)


def unfinished(project: Project, upto: int) -> list[tuple[Step, list[str]]]:
    """Steps up to this one, and their functions that nobody has written yet. Of bonus steps and trees only this one
    counts: pictures can do without. Parts before its own are drawn with, whether the course has them or not."""
    every = kit_steps(project)
    part = next((step.part for step in every if step.index == upto), 1)
    steps = [step for step in every if step.index <= upto and step.part <= part]
    needed = [step for step in steps if step.index == upto or not (step.bonus or step.is_about_a_tree)]
    return [(step, left) for step in needed if (left := _left_in(project, step))]


def last_written(project: Project) -> int:
    """The last step whose picture the student's own steps can draw; 0 while step 01 is not written."""
    last = 0
    for step in kit_steps(project):
        if step.index <= _LAST_PICTURE and not _left_in(project, step):
            last = step.index
        elif not (step.bonus or step.is_about_a_tree):
            break
    return last


def default_step(project: Project) -> int:
    """Of a picture that names none, as raytrace has it."""
    return min(_LAST_PICTURE, read_steps(project)[-1].index)


def last_value(words: Sequence[str], option: str) -> str | None:
    """What stands behind the option; of several the last counts, as in the programs."""
    found = [value for word, value in pairwise(words) if word == option]
    return found[-1] if found else None


def wanted_step(project: Project, words: Sequence[str]) -> int:
    """Of the picture with these words; refuses what is no step."""
    if "--step" not in words:
        return default_step(project)
    word = last_value(words, "--step") or ""
    steps = read_steps(project)
    for other in outside_course(project):
        if word in (other.number, str(other.index)):
            raise UsageError(f"--step: {why_outside(steps, other)}")
    if not re.fullmatch("[0-9]{1,2}", word) or int(word) not in [step.index for step in kit_steps(project)]:
        raise UsageError(f"--step: expected the number of a step, {' or '.join(steps_words(steps))}, found '{word}'")
    return int(word)


def as_far_as_written(project: Project, words: Sequence[str]) -> tuple[list[str], str]:
    """What to add to the words of a picture that names no step, the last one that is written, and what to say of it."""
    more: list[str] = []
    said = ""
    if "--step" not in words:
        last = last_written(project)
        if last == 0:
            return [], ""
        if last < default_step(project):
            said = f"--step {last}, the last that your steps can draw"
            more = ["--step", str(last)]
    return [*more, *without_tree(project, wanted_step(project, [*words, *more]), words)], said


def without_tree(project: Project, step: int, words: Sequence[str]) -> list[str]:
    """What to add to the words of a picture so that it needs no tree that nobody has written yet."""
    trees = [one for one in kit_steps(project) if one.index < step and one.is_about_a_tree]
    missing = step not in _TREES.values() and any(_left_in(project, one) for one in trees)
    return ["--accel", "none"] if missing and "--accel" not in words else []


def built_trees(project: Project) -> list[str]:
    """Those whose steps a students' kit has."""
    return [name for name, index in _TREES.items() if any(project.steps.glob(f"{index:02}-*/step.toml"))]


def refuse_missing_tree(project: Project, words: Sequence[str]) -> None:
    """Where `--accel` names a tree that finds nothing: the course has no such step, or nobody has written it yet. The
    picture of the step itself is drawn as soon as it is begun."""
    accel = last_value(words, "--accel")
    if accel not in _TREES:
        return
    index, other = _TREES[accel], "--accel none draws the same picture"
    step = next((one for one in read_steps(project) if one.index == index), None)
    if step is None:
        raise UsageError(f"--accel {accel}: this course has no step {index:02}, which builds it; {other}")
    left = _left_in(project, step)
    if left and (wanted_step(project, words) != index or len(left) == len(step.functions)):
        raise UsageError(
            f"--accel {accel}: step {step.number} is not written yet: expected {join_and(left)} in "
            f"steps/{step.path.as_posix()}; {other}"
        )


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
        f"what you have, and {_elsewhere(project)} what it should be"
    )
