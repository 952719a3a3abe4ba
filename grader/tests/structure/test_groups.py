"""Tests of one group share what is costly to make, so they must meet in one process."""

import subprocess
import sys
from pathlib import Path

_TESTS = """
import os, pathlib, pytest
pytestmark = pytest.mark.xdist_group("together")
@pytest.mark.parametrize("number", range(12))
def test(number):
    pathlib.Path(f"{number}.txt").write_text(str(os.getpid()))
"""


def test_a_group_runs_in_one_process(tmp_path: Path) -> None:
    (tmp_path / "test_one.py").write_text(_TESTS, encoding="utf-8")
    words = [sys.executable, "-m", "pytest", "-q", "-n", "3", "--dist", "loadgroup", "-p", "no:cacheprovider"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    processes = [path.read_text(encoding="utf-8") for path in tmp_path.glob("*.txt")]
    assert len(processes) == 12
    assert len(set(processes)) == 1
