"""The pixel that is most wrong, and the command that looks into it."""

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from raysteps.commands.watch.view import View
from raysteps.kit.project import Project
from raysteps.programs.pictures import gaps, read_png, widest
from raysteps.reports.commands import inspect_words


def worst_pixel(mine: Path, reference: Path) -> tuple[int, int] | None:
    """The column and the row; none where the pictures cannot be compared or are the same."""
    try:
        one, other = read_png(mine), read_png(reference)
    except OSError:
        return None
    if one.shape != other.shape:
        return None
    gap = gaps(one, other)
    return widest(gap) if gap.any() else None


def command_of_worst(view: View) -> list[str] | None:
    """Of the first picture that is wrong."""
    if view.result is None or view.out is None:
        return None
    cases = {case.name: case for case in view.step.images}
    for image in view.result["images"]:
        if image["passed"] or not image["mine"] or not image["reference"] or image["name"] not in cases:
            continue
        worst = worst_pixel(view.out / image["mine"], view.out / image["reference"])
        if worst is not None:
            return inspect_words(cases[image["name"]], *worst)
    return None


def run_inspect(project: Project, words: Sequence[str]) -> None:
    """On this terminal; Ctrl-C ends it and nothing else."""
    try:
        subprocess.run([sys.executable, "-P", "-m", "raysteps", *words], cwd=project.root, check=False)
    except KeyboardInterrupt:
        print()
