"""Which scenes the gallery shows, what each looks like after a step, and what it costs."""

import re
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.text import join_and, printable, shorten
from raysteps.course.manifest import Step, earlier
from raysteps.course.project import Project, generated, is_of_part_two
from raysteps.course.stubs import unfinished_functions
from raysteps.grading.build_messages import link_message, why_not_built
from raysteps.grading.images import trouble
from raysteps.grading.step import GradingContext
from raysteps.images.compare import Pixels
from raysteps.images.render import RenderResult, reference_picture, reference_work, render
from raysteps.results.model import Work
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.submission.load import Submission, load_submission
from raysteps.toolchain.compile import Program, StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback
from raysteps.toolchain.limits import StepLimits, limits_of

# What a visitor of the gallery is told; what each step adds, its step.toml says.

_MAX_SENTENCE = 240  # characters
_SCENES = {
    "showcase": ("Showcase", "Painted balls, pillars, a mirror, polished tiles and glass: something for every step."),
    "sphereflake": ("Sphereflake", "A ball carries nine smaller ones, and each of these nine more: 820 in all."),
    "facing-mirrors": ("Facing mirrors", "Two mirrors that look at each other: a corridor without an end."),
    "mountain": ("Mountain", "A mountain made by chance, at a lake that mirrors it, behind four balls of glass."),
    "gears": ("Gears", "Meshing gears, each face a polygon of 144 corners, some of them of glass."),
    "studio": ("Studio", "A vase, metal, glass and paint below a bulb, a lamp and a window: part two in one room."),
    "cornell": ("Cornell box", "A red wall, a green one and one lamp: what white paper shows is what the walls send."),
    "plates": ("Plates", "Lamps of four sizes in four plates from polished to rough: what is mirrored, and where."),
    "still-life": ("Still life", "Gold, copper, steel, clear and frosted glass below two lamps, through a lens."),
}


def _first_sentence(scene: Path) -> str:
    """Of the comment that the file begins with."""
    try:
        with scene.open(encoding="utf-8", errors="replace") as file:
            head = [file.readline(1000) for _ in range(12)]
    except OSError:
        return ""
    lines = []
    for line in head:
        if not line.startswith("#"):
            break
        lines.append(line.lstrip("# \t").strip())
    sentence = re.split(r"(?<=[.:])\s", " ".join(lines))[0].rstrip(":")
    return shorten(printable(sentence), _MAX_SENTENCE)


def about_scene(name: str, scene: Path) -> tuple[str, str]:
    """Its title, and a sentence."""
    title = printable(name.replace("-", " ")).capitalize() or "Scene"
    return _SCENES.get(name) or (title, _first_sentence(scene))


_PART_ONE = ("showcase", "sphereflake", "facing-mirrors", "mountain", "gears")
_OF_PARTS = {1: _PART_ONE, 2: ("studio", "cornell", "plates", "still-life")}
CHOSEN = (*_PART_ONE, *_OF_PARTS[2])  # in this order
_FLAKE = 3  # generations: enough surfaces for the boxes to pay, few enough to be counted one by one

# Before step 12 nothing is seen of lamps that have a size; and not every step is to be seen in each scene.
_SHOWN = {"studio": (9, 15), "cornell": (12, 13), "plates": (14, 15), "still-life": (12, 15)}
_LAST = 99
_LAST_OF_NFF = 10  # of part two: surfaces and lamps of NFF are those of part one, and this step makes edges smooth


@dataclass(frozen=True)
class GalleryScene:
    """One scene of the gallery, and the first and the last step after which it is shown."""

    name: str
    title: str
    words: str
    path: Path
    first: int = 1
    last: int = _LAST

    def shows(self, step: Step) -> bool:
        if step.is_in_part_two and not is_of_part_two(self.path):
            return step.index == _LAST_OF_NFF
        return self.first <= step.index <= self.last


def usual_scenes(steps: Sequence[Step]) -> list[str]:
    """Those that show these steps best."""
    parts = {step.part for step in steps}
    return [name for name in CHOSEN if any(name in _OF_PARTS.get(part, _PART_ONE) for part in parts)]


def _committed(project: Project) -> dict[str, Path]:
    files = [
        path
        for folder in ("lessons", "generated")
        for ending in ("nff", "pbrt")
        for path in sorted((project.scenes / folder).glob(f"*.{ending}"))
    ]
    return {path.stem: path for path in files}


