"""A class of complete, partial, broken and hostile submissions, killed at random moments and gone on with.

RAYSTEPS_CLASS_SIZE=200 makes it the size of a real course, RAYSTEPS_CLASS_ONLY= takes all steps."""

import hashlib
import json
import os
import random
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
from sample_class import make_class

from raysteps.common.files import write_bytes
from raysteps.course.manifest import read_steps
from raysteps.course.project import Project
from raysteps.submission.load import load_submission

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("many programs")]

_SIZE = int(os.environ.get("RAYSTEPS_CLASS_SIZE", "12"))
_ONLY = os.environ.get("RAYSTEPS_CLASS_ONLY", "01 03 05").split()  # those with quick programs, and all that stalls
_SEED = 7
_KILLS = max(2, _SIZE // 10)
_SECONDS = 3600


def _words(folder: Path, out: Path, *more: str) -> list[str]:
    limits = ["--limit", "seconds=6", "--limit", "compile_seconds=20"]
    limits += ["--only", *_ONLY] if _ONLY else []
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


def _make_class(project: Project, folder: Path, dice: random.Random) -> None:
    """Two of it try to stall the grader: one sleeps below every limit, one shapes what its compiler says."""
    made = make_class(project, folder, _SIZE - 2, _SEED)
    complete = load_submission(next(one.path for one in made if one.kind == "complete"), read_steps(project)).sources
    first = next(iter(complete))
    stallers = {
        "sleeps": b"#include <unistd.h>\nstatic const bool slept = usleep(1'500'000) == 0;\n" + complete[first],
        "says": b'static_assert(false, "' + b"/a" * 20_000 + b'");\n' + complete[first],
    }
    for name, source in stallers.items():
        place = folder / f"{dice.choice('abcdefghijklmnopqrstuvwxyz')}-{name}"  # anywhere in the order
        for step, text in {**complete, first: source}.items():
            write_bytes(place / "steps" / step / _file_of(project, step), text)


def _file_of(project: Project, step: str) -> str:
    return next(one.file for one in read_steps(project) if one.id == step)


def _killed(folder: Path, out: Path, dice: random.Random, until: int) -> int:
    """Grades on until so many are done, or a moment longer; how many there are then."""
    words = _words(folder, out, *(["--resume"] if _amount_done(out) else []))
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as grading:
        give_up = time.monotonic() + _SECONDS
        while _amount_done(out) < until:
            assert grading.poll() is None, "it ended before it could be killed"
            assert time.monotonic() < give_up
            time.sleep(0.1)
        time.sleep(dice.random())  # anywhere in what comes next
        grading.send_signal(signal.SIGKILL)
    return _amount_done(out)


def test_killed_and_gone_on_with(project: Project, tmp_path: Path) -> None:
    folder, whole, out = tmp_path / "class", tmp_path / "whole", tmp_path / "killed"
    seed = int(os.environ.get("RAYSTEPS_CLASS_SEED") or time.time_ns())
    print(f"RAYSTEPS_CLASS_SEED={seed} kills it at the same moments")
    dice = random.Random(seed)
    _make_class(project, folder, dice)
    subprocess.run(_words(folder, whole), check=True, capture_output=True, timeout=_SECONDS)
    expected = _results(whole)
    assert sum(name.endswith("/results.json") for name in expected) == _SIZE
    assert not [name for name in expected if name.endswith("fault.txt")]

    done = 0
    for until in sorted(dice.sample(range(1, _SIZE - 2), _KILLS)):
        before, done = done, _killed(folder, out, dice, until)
        assert before <= done < _SIZE
    subprocess.run(_words(folder, out, "--resume"), check=True, capture_output=True, timeout=_SECONDS)
    found = _results(out)
    assert sorted(found) == sorted(expected)
    differences = [difference(expected[name], found[name], name) for name in expected]
    assert not any(differences), "\n".join(filter(None, differences))
    with closing(sqlite3.connect(out / "class.sqlite")) as database:
        once = database.execute(
            "SELECT max(amount), min(amount), count(*) FROM (SELECT count(*) AS amount "
            "FROM results GROUP BY submission)"
        ).fetchone()
    assert once == (1, 1, _SIZE)
