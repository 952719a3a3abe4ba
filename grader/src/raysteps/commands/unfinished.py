"""Which of a student's own steps are still to be written, for commands that need them."""

from raysteps.kit.manifest import Step, read_steps
from raysteps.kit.project import Project
from raysteps.kit.stubs import unfinished_functions


def unfinished(project: Project, upto: int) -> list[tuple[Step, list[str]]]:
    """Steps up to this one, and their functions that nobody has written yet. Of bonus steps only this one counts."""
    left = []
    for step in read_steps(project):
        path = project.steps / step.path
        if step.index <= upto and step.bonus <= (upto == step.index) and path.is_file():
            functions = unfinished_functions(path.read_text(encoding="utf-8", errors="replace"), step)
            left += [(step, functions)] if functions else []
    return left


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
