"""Tests whose errors are fixed: right numbers pass, wrong ones are found, and the tail is that of the books."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from raysteps.judge.answers import Verdict
from raysteps.judge.cases.sampling import FUNCTIONS
from raysteps.judge.functions import Case
from raysteps.judge.protocol import Inputs, Whole, text
from raysteps.judge.statistics import (
    Numbers,
    are_independent,
    chi_square_tail,
    has_mean,
    is_plausible_total,
    is_uniform,
    uneven_problem,
)

_SEED = 20


@pytest.mark.parametrize(
    ("value", "degrees", "tail"),
    [  # from published tables of the distribution's upper quantiles
        (3.841459, 1, 0.05),
        (5.991465, 2, 0.05),
        (6.634897, 1, 0.01),
        (18.307038, 10, 0.05),
        (29.588298, 10, 0.001),
        (82.528727, 63, 0.05),
        (103.442377, 63, 0.001),
        (1000.0, 1, 0.0),
        (0.0, 5, 1.0),
    ],
)
def test_the_tail_is_that_of_the_tables(value: float, degrees: int, tail: float) -> None:
    assert chi_square_tail(value, degrees) == pytest.approx(tail, rel=1e-4, abs=1e-12)


def test_a_tail_far_out_is_as_small_as_it_is() -> None:
    assert chi_square_tail(4 * 70.0, 2) == pytest.approx(math.exp(-140.0), rel=1e-9)


def test_a_histogram_shows_what_came_beside_what_should() -> None:
    low = np.concatenate([np.full(300, 0.01), np.full(100, 0.99)])
    even = uneven_problem("too low", "numbers", low).histogram
    assert (even.counts[0], even.counts[-1], sum(even.counts)) == (300, 100, 400)
    assert even.expected == [25.0] * 16
    beside = uneven_problem("too low", "numbers", low, np.repeat([0.01, 0.99], 1000)).histogram
    assert (beside.expected[0], beside.expected[7], beside.expected[-1]) == (200.0, 0.0, 200.0)


def test_many_events_of_unequal_chance_are_told_from_too_many() -> None:
    draw = np.random.default_rng(_SEED)
    shares = draw.random(1000) * 0.02
    assert all(is_plausible_total(int((draw.random(1000) < shares).sum()), shares, 0) for _ in range(500))
    assert is_plausible_total(24, shares, 0)  # ten are expected
    assert not is_plausible_total(48, shares, 0)
    assert is_plausible_total(48, shares, 20)
    assert is_plausible_total(990, 1 - shares, 0)
    assert not is_plausible_total(952, 1 - shares, 0)
    assert is_plausible_total(0, np.zeros(0), 0)


def test_even_numbers_pass_and_uneven_ones_do_not() -> None:
    draw = np.random.default_rng(_SEED)
    even = draw.random(20_000)
    assert is_uniform(even, 16)
    assert has_mean(even, 0.5, math.sqrt(1 / 12))
    assert not is_uniform(even * 0.97, 16)
    assert not has_mean(even * 0.95, 0.5, math.sqrt(1 / 12))
    assert is_uniform(draw.random((20_000, 2)), 8)
    assert not is_uniform(np.stack([even, even], axis=1), 8)
    assert are_independent(even[::2], even[1::2], 16)
    assert not are_independent(even, np.asarray((even + 0.01 * draw.random(20_000)) % 1.0), 16)


def test_too_few_numbers_tell_nothing() -> None:
    assert is_uniform(np.zeros(10), 16)


# What the judge says of points that are wrong in one way.

_STRATIFIED = FUNCTIONS[0]
_SIDE, _TIMES = 4, 512


def _inputs(side: int = _SIDE, times: int = _TIMES) -> Inputs:
    return {"side": Whole(side), "seed": Whole(1), "times": Whole(times)}


def _right(side: int = _SIDE, times: int = _TIMES) -> Numbers:
    """Times, squares, x and y."""
    draw = np.random.default_rng(_SEED)
    corners = np.array([(column, row) for row in range(side) for column in range(side)])
    return np.asarray((corners + draw.random((times, side * side, 2))) / side)


def _verdict(points: Numbers, inputs: Inputs, *, last: Numbers | None = None) -> Verdict:
    def line(found: Numbers) -> str:
        times = [*found, found[0] if last is None or found is not points else last]
        return " ".join(f"{len(one)} " + " ".join(text(float(x)) for x in one.ravel()) for one in times)

    expected = line(_right(_whole(inputs, "side"), _whole(inputs, "times")))
    return Case(_STRATIFIED.name, "", inputs).verdict(_STRATIFIED.answer, expected, line(points))


def _whole(inputs: Inputs, name: str) -> int:
    value = inputs[name]
    assert isinstance(value, Whole)
    return value.value


def test_right_points_in_any_order_are_right() -> None:
    draw = np.random.default_rng(_SEED + 1)
    corners = np.array([(column, row) for column in range(_SIDE) for row in range(_SIDE)])
    points = (corners + draw.random((_TIMES, _SIDE * _SIDE, 2))) / _SIDE
    shuffled = np.stack([draw.permutation(one) for one in points])
    assert _verdict(shuffled, _inputs()).problem == ""


def test_a_point_on_the_border_of_its_square_may_be_rounded_across() -> None:
    points = _right()
    points[0, 5] = (2 / _SIDE, 2 / _SIDE)  # of the square in column 1 and row 1, just at its end
    points[1, 15] = (1.0, 1.0)
    assert _verdict(points, _inputs()).problem == ""


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda p: p[:, :-1], "there are not side * side points"),
        (lambda p: p[:, :0], "there are no points"),
        (lambda p: p[:, _SIDE:], "a row of points is missing"),
        (lambda p: p * 1.2, "outside of the unit square, beyond 1"),
        (lambda p: p - 0.5 / _SIDE, "outside of the unit square, below 0"),
        (lambda p: np.random.default_rng(3).random(p.shape), "a square has no point, or two"),
        (lambda p: (np.floor(p * _SIDE) + 0.5 * ((p * _SIDE) % 1)) / _SIDE, "do not lie everywhere"),
        (lambda p: np.floor(p * _SIDE) / _SIDE + 0.5 / _SIDE, "do not lie everywhere"),
        (
            lambda p: (np.floor(p * _SIDE) + ((p * _SIDE) % 1)[..., :1]) / _SIDE,
            "x and y of a point",
        ),
        (
            lambda p: (np.floor(p * _SIDE) + ((p * _SIDE) % 1)[:, :1]) / _SIDE,
            "all squares have their points at the same",
        ),
        (lambda p: _with_shares(p, np.repeat(_shares(p)[:, :, :1], _SIDE, axis=2)), "the squares of a row"),
        (lambda p: _with_shares(p, np.repeat(_shares(p)[:, :1], _SIDE, axis=1)), "the squares of a column"),
        (lambda p: _with_shares(p, np.floor(_shares(p) * 16) / 16 + 0.01), "a few places of their squares"),
        (lambda p: _with_shares(p, _one_stays(_shares(p))), "some squares have their point always"),
        (lambda p: _with_shares(p, _shares(p) * [1, 0] + [0, 0.5]), "only one of x and y"),
        (
            lambda p: (np.floor(p * _SIDE) + ((p * _SIDE) % 1)[np.arange(len(p)) // 2]) / _SIDE,
            "the same for different streams",
        ),
    ],
)
def test_each_fault_has_its_words(change: object, said: str) -> None:
    assert callable(change)
    assert said in _verdict(np.asarray(change(_right())), _inputs()).problem


def _shares(points: Numbers) -> Numbers:
    """Times, rows, columns, x and y."""
    return np.asarray(points.reshape(len(points), _SIDE, _SIDE, 2) * _SIDE % 1.0)


def _with_shares(points: Numbers, shares: Numbers) -> Numbers:
    return np.asarray((np.floor(points * _SIDE) + shares.reshape(points.shape)) / _SIDE)


def _one_stays(shares: Numbers) -> Numbers:
    """The last square's point lies in its middle."""
    found = shares.copy()
    found[:, -1, -1] = 0.5
    return found


