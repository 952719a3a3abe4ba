"""The command `bench mitsuba`: the same paths by Mitsuba 3 and by raytrace, in turns: how long for one error?"""

import math
import re
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

import numpy as np
import numpy.typing as npt
from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.process import run
from raysteps.common.vectors import Vector
from raysteps.course.project import Project
from raysteps.images.noise import read_estimates
from tools.bench.model import MitsubaNumbers, MitsubaRow, PathTimes, Spread, keep
from tools.bench.programs import Programs, checked, portable, run_pinned
from tools.bench.tables import median, quartiles, terminal_table

Light = npt.NDArray[np.float64]

VERSION = "3.9.1"
HOW_TO_GET_IT = (
    "Mitsuba is measured in a Python of its own. Get it, and say where:\n"
    "  python3 -m venv build/mitsuba\n"
    f"  build/mitsuba/bin/pip install mitsuba=={VERSION}\n"
    "  ./raysteps bench mitsuba --python build/mitsuba/bin/python"
)

# Matt scenes of part two, in pbrt's format, as both programs understand them.


@dataclass(frozen=True)
class MattShape:
    """A ball (middle, radius), or triangles (corners, indices); what it throws back, and what it sends out."""

    reflectance: Vector
    emission: Vector | None
    ball: tuple[Vector, float] | None = None
    corners: tuple[Vector, ...] = ()
    indices: tuple[int, ...] = ()


@dataclass
class MattScene:
    """What a peer needs to draw the same picture."""

    view: tuple[float, ...] = ()  # eye, target, up
    angle: float = 90.0
    sky: Vector | None = None
    shapes: list[MattShape] = field(default_factory=list)


_WORD = re.compile(r'#[^\n]*|"[^"]*"|\[|\]|[^\s"\[\]#]+')
_Values = list[str]


def _words(text: str) -> list[str]:
    return [word for word in _WORD.findall(text) if not word.startswith("#")]


def _vector(values: _Values, times: float = 1.0) -> Vector:
    x, y, z = (times * float(value) for value in values)
    return x, y, z


def _light(given: dict[str, _Values]) -> Vector:
    return _vector(given["L"], float(given.get("scale", ["1"])[0]))


@dataclass(frozen=True)
class _State:
    reflectance: Vector = (0.5, 0.5, 0.5)
    emission: Vector | None = None
    shift: Vector = (0.0, 0.0, 0.0)


class _Reader:
    """Of the few words that matt scenes are made of; what has no counterpart is refused."""

    def __init__(self, text: str) -> None:
        self._words = _words(text)
        self._at = 0
        self._named: dict[str, Vector] = {}
        self._states = [_State()]
        self.scene = MattScene()

    def read(self) -> MattScene:
        mirrored = False
        while self._at < len(self._words):
            word = self._next()
            if word == "Scale":
                mirrored = self._numbers(3) == [-1.0, 1.0, 1.0]
            elif word == "LookAt":
                self.scene.view = tuple(self._numbers(9))
            elif word == "Translate":
                x, y, z = (a + b for a, b in zip(self._states[-1].shift, self._numbers(3), strict=True))
                self._set(replace(self._states[-1], shift=(x, y, z)))
            elif word in ("AttributeBegin", "AttributeEnd"):
                self._states = [*self._states, self._states[-1]] if word == "AttributeBegin" else self._states[:-1]
            elif word != "WorldBegin":
                self._directive(word)
        if not mirrored or not self.scene.view:
            raise UsageError("expected a scene that begins with `Scale -1 1 1` and a LookAt")
        return self.scene

    def _directive(self, word: str) -> None:
        kind = self._next().strip('"')
        given, state = self._parameters(), self._states[-1]
        if word == "Camera":
            self._refuse_more(word, given, "fov")
            self.scene.angle = float(given["fov"][0])
        elif word == "LightSource" and kind == "infinite":
            self.scene.sky = _light(given)
        elif word == "AreaLightSource":
            self._set(replace(state, emission=_light(given)))
        elif word == "MakeNamedMaterial":
            self._named[kind] = self._matt(given["type"][0].strip('"'), given)
        elif word == "NamedMaterial":
            self._set(replace(state, reflectance=self._named[kind]))
        elif word == "Material":
            self._set(replace(state, reflectance=self._matt(kind, given)))
        elif word == "Shape":
            self.scene.shapes.append(self._shape(kind, given))
        elif word != "Film":
            raise UsageError(f"{word} {kind}: has no counterpart in the scene for Mitsuba")

    def _shape(self, kind: str, given: dict[str, _Values]) -> MattShape:
        state = self._states[-1]
        if kind == "sphere":
            return MattShape(state.reflectance, state.emission, ball=(state.shift, float(given["radius"][0])))
        if kind != "trianglemesh" or "N" in given or state.shift != _State.shift:
            raise UsageError(f"Shape {kind}: expected a sphere, or triangles without normals where they stand")
        places = given["P"]
        corners = tuple(_vector(places[at : at + 3]) for at in range(0, len(places), 3))
        return MattShape(state.reflectance, state.emission, corners=corners, indices=tuple(map(int, given["indices"])))

    def _matt(self, kind: str, given: dict[str, _Values]) -> Vector:
        if kind != "diffuse":
            raise UsageError(f"Material {kind}: expected matt surfaces only; others follow other laws in Mitsuba")
        self._refuse_more(f"Material {kind}", given, "reflectance", "type")
        return _vector(given["reflectance"])

    def _set(self, state: _State) -> None:
        self._states[-1] = state

    @staticmethod
    def _refuse_more(word: str, given: dict[str, _Values], *known: str) -> None:
        more = [name for name in given if name not in known]
        if more:
            raise UsageError(f"{word}: `{more[0]}` has no counterpart in the scene for Mitsuba")

    def _next(self) -> str:
        self._at += 1
        return self._words[self._at - 1]

    def _numbers(self, count: int) -> list[float]:
        return [float(self._next()) for _ in range(count)]

    def _parameters(self) -> dict[str, _Values]:
        """By name, without their types."""
        found: dict[str, _Values] = {}
        while self._at < len(self._words) and " " in (name := self._words[self._at]) and name.startswith('"'):
            self._at += 1
            first = self._next()
            values = [first]
            if first == "[":
                end = self._words.index("]", self._at)
                values, self._at = self._words[self._at : end], end + 1
            found[name.strip('"').split()[-1]] = values
        return found


