"""A flat scene in POV-Ray's language, so that both programs follow the same rays through the same shapes."""

import math
from collections.abc import Iterator

from raysteps.common.errors import UsageError
from raysteps.upkeep.bench.flat_scene import FlatScene, Numbers, Shape

Vector = tuple[float, float, float]


def _minus(a: Numbers, b: Numbers) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _cross(a: Numbers, b: Numbers) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _scaled(a: Numbers, length: float) -> Vector:
    factor = length / math.hypot(*a[:3])
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def _vector(numbers: Numbers) -> str:
    return "<" + ",".join(f"{number:.9g}" for number in numbers[:3]) + ">"


def _camera(view: dict[str, Numbers]) -> str:
    """`angle` spans a square picture from edge to edge in both programs; right and up are its sides at distance 1."""
    forward = _scaled(_minus(view["at"], view["from"]), 1.0)
    side = 2.0 * math.tan(math.radians(view["angle"][0]) / 2.0)
    right = _scaled(_cross(forward, view["up"]), side)
    up = _scaled(_cross(right, forward), side)
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
