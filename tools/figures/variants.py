"""A step from another source: a constant of the reference is read at the start, and one program draws a whole curve."""

import json
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault
from raysteps.common.text import shorten
from raysteps.course.manifest import Step
from raysteps.course.mutants import reference_source, replaced_once
from raysteps.images.compare import Pixels, parse_ppm
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Input, Output, Task, Word
from raysteps.toolchain.compile import Program, StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.toolchain.limits import limits_of

# Read once, from what the program gets on its standard input; the kit's programs never read it otherwise.
_READER = """
#include <cstdio>

namespace {

float knob(int number) {
    static float values[2] = {0.0F, 0.0F};
    [[maybe_unused]] static const int read = std::scanf("%f %f", &values[0], &values[1]);
    return values[number];
}

}  // namespace
"""


@dataclass(frozen=True)
class RenderedVariant:
    """A picture and the counters that stand beside it."""

    pixels: Pixels
    stats: dict[str, Any]


def with_knobs(kit: BuiltKit, step: Step, changes: Mapping[str, str]) -> str:
    """The reference's source, with knob(0) and knob(1) in place of constants."""
    source = reference_source(kit.project, step)
    for old, new in changes.items():
        source = replaced_once(source, old, new, f"figures: '{old}' in solutions/{step.path.as_posix()}")
    return _READER + source


class Variant:
    """One step from another source, compiled as a student's step is, and linked with the kit."""

    def __init__(self, kit: BuiltKit, step: Step, source: str) -> None:
        self._kit, self._air = kit, LimitsOnly()
        self._limits = limits_of(step, {})
        self._folder = tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True)
        build = StudentBuild(kit.in_one_process(), self._air, Path(self._folder.name))
        compiled = build.compile(step, source.encode(), self._limits)
        if compiled.binary is None:
            raise GraderFault(f"figures: {step.id} does not build: {shorten(compiled.ran.outcome.stderr, 1000)}")
        program, _ = build.program("raytrace", step, {step.number: compiled.binary}, self._limits)
        if program is None:
            raise GraderFault(f"figures: {step.id} cannot be linked")
        self._program: Program = program

    def draw(self, scene: str, args: Sequence[str], knobs: Sequence[float] = ()) -> RenderedVariant:
        """One picture; `knobs` are the two numbers that the source asks for with knob(0) and knob(1)."""
        words: list[Word] = [*self._program.words, Input(self._kit.project.root / scene, "scene.nff"), *args, "--quiet"]
        words += ["-o", Output("picture"), "--stats", Output("stats")]
        told = " ".join(str(value) for value in [*knobs, 0, 0][:2]).encode()
        ran = self._air.run(Task(tuple(words), self._limits.of_program(), stdin=told))
        if ran.outcome.code != 0 or "picture" not in ran.outputs:
            raise GraderFault(f"figures: {scene} cannot be rendered: {shorten(ran.outcome.stderr, 1000)}")
        return RenderedVariant(parse_ppm(ran.outputs["picture"]), json.loads(ran.outputs["stats"]))
