"""Shares of wrong pixels: a source compiled in some setting, rendered, and compared with the reference."""

import hashlib
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from threading import Lock

from raysteps.common.errors import GraderFault
from raysteps.common.text import printable
from raysteps.kit.built_kit import BuiltKit
from raysteps.kit.manifest import Step
from raysteps.programs.limits import StepLimits, limits_of
from raysteps.programs.pictures import compare
from raysteps.programs.rendering import reference_picture, render
from raysteps.programs.student_build import Compiled, Program, StudentBuild
from raysteps.sandbox.open_air import OpenAir
from raysteps.upkeep.calibration.scenes import View
from raysteps.upkeep.calibration.settings import Setting
from raysteps.upkeep.entrants import Entrant

_NO_PICTURE = 1.0


class PictureShares:
    """Renders the same binary once only: many settings give the same one. Used from several threads."""

    def __init__(self, kit: BuiltKit, step: Step, views: Sequence[View]) -> None:
        self._kit = kit
        self._step = step
        self._views = views
        self._known: dict[str, tuple[float, ...]] = {}
        self._lock = Lock()
        self._reference = [reference_picture(kit, view.scene, view.args) for view in views]

    @property
    def pixels(self) -> list[int]:
        """How many each picture has."""
        return [picture.shape[0] * picture.shape[1] for picture in self._reference]

    @property
    def binaries(self) -> int:
        """How many different ones were rendered."""
        return len(self._known)

    def shares(self, candidate: Entrant, setting: Setting) -> tuple[float, ...]:
        """One for each view; a program that makes no picture has every pixel wrong."""
        limits = limits_of(self._step, {})
        with tempfile.TemporaryDirectory(prefix="raysteps-") as name:
            build = StudentBuild(setting.applied(self._kit), OpenAir(), Path(name))
            compiled = build.compile(self._step, candidate.source.encode(), limits)
            if compiled.binary is None:
                raise GraderFault(f"{self._step.id}: {candidate.name}, {setting.name}: {_said(compiled)}")
            key = hashlib.sha256(compiled.binary.read_bytes()).hexdigest()
            with self._lock:
                known = self._known.get(key)
            if known is None:
                known = self._render(build, compiled.binary, limits)
                with self._lock:
                    self._known[key] = known
        return known

    def _render(self, build: StudentBuild, binary: Path, limits: StepLimits) -> tuple[float, ...]:
        program, ran = build.program("raytrace", self._step, [binary], limits)
        if program is None:
            raise GraderFault(f"{self._step.id} does not link: {printable(ran.outcome.stderr) if ran else ''}")
        shares: list[float] = []
        hung = False  # such a program is not asked for more
        for place in range(len(self._views)):
            share, hung = (_NO_PICTURE, True) if hung else self._share(program, place, limits)
            shares.append(share)
        return tuple(shares)

    def _share(self, program: Program, place: int, limits: StepLimits) -> tuple[float, bool]:
        view = self._views[place]
        rendered = render(OpenAir(), program, view.scene, view.args, limits.of_program())
        if rendered.pixels is None:
            return _NO_PICTURE, rendered.ran.outcome.timed_out
        return compare(rendered.pixels, self._reference[place], 0.0).wrong_share, False


def _said(compiled: Compiled) -> str:
    if compiled.forbidden or compiled.missing or compiled.undefined:
        return f"names that do not fit: {', '.join(compiled.forbidden + compiled.missing + compiled.undefined)}"
    return "does not compile:\n" + printable(compiled.ran.outcome.stderr)[:2000]


def patient(step: Step) -> Step:
    """Without optimisation, and beside other work, a picture takes longer."""
    return replace(step, seconds=6 * step.seconds)
