"""Pictures: the reference's, which are kept, and a student's, made in the sandbox."""

import contextlib
import hashlib
import json
import math
import tempfile
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_bytes
from raysteps.common.process import run
from raysteps.kit.built_kit import BuiltKit
from raysteps.programs.given_pictures import given_picture, given_work
from raysteps.programs.pictures import PictureError, Pixels, parse_ppm, read_ppm
from raysteps.programs.student_build import Program
from raysteps.results.work import Work, read_work
from raysteps.sandbox.task import Input, Limits, Output, Ran, Sandbox, Task, Word

_REFERENCE_SECONDS = 600


@dataclass(frozen=True)
class Rendered:
    """A picture, or why there is none."""

    ran: Ran
    pixels: Pixels | None
    problem: str = ""
    share_tested: float | None = None
    work: Work | None = None


def _share_tested(stats: bytes) -> float | None:
    """From the statistics of raytrace: how much of the scene each ray was tested against."""
    try:
        share = float(json.loads(stats)["share_tested"])
    except (ValueError, KeyError, TypeError, RecursionError):
        return None
    return share if math.isfinite(share) and share >= 0 else None


def render(sandbox: Sandbox, program: Program, scene: Path, args: tuple[str, ...], limits: Limits) -> Rendered:
    """One picture by a student's program, which learns neither where it is nor what for."""
    command: tuple[Word, ...] = (*program.words, Input(scene, "scene.nff"), *args, "--quiet")
    command += ("-o", Output("picture"), "--stats", Output("stats"))
    ran = sandbox.run(Task(command, limits))
    if ran.outcome.timed_out or ran.stopped or ran.outcome.code != 0:
        return Rendered(ran, None)
    try:
        pixels = parse_ppm(ran.outputs.get("picture", b""))
    except PictureError as error:
        return Rendered(ran, None, str(error))
    stats = ran.outputs.get("stats", b"")
    return Rendered(ran, pixels, share_tested=_share_tested(stats), work=read_work(stats))


def _kept(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> Path:
    """Where the reference's picture of a scene is kept; its statistics lie beside it."""
    if not scene.is_file():
        raise GraderFault(f"the scene {scene} is missing")
    key = hashlib.sha256(scene.read_bytes() + "\0".join(args).encode()).hexdigest()
    return kit.pictures / f"{key[:32]}.ppm"


def _stats_beside(picture: Path) -> Path:
    return picture.with_suffix(".json")


def reference_picture(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> Pixels:
    """Rendered at the first call; a reference that cannot is the kit's fault. A students' kit has it ready."""
    if not kit.has_reference:
        return given_picture(kit, scene, args)
    path = _kept(kit, scene, args)
    if _stats_beside(path).is_file():
        with contextlib.suppress(PictureError):
            return read_ppm(path)
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        picture, stats = Path(folder) / "picture.ppm", Path(folder) / "stats.json"
        command: list[str | Path] = [kit.reference("raytrace"), scene, *args, "-o", picture, "--quiet"]
        command += ["--stats", stats]
        outcome = run(command, seconds=_REFERENCE_SECONDS, cwd=Path(folder))
        try:
            pixels, told = read_ppm(picture), stats.read_bytes()
        except (PictureError, OSError) as error:
            said = outcome.stderr.strip() or str(error)
            raise GraderFault(f"the reference cannot render {scene.name}: {said}") from error
        write_bytes(_stats_beside(path), told)
        write_bytes(path, picture.read_bytes())
    return pixels


def reference_work(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> Work:
    """What the same picture costs the reference."""
    if not kit.has_reference:
        return given_work(kit, scene, args)
    reference_picture(kit, scene, args)
    path = _stats_beside(_kept(kit, scene, args))
    work = read_work(path.read_bytes())
    if work is None:
        raise GraderFault(f"{path}: expected what `raytrace --stats` writes; delete the folder {kit.pictures}")
    return work
