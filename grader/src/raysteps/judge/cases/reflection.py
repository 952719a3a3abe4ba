"""Cases of step 05: reflected rays, and what they bring."""

from collections.abc import Sequence

from raysteps.common.vectors import Vector, add, dot, length, minus, times
from raysteps.judge.answers import Answer, angle, channels, first, plainly_wrong
from raysteps.judge.functions import Function, Group
from raysteps.judge.hits import REFLECTED_RAY
from raysteps.judge.protocol import Hit, Inputs, Ray, Whole, rounded
from raysteps.judge.random_source import RandomSource, next_axis
from raysteps.judge.scripted_tracer import Script, ScriptedHit, TracedCall, read_traced, traced_words

# Cases of step 05: what a ray brings from mirror to mirror.

_DEGREES = 0.5
_AT_THE_HIT = 0.5  # a bounced ray that starts farther away from the hit was not made by reflected_ray
_HEAD_ON = 0.9999  # cosine


def _script(inputs: Inputs) -> Script:
    script = inputs["tracer"]
    assert isinstance(script, Script)
    return script


def _met_head_on(inputs: Inputs) -> bool:
    """Whether the first hit sends the ray straight back."""
    ray, hits = inputs["ray"], _script(inputs).hits
    assert isinstance(ray, Ray)
    return bool(hits) and abs(dot(ray.direction, hits[0].normal)) > _HEAD_ON


def _is_astray(inputs: Inputs, expected: Sequence[Ray], actual: Sequence[Ray]) -> bool:
    """Where exactly a bounced ray starts is reflected_ray's matter, and so is its direction where that is not simple: a
    mistake there alone must not make all of trace wrong. The hits lie on the rays that were really cast."""
    same = [angle(mine.direction, theirs.direction) <= _DEGREES for mine, theirs in zip(expected, actual, strict=True)]
    if not same[0] or not length(minus(expected[0].origin, actual[0].origin)) <= 1e-3:
        return True
    for before, after, hit in zip(actual, actual[1:], _script(inputs).hits, strict=False):
        position = add(before.origin, before.direction, hit.distance)
        if not length(minus(after.origin, position)) <= _AT_THE_HIT:
            return True
    return _met_head_on(inputs) and not all(same)


def _trace_problems(inputs: Inputs, expected: TracedCall, actual: TracedCall) -> tuple[str, ...]:
    counts = ""
    if len(actual.cast) != len(expected.cast):
        counts = f"too {'many' if len(actual.cast) > len(expected.cast) else 'few'} rays were cast"
    astray = not counts and bool(expected.cast) and _is_astray(inputs, expected.cast, actual.cast)
    shaded = sorted(expected.shaded) == sorted(actual.shaded)
    return (
        counts,
        plainly_wrong("a ray that was cast") if astray else "",
        channels("the colour", expected.color, actual.color),
        "" if shaded else "direct_lighting was asked for other hits, or with another depth",
    )


def _trace_credit(inputs: Inputs, expected: TracedCall, actual: TracedCall) -> float:
    """The right rays and lights with a wrong colour, or the other way round, are half of it. A quarter are the right
    rays alone, where one is mirrored, or rays and lights that are right as far as they go."""
    counts, astray, color, shaded = _trace_problems(inputs, expected, actual)
    cast = len(expected.cast) > 1 and not (counts or astray)
    if (cast and not shaded) or not color:
        return 0.5
    lit = bool(actual.shaded) and set(actual.shaded) <= set(expected.shaded)
    begun = lit and 0 < len(actual.cast) <= len(expected.cast)
    right_so_far = begun and not _is_astray(inputs, expected.cast[: len(actual.cast)], actual.cast)
    return 0.25 if cast or right_so_far else 0.0


def _scripted(draw: RandomSource, count: int, low: float, high: float) -> tuple[ScriptedHit, ...]:
    """ks between low and high."""
    distances = [float(i + 1) + draw.real(0.1, 0.8) for i in range(count)]
    return tuple(
        ScriptedHit(distance, draw.direction(), draw.real(low, high), draw.color(0.05, 1.0)) for distance in distances
    )


def _trace(draw: RandomSource, hits: tuple[ScriptedHit, ...], depth: int, most: int) -> Inputs:
    ray = Ray(draw.point(3), draw.direction())
    return {"ray": ray, "depth": Whole(depth), "tracer": Script(most, draw.color(0.2, 0.9), hits)}


def _mirror_and_dull(draw: RandomSource) -> Inputs:
    """Some mirrors, then something dull or nothing; or a dull thing at once."""
    if draw.chance(0.25):
        return _trace(draw, _scripted(draw, 1, 0.0, 0.0), 1, 6)
    hits = _scripted(draw, draw.whole(1, 3), 0.2, 0.9)
    end = _scripted(draw, 4, 0.0, 0.0)[3:] if draw.chance(0.6) else ()
    return _trace(draw, hits + end, 1, 6)


