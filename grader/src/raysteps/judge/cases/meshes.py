"""Cases of step 11."""

import math
from dataclasses import dataclass, replace

from raysteps.common.vectors import Vector, add, cross, dot, length, minus, times, unit
from raysteps.judge.answers import (
    Answer,
    Tolerance,
    channels,
    direction,
    first,
    itself,
    number_answer,
    plainly_wrong,
    read_vector,
    read_whole,
    real,
    vector,
    words_of_number,
    words_of_vector,
)
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import (
    Corner,
    Face,
    Hit,
    Inputs,
    Pyramid,
    Real,
    Texture,
    TokenReader,
    Vec,
    Vec2,
    Whole,
    f32,
    rounded,
    text,
)
from raysteps.judge.random_source import RandomSource, circle
from raysteps.judge.surfaces import Triangle

# Faces, and places in them.

_Pair = tuple[float, float]
_EVEN: Vector = (0.25, 0.25, 0.5)


def _flat_normal(t: Triangle) -> Vector:
    return unit(cross(minus(t.b, t.a), minus(t.c, t.a)))


def _uv(draw: RandomSource) -> _Pair:
    return draw.real(-1, 2), draw.real(-1, 2)


def _face(draw: RandomSource, *, steepest: float = 0.75) -> Face:
    """The normals lean this way and that, by at most that cosine."""
    t = draw.triangle()
    normal = _flat_normal(t)
    a, b, c = (Corner(at, draw.above(normal, steepest, 0.97), _uv(draw)) for at in (t.a, t.b, t.c))
    return Face(a, b, c)


def _simple_face() -> Face:
    up = (0.0, 0.0, 1.0)
    return Face(
        Corner((0.0, 0.0, 0.0), up, (0.0, 0.0)),
        Corner((4.0, 0.0, 0.0), up, (1.0, 0.0)),
        Corner((0.0, 4.0, 0.0), up, (0.0, 1.0)),
    )


def _weights(draw: RandomSource, low: float = 0.05) -> Vector:
    b = draw.fine(low, 1 - 2 * low)
    c = draw.fine(low, 1 - low - b)
    return rounded((1 - b - c, b, c))


def _place(face: Face, weights: Vector) -> Vector:
    a, b, c = face.a.position, face.b.position, face.c.position
    return rounded(add(add(times(weights[0], a), b, weights[1]), c, weights[2]))


def _corner_weights(draw: RandomSource) -> Vector:
    return ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))[draw.whole(0, 2)]


# Weights.


def _barycentric(face: Face, weights: Vector) -> Inputs:
    return {"face": face, "point": Vec(_place(face, weights))}


def _moved(draw: RandomSource) -> Inputs:
    """Far from the point 0, where only differences of positions help."""
    off = times(40, draw.direction())
    face = _face(draw)
    a, b, c = (replace(corner, position=rounded(add(corner.position, off))) for corner in (face.a, face.b, face.c))
    return _barycentric(Face(a, b, c), _weights(draw))


def _upright(draw: RandomSource) -> Inputs:
    """All of it as far along one of the axes: seen along another one, it is a line."""
    number, level = draw.whole(0, 2), draw.real(-3, 3)

    def moved(at: Vector) -> Vector:
        x, y, z = (level if i == number else part for i, part in enumerate(at))
        return x, y, z

    def make() -> Triangle:
        t = draw.triangle()
        return Triangle(moved(t.a), moved(t.b), moved(t.c))

    t = draw.until(lambda t: length(cross(minus(t.b, t.a), minus(t.c, t.a))) > 2, make)
    a, b, c = (Corner(at, draw.direction(), _uv(draw)) for at in (t.a, t.b, t.c))
    return _barycentric(Face(a, b, c), _weights(draw))


def _on_edge(draw: RandomSource) -> Inputs:
    share, turn = draw.fine(0.1, 0.9), draw.whole(0, 2)
    shares = (share, 1 - share, 0.0)
    return _barycentric(_face(draw), (shares[turn], shares[(turn + 1) % 3], shares[(turn + 2) % 3]))