def read_matt(text: str) -> MattScene:
    """A scene of matt balls and triangles, lamps and sky, in pbrt's format."""
    try:
        return _Reader(text).read()
    except (ValueError, KeyError, IndexError) as error:
        raise UsageError(f"not a scene of matt surfaces as the kit writes them: {error}") from error


# The scene in Mitsuba's XML. Its meshes are files beside it.


def _xml_vector(numbers: tuple[float, ...]) -> str:
    return ", ".join(f"{number:.9g}" for number in numbers)


def obj_text(shape: MattShape) -> str:
    """A mesh."""
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in shape.corners]
    triples = zip(*[iter(shape.indices)] * 3, strict=True)
    return "\n".join([*lines, *(f"f {a + 1} {b + 1} {c + 1}" for a, b, c in triples)]) + "\n"


def _xml_shape(shape: MattShape, number: int) -> Iterator[str]:
    if shape.ball is not None:
        middle, radius = shape.ball
        yield '<shape type="sphere">'
        yield f'<point name="center" value="{_xml_vector(middle)}"/><float name="radius" value="{radius:.9g}"/>'
    else:
        yield '<shape type="obj"><boolean name="face_normals" value="true"/>'
        yield f'<string name="filename" value="{number}.obj"/>'
    color = f'<rgb name="reflectance" value="{_xml_vector(shape.reflectance)}"/>'
    yield f'<bsdf type="twosided"><bsdf type="diffuse">{color}</bsdf></bsdf>'
    if shape.emission is not None:
        yield f'<emitter type="area"><rgb name="radiance" value="{_xml_vector(shape.emission)}"/></emitter>'
    yield "</shape>"


# Roulette begins after as many hits as in step 13.
_INTEGRATOR = '<integrator type="path"><integer name="max_depth" value="-1"/><integer name="rr_depth" value="4"/>'
_PIXEL = '<rfilter type="box"/><string name="pixel_format" value="rgb"/>'


