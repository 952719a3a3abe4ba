"""A class of complete, partial, broken and hostile submissions, killed in the middle and gone on with.

RAYSTEPS_CLASS_SIZE=200 makes it the size of a real course."""

import hashlib
import json
import os
import signal
import sqlite3
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from class_documents import without_times

from raysteps.course.project import Project
from tools.sample_class import make_class

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("many programs")]

_SIZE = int(os.environ.get("RAYSTEPS_CLASS_SIZE", "12"))
_SEED = 7
_SECONDS = 3600


def _words(folder: Path, out: Path, *more: str) -> list[str]:
    limits = ["--limit", "seconds=4", "--limit", "compile_seconds=20"]
    words = [sys.executable, "-P", "-m", "raysteps", "grade-class", str(folder), "--out", str(out), "--jobs", "2"]
    return [*words, *limits, *more]


def _amount_done(out: Path) -> int:
    path = out / "class.sqlite"
    if not path.is_file():
        return 0
    try:
        with closing(sqlite3.connect(f"file:{path}?mode=ro", uri=True)) as database:
            return int(database.execute("SELECT count(*) FROM results").fetchone()[0])
    except sqlite3.Error:
        return 0


def _results(out: Path) -> dict[str, Any]:
    """Of every submission: what was found, and its pictures."""
    found: dict[str, Any] = {}
    for path in sorted((out / "submissions").rglob("*")):
        name = path.relative_to(out / "submissions").as_posix()
        if path.name == "results.json":
            found[name] = without_times(json.loads(path.read_text(encoding="utf-8")))
        elif path.is_file():
            found[name] = hashlib.sha256(path.read_bytes()).hexdigest()
    return found


def difference(expected: object, actual: object, place: str) -> str:
    """The first place where two documents differ."""
    if isinstance(expected, dict) and isinstance(actual, dict) and expected.keys() == actual.keys():
        found = (difference(expected[key], actual[key], f"{place}/{key}") for key in expected)
    elif isinstance(expected, list) and isinstance(actual, list) and len(expected) == len(actual):
        found = (difference(a, b, f"{place}/{at}") for at, (a, b) in enumerate(zip(expected, actual, strict=True)))
    else:
        return "" if expected == actual else f"{place}: {expected!r} became {actual!r}"
    return next(filter(None, found), "")


def test_killed_and_gone_on_with(project: Project, tmp_path: Path) -> None:
    folder, whole, killed = tmp_path / "class", tmp_path / "whole", tmp_path / "killed"
    make_class(project, folder, _SIZE, _SEED)
    subprocess.run(_words(folder, whole), check=True, capture_output=True, timeout=_SECONDS)
    expected = _results(whole)
    assert sum(name.endswith("/results.json") for name in expected) == _SIZE
    assert not [name for name in expected if name.endswith("fault.txt")]

    with subprocess.Popen(_words(folder, killed), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as grading:
        until = time.monotonic() + _SECONDS
        while _amount_done(killed) < _SIZE // 2:
            assert grading.poll() is None, "it ended before it could be killed"
            assert time.monotonic() < until
            time.sleep(0.1)
        grading.send_signal(signal.SIGKILL)
    done = _amount_done(killed)
    assert _SIZE // 2 <= done < _SIZE
    subprocess.run(_words(folder, killed, "--resume"), check=True, capture_output=True, timeout=_SECONDS)
    found = _results(killed)
    assert sorted(found) == sorted(expected)
    differences = [difference(expected[name], found[name], name) for name in expected]
    assert not any(differences), "\n".join(filter(None, differences))
    with closing(sqlite3.connect(killed / "class.sqlite")) as database:
        once = database.execute(
            "SELECT max(amount), min(amount), count(*) FROM (SELECT count(*) AS amount "
            "FROM results GROUP BY submission)"
        ).fetchone()
    assert once == (1, 1, _SIZE)
