"""The command line of `grade-class` with a fake grader, and what it is given."""

import argparse
import errno
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from fake_grader import FAKE
from rich.console import Console

from raysteps.cli.grade_class import add_arguments, run
from raysteps.common.errors import RaystepsError
from raysteps.course.project import here

FIRST = "01-camera-rays/camera_rays.cpp"


def write_entry(folder: Path, name: str, text: str) -> Path:
    """A folder with a step 01."""
    path = folder / name / "steps" / FIRST
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return folder / name


def start_class(*words: str | Path) -> "subprocess.Popen[str]":
    """As a process of its own, which hears SIGINT even where the tests run in the background and do not."""
    return subprocess.Popen(
        [sys.executable, "-m", "class_fakes", *map(str, words)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )


def grade_class(*words: str | Path | int, console: Console | None = None) -> int:
    """As the command line, but with the fake grader, in one process where the words do not say how many."""
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    arguments = parser.parse_args([str(word) for word in words])
    if arguments.jobs is None and not (arguments.scheduler or arguments.merge):
        arguments.jobs = 1
    return run(here(), arguments, console or Console(width=150), grader=FAKE)


def close_to_looks(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As without the x of its mode, which root does not feel: it tells names, and nothing of what bears them."""
    lstat = Path.lstat

    def look(path: Path) -> os.stat_result:
        if path.parent == folder:
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
        return lstat(path)

    monkeypatch.setattr(Path, "lstat", look)


if __name__ == "__main__":
    try:
        sys.exit(grade_class(*sys.argv[1:]))
    except RaystepsError as error:
        print(f"raysteps: {error}", file=sys.stderr)
        sys.exit(error.exit_code)