def _turned_round(shares: Numbers) -> None:
    shares[:, :, 1::2] = 1 - shares[:, :, 0::2]


def _two_columns_on(shares: Numbers) -> None:
    shares[:, :, 2:] = shares[:, :, :2]


def _far_corner(shares: Numbers) -> None:
    shares[:, -1, -1] = shares[:, 0, 0]


def _y_of_x_before(shares: Numbers) -> None:
    shares[:, :, 1::2, 1] = 1 - shares[:, :, 0::2, 0]


def _every_other_stream(shares: Numbers) -> None:
    shares[2::4] = shares[0::4]


@pytest.mark.parametrize("times", [128, 512])
@pytest.mark.parametrize(
    ("copy", "said"),
    [
        (_turned_round, "different squares"),
        (_two_columns_on, "different squares"),
        (_far_corner, "different squares"),
        (_y_of_x_before, "different squares"),
        (_every_other_stream, "different streams"),
    ],
)
def test_numbers_that_are_used_again_are_found_wherever(copy: Callable[[Numbers], None], said: str, times: int) -> None:
    points = _right(_SIDE, times)
    shares = _shares(points)
    copy(shares)
    assert said in _verdict(_with_shares(points, shares), _inputs(_SIDE, times)).problem


@pytest.mark.parametrize("side", [3, 5])
def test_odd_sides_are_right_too(side: int) -> None:
    assert _verdict(_right(side, 256), _inputs(side, 256)).problem == ""


