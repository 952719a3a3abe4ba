"""One step between the student's own steps: a students' kit has no reference to put around it."""

from pathlib import Path

from raysteps.grading.scoring import status_and_points
from raysteps.grading.step_grader import StepGrader, Work
from raysteps.kit.built_kit import Kind
from raysteps.kit.manifest import Step
from raysteps.programs.student_build import Compiled, Program
from raysteps.results.model import Cumulative, StepResult


def own_steps(work: Work, step: Step, compiled: dict[str, Compiled]) -> list[Path]:
    """Those before this one. Where one does not build or was not started its stub stands in."""
    found = []
    for other in work.kit.steps:
        if other.index < step.index:
            own = compiled.get(other.id)
            binary = own.binary if own is not None else None
            found.append(binary or work.kit.reference_step(other))
    return found


class OwnGrader(StepGrader):
    """What a student can be told at home."""

    def _program(self, kind: Kind, binary: Path) -> Program | None:
        return self._linked(kind, [*own_steps(self._work, self.step, self._compiled), binary], together=True)

    def check(self) -> StepResult:
        """The visible part, with its points. The pictures are made with the student's own steps already."""
        result = self.grade()
        if self._ran:
            result.cumulative = Cumulative(all(image.passed for image in result.images[:1]))
            result.status, result.points = status_and_points(result, self.step)
        return result
