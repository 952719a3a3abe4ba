"""Benchmarks: means, slopes, spreads and axes."""

import math

import pytest

from tools.bench.charts import linear_axis, log_axis, tick_text
from tools.bench.command import growth, growth_of, sizes
from tools.bench.model import ScaleRow, Spread, geometric_mean
from tools.bench.pictures import thread_counts

pytestmark = pytest.mark.portable


def test_the_geometric_mean_of_a_ratio_and_its_inverse_is_1() -> None:
    assert geometric_mean([4.0, 0.25]) == pytest.approx(1.0)
    assert geometric_mean([2.0, 8.0]) == pytest.approx(4.0)


@pytest.mark.parametrize("exponent", [0.0, 0.5, 1.0, 1.7])
def test_a_power_is_found_again(exponent: float) -> None:
    found = growth([(n, 3.0 * n**exponent) for n in (1e3, 1e4, 1e5, 1e6)])
    assert found.exponent == pytest.approx(exponent)


def test_a_logarithm_grows_by_the_same_with_each_doubling() -> None:
    found = growth([(n, 5.0 + 2.5 * math.log2(n)) for n in (1e3, 1e4, 1e5, 1e6)])
    assert found.per_doubling == pytest.approx(2.5)
    assert 0.0 < found.exponent < 0.15


def test_growth_is_fitted_from_a_thousand_surfaces_on() -> None:
    def row(surfaces: int, tests: float) -> ScaleRow:
        time = Spread.of([10.0 * tests])
        return ScaleRow("octree", "cloud", surfaces, 9, 9, 9, 9, tests / 2, tests / 2, None, time, time)

    rows = [row(100, 999.0), row(1000, 10.0), row(10000, 20.0)]
    (found,) = growth_of(rows)
    assert (found["from"], found["to"]) == (1000, 10000)
    assert found["tests_exponent"] == pytest.approx(math.log10(2))
    assert found["time_exponent"] == pytest.approx(math.log10(2))
    assert found["tests_per_doubling"] == pytest.approx(10 / math.log2(10))


def test_a_spread_tells_median_quartiles_and_every_round() -> None:
    found = Spread.of([5.0, 1.0, 4.0, 2.0, 3.0])
    assert (found.min, found.q1, found.median, found.q3, found.max) == (1.0, 2.0, 3.0, 4.0, 5.0)
    assert found.rounds == [5.0, 1.0, 4.0, 2.0, 3.0]
    assert Spread.of([7.0]).q1 == 7.0


def test_sizes_and_threads() -> None:
    assert sizes(100_000) == [100, 1000, 10_000, 100_000]
    assert sizes(99_999) == [100, 1000, 10_000]
    assert [thread_counts(cores) for cores in (1, 2, 6, 8)] == [[1], [1, 2], [1, 2, 4, 6], [1, 2, 4, 8]]


def test_a_linear_axis_begins_at_0_and_has_round_ticks() -> None:
    axis = linear_axis("ns", [3.0, 87.0])
    assert axis.ticks() == pytest.approx([0.0, 20.0, 40.0, 60.0, 80.0, 100.0])
    assert axis.share(0.0) == 0.0
    assert axis.share(87.0) < 1.0


def test_a_logarithmic_axis_gives_each_factor_of_ten_the_same_room() -> None:
    axis = log_axis("surfaces", [100.0, 1e6])
    assert axis.ticks() == pytest.approx([1e2, 1e3, 1e4, 1e5, 1e6])
    steps = [axis.share(10 * value) - axis.share(value) for value in (1e2, 1e3, 1e4, 1e5)]
    assert steps == pytest.approx([steps[0]] * 4)
    assert log_axis("tests", [12.0, 41.0]).ticks() == pytest.approx([10.0, 20.0, 50.0])


@pytest.mark.parametrize(("value", "text"), [(0.5, "0.5"), (250, "250"), (1500, "1.5k"), (1_000_000, "1M")])
def test_ticks_are_short(value: float, text: str) -> None:
    assert tick_text(value) == text
