"""The command `demo`: one picture per step, then two sample submissions graded."""

import argparse
import sys
from pathlib import Path

from rich.console import Console

from raysteps.cli.grade import GradeOptions, grade
from raysteps.common import process
from raysteps.common.errors import GraderFault
from raysteps.common.files import usable_folder
from raysteps.common.text import number, print_plain
from raysteps.course.manifest import Step
from raysteps.course.project import Project, generated
from raysteps.report.terminal import short_path
from raysteps.results.model import Results
from raysteps.toolchain.build_kit import build_kit

_SIZE = "512x512"
_SECONDS = 600


def complain_about(sample: str, results: Results) -> None:
    """A sample whose points are not what the kit promises is the kit's fault."""
    points = sum(step.points for step in results.steps)
    if sample == "complete":
        as_promised = points == sum(step.max for step in results.steps)
    else:
        full = {step.id[:2]: step.points == step.max for step in results.steps}
        as_promised = all(full[solved] for solved in ("01", "02", "03")) and not full["04"]
    if not as_promised:
        raise GraderFault(f"the sample submission {sample} got {number(points)} points, which is not what it is worth")


def _render(program: Path, scene: Path, step: Step, folder: Path) -> Path:
    path = folder / f"{step.id}.png"
    words: list[str | Path] = [program, scene, "--step", str(step.index), "--size", _SIZE, "-o", path, "--quiet"]
    outcome = process.run(words + (["--accel", "boxes"] if step.index < 6 else []), seconds=_SECONDS)
    if outcome.code != 0 or outcome.timed_out:
        raise GraderFault(f"the reference cannot render step {step.id}: {outcome.stderr.strip()}")
    return path


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where it goes."""
    parser.add_argument("--out", type=Path, help="where the pictures go (build/demo)")


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Shows what the kit does, from a fresh clone."""
    folder = (arguments.out or project.build / "demo").resolve()
    usable_folder(folder)
    kit = build_kit(project, lambda text: print(f"raysteps: {text}", file=sys.stderr, flush=True))
    scene = generated(project, "sphereflake", 3)
    console.print("Rendering the sphereflake with what the course has after each step:")
    for step in kit.steps:
        path = _render(kit.reference("raytrace"), scene, step, folder)
        print_plain(console, f"  {short_path(path)}")
    for sample in ("complete", "partial"):
        console.print(f"\nGrading the sample submission [bold]{sample}[/bold].")
        options = GradeOptions(project.samples / sample, folder / sample, details=sample == "partial")
        complain_about(sample, grade(project, options, console))
    return 0