_BARYCENTRIC = Function(
    "barycentric",
    Answer(
        read_vector,
        words_of_vector,
        lambda _, e, a: vector("the weights", e, a, Tolerance(5e-4, 0)),
        near=itself,
    ),
    (
        Group("any point", lambda d: _barycentric(_face(d), _weights(d))),
        Group("upright", _upright),
        Group("simple numbers", lambda d: _barycentric(_simple_face(), _EVEN)),
        Group("a corner", lambda d: _barycentric(_face(d), _corner_weights(d))),
        Group("on an edge", _on_edge),
        Group("far away", _moved),
    ),
)

# Normals.


def _blend(face: Face, weights: Vector) -> Vector:
    return add(add(times(weights[0], face.a.normal), face.b.normal, weights[1]), face.c.normal, weights[2])


def _hit_of(face: Face, weights: Vector, ray: Vector, distance: float = 4.0) -> Hit:
    """The flat triangle's, whose normal is turned to where the ray came from."""
    flat = _flat_normal(Triangle(face.a.position, face.b.position, face.c.position))
    side = -1.0 if dot(flat, ray) > 0 else 1.0
    return Hit(_place(face, weights), rounded(times(side, flat)), ray, distance)


def _shading(face: Face, weights: Vector, ray: Vector) -> Inputs:
    return {"face": face, "weights": Vec(weights), "hit": _hit_of(face, weights, ray)}


def _any_normal(draw: RandomSource) -> Inputs:
    face, weights = _face(draw), _weights(draw)
    flat = _flat_normal(Triangle(face.a.position, face.b.position, face.c.position))
    seen = draw.until(lambda up: dot(up, flat) > 0.1, lambda: draw.above(unit(_blend(face, weights)), 0.35))
    return _shading(face, weights, rounded(times(-1, seen)))


def _normal_of_corner(draw: RandomSource) -> Inputs:
    face = _face(draw)
    return _shading(face, (0.0, 1.0, 0.0), rounded(times(-1, draw.above(face.b.normal, 0.9))))


def _turned_away(draw: RandomSource) -> Inputs:
    """The flat triangle is seen, the blend points away from the viewer, by some degrees at least."""

    def make() -> Inputs:
        face, weights = _face(draw, steepest=0.5), _weights(draw)
        flat = _flat_normal(Triangle(face.a.position, face.b.position, face.c.position))
        return _shading(face, weights, rounded(times(-1, draw.above(flat, 0.04, 0.3))))

    def is_turned(inputs: Inputs) -> bool:
        face, weights, hit = inputs["face"], inputs["weights"], inputs["hit"]
        assert isinstance(face, Face)
        assert isinstance(weights, Vec)
        assert isinstance(hit, Hit)
        return 0.08 < dot(unit(_blend(face, weights.value)), hit.ray_direction) < 0.8

    return draw.until(is_turned, make)


def _seen_from_the_side(draw: RandomSource) -> Inputs:
    """The blend is nearly at right angles to the ray, and not turned away."""
    face, weights = _face(draw), _weights(draw)
    blend, flat = unit(_blend(face, weights)), _flat_normal(Triangle(face.a.position, face.b.position, face.c.position))
    seen = draw.until(lambda up: dot(up, flat) > 0.02, lambda: draw.above(blend, 0.02, 0.12))
    return _shading(face, weights, rounded(times(-1, seen)))


def _short_blend(draw: RandomSource) -> Inputs:
    """Normals far apart: their blend is much shorter than 1."""
    face, normal = _simple_face(), (0.0, 0.0, 1.0)
    a, b, c = (replace(corner, normal=draw.above(normal, 0.25, 0.6)) for corner in (face.a, face.b, face.c))
    return _shading(Face(a, b, c), _EVEN, rounded(times(-1, draw.above(normal, 0.95))))


