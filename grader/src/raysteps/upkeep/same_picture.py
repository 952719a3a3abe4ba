"""Whether the accelerations give the same picture, byte for byte."""

import tempfile
from pathlib import Path

from raysteps.common.process import Outcome, run
from raysteps.kit.project import Project

ACCELERATIONS = ("none", "boxes", "octree", "bvh")  # that every raytrace has
_SIZE = "96x96"
_SECONDS = 300


def render_with(
    program: Path, scene: Path, accel: str, picture: Path, *options: str | Path, size: str, seconds: float
) -> Outcome:
    """Renders the scene with one of the accelerations."""
    words: list[str | Path] = [program, scene, "-o", picture, "--accel", accel, "--size", size, "--quiet", *options]
    return run(words, seconds=seconds)


def accelerations_of(program: Path) -> list[str]:
    """All that this program has: those that every raytrace has come first."""
    names = run([program, "--list-accel"], seconds=_SECONDS).stdout.split()
    return [*ACCELERATIONS, *(name for name in names if name not in ACCELERATIONS)]


def _bytes(program: Path, scene: Path, accel: str, folder: Path) -> tuple[bytes, str]:
    picture = folder / f"{accel}.ppm"
    outcome = render_with(program, scene, accel, picture, size=_SIZE, seconds=_SECONDS)
    if outcome.code != 0 or outcome.timed_out:
        return b"", outcome.stderr.strip() or "it did not end"
    return picture.read_bytes(), ""


def scenes_that_differ(project: Project, program: Path) -> list[str]:
    """One line for each scene whose pictures differ or that cannot be rendered."""
    scenes = sorted(project.scenes.rglob("*.nff"))
    if not scenes:
        return ["scenes/ holds no scene"]
    accelerations = accelerations_of(program)
    lines = []
    for scene in scenes:
        name = scene.relative_to(project.root).as_posix()
        with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
            first = b""
            for accel in accelerations:
                picture, problem = _bytes(program, scene, accel, Path(folder))
                first = first or picture
                if problem or picture != first:
                    lines.append(f"{name}: --accel {accel}: {problem or 'another picture than --accel none'}")
    return lines
