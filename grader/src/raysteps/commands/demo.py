"""The command `demo`: one picture per step, then two sample submissions graded."""

from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.commands.check_and_grade import grade
from raysteps.commands.render import build_program
from raysteps.common.errors import GraderFault
from raysteps.common.files import usable_folder
from raysteps.common.text import number
from raysteps.grading.pictures import write_png
from raysteps.grading.rendering import render
from raysteps.grading.results import Results
from raysteps.kit.building import release_tree
from raysteps.kit.manifest import ImageCase, read_steps
from raysteps.kit.project import Project
from raysteps.kit.scenes import generated

_SIZE = "512x512"
_SECONDS = 600


def complain_about(sample: str, results: Results) -> None:
    """A sample whose points are not what the kit promises is the kit's fault."""
    points = sum(step.points for step in results.steps)
    if sample == "complete":
        as_promised = points == 110
    else:
        full = {step.id[:2]: step.points == step.max for step in results.steps}
        as_promised = all(full[solved] for solved in ("01", "02", "03")) and not full["04"]
    if not as_promised:
        raise GraderFault(f"the sample submission {sample} got {number(points)} points, which is not what it is worth")


def demo(project: Project, out: Path | None, console: Console) -> int:
    """Shows what the kit does, from a fresh clone."""
    folder = (out or project.build / "demo").resolve()
    usable_folder(folder)
    program = build_program(release_tree(project), "reference")
    scene = generated(project, "sphereflake", 3)
    steps = read_steps(project)
    console.print("Rendering the sphereflake with what the course has after each step:")
    for step in steps:
        args: tuple[str, ...] = ("--step", str(step.index), "--size", _SIZE)
        if step.index < 6:
            args += ("--accel", "boxes")
        rendered = render(project, program, ImageCase(step.id, str(scene), args, 0.0), _SECONDS)
        if rendered.pixels is None:
            raise GraderFault(f"the reference cannot render step {step.id}: {rendered.outcome.stderr.strip()}")
        path = folder / f"{step.id}.png"
        write_png(rendered.pixels, path)
        console.print(f"  {escape(str(path))}", soft_wrap=True, highlight=False)
    for sample in ("complete", "partial"):
        console.print(f"\nGrading the sample submission [bold]{sample}[/bold].")
        results = grade(project, project.samples / sample, folder / sample, console, details=sample == "partial")
        complain_about(sample, results)
    return 0