def _very_short_blend(draw: RandomSource) -> Inputs:
    """Two normals that nearly cancel each other out; what is left is a hundredth or less, and points to the viewer."""
    face, across = _simple_face(), (*circle(draw.fine(0, 1)), 0.0)
    left = times(draw.logarithmic(2e-3, 8e-3), draw.above((0.0, 0.0, 1.0), 0.7, 0.95))
    a, b = (
        replace(corner, normal=rounded(unit(add(left, across, sign))))
        for corner, sign in ((face.a, 1.0), (face.b, -1.0))
    )
    return _shading(Face(a, b, face.c), (0.5, 0.5, 0.0), (0.0, 0.0, -1.0))


def _nothing_left(draw: RandomSource) -> Inputs:
    """The normals cancel each other out, or the mesh has none."""
    face = _simple_face()
    normal = draw.axis() if draw.chance(0.5) else (0.0, 0.0, 0.0)
    a, b = replace(face.a, normal=normal), replace(face.b, normal=times(-1, normal))
    weights = (0.5, 0.5, 0.0)
    ray = rounded(unit((draw.eighths(-1, 1), draw.eighths(-1, 1), -1.0)))
    return _shading(Face(a, b, face.c), weights, ray)


def _normal_problem(inputs: Inputs, expected: Vector, actual: Vector) -> str:
    hit = inputs["hit"]
    assert isinstance(hit, Hit)
    if dot(actual, hit.ray_direction) > 1e-3:
        return "the normal is turned away from the viewer"
    return direction("the normal", expected, actual)


_NORMAL = Function(
    "shading_normal",
    Answer(read_vector, words_of_vector, _normal_problem, near=itself),
    (
        Group("any place", _any_normal),
        Group("a corner", _normal_of_corner),
        Group("turned away from the viewer", _turned_away),
        Group("a short blend", _short_blend),
        Group("a very short blend", _very_short_blend),
        Group("seen from the side", _seen_from_the_side),
        Group("nothing left", _nothing_left, exact=True),
    ),
)

# Positions.


def _curved(face: Face, weights: Vector) -> Inputs:
    return {"face": face, "weights": Vec(weights), "point": Vec(_place(face, weights))}


def _bulge(draw: RandomSource, way: float) -> Inputs:
    """All normals lean outwards, so that the whole triangle is below every plane, or inwards."""
    t = draw.triangle()
    normal = _flat_normal(t)
    middle = times(1 / 3, add(add(t.a, t.b), t.c))

    def lean(at: Vector) -> Vector:
        return rounded(unit(add(normal, unit(minus(at, middle)), way * draw.fine(0.2, 0.9))))

    a, b, c = (Corner(at, lean(at)) for at in (t.a, t.b, t.c))
    return _curved(Face(a, b, c), _weights(draw))


_CURVED = Function(
    "curved_position",
    Answer(
        read_vector,
        words_of_vector,
        lambda _, e, a: vector("the position", e, a, Tolerance(1e-3, 2e-4)),
        near=itself,
    ),
    (
        Group("any place", lambda d: _curved(_face(d), _weights(d))),
        Group("bulging out", lambda d: _bulge(d, 1.0)),
        Group("hollow", lambda d: _bulge(d, -1.0)),
        Group("flat", lambda d: _curved(_simple_face(), _weights(d))),
        Group("a corner", lambda d: _curved(_face(d), _corner_weights(d))),
    ),
)

# Places in textures.


def _read_pair(tokens: TokenReader) -> _Pair:
    return tokens.real(), tokens.real()


def _words_of_pair(pair: _Pair) -> str:
    return f"({text(pair[0])}, {text(pair[1])})"


