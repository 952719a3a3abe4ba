"""Reads the inputs of a function back from the line that the worker reads."""

from collections.abc import Callable
from typing import Any

from raysteps.common.vectors import Vector
from raysteps.judge.functions import Function
from raysteps.judge.protocol import (
    Box,
    Camera,
    Corner,
    Face,
    Fill,
    Frame,
    Hit,
    Inputs,
    Light,
    Lights,
    PixelSample,
    PixelSamples,
    ProtocolError,
    Pyramid,
    Ray,
    Real,
    Texture,
    TokenReader,
    Vec,
    Vec2,
    Whole,
    f32,
)
from raysteps.judge.random_source import RandomSource
from raysteps.judge.scripted_tracer import (
    DirectSample,
    DirectSamples,
    MisHit,
    MisScript,
    PathHit,
    PathScript,
    PlateLamp,
    Scatter,
    Script,
    ScriptedHit,
    WeighedScatter,
)
from raysteps.judge.searches import BvhSource, Rays, RaySegment, RaySegments, TreeSource
from raysteps.judge.surfaces import ScriptedSurface, Sphere, Surface, Surfaces, Triangle

_MAX_ITEMS = 1000
_LOWEST = -1_000_000_000  # as the worker takes them
_HIGHEST = 1_000_000_000


class _Numbers:
    """Words as the worker understands them: float32."""

    def __init__(self, tokens: TokenReader) -> None:
        self._tokens = tokens
        self.flag = tokens.flag

    def real(self) -> float:
        return f32(self._tokens.real())

    def whole(self) -> int:
        return self._tokens.whole(_LOWEST, _HIGHEST)

    def vector(self) -> Vector:
        return self.real(), self.real(), self.real()

    def many(self, read: Callable[["_Numbers"], Any]) -> tuple[Any, ...]:
        return tuple(read(self) for _ in range(self._tokens.whole(0, _MAX_ITEMS)))


def _fill(n: _Numbers) -> Fill:
    return Fill(n.vector(), n.real(), n.real(), n.real(), n.real(), n.real())


def _ray(n: _Numbers) -> Ray:
    return Ray(n.vector(), n.vector())


def _light(n: _Numbers) -> Light:
    return Light(n.vector(), n.vector())


def _pixel_sample(n: _Numbers) -> PixelSample:
    return PixelSample((n.real(), n.real()), n.vector())


def _corner(n: _Numbers) -> Corner:
    return Corner(n.vector(), n.vector(), (n.real(), n.real()))


def _texture(n: _Numbers) -> Texture:
    width, height = n.whole(), n.whole()
    if width < 1 or not 0 < width * height <= _MAX_ITEMS:
        raise ProtocolError("the answer holds a number out of range")
    return Texture(width, tuple(n.vector() for _ in range(width * height)))


def _hit(n: _Numbers) -> Hit:
    position, fill, normal, direction = n.vector(), _fill(n), n.vector(), n.vector()
    return Hit(position, normal, direction, n.real(), fill, n.flag())


def _camera(n: _Numbers) -> Camera:
    return Camera(n.vector(), n.vector(), n.vector(), n.real(), n.whole(), n.whole(), n.vector())


def _frame(n: _Numbers) -> Frame:
    return Frame(n.vector(), n.vector(), n.vector(), n.real(), n.real())


def _surface(n: _Numbers) -> Surface:
    kind = n.whole()
    if kind in (0, 4):
        return Sphere(n.vector(), n.real(), glass=kind == 4)
    if kind == 1:
        return Triangle(n.vector(), n.vector(), n.vector())
    if kind in (2, 3):
        return ScriptedSurface(n.real() if kind == 2 else None)
    raise ProtocolError(f"there is no surface of kind {kind}")


def _scripted_hit(n: _Numbers) -> ScriptedHit:
    return ScriptedHit(n.real(), n.vector(), n.real(), n.vector())


def _scatter(n: _Numbers) -> Scatter:
    return Scatter(n.vector(), n.vector(), n.flag())


