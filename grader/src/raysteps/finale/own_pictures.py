"""What the student's own program draws for the finale, and what it counts."""

import importlib.util
import re
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

import numpy as np

from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.images.compare import Pixels, read_png
from raysteps.images.noise import Light, as_picture, read_estimates
from raysteps.images.render import read_work
from raysteps.results.model import Work

_SMALL = 480  # pixels: the longer side of a picture of one step
_SMALL_SAMPLES, _SMALL_NOISY = "4", "16"
_COUNTED = 160  # pixels: small, as every surface is tested for every ray
_LARGEST_COUNTED = 20_000  # surfaces
_SECONDARY = {"shadow": "shadow rays", "reflect": "reflected rays", "refract": "refracted rays"}
_LAST_OF_PART_ONE = 8  # step 09 draws the same


class RenderFailed(Exception):
    """The program gave up or crashed, and has said why on the terminal."""

    def __init__(self, code: int, what: str) -> None:
        super().__init__(what)
        self.code = code


@dataclass(frozen=True)
class AvailableSteps:
    """Which steps there are to draw with."""

    drawn: tuple[Step, ...]
    missing: tuple[Step, ...]
    part_two: bool = False  # the scene is one of part two, whose steps go on from those of part one

    @property
    def last(self) -> int:
        """Whose picture shows all of them."""
        indices = [step.index for step in self.drawn if not step.is_about_a_tree]
        return max(indices) if self.part_two else min(max(indices), _LAST_OF_PART_ONE)

    def shows(self, step: Step) -> bool:
        """Whether the page has a picture after that step, or a word why there is none."""
        return step.is_in_part_two or not self.part_two

    @property
    def trees(self) -> dict[str, str]:
        """The option for each tree, and what people call it."""
        there = {step.index for step in self.drawn}
        known = {6: ("octree", "octree"), 9: ("bvh", "bounding volumes")}
        return {option: name for index, (option, name) in known.items() if index in there}

    @property
    def tree(self) -> str:
        """The one to draw with. Where part one is no part of the course the reference stands in for it."""
        is_given = all(step.is_in_part_two for step in (*self.drawn, *self.missing))
        return next(reversed(self.trees), "octree" if is_given else "none")

    def accel_of(self, step: Step) -> str:
        """A step that is about a tree is drawn with its own, all others with the quickest: the picture is the same."""
        return {6: "octree", 9: "bvh"}.get(step.index, self.tree) if step.is_about_a_tree else self.tree


def _size(longest: int, shape: tuple[int, ...]) -> str:
    """Of the form of a picture of this shape, with so many pixels along its longer side."""
    scale = longest / max(shape[:2])
    return f"{max(1, round(shape[1] * scale))}x{max(1, round(shape[0] * scale))}"


def available_steps(steps: Sequence[Step], written: set[str], *, part_two: bool = False) -> AvailableSteps:
    """A step that changes the picture needs those before it; trees and bonuses may be left out."""
    drawn: list[Step] = []
    broken = False
    for step in steps:
        there = step.id in written and not broken
        if there:
            drawn.append(step)
        elif not (step.bonus or step.is_about_a_tree):
            broken = True
    return AvailableSteps(tuple(drawn), tuple(step for step in steps if step not in drawn), part_two)


@dataclass(frozen=True)
class CountedPicture:
    """The same small picture with one way to find what a ray meets."""

    name: str
    work: Work


@dataclass(frozen=True)
class LargePicture:
    """And what it cost."""

    pixels: Pixels
    samples: int
    work: Work
    secondary: dict[str, int]  # rays behind those of the eye, by what people call them
    seconds: float
    surfaces: int  # of the scene
    noisy: Pixels | None = None  # as it was drawn, where the noise was taken out


