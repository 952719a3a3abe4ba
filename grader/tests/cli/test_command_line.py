"""What is said of words that no command knows, and to a reader who has read enough."""

import errno
import os
import subprocess
import sys
from pathlib import Path

import pytest

from raysteps.cli.app import main
from raysteps.course.project import Project

pytestmark = pytest.mark.portable


@pytest.mark.parametrize(
    ("typed", "command", "wrong"),
    [
        ("hint --lvl 2", "hint", "--lvl: there is no such option; did you mean --level?"),
        ("inspect --stpe 3", "inspect", "--stpe: there is no such option; did you mean --step?"),
        ("export canvas --otu=a", "export canvas", "--otu: there is no such option; did you mean --out?"),
        ("compare a.png b.png -x", "compare", "-x: there is no such option"),
        ("list all", "list", "'all': expected nothing more"),
    ],
)
def test_the_usage_is_that_of_the_command_and_one_line_says_what_is_wrong(
    typed: str, command: str, wrong: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(typed.split())
    said = capsys.readouterr().err
    assert said.startswith(f"usage: raysteps {command} [-h]")
    assert said.splitlines()[-1] == f"raysteps {command}: error: {wrong}"


def test_a_command_that_is_none(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(["chekc", "01"])
    assert "chekc: there is no such command; did you mean check? See ./raysteps --help" in capsys.readouterr().err


def test_a_step_that_is_none(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["hint", "02-intersecton"]) == 2
    assert "no step '02-intersecton'; did you mean 02-intersection? The steps are 01-" in capsys.readouterr().err
    assert main(["hint", "77"]) == 2
    assert "no step '77'. The steps are 01-" in capsys.readouterr().err


def test_what_must_not_be_read_is_one_message(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], project: Project
) -> None:
    """Root may read everything, so nothing is left but to say that it may not."""
    closed = project.steps / "02-intersection" / "intersection.cpp"
    real = Path.read_text

    def read_text(path: Path, *words: str, **named: str) -> str:
        if path == closed:
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return real(path, *words, **named)

    monkeypatch.setattr(Path, "read_text", read_text)
    assert main(["inspect", str(project.scenes / "lessons" / "three-spheres.nff"), "1", "2"]) == 2
    said = capsys.readouterr().err.splitlines()
    assert said[-1] == f"raysteps: {closed}: no permission; what it needs there must be open to you"
    assert "Traceback" not in "".join(said)


def test_several_submissions_in_one_folder_are_no_submission(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    for name in ("bob jones", "ann"):
        (tmp_path / name / "steps" / "01-camera-rays").mkdir(parents=True)
        (tmp_path / name / "steps" / "01-camera-rays" / "camera_rays.cpp").write_text("int a;")
    assert main(["grade", str(tmp_path)]) == 2
    assert capsys.readouterr().err == (
        f"raysteps: {tmp_path}: holds several submissions: ann and bob jones. "
        f"Grade one of them with `./raysteps grade {tmp_path / 'ann'}`, "
        f"or all with `./raysteps grade-class {tmp_path} --out grades`\n"
    )


def test_the_beginning_of_an_option_is_known(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["hint", "01", "--al"]) == 0


def test_what_follows_two_dashes_is_no_option(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", "--", "--a.png", "--b.png"]) == 2
    assert "--a.png: " in capsys.readouterr().err


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGPIPE")
@pytest.mark.parametrize(
    ("words", "unbuffered"), [(["list"], ""), (["list"], "1"), (["--help"], ""), (["compare", "--help"], "")]
)
def test_a_reader_who_is_gone_ends_a_command_without_a_word(words: list[str], unbuffered: str) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    command = [sys.executable, "-m", "raysteps", *words]
    environment = {**os.environ, "PYTHONUNBUFFERED": unbuffered}
    done = subprocess.run(command, stdout=writing, stderr=subprocess.PIPE, env=environment, timeout=60, check=False)
    os.close(writing)
    assert (done.returncode, done.stderr) == (141, b"")
