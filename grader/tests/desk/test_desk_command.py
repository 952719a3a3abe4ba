"""The command `desk` as it is typed."""

import json
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path
from types import SimpleNamespace

import pytest
from class_fakes import grade_class, write_entry

from raysteps.classroom.database import LOCK
from raysteps.cli import desk
from raysteps.cli.app import main
from raysteps.common.errors import GraderFault
from raysteps.common.files import try_lock

pytestmark = pytest.mark.usefixtures("fake_grader")


@pytest.fixture
def grades(tmp_path: Path) -> Path:
    write_entry(tmp_path / "in", "ann", "// points 4\n")
    assert grade_class(tmp_path / "in", "--out", tmp_path / "out") == 0
    return tmp_path / "out"


def _hear_interrupts() -> None:
    """Also where the tests run in the background and do not."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_it_serves_until_it_is_ended(grades: Path, number: signal.Signals) -> None:
    words = [sys.executable, "-P", "-m", "raysteps", "desk", str(grades), "--no-open", "--as", "Ada"]
    program = subprocess.Popen(words, stdout=subprocess.PIPE, text=True, preexec_fn=_hear_interrupts)
    assert program.stdout is not None
    assert program.stdout.readline().startswith("Page: http://127.0.0.1:")
    assert program.stdout.readline().startswith("Ctrl-C ends it.")
    os.kill(program.pid, number)
    told, _ = program.communicate(timeout=60)
    assert program.returncode == 0
    assert "All files hold what was said." in told


def test_files_in_and_out(tmp_path: Path, grades: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table = tmp_path / "asked.csv"
    table.write_text("submission,kind,step,text,author\nann,request,1,was it right?,Ada\n")
    assert main(["desk", str(grades), "--import", str(table)]) == 0
    assert f"{table}: 1 row taken in that the class did not have" in capsys.readouterr().out
    assert main(["desk", str(grades), "--import", str(table)]) == 0
    assert f"{table}: nothing is new" in capsys.readouterr().out
    results = json.loads((grades / "submissions" / "ann" / "results.json").read_text())
    assert results["steps"][0]["review"]["requests"][0]["text"] == "was it right?"
    assert main(["desk", str(grades), "--export", str(tmp_path / "said.json")]) == 0
    assert json.loads((tmp_path / "said.json").read_text())["annotations"][0]["entry"] == "ann"
    assert main(["desk", str(grades), "--write"]) == 0
    assert "Written:" in capsys.readouterr().out


def test_what_was_said_goes_into_no_file_of_another_kind(
    tmp_path: Path, grades: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["desk", str(grades), "--export", str(tmp_path / "said.xlsx")]) == 2
    assert "said.xlsx: expected a name that ends in .json" in " ".join(capsys.readouterr().err.split())
    assert not (tmp_path / "said.xlsx").exists()


def test_while_something_else_is_at_work_the_way_to_write_later_is_named(
    tmp_path: Path, grades: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table = tmp_path / "asked.csv"
    table.write_text("submission,kind,text\nann,request,was it right?\n")
    with (grades / LOCK).open("a") as file:
        assert try_lock(file.fileno())
        assert main(["desk", str(grades), "--import", str(table)]) == 0
        assert main(["desk", str(grades), "--write"]) == 2
    told = capsys.readouterr()
    for words in (told.out, " ".join(told.err.split())):
        assert "something else is at work there" in words
        assert f"./raysteps desk {grades} --write" in words


def test_files_that_could_not_be_written_are_a_fault(
    grades: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupted(_wait: threading.Event) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(desk, "end_as_interrupted", lambda: None)
    monkeypatch.setattr(threading.Event, "wait", interrupted)
    writer = SimpleNamespace(state="failed", trouble="the disk is full")
    monkeypatch.setattr(desk, "Desk", lambda *_: SimpleNamespace(writer=writer, close=lambda: None))
    monkeypatch.setattr(desk, "DeskServer", lambda *_: SimpleNamespace(address="here", close=lambda: None))
    assert main(["desk", str(grades), "--no-open"]) == GraderFault.exit_code
    assert "The files could not be written: the disk is full." in capsys.readouterr().out


def test_a_folder_without_a_class_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for words in ([], ["--write"], ["--export", str(tmp_path / "x.json")]):
        assert main(["desk", str(tmp_path), *words]) == 2
        assert "holds no class.sqlite" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
