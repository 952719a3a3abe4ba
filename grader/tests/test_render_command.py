"""The arguments of `render`."""

import pytest

from raysteps.errors import UsageError
from raysteps.render_command import take_impl


def test_impl_is_taken_out() -> None:
    assert take_impl(["a.nff", "-o", "b.ppm"]) == ("mine", ["a.nff", "-o", "b.ppm"])
    assert take_impl(["a.nff", "--impl", "reference", "--quiet"]) == ("reference", ["a.nff", "--quiet"])
    assert take_impl(["--impl=mine"]) == ("mine", [])


@pytest.mark.parametrize("words", [["--impl"], ["--impl", "yours"], ["--impl="]])
def test_other_impls_are_refused(words: list[str]) -> None:
    with pytest.raises(UsageError, match="mine or reference"):
        take_impl(words)