def mitsuba_xml(scene: MattScene, size: int, sampler: str) -> str:
    """The whole file, for a square picture."""
    eye, target, up = (_xml_vector(scene.view[at : at + 3]) for at in (0, 3, 6))
    look = f'<lookat origin="{eye}" target="{target}" up="{up}"/>'
    lines = ['<scene version="3.0.0">', f"{_INTEGRATOR}</integrator>", '<sensor type="perspective">']
    lines += [f'<float name="fov" value="{scene.angle:.9g}"/><transform name="to_world">{look}</transform>']
    side = f'<integer name="width" value="{size}"/><integer name="height" value="{size}"/>'
    lines += [f'<sampler type="{sampler}"/>', f'<film type="hdrfilm">{side}{_PIXEL}</film></sensor>']
    if scene.sky is not None:
        sky = f'<rgb name="radiance" value="{_xml_vector(scene.sky)}"/>'
        lines.append(f'<emitter type="constant">{sky}</emitter>')
    for number, shape in enumerate(scene.shapes):
        lines += _xml_shape(shape, number)
    return "\n".join([*lines, "</scene>"]) + "\n"


# Typed into the other Python: a picture as PFM, and the seconds of the processor that its paths took. A picture of one
# sample warms up.
_JOB = """
import sys, time
import drjit, mitsuba
scene, picture, samples, seed = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
mitsuba.set_variant("scalar_rgb")
drjit.set_thread_count(1)
loaded = mitsuba.load_file(scene)
mitsuba.render(loaded, spp=1, seed=seed)
start = time.process_time()
light = mitsuba.render(loaded, spp=samples, seed=seed)
seconds = time.process_time() - start
mitsuba.Bitmap(light).write(picture)
print(mitsuba.__version__, seconds)
"""


def read_pfm(data: bytes) -> Light:
    """A picture in colours, as Mitsuba writes it: rows from below, little-endian floats."""
    kind, sides, order, rest = data.split(b"\n", 3)
    width, height = map(int, sides.split())
    if kind != b"PF" or float(order) >= 0.0 or len(rest) != 12 * width * height:
        raise GraderFault("expected a PFM of three little-endian floats a pixel")
    light: Light = np.frombuffer(rest, dtype="<f4").reshape(height, width, 3)[::-1].astype(np.float64)
    return light


# The race.

# What Mitsuba takes without being told, and what stratifies every number along a path. The first one is compared with.
_SAMPLERS = ("multijitter", "independent")
_TREES = ("bvh", "wide")

_STEP = "15"  # Mitsuba's integrator weighs lamps that are met and sampled, too
_MAX_DIFFERENCE = 0.01  # of the mean light
_BLOCK = 16  # pixels
_MAX_OF_BLOCKS = 0.05


@dataclass(frozen=True)
class MitsubaOptions:
    """What `bench mitsuba` was asked for."""

    python: Path | None
    scenes: list[Path]
    size: int = 128
    samples: int = 64
    rounds: int = 6


@dataclass(frozen=True)
class _Shot:
    light: Light
    seconds: float


Runner = Callable[[int], _Shot]  # of a picture with that seed


def _mitsuba(python: Path, folder: Path, sampler: str, samples: int, seed: int) -> _Shot:
    outcome, _ = run_pinned([python, "-c", _JOB, f"{sampler}.xml", "picture.pfm", str(samples), str(seed)], folder)
    return _Shot(read_pfm((folder / "picture.pfm").read_bytes()), float(outcome.stdout.split()[-1]))


def _raytrace(programs: Programs, scene: Path, folder: Path, tree: str, options: MitsubaOptions, seed: int) -> _Shot:
    """The whole process: reading and building are thousandths of it."""
    words: list[str | Path] = [programs.raytrace, scene, "-o", "picture.ppm", "--estimates", "estimates", "--quiet"]
    words += ["--step", _STEP, "--filter", "box", "--threads", "1", "--accel", tree, "--seed", str(seed)]
    words += ["--size", f"{options.size}x{options.size}", "--samples", str(options.samples)]
    _, seconds = run_pinned(words, folder)
    return _Shot(read_estimates((folder / "estimates").read_bytes()).mean, seconds)


def _blocks(light: Light) -> Light:
    side = min(_BLOCK, *light.shape[:2])
    rows, columns = light.shape[0] // side, light.shape[1] // side
    means: Light = light[: rows * side, : columns * side].reshape(rows, side, columns, side, 3).mean(axis=(1, 3))
    return means


def refuse_another_scene(ours: Light, theirs: Light, scene: str) -> None:
    """Of the means of all rounds: both programs must have drawn the same light in the same places."""
    whole = abs(float(ours.mean() / theirs.mean()) - 1.0)
    blocks = float(np.abs(_blocks(ours) - _blocks(theirs)).mean() / theirs.mean())
    if not (whole <= _MAX_DIFFERENCE and blocks <= _MAX_OF_BLOCKS):
        raise GraderFault(
            f"{scene}: not the same picture: the mean light differs by {whole:.1%}, blocks by {blocks:.1%}"
        )