_COORDINATES = Function(
    "texture_coordinates",
    Answer(
        _read_pair,
        _words_of_pair,
        lambda _, e, a: first(real("u", e[0], a[0]), real("v", e[1], a[1])),
    ),
    (
        Group("any place", lambda d: {"face": _face(d), "weights": Vec(_weights(d))}),
        Group("a corner", lambda d: {"face": _face(d), "weights": Vec(_corner_weights(d))}),
        Group("simple numbers", lambda d: {"face": _simple_face(), "weights": Vec(_EVEN)}),
    ),
)

_REPEAT, _CLAMP = range(2)  # as in core/texture.hpp


def _wrap(draw: RandomSource, low: float, high: float, wrap: int | None = None) -> Inputs:
    """Between those multiples of the size."""
    size = draw.whole(2, 300)
    texel = draw.whole(math.ceil(low * size), math.floor(high * size) - 1)
    return {"texel": Whole(texel), "size": Whole(size), "wrap": Whole(draw.whole(0, 1) if wrap is None else wrap)}


def _one_texel(draw: RandomSource) -> Inputs:
    return {"texel": Whole(draw.whole(-5, 5)), "size": Whole(1), "wrap": Whole(draw.whole(0, 1))}


def _at_border(draw: RandomSource) -> Inputs:
    size = draw.whole(2, 64)
    texel = (-1, 0, size - 1, size, -size, -size - 1, 2 * size)[draw.whole(0, 6)]
    return {"texel": Whole(texel), "size": Whole(size), "wrap": Whole(draw.whole(0, 1))}


_WRAP = Function(
    "wrap_texel",
    Answer(read_whole, words_of_number, lambda _, e, a: "" if e == a else "it is another texel"),
    (
        Group("inside and around", lambda d: _wrap(d, -1, 2), exact=True),
        Group("repeat, to the right", lambda d: _wrap(d, 1, 9, _REPEAT), exact=True),
        Group("repeat, to the left", lambda d: _wrap(d, -9, 0, _REPEAT), exact=True),
        Group("clamp", lambda d: _wrap(d, -3, 4, _CLAMP), exact=True),
        Group("at the border", _at_border, exact=True),
        Group("one texel", _one_texel, exact=True),
    ),
)

# Looking up.

_LIGHT = Answer(
    read_vector,
    words_of_vector,
    lambda _, e, a: channels("the colour", e, a, Tolerance(2e-3, 1e-3)),
    near=itself,
)


def _texture(draw: RandomSource, width: int, height: int) -> Texture:
    return Texture(width, tuple(draw.color(0, 1) for _ in range(width * height)))


def _look(texture: Texture, uv: _Pair, wrap: int) -> Inputs:
    return {"texture": texture, "uv": Vec2((f32(uv[0]), f32(uv[1]))), "wrap": Whole(wrap)}


def _any_look(draw: RandomSource, low: float = 0.0, high: float = 1.0) -> Inputs:
    texture = _texture(draw, draw.whole(3, 6), draw.whole(2, 5))
    return _look(texture, (draw.fine(low, high), draw.fine(low, high)), draw.whole(0, 1))


def _middle(draw: RandomSource) -> Inputs:
    """Of a texel: its own colour and nobody else's."""
    texture = _texture(draw, 4, 2)
    return _look(texture, ((draw.whole(0, 3) + 0.5) / 4, (draw.whole(0, 1) + 0.5) / 2), draw.whole(0, 1))


def _outer_half(draw: RandomSource) -> Inputs:
    """Between the border and the middle of the texels there."""
    texture = _texture(draw, draw.whole(2, 5), draw.whole(2, 5))
    u = draw.fine(0.02, 0.45) / texture.width
    v = 1 - draw.fine(0.02, 0.45) / texture.height
    return _look(texture, (u, v) if draw.chance(0.5) else (v * 1.0, 0.5), draw.whole(0, 1))


def _single(draw: RandomSource) -> Inputs:
    return _look(_texture(draw, 1, 1), _uv(draw), draw.whole(0, 1))


