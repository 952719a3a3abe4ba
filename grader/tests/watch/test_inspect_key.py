"""The key `i`: into the pixel that is most wrong."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from course_fakes import printed, text
from watch_fakes import result_of

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.watch import session as actions
from raysteps.watch.session import Actions
from raysteps.watch.step_view import StepView
from raysteps.watch.terminal_view import TerminalView

_COMMAND = "./raysteps inspect scenes/lessons/three-spheres.nff 5 3 --step 1 --size 160x120 --against reference"


class LentKeyboard:
    """Says when somebody else has the terminal."""

    def __init__(self, log: list[str]) -> None:
        self._log = log

    @contextmanager
    def lent(self) -> Iterator[None]:
        self._log.append("lent")
        yield
        self._log.append("back")


def _press(project: Project, step: Step, source: str, out: Path, log: list[str]) -> str:
    """What is printed."""
    view = StepView(step, "idle", result=result_of(step, source, out, full=False), out=out, complete=True)
    session: Any = SimpleNamespace(
        project=project, view=view, showing=TerminalView(printed()), keyboard=LentKeyboard(log)
    )
    session.look = session.go_to = session.check = None
    Actions(session).press("i")
    return text(session.showing.console)


def test_where_nothing_is_wrong(project: Project, steps: list[Step], tmp_path: Path) -> None:
    assert _press(project, steps[0], "int right;", tmp_path, []).startswith("No picture is wrong")


def test_it_runs_while_the_keys_rest(
    project: Project, steps: list[Step], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    log: list[str] = []

    def run(_project: Project, words: Sequence[str]) -> None:
        log.append(" ".join(words))

    monkeypatch.setattr(actions, "run_inspect", run)
    assert _press(project, steps[0], "// wrong", tmp_path, log) == _COMMAND + "\n"
    assert log == ["lent", _COMMAND.removeprefix("./raysteps "), "back"]
