"""The same question twice, with a similar one between."""

from collections.abc import Iterator

import pytest

from raysteps.judge.functions import AGAIN, Function, functions_of
from raysteps.judge.hidden_tests import cases_asked_again

pytestmark = pytest.mark.portable


def _functions() -> Iterator[Function]:
    for number in range(1, 10):
        yield from functions_of(f"{number:02d}").values()


@pytest.mark.parametrize("function", list(_functions()), ids=lambda function: function.name)
def test_the_question_between_differs_in_each_input_in_its_turn(function: Function) -> None:
    cases = cases_asked_again(function, AGAIN, "a seed", 24)
    assert len(cases) == 24
    assert cases == cases_asked_again(function, AGAIN, "a seed", 24)
    different: set[str] = set()
    alone = 0
    for first, other, last in zip(cases[::3], cases[1::3], cases[2::3], strict=True):
        assert first == last
        changed = {name for name in first.inputs if first.inputs[name] != other.inputs[name]}
        assert changed
        alone += len(changed) == 1
        different |= changed
    fixed = {"depth", "tree"} & set(cases[0].inputs)  # ordinary questions have one value of it
    assert different | fixed == set(cases[0].inputs)
    assert alone >= 3, "mostly in one input alone; where one depends on another that cannot be"
