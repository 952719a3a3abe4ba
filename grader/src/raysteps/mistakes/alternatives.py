"""Other correct ways to write a step: solutions/NN-name/alternatives/*.cpp."""

from dataclasses import dataclass

from raysteps.common.tables import read_text
from raysteps.kit.manifest import Step
from raysteps.kit.project import Project


@dataclass(frozen=True)
class Alternative:
    """A correct file of a step that differs from the reference in method or arithmetic."""

    name: str
    step: str
    source: str


def read_alternatives(project: Project, step: Step) -> tuple[Alternative, ...]:
    """Sorted by name; none in a student's kit, which has no solutions."""
    found = []
    for path in sorted((project.solutions / step.id / "alternatives").glob("*.cpp")):
        found.append(Alternative(path.stem, step.id, read_text(path)))
    return tuple(found)
