"""A class on a cluster: a scheduler and workers on this machine, one of which is lost."""

import json
import os
import signal
import sqlite3
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path

import pytest
from class_documents import without_times
from class_fakes import grade_class, start_class, write_entry

import raysteps.classroom.cluster
from raysteps.common.errors import GraderFault, UsageError

pytest.importorskip("distributed")
_TIMEOUT = 90
_COUNT = 12


class _Cluster:
    """A scheduler and its workers, each a process."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._processes: list[subprocess.Popen[bytes]] = []
        self.address = ""

    def start(self) -> None:
        file = self._folder / "scheduler.json"
        self._start("dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--scheduler-file", str(file))
        wait_for(lambda: file.exists() and file.read_text().rstrip().endswith("}"))
        self.address = str(json.loads(file.read_text())["address"])

    def _start(self, program: str, *words: str, **changes: str) -> "subprocess.Popen[bytes]":
        with (self._folder / f"{program}-{len(self._processes)}.txt").open("wb") as log:
            command = [sys.executable, "-m", f"distributed.cli.{program}", "--no-dashboard", *words]
            environment = {**os.environ, **changes}
            process = subprocess.Popen(command, stdout=log, stderr=log, cwd=self._folder, env=environment)
        self._processes.append(process)
        return process

    def worker(self, name: str, **changes: str) -> "subprocess.Popen[bytes]":
        words = ("--nthreads", "1", "--no-nanny", "--host", "127.0.0.1", "--name", name)
        return self._start("dask_worker", self.address, *words, FAKE_WORKER=name, **changes)

    def close(self) -> None:
        for process in self._processes:
            process.kill()
            process.wait()


def wait_for(what: Callable[[], bool]) -> None:
    end = time.monotonic() + _TIMEOUT
    while not what():
        assert time.monotonic() < end, "it took too long"
        time.sleep(0.02)


@pytest.fixture
def cluster(tmp_path: Path, fake_grader: None) -> Iterator[_Cluster]:
    running = _Cluster(tmp_path)
    try:
        running.start()
        yield running
    finally:
        running.close()


def _log(tmp_path: Path, word: str) -> list[str]:
    path = tmp_path / "log.txt"
    lines = path.read_text().splitlines() if path.exists() else []
    return [line.removeprefix(f"{word} ") for line in lines if line.startswith(f"{word} ")]


def _class(tmp_path: Path, wait: float) -> Path:
    for number in range(_COUNT):
        write_entry(tmp_path / "in", f"s{number:02}", f"// points {number / 10}\n// wait {wait}\n")
    return tmp_path / "in"


def _results(out: Path) -> dict[str, object]:
    return {path.parent.name: without_times(json.loads(path.read_text())) for path in out.glob("*/*/results.json")}


def test_a_worker_is_lost(tmp_path: Path, cluster: _Cluster) -> None:
    folder = _class(tmp_path, 0.4)
    out, here = tmp_path / "out", tmp_path / "here"
    victim = cluster.worker("one")
    cluster.worker("two")
    head = start_class(folder, "--out", out, "--scheduler", cluster.address)
    wait_for(lambda: {"one", "two"} <= set(_log(tmp_path, "at")) and len(_log(tmp_path, "end")) >= 4)
    wait_for(lambda: len(_log(tmp_path, "begin")) > len(_log(tmp_path, "end")))
    victim.send_signal(signal.SIGKILL)
    _, errors = head.communicate(timeout=_TIMEOUT)
    assert head.returncode == 0, errors
    begun = Counter(_log(tmp_path, "begin"))
    assert set(begun) == {f"s{number:02}" for number in range(_COUNT)}
    assert max(begun.values()) <= 3
    with closing(sqlite3.connect(out / "class.sqlite")) as connection:
        rows = connection.execute("SELECT name, status FROM results JOIN submissions ON id = submission").fetchall()
    assert sorted(rows) == [(f"s{number:02}", "graded") for number in range(_COUNT)]
    assert grade_class(folder, "--out", here) == 0
    assert _results(out) == _results(here)
    assert len(_results(out)) == _COUNT
    assert {path.name: path.read_bytes() for path in out.rglob("*.png")} != {}
    tables = [(place / "results.csv").read_bytes() for place in (out, here)]
    assert tables[0] == tables[1]


def test_what_goes_wrong_with_one_stops_none(tmp_path: Path, cluster: _Cluster) -> None:
    cluster.worker("one")
    for name, text in {"die": "// die", "fault": "// fault", "well": "// points 5"}.items():
        write_entry(tmp_path / "in", name, text)
    out = tmp_path / "out"
    assert grade_class(tmp_path / "in", "--out", out, "--scheduler", cluster.address) == 4
    document = json.loads((out / "class.json").read_text())
    assert document["faults"] == ["die", "fault"]
    assert document["statistics"]["graded"] == 1


def test_another_kit_is_told_before_anything_is_graded(tmp_path: Path, cluster: _Cluster) -> None:
    cluster.worker("one")
    cluster.worker("two", FAKE_KIT="older-kit")
    folder = _class(tmp_path, 0)
    wait_for(lambda: len(_registered(tmp_path)) == 2)
    with pytest.raises(GraderFault, match=r"(?s)of this machine \(fake-kit\):.*older-kit.*RAYSTEPS_COURSE.*--resume"):
        grade_class(folder, "--out", tmp_path / "out", "--scheduler", cluster.address)
    assert _log(tmp_path, "begin") == []


def _registered(tmp_path: Path) -> list[str]:
    return [path.name for path in tmp_path.glob("dask_worker-*.txt") if "Registered to" in path.read_text()]


def test_interrupted(tmp_path: Path, cluster: _Cluster) -> None:
    cluster.worker("one")
    write_entry(tmp_path / "in", "a", "// points 1\n")
    write_entry(tmp_path / "in", "b", "// program\n")
    head = start_class(tmp_path / "in", "--out", tmp_path / "out", "--scheduler", cluster.address)
    wait_for(lambda: bool(_log(tmp_path, "program")) and "a" in _results(tmp_path / "out"))
    (program,) = _log(tmp_path, "program")
    head.send_signal(signal.SIGINT)
    printed, errors = head.communicate(timeout=_TIMEOUT)
    assert head.returncode == 130, errors
    assert f"--scheduler {cluster.address} --resume" in printed
    wait_for(lambda: not Path(f"/proc/{program}").exists() or "Z" in Path(f"/proc/{program}/stat").read_text())
    assert set(_results(tmp_path / "out")) == {"a"}


def test_no_scheduler(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(raysteps.classroom.cluster, "_CONNECT_SECONDS", 1)
    with pytest.raises(UsageError, match="no scheduler that answers"):
        grade_class(_class(tmp_path, 0), "--out", tmp_path / "out", "--scheduler", "tcp://127.0.0.1:9")


def test_without_distributed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(UsageError, match=r"pip install .*grader\[cluster\]"):
        grade_class(_class(tmp_path, 0), "--out", tmp_path / "out", "--scheduler", "tcp://127.0.0.1:9")
