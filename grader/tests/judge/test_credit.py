"""What is partly right earns a part, and what is easily said earns nothing."""

import pytest

from raysteps.common.vectors import Vector, add, minus, times, unit
from raysteps.judge.answers import FARTHEST
from raysteps.judge.functions import Case, functions_of
from raysteps.judge.hits import hit_of
from raysteps.judge.protocol import Light, text
from raysteps.judge.random_source import RandomSource

pytestmark = pytest.mark.portable


def _line(*vectors: Vector) -> str:
    return " ".join(text(x) for vector in vectors for x in vector)


def _cases(step: str, function: str, amount: int = 20, kind: str = "") -> list[Case]:
    known, draw = functions_of(step)[function], RandomSource("credit")
    group = known.by_name[kind] if kind else known.groups[0]
    return [Case(function, group.name, group.make(draw)) for _ in range(amount)]


def _credit(step: str, case: Case, right: str, given: str) -> float:
    return case.verdict(functions_of(step)[case.function].answer, right, given).credit


def test_a_shadow_ray() -> None:
    for case in _cases("04", "shadow_ray"):
        hit, light = hit_of(case.inputs), case.inputs["light"]
        assert isinstance(light, Light)
        origin = add(hit.position, hit.normal, 0.001)
        to_light = unit(minus(light.position, origin))
        right = _line(origin, to_light)
        assert _credit("04", case, right, right) == 1
        assert _credit("04", case, right, _line(hit.position, to_light)) == 0.5, "no threshold"
        assert _credit("04", case, right, _line(light.position, (0.0, 0.0, 1.0))) == 0, "it starts at the light"
        assert _credit("04", case, right, _line(light.position, times(-1.0, to_light))) == 0, "it comes from there"
        assert _credit("04", case, right, _line(origin, hit.normal)) == 0


def test_a_bounced_ray() -> None:
    for case in _cases("05", "reflected_ray"):
        hit = hit_of(case.inputs)
        away = unit(add(hit.normal, (0.1, 0.2, 0.0)))
        right = _line(add(hit.position, hit.normal, 0.5 * FARTHEST), away)
        assert _credit("05", case, right, _line(add(hit.position, hit.normal, 5.0), away)) == 0.5
        assert _credit("05", case, right, _line(add(hit.position, hit.normal, 0.001), times(-1.0, away))) == 0


def test_light_through_glass() -> None:
    ray = ((0.0, 0.0, 0.0), (0.0, 0.0, -1.0))
    for case in _cases("08", "transmitted_light"):
        at = hit_of(case.inputs).position
        color, other = (0.5, 0.25, 0.125), (0.5, 0.5, 0.5)
        right = f"{_line(color)} 1 {_line(at, ray[1])} 2"
        assert _credit("08", case, right, right) == 1
        assert _credit("08", case, right, f"{_line(color)} 0") == 0.5
        assert _credit("08", case, right, f"{_line(other)} 1 {_line(at, ray[1])} 2") == 0.5
        assert _credit("08", case, right, f"{_line(other)} 1 {_line(at, ray[1])} 3") == 0
        assert _credit("08", case, right, f"{_line(other)} 1 {_line((900.0, 0.0, 0.0), ray[1])} 2") == 0


def test_glass_past_the_depth_limit() -> None:
    """A ray that is too deep to bring anything may be sent or spared, but not be taken for one that sees the sky."""
    ray = ((0.0, 0.0, 0.0), (0.0, 0.0, -1.0))
    for case in _cases("08", "transmitted_light", kind="past the depth limit"):
        black, sky, sent = (0.0, 0.0, 0.0), (0.2, 0.4, 0.6), _line(hit_of(case.inputs).position, ray[1])
        right = f"{_line(black)} 1 {sent} 2"
        assert _credit("08", case, right, right) == 1
        assert _credit("08", case, right, f"{_line(black)} 0") == 1
        assert _credit("08", case, right, f"{_line(black)} 2 {sent} 2 {sent} 2") == 0.5
        assert _credit("08", case, right, f"{_line(sky)} 0") < 1


def test_a_sample_that_only_says_what_it_is() -> None:
    nothing = (float("nan"),) * 3
    for case in _cases("14", "scatter_mirror"):
        away, color = unit(add(hit_of(case.inputs).normal, (0.1, 0.2, 0.0))), (0.5, 0.25, 0.125)
        right = f"1 {_line(away, color)} 1 1"
        assert _credit("14", case, right, right) == 1
        assert _credit("14", case, right, f"1 {_line(away, nothing)} 1 1") == 0.375
        assert _credit("14", case, right, f"1 {_line(times(-1.0, away), color)} 0 0") == 0.125
        assert _credit("14", case, right, f"1 {_line(times(-1.0, away), nothing)} 1 1") == 0


def test_directions_that_are_no_numbers() -> None:
    answer = functions_of("13")["scatter_diffuse"].answer
    for case in _cases("13", "scatter_diffuse", 1):
        amount = int(case.inputs["times"].numbers()[0])
        given = answer.parse(" ".join(["1 nan nan nan nan nan nan nan 0"] * amount))
        assert answer.problem(case.inputs, given, given)
        assert answer.credit(case.inputs, given, given) == 0