@dataclass(frozen=True)
class OwnProgram:
    """Draws one scene into a folder."""

    run: Callable[[list[str]], int]  # with these words, on this terminal: its bar and its errors show
    scene: str
    folder: Path
    threads: tuple[str, ...] = ()

    def _draw(self, what: str, *words: str) -> Path:
        picture = self.folder / "picture.png"
        picture.unlink(missing_ok=True)
        code = self.run([self.scene, "-o", str(picture), *self.threads, *words])
        if code != 0 or not picture.is_file():
            raise RenderFailed(code or 1, what)
        return picture

    def _counters(self) -> Path:
        return self.folder / "stats.json"

    def large(
        self, available: AvailableSteps, size: str | None, samples: int, *, denoise: bool = False
    ) -> LargePicture:
        """Without a size it is the scene's own."""
        estimates = self.folder / "estimates"
        sized = () if size is None else ("--size", size)
        words = ("--step", str(available.last), "--accel", available.tree, "--samples", str(samples), *sized)
        words += ("--estimates", str(estimates)) if denoise else ()
        path = self._draw("the large picture", *words, "--stats", str(self._counters()))
        rays = {name: int(self._told(kind)) for kind, name in _SECONDARY.items()}
        seconds, surfaces = self._told("render_seconds"), int(self._told("surfaces"))
        drawn = read_png(path)
        shown = denoised(read_estimates(estimates.read_bytes()).mean) if denoise else drawn
        return LargePicture(shown, samples, self._work(), rays, seconds, surfaces, drawn if denoise else None)

    def _work(self) -> Work:
        work = read_work(self._counters().read_bytes())
        if work is None:
            raise RenderFailed(1, "the counters: they cannot be read")
        return work

    def _told(self, name: str) -> float:
        found = re.search(rf'"{name}": *([0-9]{{1,18}}(\.[0-9]+)?)'.encode(), self._counters().read_bytes())
        return float(found[1]) if found else 0.0

    def small(self, available: AvailableSteps, step: Step, shape: tuple[int, ...]) -> Pixels:
        """As the steps up to this one see the scene; `shape` is that of the large picture."""
        size = _size(_SMALL, shape)
        at = str(min(step.index, available.last) if step.is_about_a_tree else step.index)
        view = ("--view", "normals") if step.index == 2 else ()
        samples = _SMALL_NOISY if available.part_two else _SMALL_SAMPLES
        words = ("--step", at, *view, "--accel", available.accel_of(step), "--samples", samples, "--size", size)
        return read_png(self._draw(f"the picture of step {step.number}", *words, "--quiet"))

    def counted(self, available: AvailableSteps, large: LargePicture) -> list[CountedPicture]:
        """Every surface for every ray, then with each tree. Nothing where there is no tree, or too much to test."""
        if not available.trees or large.surfaces > _LARGEST_COUNTED:
            return []
        size = _size(_COUNTED, large.pixels.shape)
        found = []
        for accel, name in {"none": "every surface", **available.trees}.items():
            words = ("--step", str(available.last), "--accel", accel, "--samples", "1", "--size", size)
            stats = ("--stats", str(self._counters()))
            self._draw(f"the picture that is counted ({name})", *words, *stats, "--quiet")
            found.append(CountedPicture(name, self._work()))
        return found


# Noise taken out of a picture by Open Image Denoise, where somebody has installed it: the kit does without.

_LIBRARY, _VERSION = "pyoidn", "2.5.1.0"  # Open Image Denoise 2.5.1, and Python's way to it


def refuse_without_denoiser() -> None:
    """Told before anything is drawn."""
    if importlib.util.find_spec(_LIBRARY) is None:
        raise UsageError(
            "--denoise: Open Image Denoise is not installed, and the kit does without; get it (90 MB) with: "
            f"{sys.executable} -m pip install {_LIBRARY}=={_VERSION}"
        )


def denoised(light: Light) -> Pixels:
    """Of the mean light of each pixel, before filter and curve: a filter would share the noise with the neighbours, and
    then it looks like something that is there."""
    library = import_module(_LIBRARY)
    return as_picture(np.asarray(library.denoise(np.ascontiguousarray(light, dtype=np.float32), hdr=True), np.float64))