def _simple_trace(draw: RandomSource) -> Inputs:
    """One hit straight ahead, ks 0.5, and perhaps a dull one behind."""
    down: Vector = (0.0, 0.0, -1.0)
    mirror = ScriptedHit(5.0, (0.0, 0.0, 1.0), 0.5, draw.color())
    dull = ScriptedHit(3.0, (0.0, 0.0, -1.0), 0.0, draw.color())
    hits = (mirror, dull) if draw.chance(0.7) else (mirror,)
    return {"ray": Ray((0.0, 0.0, 5.0), down), "depth": Whole(1), "tracer": Script(5, draw.color(), hits)}


def _depth_limit(draw: RandomSource) -> Inputs:
    """More mirrors than the limit lets a ray see."""
    most = draw.whole(1, 5)
    return _trace(draw, _scripted(draw, most + 2, 0.3, 0.9), 1, most)


def _deepest(draw: RandomSource) -> Inputs:
    """The depth at the start is the last that counts."""
    most = draw.whole(1, 6)
    return _trace(draw, _scripted(draw, 2, 0.3, 0.9), most, most)


def _too_deep(draw: RandomSource) -> Inputs:
    most = draw.whole(1, 6)
    return _trace(draw, _scripted(draw, 2, 0.3, 0.9), most + draw.whole(1, 3), most)


def _faint(draw: RandomSource) -> Inputs:
    """Any ks above 0 is a mirror, and so is a whole one."""
    low, high = (0.001, 0.01) if draw.chance(0.5) else (1.0, 1.0)
    return _trace(draw, _scripted(draw, draw.whole(1, 3), low, high), 1, 5)


def _corridor(draw: RandomSource) -> Inputs:
    """Very many mirrors in a row; the last rays miss, or the limit ends them."""
    return _trace(draw, _scripted(draw, draw.whole(12, 20), 0.8, 0.95), 1, draw.whole(10, 25))


TRACE = Function(
    "trace",
    Answer(
        read_traced,
        traced_words,
        lambda inputs, expected, actual: first(*_trace_problems(inputs, expected, actual)),
        _trace_credit,
    ),
    (
        Group("mirrors and what they show", _mirror_and_dull),
        Group("simple numbers", _simple_trace),
        Group("dull surfaces", lambda d: _trace(d, _scripted(d, d.whole(1, 3), 0.0, 0.0), 1, 5)),
        Group("a miss", lambda d: _trace(d, (), 1, 5)),
        Group("the depth limit", _depth_limit),
        Group("the deepest ray", _deepest),
        Group("faint mirrors and whole ones", _faint),
        Group("many mirrors", _corridor),
        Group("no depth at all", lambda d: _trace(d, _scripted(d, 1, 0.3, 0.9), 1, 0)),
        Group("a bounced ray that misses", lambda d: _trace(d, (), d.whole(2, 4), 5)),
        Group("beyond the limit", _too_deep),
    ),
)


def _hit(draw: RandomSource, low: float = 0.15, high: float = 1.0, reach: float = 3.0) -> Inputs:
    """A mirror may be met from its back, and be of anything: neither matters."""
    normal = draw.direction()
    direction = rounded(times(-1.0, draw.above(normal, low, high)))
    position = draw.point(reach)
    return {"hit": Hit(position, normal, direction, draw.real(0.5, 20), draw.fill(), draw.chance(0.6))}


def _simple_hit(draw: RandomSource) -> Inputs:
    normal = draw.axis()
    side = next_axis(normal)
    straight = draw.chance(0.4)
    direction = times(-1.0, normal) if straight else rounded(add(times(-0.8, normal), side, 0.6))
    return {"hit": Hit(draw.simple_point(3), normal, direction)}


def _far_hit(draw: RandomSource) -> Inputs:
    normal = draw.direction()
    position = rounded(add((100.0, -100.0, 100.0), draw.point(3)))
    return {"hit": Hit(position, normal, rounded(times(-1.0, draw.above(normal, 0.3))))}


def _head_on(draw: RandomSource) -> Inputs:
    normal = draw.axis() if draw.chance(0.3) else draw.direction()
    return {"hit": Hit(draw.point(3), normal, times(-1.0, normal))}


_REFLECTED_RAY = Function(
    "reflected_ray",
    REFLECTED_RAY,
    (
        Group("any hit", _hit),
        Group("simple numbers", _simple_hit),
        Group("at a grazing angle", lambda d: _hit(d, 0.06, 0.15)),
        Group("far from the centre of the world", _far_hit),
        Group("head-on", _head_on),
        Group("almost along the surface", lambda d: _hit(d, 0.02, 0.06)),
    ),
)

FUNCTIONS = (_REFLECTED_RAY, TRACE)