def _path_hit(n: _Numbers) -> PathHit:
    distance, normal, emission, front_face = n.real(), n.vector(), n.vector(), n.flag()
    return PathHit(distance, normal, emission, n.vector(), _scatter(n) if n.flag() else None, front_face)


def _direct_samples(n: _Numbers) -> DirectSamples:
    return DirectSamples(n.many(lambda m: DirectSample(m.vector(), m.real(), m.real())))


def _weighed(n: _Numbers) -> WeighedScatter:
    return WeighedScatter(_scatter(n), n.real())


def _mis_hit(n: _Numbers) -> MisHit:
    distance, normal, emission, front_face, light_pdf = n.real(), n.vector(), n.vector(), n.flag(), n.real()
    samples, scatter = _direct_samples(n), _weighed(n) if n.flag() else None
    exponent, lamps = n.real(), n.many(lambda m: PlateLamp(m.real(), m.real(), m.vector()))
    return MisHit(distance, normal, emission, front_face, light_pdf, samples, scatter, exponent, lamps)


_READERS: dict[type, Callable[[_Numbers], Any]] = {
    Real: lambda n: Real(n.real()),
    Whole: lambda n: Whole(n.whole()),
    Vec: lambda n: Vec(n.vector()),
    Ray: _ray,
    Camera: _camera,
    Frame: _frame,
    Fill: _fill,
    Light: _light,
    Lights: lambda n: Lights(n.many(_light)),
    PixelSamples: lambda n: PixelSamples(n.many(_pixel_sample)),
    Vec2: lambda n: Vec2((n.real(), n.real())),
    Face: lambda n: Face(_corner(n), _corner(n), _corner(n)),
    Texture: _texture,
    Pyramid: lambda n: Pyramid(n.many(_texture)),
    Hit: _hit,
    Box: lambda n: Box(n.vector(), n.vector()),
    Sphere: lambda n: Sphere(n.vector(), n.real(), _fill(n)),
    Triangle: lambda n: Triangle(n.vector(), n.vector(), n.vector(), _fill(n)),
    Surfaces: lambda n: Surfaces(n.many(_surface)),
    Script: lambda n: Script(n.whole(), n.vector(), n.many(_scripted_hit)),
    PathScript: lambda n: PathScript(n.vector(), n.flag(), n.many(_path_hit)),
    DirectSamples: _direct_samples,
    WeighedScatter: _weighed,
    MisScript: lambda n: MisScript(n.vector(), n.flag(), n.many(_mis_hit)),
    TreeSource: lambda n: TreeSource(n.flag()),
    BvhSource: lambda n: BvhSource(n.flag()),
    Rays: lambda n: Rays(n.many(_ray)),
    RaySegments: lambda n: RaySegments(n.many(lambda m: RaySegment(_ray(m), m.real()))),
}
_WITHOUT_FILL: dict[type, Callable[[_Numbers], Any]] = {
    Sphere: lambda n: Sphere(n.vector(), n.real()),
    Triangle: lambda n: Triangle(n.vector(), n.vector(), n.vector()),
}


def decode_inputs(function: Function, line: str) -> Inputs:
    """All cases of a function take the same kinds of values. Raises ProtocolError where the line does not fit them."""
    tokens = TokenReader(line)
    tokens.word()  # the number of the case
    name = tokens.word()
    if name != function.name:
        raise ProtocolError(f"expected a case of {function.name}, found {name[:100]}")
    numbers = _Numbers(tokens)
    inputs = {}
    for what, sample in function.groups[0].make(RandomSource("a sample")).items():
        bare = isinstance(sample, Sphere | Triangle) and sample.fill is None
        try:
            inputs[what] = (_WITHOUT_FILL if bare else _READERS)[type(sample)](numbers)
        except (ProtocolError, OverflowError) as error:
            raise ProtocolError(f"{what}: {str(error).replace('answer', 'line')}") from error
    if not tokens.at_end():
        raise ProtocolError("there are more numbers than the function takes")
    return inputs