_BILINEAR = Function(
    "bilinear",
    _LIGHT,
    (
        Group("inside", _any_look),
        Group("the middle of a texel", _middle),
        Group("at the border", _outer_half),
        Group("outside", lambda d: _any_look(d, -2, 3)),
        Group("one texel", _single),
    ),
)

# Pyramids.


@dataclass(frozen=True)
class _Levels:
    levels: tuple[Texture, ...]


def _read_levels(tokens: TokenReader) -> _Levels:
    levels = []
    for _ in range(tokens.whole(0, 64)):
        width, height = tokens.whole(1, 4096), tokens.whole(1, 4096)
        texels = tokens.reals(3 * width * height).reshape(-1, 3)
        levels.append(Texture(width, tuple((x, y, z) for x, y, z in texels.tolist())))
    return _Levels(tuple(levels))


def _words_of_levels(found: _Levels) -> str:
    sizes = ", ".join(f"{level.width} x {level.height}" for level in found.levels) or "none"
    return f"levels: {sizes}" + "".join(f"; {level.words()}" for level in found.levels[1:])


def _levels_problem(_inputs: Inputs, expected: _Levels, actual: _Levels) -> str:
    if len(actual.levels) != len(expected.levels):
        return plainly_wrong("the number of levels")
    for right, found in zip(expected.levels, actual.levels, strict=True):
        if (right.width, right.height) != (found.width, found.height):
            return "a level has the wrong size"
    for right, found in zip(expected.levels, actual.levels, strict=True):
        for texels in zip(right.texels, found.texels, strict=True):
            if problem := channels("a texel", *texels, Tolerance(1e-4, 1e-3)):
                return problem
    return ""


def _levels_right(_inputs: Inputs, expected: _Levels, actual: _Levels) -> float:
    """Sizes alone are worth something."""
    sizes = [[(level.width, level.height) for level in levels.levels] for levels in (expected, actual)]
    return 0.3 if sizes[0] == sizes[1] else 0.0


def _pyramid_of(draw: RandomSource, width: int, height: int) -> Inputs:
    return {"texture": _texture(draw, width, height)}


def _odd(draw: RandomSource) -> Inputs:
    return _pyramid_of(draw, 2 * draw.whole(1, 4) + 1, 2 * draw.whole(1, 4) + 1)


def _of_many_levels(draw: RandomSource) -> Inputs:
    long = draw.whole(65, 300)
    return _pyramid_of(draw, *((long, 1) if draw.chance(0.5) else (1, long)))


_BUILD = Function(
    "build_pyramid",
    Answer(_read_levels, _words_of_levels, _levels_problem, credit=_levels_right),
    (
        Group("any size", lambda d: _pyramid_of(d, d.whole(2, 9), d.whole(2, 9))),
        Group("powers of two", lambda d: _pyramid_of(d, 8, 8)),
        Group("odd sizes", _odd),
        Group("long and thin", lambda d: _pyramid_of(d, d.whole(5, 16), d.whole(1, 2))),
        Group("one texel", lambda d: _pyramid_of(d, 1, 1)),
        Group("many levels", _of_many_levels),
    ),
)

# Levels.


def _pixel(draw: RandomSource, face: Face, low: float, high: float = 0.99) -> Inputs:
    flat = _flat_normal(Triangle(face.a.position, face.b.position, face.c.position))
    ray = rounded(times(-draw.sign(), draw.above(flat, low, high)))
    return {
        "face": face,
        "texture_size": Vec2((float(draw.whole(16, 1024)), float(draw.whole(16, 1024)))),
        "hit": _hit_of(face, _EVEN, ray, draw.real(1, 50)),
        "pixel_angle": Real(draw.logarithmic(1e-4, 1e-2)),
    }


def _laid_out(draw: RandomSource) -> Face:
    """With an area in the texture that no rounding changes much."""

    def area(face: Face) -> float:
        (ax, ay), (bx, by), (cx, cy) = face.a.uv, face.b.uv, face.c.uv
        return abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))

    return draw.until(lambda face: area(face) > 0.1, lambda: _face(draw))


