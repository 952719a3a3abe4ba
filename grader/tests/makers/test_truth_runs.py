"""What `dev check` runs: each program once for the same bytes, under limits."""

import os
import signal
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Input, Limits, Output, Task
from tools.direct_grading import CachingSandbox, sandbox_of_the_kit

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="its programs are scripts of a shell")


def _script(folder: Path, text: str) -> Input:
    path = folder / "script.sh"
    path.write_text(text, encoding="utf-8")
    return Input(path)


def _task(folder: Path, text: str = 'cat "$1" - > "$2"; echo said; echo wrong >&2; exit 3', data: str = "one ") -> Task:
    (folder / "data.txt").write_text(data, encoding="utf-8")
    words = ("/bin/sh", _script(folder, text), Input(folder / "data.txt"), Output("made"))
    return Task(words, Limits(wall_seconds=20), stdin=b"two")


@pytest.fixture
def remembered(tmp_path: Path) -> CachingSandbox:
    return sandbox_of_the_kit(tmp_path / "kept", "this machine")


def test_an_answer_is_what_a_sandbox_would_have_given(tmp_path: Path, remembered: CachingSandbox) -> None:
    right = LimitsOnly().run(_task(tmp_path))
    for _ in range(2):
        ran = remembered.run(_task(tmp_path))
        assert (ran.outcome.code, ran.outcome.stdout, ran.outcome.stderr) == (3, "said\n", "wrong\n")
        assert ran.outputs == right.outputs == {"made": b"one two"}
        assert replace(ran.outcome, seconds=0) == replace(right.outcome, seconds=0)
    assert (remembered.asked, remembered.ran) == (2, 1)


def test_another_byte_anywhere_is_another_question(tmp_path: Path, remembered: CachingSandbox) -> None:
    task = _task(tmp_path)
    others = [
        replace(task, stdin=b"three"),
        replace(task, tools=True),
        replace(task, limits=replace(task.limits, memory_mb=100)),
        replace(task, command=(*task.command, "more")),
    ]
    remembered.run(task)
    for count, other in enumerate(others, start=2):
        remembered.run(other)
        assert remembered.ran == count
    assert remembered.run(_task(tmp_path, data="1 ")).outputs == {"made": b"1 two"}
    assert remembered.run(_task(tmp_path, 'echo new > "$2"')).outputs == {"made": b"new\n"}
    elsewhere = sandbox_of_the_kit(tmp_path / "kept", "another machine")
    elsewhere.run(task)
    assert elsewhere.ran == 1


def test_a_folder_is_what_is_in_it(tmp_path: Path, remembered: CachingSandbox) -> None:
    folder = tmp_path / "folder"
    folder.mkdir()
    task = Task(("/bin/ls", Input(folder)))
    for count, name in enumerate(("a", "b"), start=1):
        (folder / name).touch()
        for _ in range(2):
            assert name in remembered.run(task).outcome.stdout
        assert remembered.ran == count


def test_what_a_limit_stopped_is_run_again(tmp_path: Path, remembered: CachingSandbox) -> None:
    task = replace(_task(tmp_path, "echo begun; sleep 60"), limits=Limits(wall_seconds=0.5, cpu_seconds=0.05))
    for count in (1, 2):
        ran = remembered.run(task)
        assert (ran.stopped, ran.outcome.timed_out, ran.outcome.code) == ("wall", True, -signal.SIGKILL)
        assert remembered.ran == count


def test_what_took_longer_than_it_may_now_is_run_again(tmp_path: Path, remembered: CachingSandbox) -> None:
    task = _task(tmp_path, "sleep 1")
    remembered.run(task)
    remembered.run(replace(task, limits=replace(task.limits, wall_seconds=0.3)))
    assert remembered.ran == 2


def test_half_an_answer_is_none(tmp_path: Path, remembered: CachingSandbox) -> None:
    remembered.run(_task(tmp_path))
    for count, path in enumerate(list((tmp_path / "kept").glob("??/*")), start=2):
        path.write_bytes(path.read_bytes()[:10])
        assert remembered.run(_task(tmp_path)).outcome.stdout == "said\n"
        assert remembered.ran == count
    remembered.run(_task(tmp_path))
    assert remembered.ran == 3


def test_the_same_answer_to_two_questions_lies_there_once(tmp_path: Path, remembered: CachingSandbox) -> None:
    task = _task(tmp_path, 'echo made > "$2"')
    others = [task, replace(task, stdin=b"three"), replace(task, command=(*task.command, "more"))]
    assert {remembered.run(one).outputs["made"] for one in others} == {b"made\n"}
    assert remembered.ran == len(others)
    assert len(list((tmp_path / "kept").glob("??/*"))) == len(others) + 1


def test_what_nobody_asked_for_is_forgotten(tmp_path: Path, remembered: CachingSandbox) -> None:
    remembered.run(_task(tmp_path))
    for path in (tmp_path / "kept").glob("??/*"):
        os.utime(path, (1, 1))
    remembered.run(_task(tmp_path, data="another"))
    remembered.forget_unused()
    again = sandbox_of_the_kit(tmp_path / "kept", "this machine")
    again.run(_task(tmp_path, data="another"))
    assert again.ran == 0
    again.run(_task(tmp_path))
    assert again.ran == 1


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere the keeper is between")
def test_a_signal_is_told(tmp_path: Path, remembered: CachingSandbox) -> None:
    assert remembered.run(_task(tmp_path, "kill -SEGV $$")).outcome.code == -signal.SIGSEGV


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere the keeper is between")
def test_memory_has_its_limit(tmp_path: Path, remembered: CachingSandbox) -> None:
    program = "x = bytearray(1 << 33)"
    task = Task((sys.executable, "-c", program), Limits(memory_mb=64, processes=1), tools=True)
    ran = remembered.run(task)
    assert ran.stopped == "memory" or "MemoryError" in ran.outcome.stderr
