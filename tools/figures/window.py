"""The picture of the window: what it really shows, on a screen that nobody sees."""

import subprocess
import tempfile
from pathlib import Path

import numpy as np

from raysteps.cli.render import build_program
from raysteps.cli.view import check_glfw
from raysteps.common.errors import GraderFault, UsageError
from raysteps.images.compare import Pixels, read_ppm
from raysteps.images.render import reference_picture
from raysteps.toolchain.cmake import release_tree
from raysteps.toolchain.kit_artifacts import BuiltKit
from tools.xvfb import NoScreen, hidden_screen

_SECONDS = 120
_SIZE = ("--size", "480x360")


class CannotDraw(Exception):
    """Something optional is missing; the message says what to install."""


def _screenshot(program: Path, scene: Path, folder: Path) -> Pixels:
    shown = folder / "shown.ppm"
    words: list[str | Path] = [program, scene, *_SIZE, "--screenshot", shown, "--strip"]
    try:
        with hidden_screen() as environment:
            done = subprocess.run(
                words, cwd=folder, env=environment, capture_output=True, text=True, timeout=_SECONDS, check=False
            )
    except NoScreen as missing:
        raise CannotDraw(str(missing)) from missing
    except subprocess.TimeoutExpired as late:
        raise GraderFault(f"the window did not end by itself within {_SECONDS} s: {program}") from late
    if done.returncode != 0:
        raise GraderFault(f"the window cannot be shown: {done.stderr.strip()}")
    return read_ppm(shown)


def window(kit: BuiltKit) -> Pixels:
    """A scene with its strip, and the work map that the key M shows."""
    scene = kit.project.scenes / "lessons" / "glass.nff"
    tree = release_tree(kit.project)
    try:
        check_glfw(tree)
    except UsageError as missing:
        raise CannotDraw(str(missing)) from missing
    program = build_program(tree, "view", "reference")
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        shown = _screenshot(program, scene, Path(folder))
    costs = reference_picture(kit, scene, (*_SIZE, "--map", "tests"))
    gap = np.full((shown.shape[0], 12, 3), 255, np.uint8)
    return np.concatenate([shown, gap, costs], axis=1)
