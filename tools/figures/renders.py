"""Pictures: before and after each step, all steps on one sheet, the one at the top of the README, and the window."""

import io
import os
import random
import shutil
import socket
import struct
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from raysteps.cli.render import build_program
from raysteps.cli.view import check_glfw
from raysteps.common.errors import GraderFault, UsageError, reason
from raysteps.common.files import write_bytes
from raysteps.course.mutants import reference_source, replaced_once
from raysteps.course.project import generated
from raysteps.course.stubs import stub_for
from raysteps.images.compare import Pixels, channel_differences, read_png, read_ppm
from raysteps.images.render import reference_picture
from raysteps.toolchain.cmake import release_tree
from raysteps.toolchain.kit_artifacts import BuiltKit
from tools.figures.measuring import Variant

_MAX_APART = 2.0  # of 255, on average: another compiler moves a few pixels
_SMALL = ("--size", "240x180")
_SQUARE = ("--size", "240x240")
_TILE, _GAP, _LETTERS = 236, 6, 18
_PAPER, _INK = (26, 27, 30), (235, 235, 235)


@dataclass(frozen=True)
class Shot:
    """A scene, as raytrace is asked for it."""

    scene: str
    args: tuple[str, ...]
    size: tuple[str, str] = _SMALL

    @property
    def file(self) -> str:
        """NFF, unless it says otherwise."""
        return self.scene if "." in self.scene else f"{self.scene}.nff"

    def pixels(self, kit: BuiltKit) -> Pixels:
        return reference_picture(kit, kit.project.scenes / self.file, (*self.args, *self.size))


def _lesson(name: str, *args: str) -> Shot:
    return Shot(f"lessons/{name}", args)


SHOTS = {
    "01-after": _lesson("three-spheres", "--step", "1"),
    "02-color": _lesson("three-spheres", "--step", "2"),
    "02-after": _lesson("three-spheres", "--step", "2", "--view", "normals"),
    "03-after": _lesson("three-spheres", "--step", "3"),
    "04-after": _lesson("three-spheres", "--step", "4"),
    "05-after": _lesson("three-spheres", "--step", "5"),
    "05-mirrors-1": _lesson("facing-mirrors", "--step", "5", "--depth", "1"),
    "05-mirrors-2": _lesson("facing-mirrors", "--step", "5", "--depth", "2"),
    "05-mirrors-8": _lesson("facing-mirrors", "--step", "5", "--depth", "8"),
    "06-after": _lesson("many-spheres", "--step", "6", "--accel", "octree"),
    "07-before": _lesson("overexposed", "--step", "5"),
    "07-after": _lesson("overexposed", "--step", "7"),
    "08-before": _lesson("glass", "--step", "7"),
    "08-after": _lesson("glass", "--step", "8"),
    "10-before": _lesson("three-spheres", "--step", "9"),
    "10-after": _lesson("three-spheres", "--step", "10", "--samples", "16", "--filter", "mitchell"),
    "11-before": Shot("generated/vase.pbrt", ("--step", "10")),
    "11-after": Shot("generated/vase.pbrt", ("--step", "11")),
    "12-after": Shot("lessons/soft-shadows.pbrt", ("--step", "12", "--samples", "256")),
    "12-focus": Shot("lessons/lens.pbrt", ("--step", "12", "--samples", "256")),
    "13-before": Shot("lessons/cornell.pbrt", ("--step", "12", "--samples", "64"), _SQUARE),
    "13-after": Shot("lessons/cornell.pbrt", ("--step", "13", "--samples", "256"), _SQUARE),
    "14-before": Shot("lessons/metals.pbrt", ("--step", "13", "--samples", "256")),
    "14-after": Shot("lessons/metals.pbrt", ("--step", "14", "--samples", "256")),
    "14-glass": Shot("lessons/glass-balls.pbrt", ("--step", "14", "--samples", "256")),
    "15-before": Shot("lessons/plates.pbrt", ("--step", "14", "--samples", "4")),
    "15-after": Shot("lessons/plates.pbrt", ("--step", "15", "--samples", "4")),
    "09-after": Shot("generated/mountain", ("--step", "9", "--accel", "bvh")),
}