def _path_times(name: str, shots: list[_Shot]) -> PathTimes:
    """The variance of a pixel is that between the rounds, whose seeds are different."""
    lights = np.stack([shot.light for shot in shots])
    variance = float(lights.var(axis=0, ddof=1).mean())
    return PathTimes(name, Spread.of([shot.seconds for shot in shots]), variance, float(lights.mean()))


def _race(programs: Programs, python: Path, scene: Path, options: MitsubaOptions) -> MitsubaRow:
    matt = read_matt(scene.read_text(encoding="utf-8"))
    with tempfile.TemporaryDirectory(prefix="raysteps-mitsuba-") as name:
        folder = Path(name)
        for number, shape in enumerate(matt.shapes):
            if shape.corners:
                (folder / f"{number}.obj").write_text(obj_text(shape), encoding="utf-8")
        runners: dict[str, Runner] = {}
        for sampler in _SAMPLERS:
            (folder / f"{sampler}.xml").write_text(mitsuba_xml(matt, options.size, sampler), encoding="utf-8")
            runners[f"mitsuba {sampler}"] = partial(_mitsuba, python, folder, sampler, options.samples)
        for tree in _TREES:
            runners[f"raytrace {tree}"] = partial(_raytrace, programs, scene.resolve(), folder, tree, options)
        shots: dict[str, list[_Shot]] = {runner: [] for runner in runners}
        for seed in range(1, options.rounds + 1):
            for runner, draw in runners.items():
                shots[runner].append(draw(seed))
    theirs, *ours = (np.mean([shot.light for shot in drawn], axis=0) for drawn in shots.values())
    for light in ours:
        refuse_another_scene(light, theirs, scene.name)
    return MitsubaRow(scene.stem, [_path_times(runner, drawn) for runner, drawn in shots.items()])


def time_ratio(theirs: PathTimes, ours: PathTimes) -> float:
    """How many times the peer's time the other one takes to the same error, which falls with the root of the time."""
    return float(ours.seconds.median * ours.variance / (theirs.seconds.median * theirs.variance))


def _print(rows: list[MitsubaRow], console: Console) -> None:
    headings = ("scene", "program", "seconds", "quartiles", "variance", "mean light", "time for one error")
    table = terminal_table("paths beside Mitsuba's, one thread each", headings)
    for row in rows:
        for number, side in enumerate(row.programs):
            table.add_row(
                escape(row.scene) if number == 0 else "",
                side.program,
                median(side.seconds, 3, " s"),
                quartiles(side.seconds, 3),
                f"{side.variance:.3g}",
                f"{side.mean:.5f}",
                f"{time_ratio(row.programs[0], side):.2f} x" if number else "",
                end_section=side is row.programs[-1],
            )
    console.print(table)


def _version(python: Path) -> str:
    """Of the Mitsuba that this Python has."""
    outcome = run([python, "-c", "import mitsuba; print(mitsuba.__version__)"], seconds=120)
    if outcome.code != 0:
        raise UsageError(f"--python {python}: has no Mitsuba\n{HOW_TO_GET_IT}")
    return outcome.stdout.strip()


def bench_mitsuba(project: Project, options: MitsubaOptions, console: Console) -> int:
    """Measures, prints a table and writes build/bench/mitsuba.json."""
    if options.python is None:
        raise UsageError(f"--python is missing\n{HOW_TO_GET_IT}")
    python = options.python.absolute()
    if not python.is_file():
        raise UsageError(f"--python {options.python}: is not there\n{HOW_TO_GET_IT}")
    if math.isqrt(options.samples) ** 2 != options.samples:
        raise UsageError(f"--samples {options.samples}: expected a square number, like 64")
    lessons = project.scenes / "lessons"
    scenes = checked(options.scenes) or [lessons / "cornell.pbrt", lessons / "open-sky.pbrt"]
    version = _version(python)
    with console.status("building the benchmarks"):
        programs = portable(project)
    rows = []
    for scene in scenes:
        with console.status(f"Mitsuba and raytrace in turns: {escape(scene.name)}"):
            rows.append(_race(programs, python, scene, options))
    _print(rows, console)
    numbers = MitsubaNumbers(
        machine=programs.machine, version=version, size=options.size, samples=options.samples, rows=rows
    )
    keep(project, numbers, console)
    return 0
