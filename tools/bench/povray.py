"""The same picture by POV-Ray and by raytrace, in turns."""

import json
import math
import re
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.vectors import Vector, cross, length, minus, times, unit
from tools.bench.model import PovrayRow, ProgramTimes, Spread
from tools.bench.programs import Programs, flat_nff, run_pinned

# A scene of spheres, cones and triangles, from the NFF that `raysteps-bench nff` writes.

Numbers = tuple[float, ...]


@dataclass(frozen=True)
class Shape:
    """One surface. s: centre, radius; c: two ends, each with radius; p: three corners; pp: each with a normal."""

    kind: str
    numbers: Numbers
    fill: Numbers  # colour, kd, ks, shine, transmittance, index of refraction


@dataclass
class FlatScene:
    """What a peer needs to draw the same picture."""

    view: dict[str, Numbers] = field(default_factory=dict)
    lights: list[Numbers] = field(default_factory=list)
    shapes: list[Shape] = field(default_factory=list)


_MORE_LINES = {"c": 2, "p": 3, "pp": 3}
_VIEW = ("from", "at", "up", "angle", "hither", "resolution")


def _numbers(words: list[str]) -> Numbers:
    return tuple(float(word) for word in words)


def _shape(kind: str, words: list[str], lines: Iterator[str], fill: Numbers) -> Shape:
    if kind == "s":
        return Shape(kind, _numbers(words), fill)
    if kind in ("p", "pp") and words != ["3"]:
        raise GraderFault(f"expected triangles only, found a polygon of {' '.join(words)} corners")
    rows = [next(lines) for _ in range(_MORE_LINES[kind] - len(words) // 4)]
    first = _numbers(words) if kind == "c" else ()
    return Shape(kind, first + tuple(number for row in rows for number in _numbers(row.split())), fill)


def read_flat(text: str) -> FlatScene:
    """The text that write_nff makes, not any NFF."""
    scene = FlatScene()
    fill: Numbers = ()
    lines = iter(text.splitlines())
    for line in lines:
        kind, *words = line.split()
        if kind in _VIEW:
            scene.view[kind] = _numbers(words)
        elif kind == "l":
            scene.lights.append(_numbers(words))
        elif kind == "f":
            fill = _numbers(words)
        elif kind in ("s", "c", "p", "pp"):
            scene.shapes.append(_shape(kind, words, lines, fill))
        elif kind not in ("v", "b"):
            raise GraderFault(f"expected NFF as raysteps-bench writes it, found '{line[:80]}'")
    return scene


# A flat scene in POV-Ray's language, so that both programs follow the same rays through the same shapes.


def _three(numbers: Numbers) -> Vector:
    return numbers[0], numbers[1], numbers[2]


def _scaled(v: Vector, to: float) -> Vector:
    return times(to / length(v), v)


def _vector(numbers: Numbers) -> str:
    return "<" + ",".join(f"{number:.9g}" for number in numbers[:3]) + ">"


def _camera(view: dict[str, Numbers]) -> str:
    """`angle` spans a square picture from edge to edge in both programs; right and up are its sides at distance 1."""
    forward = unit(minus(_three(view["at"]), _three(view["from"])))
    side = 2.0 * math.tan(math.radians(view["angle"][0]) / 2.0)
    right = _scaled(cross(forward, _three(view["up"])), side)
    up = _scaled(cross(right, forward), side)
    vectors = (f"location {_vector(view['from'])}", f"direction {_vector(forward)}")
    return f"camera {{ perspective {' '.join(vectors)} right {_vector(right)} up {_vector(up)} }}"


def _texture(name: str, fill: Numbers) -> str:
    """POV-Ray dims what is under a transparent colour, the kit does not."""
    kd, ks, shine, transmittance = fill[3:7]
    diffuse = kd / (1.0 - transmittance) if transmittance < 1.0 else 0.0
    pigment = f"pigment {{ rgb {_vector(fill)} transmit {transmittance:.9g} }}"
    highlight = f"phong {ks:.9g} phong_size {shine:.9g} reflection {ks:.9g}" if ks > 0.0 else ""
    finish = f"finish {{ ambient 0 diffuse {diffuse:.9g} {highlight} }}"
    return f"#declare {name} = texture {{ {pigment} {finish} }}"


def _corners(numbers: Numbers, each: int) -> str:
    """Points, and normals beside them where there are six numbers a corner."""
    corners = [numbers[start : start + each] for start in range(0, len(numbers), each)]
    return ", ".join(", ".join(_vector(corner[part : part + 3]) for part in range(0, each, 3)) for corner in corners)


def _outline(shape: Shape) -> str:
    numbers = shape.numbers
    if shape.kind == "p":
        return f"triangle {{ {_corners(numbers, 3)}"
    if shape.kind == "pp":
        return f"smooth_triangle {{ {_corners(numbers, 6)}"
    if min(numbers[3::4]) < 0.0:
        raise UsageError("a surface that only its inside shows has no counterpart in POV-Ray")
    if shape.kind == "s":
        return f"sphere {{ {_vector(numbers)}, {numbers[3]:.9g}"
    ends = f"{_vector(numbers)}, {numbers[3]:.9g}, {_vector(numbers[4:])}, {numbers[7]:.9g}"
    return f"cone {{ {ends} open"


def _lines(scene: FlatScene, depth: int) -> Iterator[str]:
    yield "#version 3.7;"
    yield f"global_settings {{ assumed_gamma 1.0 max_trace_level {depth} adc_bailout 0 }}"
    yield "background { rgb 0 }"
    yield _camera(scene.view)
    for light in scene.lights:
        yield f"light_source {{ {_vector(light)} rgb {_vector(light[3:6] or (1.0, 1.0, 1.0))} }}"
    names: dict[Numbers, str] = {}
    for shape in scene.shapes:
        if shape.fill not in names:
            names[shape.fill] = f"Fill{len(names)}"
            yield _texture(names[shape.fill], shape.fill)
        glass = f" interior {{ ior {shape.fill[7]:.9g} }}" if shape.fill[6] > 0.0 and shape.fill[7] > 0.0 else ""
        yield f"{_outline(shape)} texture {{ {names[shape.fill]} }}{glass} }}"


def pov_text(scene: FlatScene, depth: int) -> str:
    """The whole file. The background is black: the kit gives black to bounced rays that miss."""
    return "\n".join(_lines(scene, depth)) + "\n"


# Whether two programs drew the same scene.

Picture = NDArray[np.float64]

_BLOCK = 16  # pixels
_WEIGHTS = np.array([0.2126, 0.7152, 0.0722])


def linear_picture(path: Path, *, tone_mapped: bool) -> Picture:
    """The light of each pixel, cut off at 1. Step 07 maps c to c / (c + 1); that is undone here."""
    with Image.open(path) as image:
        values = np.asarray(image.convert("RGB"), dtype=np.float64) / 255.0
    if tone_mapped:
        values = values / np.maximum(1.0 - values, 1e-9)
    capped: Picture = np.minimum(values, 1.0)
    return capped


def _blocks(picture: Picture) -> Picture:
    brightness: Picture = picture @ _WEIGHTS
    height, width = (max(1, side // _BLOCK) * min(_BLOCK, side) for side in brightness.shape)
    rows, columns = max(1, height // _BLOCK), max(1, width // _BLOCK)
    blocks = brightness[:height, :width].reshape(rows, height // rows, columns, width // columns)
    means: Picture = blocks.mean(axis=(1, 3))
    return means


def brightness_difference(a: Picture, b: Picture) -> float:
    """The mean over blocks of 16 x 16 pixels, from 0 to 1. Both pictures have the same size."""
    return float(np.abs(_blocks(a) - _blocks(b)).mean())


_MAX_DIFFERENCE = 0.01
_MAX_WITH_GLASS = 0.05  # light passes POV-Ray's glass, while the kit's throws a full shadow
_TRACE_TIME = re.compile(r"Trace Time:.*\(([0-9.]+) seconds\)")
_BACKGROUND = re.compile(r"^b .*$", re.MULTILINE)
_OPTIONS = ("-D", "-A", "+WT1", "+FP", "File_Gamma=1.0", "+Q9", "-V", "-P")


@dataclass(frozen=True)
class Race:
    """How whole pictures are measured."""

    size: int
    depth: int
    rounds: int
    trees: list[str]


@dataclass(frozen=True)
class TraceTime:
    """Seconds of one run: of tracing by its own account, of the whole process, and of the processor in it."""

    trace: float
    process: float
    processor: float


Runner = Callable[[int], TraceTime]  # of a picture with that many pixels on each side


def trace_seconds(report: str) -> float:
    """What POV-Ray says about itself, to the millisecond."""
    found = _TRACE_TIME.search(report)
    if not found:
        raise GraderFault("POV-Ray did not tell its trace time; expected a line 'Trace Time: ... (1.234 seconds)'")
    return float(found.group(1))


def _povray(folder: Path, size: int) -> TraceTime:
    files: list[str | Path] = ["+Iscene.pov", "+Opovray.ppm", f"+W{size}", f"+H{size}"]
    outcome, processor = run_pinned(["povray", *files, *_OPTIONS], folder)
    return TraceTime(trace_seconds(outcome.stderr + outcome.stdout), outcome.seconds, processor)


def _raytrace(program: Path, folder: Path, tree: str, depth: int, size: int) -> TraceTime:
    options = ["--size", f"{size}x{size}", "--depth", str(depth), "--threads", "1", "--quiet"]
    words: list[str | Path] = [program, "scene.nff", "-o", f"{tree}.ppm", "--accel", tree, "--stats", f"{tree}.json"]
    outcome, processor = run_pinned([*words, *options], folder)
    stats = json.loads((folder / f"{tree}.json").read_text(encoding="utf-8"))
    return TraceTime(float(stats["render_seconds"]), outcome.seconds, processor)


def _difference(folder: Path, tree: str) -> float:
    theirs = linear_picture(folder / "povray.ppm", tone_mapped=False)
    return brightness_difference(theirs, linear_picture(folder / f"{tree}.ppm", tone_mapped=True))


def _skipped(scene: str, why: str) -> PovrayRow:
    return PovrayRow(scene, why, None, [])


def _measured(folder: Path, scene: str, runners: dict[str, Runner], race: Race, bound: float) -> PovrayRow:
    """A picture of one pixel takes reading and building, but no rays to speak of: the rest is tracing."""
    size = race.size
    times: dict[str, list[tuple[TraceTime, float]]] = {name: [] for name in runners}
    for runner in runners.values():
        runner(size)  # warms up, and leaves the pictures
    difference = _difference(folder, list(runners)[1].removeprefix("raytrace "))
    if difference > bound:
        return _skipped(scene, f"not the same scene: brightness differs by {difference:.3f}, expected at most {bound}")
    for _ in range(race.rounds):
        for name, runner in runners.items():
            whole, without_rays = runner(size), runner(1)
            times[name].append((whole, max(0.0, whole.processor - without_rays.processor)))
    programs = [
        ProgramTimes(
            name,
            Spread.of([one.trace for one, _ in taken]),
            Spread.of([tracing for _, tracing in taken]),
            Spread.of([one.process for one, _ in taken]),
            Spread.of([one.processor for one, _ in taken]),
        )
        for name, taken in times.items()
    ]
    return PovrayRow(scene, "", difference, programs)


def race_povray(programs: Programs, scene: Path, race: Race) -> PovrayRow:
    """Both get the same flat scene with a black background."""
    text = flat_nff(programs.bench, scene)
    flat = read_flat(text)
    bound = _MAX_WITH_GLASS if any(shape.fill[6] > 0.0 for shape in flat.shapes) else _MAX_DIFFERENCE
    try:
        pov = pov_text(flat, race.depth)
    except UsageError as error:
        return _skipped(scene.stem, str(error))
    with tempfile.TemporaryDirectory(prefix="raysteps-pov-") as name:
        folder = Path(name)
        (folder / "scene.pov").write_text(pov, encoding="utf-8")
        (folder / "scene.nff").write_text(_BACKGROUND.sub("b 0 0 0", text), encoding="utf-8")
        runners: dict[str, Runner] = {"povray": partial(_povray, folder)}
        for tree in race.trees:
            runners[f"raytrace {tree}"] = partial(_raytrace, programs.raytrace, folder, tree, race.depth)
        return _measured(folder, scene.stem, runners, race, bound)