def untouched(kit: BuiltKit) -> Pixels:
    """What the stub of step 01 shows."""
    step = kit.steps[0]
    shot = SHOTS["01-after"]
    return (
        Variant(kit, step, stub_for(kit.project, step)).draw(f"scenes/{shot.scene}.nff", (*shot.args, *_SMALL)).pixels
    )


def hard_shadows(kit: BuiltKit) -> Pixels:
    """The scene of step 12 with lamps that are nearly points, and send as much light."""
    shot = SHOTS["12-after"]
    text = (kit.project.scenes / shot.file).read_text(encoding="ascii")
    for radius, scale in (("0.75", "18"), ("0.2", "14")):
        more = (float(radius) / _TINY) ** 2 * float(scale)
        text = text.replace(f'"float scale" {scale}\n', f'"float scale" {more:g}\n')
        text = text.replace(f'"float radius" {radius}\n', f'"float radius" {_TINY}\n')
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        scene = Path(folder) / "hard.pbrt"
        scene.write_text(text, encoding="ascii")
        return reference_picture(kit, scene, (*shot.args, *_SMALL))


_TINY = 0.01


def paths_alone(kit: BuiltKit) -> Pixels:
    """The scene of step 15 with no samples of lamps: each lamp that a path meets counts in full."""
    shot, step = SHOTS["15-after"], next(step for step in kit.steps if step.number == "15")
    changes = {
        "emission_weight(last, tracer.light_pdf(from, *hit)) * emission": "emission",
        "        light += weight * direct_light(tracer.direct_samples(*hit));\n": "",
    }
    source = reference_source(kit.project, step)
    for old, new in changes.items():
        source = replaced_once(source, old, new, f"figures: '{old}' in solutions/{step.path.as_posix()}")
    return Variant(kit, step, source).draw(f"scenes/{shot.file}", (*shot.args, *_SMALL)).pixels