def _find(project: Project, word: str) -> Path:
    known = _committed(project)
    if word == "sphereflake":
        return generated(project, word, _FLAKE)
    if word in known:
        return known[word]
    path = Path(word)
    if not path.is_file():
        raise UsageError(f"--scene {word}: is not there; expected a scene's file or one of {', '.join(sorted(known))}")
    return path


def gallery_scenes(project: Project, words: Sequence[str], steps: Sequence[Step]) -> list[GalleryScene]:
    """Those that were asked for, each once; those that show the steps best when none was."""
    paths = {_find(project, word).resolve(): word for word in words or usual_scenes(steps)}
    shown = []
    for path, word in paths.items():
        name = word if word in CHOSEN else path.stem
        scene = GalleryScene(name, *about_scene(name, path), path, *_SHOWN.get(word, (1, _LAST)))
        if not any(map(scene.shows, steps)):
            raise UsageError(
                f"--scene {word}: shows no step of this course; expected another choice of `parts` in course.toml, or "
                f"one of {', '.join(usual_scenes(steps))}"
            )
        shown.append(scene)
    return shown


# What a scene looks like after a step, and what it costs.

_TREE = 6  # the step from which on pictures are made with a tree
_SIZE, _SIZE_OF_PART_TWO = "800x600", "480x360"
SAMPLES = 100
_MAP_SIZE = "240x180"  # every surface for every ray takes its time


@dataclass(frozen=True)
class Shot:
    """A picture, or a note why there is none; a note may also go with a picture."""

    pixels: Pixels | None
    note: str = ""


@dataclass(frozen=True)
class WorkMap:
    """Where the tests went, as a map, and what was counted."""

    name: str
    map: Pixels
    work: Work


@dataclass(frozen=True)
class PictureOptions:
    """How the pictures are made. Without `size`, those of part two are smaller: each of them takes many samples."""

    size: str = ""
    samples: int = SAMPLES  # of each pixel, in scenes of part two


def picture_args(step: Step, scene: GalleryScene, options: PictureOptions) -> tuple[str, ...]:
    """Of raytrace. Before there is a tree the reference's saves time; the picture is the same."""
    noisy = is_of_part_two(scene.path)
    size = options.size or (_SIZE_OF_PART_TWO if noisy else _SIZE)
    early = ("--accel", "octree") if step.index < _TREE else ()
    samples = ("--samples", str(options.samples)) if noisy and step.is_in_part_two else ()
    return ("--step", str(step.index), "--size", size, *early, *samples)


def map_args(step: int, accel: str) -> tuple[str, ...]:
    """Of raytrace, for a map of the tests of surfaces."""
    return ("--step", str(step), "--size", _MAP_SIZE, "--accel", accel, "--map", "tests")


@dataclass(frozen=True)
class Tree:
    """A step that saves work: what came before it, and what it brings."""

    step: int
    before: tuple[str, tuple[str, ...]]
    after: tuple[str, tuple[str, ...]]


TREES = (
    Tree(6, ("every surface", map_args(5, "none")), ("octree", map_args(6, "octree"))),
    Tree(9, ("octree", map_args(8, "octree")), ("bounding volumes", map_args(9, "bvh"))),
)


def _step_of(tree: Tree, scene: GalleryScene, kit: BuiltKit) -> Step | None:
    return next((step for step in kit.steps if step.index == tree.step and scene.shows(step)), None)


# The pictures of a student's own steps. What goes wrong in a step is a note, and the others go on.

_SECONDS = 120.0
_MAX_CHARACTERS = 600  # of why a step does not build


