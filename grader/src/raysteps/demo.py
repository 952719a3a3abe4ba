"""The command `demo`: one picture per step, then two sample submissions graded."""

from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.building import release_tree
from raysteps.errors import GraderFault
from raysteps.manifest import ImageCase, read_steps
from raysteps.pictures import write_png
from raysteps.project import Project
from raysteps.render_command import build_program
from raysteps.rendering import render
from raysteps.scenes import generated
from raysteps.submissions import grade

_SIZE = "512x512"
_SECONDS = 600


def demo(project: Project, out: Path | None, console: Console) -> int:
    """Shows what the kit does, from a fresh clone."""
    folder = (out or project.build / "demo").resolve()
    console.print("Building the reference ray tracer (about a minute the first time).")
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
        grade(project, project.samples / sample, folder / sample, console, details=sample == "partial")
    return 0