@pytest.mark.parametrize("line", ["", "0", "16 0.5", "nan", "16 " + "nan " * 32, "1000000 0.5", "0 " * 100_000])
def test_whatever_a_line_holds_it_is_an_answer(line: str) -> None:
    inputs = _inputs(_SIDE, 2)
    right = " ".join("16 " + " ".join(text(float(x)) for x in one.ravel()) for one in _right(_SIDE, 2)[[0, 1, 0]])
    assert Case(_STRATIFIED.name, "", inputs).verdict(_STRATIFIED.answer, right, line).problem


def test_the_same_stream_must_give_the_same_points() -> None:
    points = _right()
    assert "the same stream gave other points" in _verdict(points, _inputs(), last=points[1]).problem


def test_one_square_is_tested_too() -> None:
    points = _right(1, 2048)
    assert _verdict(points, _inputs(1, 2048)).problem == ""
    assert "x and y" in _verdict(points[..., :1].repeat(2, axis=-1), _inputs(1, 2048)).problem


def test_few_points_can_be_told_too() -> None:
    """Smallest counterexamples are looked for among them."""
    case = Case("stratified_samples", "a few squares", _inputs(2, 1))
    assert _verdict(_right(2, 1), case.inputs).problem == ""
    assert "a square has no point" in _verdict(_right(2, 1)[:, [0, 0, 1, 2]], case.inputs).problem


def test_squares_that_never_have_a_point_are_told_apart_from_those_that_are_empty_now_and_then() -> None:
    inputs = _inputs(2, 64)
    points = _right(2, 64)
    points[:, 0] = points[:, 1]
    assert _verdict(points, inputs).problem == "some squares never have a point, others have several"
    points = _right(2, 64)
    points[0, 0] = points[0, 1]
    assert _verdict(points, inputs).problem == "a square has no point, or two"


@pytest.mark.parametrize(("side", "times"), [(2, 64), (64, 2)])
@pytest.mark.parametrize(("factor", "far"), [(1.9, ""), (64.0, "far ")])
def test_points_beyond_the_unit_square_are_told_by_how_far(factor: float, far: str, side: int, times: int) -> None:
    problem = _verdict(_right(side, times) * factor, _inputs(side, times)).problem
    assert problem == f"a point lies outside of the unit square, {far}beyond 1"
