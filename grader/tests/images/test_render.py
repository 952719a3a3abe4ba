"""What a student's program says of the picture that it made."""

from pathlib import Path

import pytest

from raysteps.common.process import Outcome
from raysteps.images.render import render
from raysteps.sandbox.task import Isolation, Limits, Task, TaskResult
from raysteps.toolchain.compile import Program

_PICTURE = b"P6\n1 1\n255\n\1\2\3"


class _Says:
    """A sandbox whose program writes these statistics."""

    isolation = Isolation()

    def __init__(self, stats: bytes) -> None:
        self._stats = stats

    def run(self, task: Task) -> TaskResult:
        outputs = {"picture": _PICTURE, "stats": self._stats}
        return TaskResult(Outcome(0, False, "", "", 0.1), outputs, 0.1, "")


@pytest.mark.parametrize(
    "stats",
    [
        b"",
        b"\xff",
        b"[1]",
        b"null",
        b'{"share_tested": "much"}',
        b'{"share_tested": null}',
        b'{"share_tested": NaN}',
        b'{"share_tested": -1}',
        b'{"share_tested": 1e999}',
        b'{"share_tested": ' + b"9" * 400 + b"}",
        b'{"share_tested": ' + b"9" * 5000 + b"}",
        b'{"share_tested": ' + b"[" * 100_000,
    ],
)
def test_statistics_that_cannot_be_read_are_none(stats: bytes, tmp_path: Path) -> None:
    scene = tmp_path / "a.nff"
    scene.touch()
    made = render(_Says(stats), Program(("program",)), scene, (), Limits())
    assert made.pixels is not None
    assert (made.share_tested, made.work) == (None, None)


def test_statistics_are_read(tmp_path: Path) -> None:
    made = render(_Says(b'{"share_tested": 0.25}'), Program(("program",)), tmp_path / "a.nff", (), Limits())
    assert made.share_tested == 0.25
