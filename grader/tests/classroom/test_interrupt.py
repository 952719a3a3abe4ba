"""Ctrl-C, SIGTERM and SIGKILL in the middle of a class."""

import json
import os
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest
from class_documents import without_times
from class_fakes import start_class, write_entry
from fake_grader import FAKE

from raysteps.classroom.jobs import Job, to_line
from raysteps.results.model import Settings
from raysteps.submission.load import Submission

_TIMEOUT = 60


@pytest.fixture(autouse=True)
def _scratch(fake_grader: None, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    monkeypatch.setenv("TMPDIR", str(scratch))


def _wait_for(what: Callable[[], bool]) -> None:
    end = time.monotonic() + _TIMEOUT
    while not what():
        assert time.monotonic() < end, "it took too long"
        time.sleep(0.02)


def _log(tmp_path: Path, word: str) -> list[str]:
    path = tmp_path / "log.txt"
    lines = path.read_text().splitlines() if path.exists() else []
    return [line.removeprefix(f"{word} ") for line in lines if line.startswith(f"{word} ")]


def _runs(pid: int) -> bool:
    """Not merely a process that nobody has waited for yet."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def _results(out: Path) -> dict[str, object]:
    found = {path.parent.name: json.loads(path.read_text()) for path in out.glob("submissions/*/results.json")}
    return {name: without_times(document) for name, document in found.items()}


def _class(tmp_path: Path, count: int, wait: float) -> Path:
    for number in range(count):
        write_entry(tmp_path / "in", f"s{number:02}", f"// points {number / 10}\n// wait {wait}\n")
    return tmp_path / "in"


@pytest.mark.skipif(not Path("/proc").exists(), reason="needs /proc")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_interrupted(tmp_path: Path, number: signal.Signals) -> None:
    folder = _class(tmp_path, 6, 0.1)
    for name in ("s02", "s03"):
        write_entry(folder, name, "// points 5\n// program\n")
    out = tmp_path / "out with spaces"
    process = start_class(folder, "--out", out, "--jobs", "2", "--seed", "7")
    _wait_for(lambda: len(_log(tmp_path, "program")) == 2 and len(_results(out)) == 2)
    programs = [int(pid) for pid in _log(tmp_path, "program")]
    assert all(map(_runs, programs))
    os.kill(process.pid, number)
    printed, errors = process.communicate(timeout=_TIMEOUT)
    assert process.returncode == 130, errors
    assert f"./raysteps grade-class {folder} --out '{out}' --jobs 2 --seed 7 --resume" in printed
    _wait_for(lambda: not any(map(_runs, programs)))
    assert not list((tmp_path / "scratch").iterdir())
    document = json.loads((out / "class.json").read_text())
    assert document["run"]["state"] == "interrupted"
    assert document["not_graded"][:2] == ["s02", "s03"]
    assert set(_results(out)) == {"s00", "s01"}
    assert "Not graded yet" in (out / "class.html").read_text("utf-8")


@pytest.mark.skipif(not Path("/proc").exists(), reason="needs /proc")
def test_killed(tmp_path: Path) -> None:
    folder = _class(tmp_path, 12, 0.1)
    write_entry(folder, "s11", "// points 5\n// held\n")
    hold = tmp_path / "log.hold"
    hold.touch()
    out, other = tmp_path / "out", tmp_path / "undisturbed"
    process = start_class(folder, "--out", out, "--jobs", "3")
    _wait_for(lambda: len(_log(tmp_path, "end")) >= 5)
    process.kill()
    process.communicate(timeout=_TIMEOUT)
    hold.unlink()
    with closing(sqlite3.connect(out / "class.sqlite")) as connection:
        assert connection.execute("PRAGMA integrity_check").fetchone() == ("ok",)
        assert connection.execute("PRAGMA foreign_key_check").fetchall() == []
        rows = connection.execute("SELECT document, points FROM results").fetchall()
    assert 0 < len(rows) < 12
    assert all(json.loads(document)["total"]["points"] == points for document, points in rows)
    _wait_for(lambda: not list((tmp_path / "scratch").iterdir()))  # its workers end by themselves
    (tmp_path / "log.txt").unlink()
    process = start_class(folder, "--out", out, "--jobs", "3", "--resume")
    printed, errors = process.communicate(timeout=_TIMEOUT)
    assert process.returncode == 0, errors
    assert len(_log(tmp_path, "begin")) == 12 - len(rows)
    assert f"{len(rows)} result" in printed
    process = start_class(folder, "--out", other, "--jobs", "3")
    process.communicate(timeout=_TIMEOUT)
    assert _results(out) == _results(other)
    assert len(_results(out)) == 12
    tables = [(folder / "results.csv").read_bytes() for folder in (out, other)]
    assert tables[0] == tables[1]
    states = [run["state"] for run in json.loads((out / "class.json").read_text())["runs"]]
    assert states == ["interrupted", "complete"]


def test_nobody_waits_for_the_answer(tmp_path: Path) -> None:
    """As when the class is killed just before it: the process of a worker still ends with all that it left."""
    scratch = tmp_path / "scratch" / "of a worker"
    scratch.mkdir()
    job = Job(Submission("a", {}, {}, {}), Settings(), FAKE, "fake-kit")
    command = [sys.executable, "-P", "-m", "raysteps.classroom.worker", str(scratch)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdout.close()
        process.stdin.write(to_line(job))
        process.stdin.flush()
        _wait_for(lambda: _log(tmp_path, "end") == ["a"])
        with pytest.raises(subprocess.TimeoutExpired):
            process.wait(1)  # the answer has been given to nobody
        process.stdin.close()
        process.wait(_TIMEOUT)
    _wait_for(lambda: not scratch.exists())


def test_two_at_once(tmp_path: Path) -> None:
    folder = tmp_path / "in"
    write_entry(folder, "s00", "// points 5\n// held\n")
    hold = tmp_path / "log.hold"
    hold.touch()
    out = tmp_path / "out"
    first = start_class(folder, "--out", out)
    _wait_for(lambda: bool(_log(tmp_path, "begin")))
    second = start_class(folder, "--out", out)
    _, errors = second.communicate(timeout=_TIMEOUT)
    assert second.returncode == 2
    assert "another grade-class or a look of `nightly` is writing there" in errors
    hold.unlink()
    first.communicate(timeout=_TIMEOUT)
    assert first.returncode == 0