class MySteps:
    """A student's steps, each built by itself. After step N the steps up to N are the student's; where one of
    these is not there, the reference stands in, and a note says so."""

    def __init__(self, kit: BuiltKit, submission: Submission, folder: Path, say: ProgressCallback) -> None:
        self._kit = kit
        self._sandbox = LimitsOnly()
        self._build = StudentBuild(kit.in_one_process(), self._sandbox, folder)
        context = GradingContext(kit, submission, self._sandbox, folder, folder)
        self._limits: dict[str, StepLimits] = {}
        self._binaries: dict[str, Path] = {}
        self._notes: dict[str, str] = {}
        self._programs: dict[str, tuple[Program | None, str]] = {}
        for step in kit.steps:
            say(f"building your step {step.number}")
            self._limits[step.id] = limits_of(step, {"seconds": max(_SECONDS, step.seconds)})
            self._compile(step, context.source(step))

    def _compile(self, step: Step, source: str | None) -> None:
        if source is None:
            self._notes[step.id] = f"Step {step.number} is not started: {step.file} is still the stub."
            return
        compiled = self._build.compile(step, source.encode(), self._limits[step.id])
        if compiled.binary is None:
            self._notes[step.id] = shorten(why_not_built(self._kit, step, compiled, source), _MAX_CHARACTERS)
            return
        self._binaries[step.id] = compiled.binary
        left = unfinished_functions(source, step)
        self._notes[step.id] = f"Unfinished: {join_and(left)}." if left else ""

    def _program(self, step: Step) -> tuple[Program | None, str]:
        if step.id not in self._programs:
            up_to = self._kit.handed_in_up_to(step)
            own = {other.number: self._binaries[other.id] for other in up_to if other.id in self._binaries}
            program, ran = self._build.program("raytrace", step, own, self._limits[step.id], together=True)
            self._programs[step.id] = (program, "" if ran is None else shorten(link_message(ran), _MAX_CHARACTERS))
        return self._programs[step.id]

    def _render(self, program: Program, step: Step, scene: GalleryScene, args: tuple[str, ...]) -> RenderResult:
        rendered = render(self._sandbox, program, scene.path, args, self._limits[step.id].of_program())
        if rendered.ran.was_stopped:
            self._limits[step.id] = self._limits[step.id].after_a_stop()
        return rendered

    def _remarks(self, step: Step) -> str:
        missing = [
            other.number
            for other in earlier(step, self._kit.steps)
            if other.id not in self._binaries or other not in self._kit.handed_in_up_to(step)
        ]
        stand_in = f"The reference stands in for {join_and(missing)}." if missing else ""
        return " ".join(filter(None, [self._notes[step.id], stand_in]))

    def shot(self, step: Step, scene: GalleryScene, options: PictureOptions) -> Shot | None:
        """After one step, if the scene shows it."""
        if not scene.shows(step):
            return None
        if step.id not in self._binaries:
            return Shot(None, self._notes[step.id])
        program, problem = self._program(step)
        if program is None:
            return Shot(None, problem)
        rendered = self._render(program, step, scene, picture_args(step, scene, options))
        if rendered.pixels is None:
            return Shot(None, trouble(rendered)[1])
        return Shot(rendered.pixels, self._remarks(step))

    def work_maps(self, scene: GalleryScene) -> dict[int, WorkMap]:
        """By step, of those that save work and can be run."""
        found = {}
        for tree in TREES:
            step = _step_of(tree, scene, self._kit)
            if step is None or step.id not in self._binaries:
                continue
            program, _ = self._program(step)
            if program is None:
                continue
            rendered = self._render(program, step, scene, tree.after[1])
            if rendered.pixels is not None and rendered.work is not None:
                found[tree.step] = WorkMap(f"my {tree.after[0]}", rendered.pixels, rendered.work)
        return found


@contextmanager
def my_steps(kit: BuiltKit, say: ProgressCallback) -> Iterator[MySteps]:
    """Built into a folder that is deleted in the end."""
    with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
        yield MySteps(kit, load_submission(kit.project.steps, kit.steps), Path(folder), say)


# The reference's pictures, which are kept from run to run.


def _of_the_kit(kit: BuiltKit, scene: GalleryScene) -> bool:
    """Else it is a file of the user's."""
    return scene.path.is_relative_to(kit.project.root)


def reference_shots(
    kit: BuiltKit, scene: GalleryScene, options: PictureOptions, say: ProgressCallback
) -> list[Shot | None]:
    """After every step, None where the scene does not show it."""
    shots: list[Shot | None] = []
    for step in kit.steps:
        if not scene.shows(step):
            shots.append(None)
            continue
        say(f"{scene.name}: step {step.number}")
        try:
            shots.append(Shot(reference_picture(kit, scene.path, picture_args(step, scene, options))))
        except GraderFault as fault:
            if _of_the_kit(kit, scene):
                raise
            raise UsageError(f"--scene {scene.path}: {fault}") from fault
    return shots


def reference_work_maps(kit: BuiltKit, scene: GalleryScene, say: ProgressCallback) -> dict[int, list[WorkMap]]:
    """By step: before and after. A scene of the user's has none when it is too large to be traced without a tree."""
    work_maps = {}
    for tree in TREES:
        if _step_of(tree, scene, kit) is None:
            continue
        say(f"{scene.name}: work in step {tree.step:02d}")
        try:
            work_maps[tree.step] = [
                WorkMap(name, reference_picture(kit, scene.path, args), reference_work(kit, scene.path, args))
                for name, args in (tree.before, tree.after)
            ]
        except GraderFault:
            if _of_the_kit(kit, scene):
                raise
    return work_maps