def contact_sheet(kit: BuiltKit) -> Pixels:
    """The same scene after each step that changes a picture; glass has a scene of its own."""
    flake = generated(kit.project, "sphereflake", 3)
    glass = kit.project.scenes / "lessons" / "glass.nff"
    size = ("--size", f"{_TILE}x{_TILE}")
    steps = [step for step in kit.steps if step.index <= 8]
    sheet = Image.new("RGB", (4 * (_TILE + _GAP) + _GAP, 2 * (_TILE + _GAP + _LETTERS) + _GAP), _PAPER)
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(size=15)
    for place, step in enumerate(steps):
        view = ("--view", "normals") if step.index == 2 else ()
        args = ("--step", str(step.index), "--accel", "bvh", "--samples", "9", *size, *view)
        x = _GAP + (place % 4) * (_TILE + _GAP)
        y = _GAP + (place // 4) * (_TILE + _GAP + _LETTERS)
        picture = reference_picture(kit, glass if step.index == 8 else flake, args)
        sheet.paste(Image.fromarray(picture), (x, y))
        pen.text((x + 4, y + _TILE + 2), f"{step.number} {step.title}", _INK, font)
    return np.asarray(sheet)


def work_maps(kit: BuiltKit) -> Pixels:
    """What each pixel costs: every surface, the octree on its own scale, and on the scale of every surface."""
    scene = kit.project.scenes / "lessons" / "many-spheres.nff"
    size = ("--map", "tests", "--size", "320x320")
    ways = (("--accel", "none"), (), ("--map-scale", "2000"))
    maps = [reference_picture(kit, scene, (*size, *way)) for way in ways]
    gap = np.full((maps[0].shape[0], 8, 3), 255, np.uint8)
    return np.concatenate([maps[0], gap, maps[1], gap, maps[2]], axis=1)


def sphereflake(kit: BuiltKit) -> Pixels:
    """What part one ends with."""
    args = ("--step", "8", "--size", "512x512", "--accel", "bvh", "--samples", "16")
    return reference_picture(kit, generated(kit.project, "sphereflake", 4), args)


def still_life(kit: BuiltKit) -> Pixels:
    """The picture at the top of the README: all of part two."""
    args = ("--step", "15", "--size", "640x360", "--samples", "256")
    return reference_picture(kit, kit.project.scenes / "lessons" / "still-life.pbrt", args)


# The window: what it really shows, on a screen that nobody sees.

_SCREEN_SECONDS = 60
_TRIES = 8
_NUMBERS = range(200, 32000)  # far from the screens that people and `xvfb-run` use
_HELLO = struct.pack("<BxHHHHxx", ord("l"), 11, 0, 0, 0)  # how a client of X11 begins, without a key


class NoScreen(Exception):
    """Xvfb is missing."""


@contextmanager
def hidden_screen() -> Iterator[dict[str, str]]:
    """The environment of a program that is to be shown on a screen that nobody sees.

    Xvfb gets a number and does not choose one: only then does it lock the number, so that no other server takes it, or
    its socket. It says when it listens, and a screen is given out when a client was let in."""
    if shutil.which("Xvfb") is None:
        raise NoScreen("Xvfb is missing: install xvfb")
    for number in random.sample(_NUMBERS, _TRIES):
        server = _started(number)
        try:
            if server is not None and _lets_in(number):
                yield {**os.environ, "DISPLAY": f":{number}", "LIBGL_ALWAYS_SOFTWARE": "1"}
                return
        finally:
            if server is not None:
                server.terminate()
                server.wait(_SCREEN_SECONDS)
    raise GraderFault(f"Xvfb does not start: {_TRIES} screens could not be opened; `Xvfb :{_NUMBERS[0]}` says why")


def _started(number: int) -> "subprocess.Popen[bytes] | None":
    """Xvfb once it listens; none where it ended before that, as where the number is taken."""
    reading, writing = os.pipe()
    with os.fdopen(reading) as pipe:
        command = ["Xvfb", f":{number}", "-displayfd", str(writing), "-screen", "0", "800x600x24"]
        command += ["-nolisten", "tcp", "-noreset"]  # else it begins anew behind each last client, deaf meanwhile
        try:
            server = subprocess.Popen(command, pass_fds=[writing], stderr=subprocess.DEVNULL)
        except OSError as error:
            raise GraderFault(f"Xvfb does not start: {reason(error)}") from error
        finally:
            os.close(writing)
        if pipe.readline().strip():
            return server
    server.kill()
    server.wait(_SCREEN_SECONDS)
    return None


def _lets_in(number: int) -> bool:
    with socket.socket(socket.AF_UNIX) as client, suppress(OSError):
        client.settimeout(_SCREEN_SECONDS)
        client.connect(f"/tmp/.X11-unix/X{number}")  # noqa: S108 - where X11 has its sockets
        client.sendall(_HELLO)
        return client.recv(1) == b"\1"  # its "Success"
    return False


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


# Their files.


def _png(pixels: Pixels) -> bytes:
    data = io.BytesIO()
    Image.fromarray(pixels).save(data, format="PNG", optimize=True)
    return data.getvalue()


def is_current(path: Path, pixels: Pixels) -> bool:
    """Whether the file shows this picture, up to what another compiler or library of letters moves."""
    try:
        kept = read_png(path)
    except (OSError, ValueError):
        return False
    return kept.shape == pixels.shape and float(channel_differences(kept, pixels).mean()) <= _MAX_APART


def write(path: Path, pixels: Pixels) -> None:
    write_bytes(path, _png(pixels))
