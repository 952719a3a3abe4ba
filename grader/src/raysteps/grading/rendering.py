"""Runs one of the raytrace programs."""

import hashlib
import json
import math
import os
import tempfile
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_bytes
from raysteps.common.process import Outcome, run
from raysteps.grading.pictures import PictureError, Pixels, read_ppm
from raysteps.kit.manifest import ImageCase
from raysteps.kit.project import Project

_MAX_STATS = 1 << 16


@dataclass(frozen=True)
class Rendered:
    """A picture, or why there is none."""

    outcome: Outcome
    pixels: Pixels | None
    problem: str = ""
    share_tested: float | None = None


def _share_tested(path: Path) -> float | None:
    """From the statistics of raytrace: how much of the scene each ray was tested against."""
    try:
        with os.fdopen(os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK), "rb") as file:
            share = float(json.loads(file.read(_MAX_STATS))["share_tested"])
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return None
    return share if math.isfinite(share) and share >= 0 else None


def render(project: Project, program: Path, case: ImageCase, seconds: float, memory_mb: int | None = None) -> Rendered:
    """Renders a picture of a step into a folder of its own."""
    with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
        picture = Path(folder) / "picture.ppm"
        scene = project.root / case.scene
        stats = Path(folder) / "stats.json"
        command: list[str | Path] = [program, scene, *case.args, "-o", picture, "--quiet"]
        command += ["--stats", stats] if case.max_share is not None else []
        outcome = run(command, seconds=seconds, cwd=Path(folder), memory_mb=memory_mb)
        if outcome.timed_out or outcome.code != 0:
            return Rendered(outcome, None)
        try:
            return Rendered(outcome, read_ppm(picture), share_tested=_share_tested(stats))
        except PictureError as error:
            return Rendered(outcome, None, str(error))


class ReferencePictures:
    """The reference's pictures, kept by scene, arguments and program."""

    def __init__(self, project: Project, program: Path, folder: Path) -> None:
        self._project = project
        self._program = program
        self._folder = folder
        self._program_hash = hashlib.sha256(program.read_bytes()).digest()

    def get(self, case: ImageCase) -> Pixels:
        """Renders at the first call; a reference that cannot is the kit's fault."""
        scene = self._project.root / case.scene
        if not scene.is_file():
            raise GraderFault(f"the scene {case.scene} is missing")
        key = hashlib.sha256(self._program_hash + scene.read_bytes() + "\0".join(case.args).encode()).hexdigest()
        path = self._folder / f"{key[:32]}.ppm"
        try:
            return read_ppm(path)
        except PictureError:
            rendered = render(self._project, self._program, case, 600)
        if rendered.pixels is None:
            said = rendered.outcome.stderr.strip() or rendered.problem
            raise GraderFault(f"the reference cannot render {case.name} ({case.scene}): {said}")
        height, width, _ = rendered.pixels.shape
        write_bytes(path, f"P6\n{width} {height}\n255\n".encode() + rendered.pixels.tobytes())
        return rendered.pixels
