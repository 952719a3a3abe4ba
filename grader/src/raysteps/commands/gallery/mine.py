"""The pictures of a student's own steps. What goes wrong in a step is a note, and the others go on."""

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from raysteps.commands.gallery.scenes import Shown
from raysteps.commands.gallery.shots import TREES, Effort, Shot, picture_args
from raysteps.common.text import listed, shorten
from raysteps.grading.build_messages import link_message, why_not_built
from raysteps.grading.step_grader import Work
from raysteps.grading.visible_images import trouble
from raysteps.kit.built_kit import BuiltKit, Say
from raysteps.kit.manifest import Step
from raysteps.kit.stubs import unfinished_functions
from raysteps.programs.limits import StepLimits, limits_of
from raysteps.programs.rendering import Rendered, render
from raysteps.programs.student_build import Program, StudentBuild
from raysteps.sandbox.open_air import OpenAir
from raysteps.submission.intake import Submission, take_in

_SECONDS = 120.0
_LONGEST = 600


class MySteps:
    """A student's steps, each built by itself. After step N the steps up to N are the student's; where one of
    these is not there, the reference stands in, and a note says so."""

    def __init__(self, kit: BuiltKit, submission: Submission, folder: Path, say: Say) -> None:
        self._kit = kit
        self._sandbox = OpenAir()
        self._build = StudentBuild(kit, self._sandbox, folder)
        work = Work(kit, submission, self._sandbox, folder, folder)
        self._limits: dict[str, StepLimits] = {}
        self._binaries: dict[str, Path] = {}
        self._notes: dict[str, str] = {}
        self._programs: dict[str, tuple[Program | None, str]] = {}
        for step in kit.steps:
            say(f"building your step {step.number}")
            self._limits[step.id] = limits_of(step, {"seconds": max(_SECONDS, step.seconds)})
            self._compile(step, work.source(step))

    def _compile(self, step: Step, source: str | None) -> None:
        if source is None:
            self._notes[step.id] = f"Step {step.number} is not started: {step.file} is still the stub."
            return
        compiled = self._build.compile(step, source.encode(), self._limits[step.id])
        if compiled.binary is None:
            self._notes[step.id] = shorten(why_not_built(self._kit, step, compiled, source), _LONGEST)
            return
        self._binaries[step.id] = compiled.binary
        left = unfinished_functions(source, step)
        self._notes[step.id] = f"Unfinished: {listed(left)}." if left else ""

    def _program(self, step: Step) -> tuple[Program | None, str]:
        if step.id not in self._programs:
            up_to = [other for other in self._kit.steps if other.index <= step.index]
            objects = [self._binaries.get(other.id) or self._kit.reference_step(other) for other in up_to]
            program, ran = self._build.program("raytrace", step, objects, self._limits[step.id], together=True)
            self._programs[step.id] = (program, "" if ran is None else shorten(link_message(ran), _LONGEST))
        return self._programs[step.id]

    def _render(self, program: Program, step: Step, scene: Shown, args: tuple[str, ...]) -> Rendered:
        rendered = render(self._sandbox, program, scene.path, args, self._limits[step.id].of_program())
        if rendered.ran.stopped in ("wall", "cpu"):
            self._limits[step.id] = self._limits[step.id].after_a_timeout()
        return rendered

    def _remarks(self, step: Step) -> str:
        missing = [
            other.number for other in self._kit.steps if other.index < step.index and other.id not in self._binaries
        ]
        stand_in = f"The reference stands in for {listed(missing)}." if missing else ""
        return " ".join(filter(None, [self._notes[step.id], stand_in]))

    def shot(self, step: Step, scene: Shown, size: str) -> Shot:
        """After one step."""
        if step.id not in self._binaries:
            return Shot(None, self._notes[step.id])
        program, problem = self._program(step)
        if program is None:
            return Shot(None, problem)
        rendered = self._render(program, step, scene, picture_args(step, size))
        if rendered.pixels is None:
            return Shot(None, trouble(rendered)[1])
        return Shot(rendered.pixels, self._remarks(step))

    def efforts(self, scene: Shown) -> dict[int, Effort]:
        """By step, of those that save work and can be run."""
        found = {}
        for tree in TREES:
            step = next((step for step in self._kit.steps if step.index == tree.step), None)
            if step is None or step.id not in self._binaries:
                continue
            program, _ = self._program(step)
            if program is None:
                continue
            rendered = self._render(program, step, scene, tree.after[1])
            if rendered.pixels is not None and rendered.work is not None:
                found[tree.step] = Effort(f"my {tree.after[0]}", rendered.pixels, rendered.work)
        return found


@contextmanager
def my_steps(kit: BuiltKit, say: Say) -> Iterator[MySteps]:
    """Built into a folder that is deleted in the end."""
    with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
        yield MySteps(kit, take_in(kit.project.steps, kit.steps), Path(folder), say)
