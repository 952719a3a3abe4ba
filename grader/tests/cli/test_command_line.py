"""What is said of words that no command knows, and to a reader who has read enough."""

import os
import subprocess
import sys

import pytest

from raysteps.cli.app import main

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