def _simple_pixel(draw: RandomSource) -> Inputs:
    ray = (0.0, 0.0, -1.0)
    return {
        "face": _simple_face(),
        "texture_size": Vec2((64.0, 64.0)),
        "hit": _hit_of(_simple_face(), _EVEN, ray, 8.0),
        "pixel_angle": Real(draw.whole(1, 16) / 64),
    }


def _without_area(draw: RandomSource) -> Inputs:
    """All corners at one place of the texture, or on a line of it."""
    inputs = _pixel(draw, _face(draw), 0.2)
    face = inputs["face"]
    assert isinstance(face, Face)
    a, b, c = (replace(corner, uv=(0.25 * i, 0.0)) for i, corner in enumerate((face.a, face.b, face.c)))
    return {**inputs, "face": Face(a, b, c) if draw.chance(0.5) else Face(a, replace(b, uv=a.uv), replace(c, uv=a.uv))}


_ACROSS = Function(
    "texels_across",
    number_answer("the number of texels", Tolerance(1e-4, 5e-3)),
    (
        Group("any pixel", lambda d: _pixel(d, _laid_out(d), 0.2)),
        Group("straight down", _simple_pixel),
        Group("flat", lambda d: _pixel(d, _laid_out(d), 0.05, 0.2)),
        Group("no area in the texture", _without_area, exact=True),
    ),
)


def _level(texels: float, levels: int) -> Inputs:
    return {"texels": Real(f32(texels)), "levels": Whole(levels)}


_NO_TEXELS = (0.0, 0.01, 0.3, 0.9, 1.0, math.nan)
_LEVEL = Function(
    "mip_level",
    number_answer("the level", Tolerance(1e-3, 1e-3)),
    (
        Group("between levels", lambda d: _level(d.logarithmic(1.2, 200), d.whole(9, 12))),
        Group("a power of two", lambda d: _level(2.0 ** d.whole(1, 8), d.whole(9, 12))),
        Group("less than a texel", lambda d: _level(_NO_TEXELS[d.whole(0, 5)], d.whole(1, 12)), exact=True),
        Group("beyond the last", lambda d: _level((300.0, 1e6, 1e30, math.inf)[d.whole(0, 3)], d.whole(1, 8))),
    ),
)


def _pyramid(draw: RandomSource) -> Pyramid:
    """Levels that have nothing to do with each other, so that none stands for another."""
    return Pyramid(tuple(_texture(draw, size, size) for size in (4, 2, 1)))


def _mixed(draw: RandomSource, level: float, low: float = 0.0, high: float = 1.0) -> Inputs:
    return {
        "pyramid": _pyramid(draw),
        "uv": Vec2((draw.real(low, high), draw.real(low, high))),
        "level": Real(f32(level)),
        "wrap": Whole(draw.whole(0, 1)),
    }


def _lonely(draw: RandomSource) -> Inputs:
    return {**_mixed(draw, 0.0), "pyramid": Pyramid((_texture(draw, 1, 1),))}


_TRILINEAR = Function(
    "trilinear",
    _LIGHT,
    (
        Group("between levels", lambda d: _mixed(d, d.fine(0.1, 0.9) + d.whole(0, 1))),
        Group("on a level", lambda d: _mixed(d, float(d.whole(0, 1))), exact=True),
        Group("the last level", lambda d: _mixed(d, 2.0), exact=True),
        Group("outside", lambda d: _mixed(d, d.fine(0.1, 0.9) + d.whole(0, 1), -1, 2)),
        Group("one level", _lonely, exact=True),
    ),
)

FUNCTIONS = (
    _BARYCENTRIC,
    _NORMAL,
    _CURVED,
    _COORDINATES,
    _WRAP,
    _BILINEAR,
    _BUILD,
    _ACROSS,
    _LEVEL,
    _TRILINEAR,
)
