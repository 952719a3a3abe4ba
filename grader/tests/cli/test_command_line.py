"""What is said of words that no command knows, and to a reader who has read enough."""

import errno
import io
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from course_fakes import small_project

from raysteps.cli import app
from raysteps.cli.app import EXAMPLES, exit_code_of, main, new_parser
from raysteps.common.errors import UsageError
from raysteps.common.platform import own_command
from raysteps.course.project import Project
from raysteps.submission.load import like, refuse_results_in

pytestmark = pytest.mark.portable


@pytest.mark.parametrize(
    ("typed", "command", "wrong"),
    [
        ("hint --lvl 2", "hint", "--lvl: there is no such option; did you mean --level?"),
        ("inspect --stpe 3", "inspect", "--stpe: there is no such option; did you mean --step?"),
        ("export canvas --otu=a", "export canvas", "--otu: there is no such option; did you mean --out?"),
        ("compare a.png b.png -x", "compare", "-x: there is no such option"),
        ("list all", "list", "'all': expected nothing more"),
        ("test 01", "test", "'01': expected nothing more; for a step of yours type: ./raysteps check 01"),
        ("list steps/01-x", "list", "'steps/01-x': expected nothing more; for a step of yours type: ./raysteps check "
         "steps/01-x"),
        ("hint --level x", "hint", "argument --level: expected a whole number from 1 on, found 'x'"),
        ("grade there --seed 1.5", "grade", "argument --seed: expected a whole number, found '1.5'"),
        ("dev errors --minutes few", "dev errors", "argument --minutes: expected a number such as 0.5, found 'few'"),
        ("watch --no-opn", "watch", "--no-opn: there is no such option; did you mean --no-open?"),
        ("export canvs", "export", "argument SYSTEM: 'canvs' is none of its values; did you mean canvas?"),
        ("dev lnt", "dev", "argument WHAT: 'lnt' is none of its values; did you mean lint?"),
        ("grade a --feedback x", "grade", "argument --feedback: 'x' is none of its values; expected full, diagnosis "
         "or score"),
        ("grade-class submissions", "grade-class", "expected --out OUT (where class.sqlite, results.csv and the rest "
         "go); such as: ./raysteps grade-class submissions --out grades"),
        ("grade-class submissions --out", "grade-class", "expected --out OUT (where class.sqlite, results.csv and the "
         "rest go); such as: ./raysteps grade-class submissions --out grades"),
        ("desk grades --port", "desk", "expected --port N (of the page (any that is free))"),
        ("compare", "compare", "expected MINE (a picture, .png or .ppm) and REFERENCE (another one of the same size); "
         "such as: ./raysteps compare mine.png reference.png"),
        ("release", "release", "expected --out DIR (a new or empty folder, or an earlier release) or --check PATH "
         "(look for solutions in a folder or zip that is to go out); such as: ./raysteps release --out ../course"),
        ("bench", "bench", "expected WHAT (render, mitsuba, scale, threads, parse, loop, waits, play, boxes, grading "
         "or docs); such as: ./raysteps bench render"),
        ("dev new", "dev new", "expected NN-name (the next number and a name, such as 20-fog)"),
    ],
)  # fmt: skip
def test_the_usage_is_that_of_the_command_and_one_line_says_what_is_wrong(
    typed: str, command: str, wrong: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(typed.split())
    said = capsys.readouterr().err
    assert said.startswith(f"usage: raysteps {command} [-h]")
    typed_here = wrong.replace("./raysteps", own_command())
    assert said.splitlines()[-1] == f"raysteps {command}: error: {typed_here}"


def test_a_command_that_needs_words_has_an_example_that_it_takes(project: Project) -> None:
    parser = new_parser(project)
    assert parser._subparsers is not None
    commands = parser._subparsers._group_actions[0].choices
    assert isinstance(commands, dict)
    for name in set(commands) - set(EXAMPLES):
        assert parser.parse_args([name]).command == name
    for name, words in EXAMPLES.items():
        assert parser.parse_args([name, *words.split()]).command == name


@pytest.mark.parametrize("command", ["watch", "play", "desk grades"])
def test_a_browser_is_kept_shut_by_one_option_everywhere(command: str, project: Project) -> None:
    parser = new_parser(project)
    for option in ("--no-open", "--no-browser", "--no"):
        told = vars(parser.parse_args([*command.split(), option]))
        assert told.get("no_open") or told.get("browser") is False


def test_an_option_before_any_command(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(["--verison"])
    assert "error: --verison: there is no such option; did you mean --version?\n" in capsys.readouterr().err


def test_a_folder_where_a_file_is_wanted_is_no_fault_of_the_grader(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    with pytest.raises((IsADirectoryError, PermissionError)) as raised:
        tmp_path.read_bytes()
    assert exit_code_of(raised.value) == 2
    said = "it is a folder; expected a file there" if sys.platform != "win32" else "no permission"
    assert capsys.readouterr().err.startswith(f"raysteps: {tmp_path}: {said}")


def test_a_report_of_nothing(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    course = small_project(tmp_path)
    monkeypatch.setattr(app, "here", lambda: course)
    assert main(["report"]) == 2
    assert "there is no check yet that could be shown: expected its results.json; " in capsys.readouterr().err


def test_a_command_that_is_none(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(["chekc", "01"])
    assert "chekc: there is no such command; did you mean check? See ./raysteps --help" in capsys.readouterr().err


def test_no_word_is_a_command_to_github_actions() -> None:
    words = [sys.executable, "-P", "-m", "raysteps", "##[error]x"]
    said = subprocess.run(words, capture_output=True, text=True, env={**os.environ, "GITHUB_ACTIONS": "true"}).stderr
    assert "# #[error]x: there is no such command" in said
    written = io.StringIO()
    app._ActionsLog(written).writelines(["a\n", "::error::b"])
    assert written.getvalue() == "a\n: :error::b"


@pytest.mark.parametrize("word", sorted(app._MEANT))
def test_a_word_of_another_program_is_answered_with_what_comes_nearest(
    word: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        main([word, "01"])
    said = capsys.readouterr().err
    command = re.search(r"error: (\w+): there is no such command; did you mean (\w+)\?", said)
    assert command is not None
    assert command[2] == app._MEANT[word]


@pytest.mark.parametrize(
    ("typed", "same"),
    [
        ("help", "--help"),
        ("help check", "check --help"),
        ("help export canvas", "export canvas --help"),
        ("version", "--version"),
    ],
)
def test_help_and_version_are_what_they_are_as_options(
    typed: str, same: str, capsys: pytest.CaptureFixture[str]
) -> None:
    said = []
    for words in (typed, same):
        with pytest.raises(SystemExit) as ended:
            main(words.split())
        assert ended.value.code == 0
        said.append(capsys.readouterr().out)
    assert said[0] == said[1] != ""


def test_help_with_what_is_no_command(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["help", "chek"])
    assert ended.value.code == 2
    assert "chek: there is no such command; did you mean check?" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        ("grade x.zip", "grade: only the instructor's kit has this command; yours is a students' kit, made from that "
         "one with `./raysteps release`. Here `./raysteps check` comes nearest: check your own steps. See ./raysteps"),
        ("gallery", "Here `./raysteps finale` comes nearest: a large smooth picture"),
        ("dev lint", "made from that one with `./raysteps release`. See ./raysteps --help"),
        ("chekc", "chekc: there is no such command; did you mean check?"),
        ("inspect a.nff 1 2 --against reference", "--against: a students' kit has no reference; pictures made with it "
         "lie in reference/"),
        ("finale --impl=reference", "--impl: a students' kit has no reference; pictures made with it lie in refer"),
    ],
)  # fmt: skip
def test_what_only_the_instructors_kit_has(
    typed: str, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    course = small_project(tmp_path)
    monkeypatch.setattr(app, "here", lambda: course)
    with pytest.raises(SystemExit, match="2"):
        main(typed.split())
    assert said in capsys.readouterr().err


def test_what_only_a_students_kit_has(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(["update"])
    assert "update: only a students' kit has this command; `./raysteps release` makes" in capsys.readouterr().err


def test_a_students_kit_offers_nothing_that_it_refuses(tmp_path: Path) -> None:
    course = small_project(tmp_path)
    parsers = new_parser(course)._subparsers
    assert parsers is not None
    commands = parsers._group_actions[0].choices
    assert isinstance(commands, dict)
    assert len(commands) > 10
    for name, parser in commands.items():
        assert not re.search(r"reference\b|whole kit|boxes|--impl|--against", parser.format_help()), name


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


def test_a_call_of_the_system_that_is_refused_is_the_graders_fault(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It names no file, so nobody can open anything."""

    def refused(*_: object) -> None:
        raise PermissionError(errno.EPERM, "Operation not permitted")

    monkeypatch.setattr("raysteps.progress.standing.standings", refused)
    assert main(["list"]) == 4
    assert "this is a fault of the grader" in capsys.readouterr().err


def test_several_submissions_in_one_folder_are_no_submission(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    for name in ("bob jones", "ann"):
        (tmp_path / name / "steps" / "01-camera-rays").mkdir(parents=True)
        (tmp_path / name / "steps" / "01-camera-rays" / "camera_rays.cpp").write_text("int a;")
    assert main(["grade", str(tmp_path)]) == 2
    assert capsys.readouterr().err == (
        f"raysteps: {tmp_path}: holds several submissions, among them ann and bob jones. "
        f"Grade one of them with `./raysteps grade {tmp_path / 'ann'}`, "
        f"or all with `./raysteps grade-class {tmp_path} --out grades`\n"
    )


def test_one_submission_is_no_class(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    ann = tmp_path / "ann"
    (ann / "steps" / "01-camera-rays").mkdir(parents=True)
    (ann / "steps" / "01-camera-rays" / "camera_rays.cpp").write_text("int a;")
    assert main(["grade-class", str(ann), "--out", str(tmp_path / "out")]) == 2
    assert f"{ann}: is one submission. Grade it with `./raysteps grade {ann}`" in capsys.readouterr().err
    assert main(["grade-class", str(tmp_path / "an"), "--out", str(tmp_path / "out")]) == 2
    assert "one entry per submission; did you mean ann?" in capsys.readouterr().err
    assert like(ann) == ""  # what cannot be read is not meant by its own name
    assert not (tmp_path / "out").exists()


def test_a_path_that_looks_like_an_option(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for words in (["grade", "-ann"], ["grade", "ann", "--out", "-ann"]):
        assert "./-ann" not in _refused(words, capsys)
        (tmp_path / "-ann").mkdir()
        assert _refused(words, capsys).endswith("a path that begins with '-' is typed like ./-ann\n")
        (tmp_path / "-ann").rmdir()


def _refused(words: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    with pytest.raises(SystemExit, match="2"):
        main(words)
    return capsys.readouterr().err


def test_a_file_is_no_class(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    (tmp_path / "a.txt").touch()
    assert main(["similar", str(tmp_path / "a.txt"), "--out", str(tmp_path / "s.html")]) == 2
    assert "a.txt: it is no folder; expected a folder with one entry per submission\n" in capsys.readouterr().err


def test_the_beginning_of_an_option_is_known(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Project, "build", property(lambda _: tmp_path))  # where it keeps what was read
    assert main(["hint", "01", "--al"]) == 0
    assert "hint 3 of 3" in capsys.readouterr().out
    assert (tmp_path / "hints.json").is_file()


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


@pytest.mark.parametrize("out", ["ann", "ann/results", "ann/../ann", "link"])
def test_a_submission_stays_as_it_was_handed_in(capsys: pytest.CaptureFixture[str], tmp_path: Path, out: str) -> None:
    ann = tmp_path / "ann"
    (ann / "steps" / "01-camera-rays").mkdir(parents=True)
    (ann / "steps" / "01-camera-rays" / "camera_rays.cpp").write_text("int a;")
    (ann / "results.json").write_text("my own notes")
    if out == "link":
        (tmp_path / "link").symlink_to(ann)
    assert main(["grade", str(ann), "--out", str(tmp_path / out)]) == 2
    told = f"--out {tmp_path / out}: the results would lie among what was handed in, {ann}; name a folder outside of it"
    assert told in capsys.readouterr().err
    assert sorted(path.name for path in ann.iterdir()) == ["results.json", "steps"]
    assert (ann / "results.json").read_text() == "my own notes"


def test_a_whole_kit_may_be_graded_into_its_build_folder(tmp_path: Path) -> None:
    refuse_results_in(tmp_path, tmp_path / "build" / "grades", ("pictures",))
    refuse_results_in(tmp_path / "ann.zip", tmp_path, ("pictures",))
    with pytest.raises(UsageError, match="among what was handed in"):
        refuse_results_in(tmp_path / "pictures" / "ann", tmp_path, ("pictures",))


@pytest.mark.parametrize("link", ["build", "build/grades", "build/grades/pictures", "build/grades/pictures/07"])
def test_results_do_not_follow_links_that_were_handed_in(tmp_path: Path, link: str) -> None:
    (tmp_path / "somebody").mkdir()
    ann = tmp_path / "ann"
    (ann / link).parent.mkdir(parents=True)
    (ann / link).symlink_to(tmp_path / "somebody")
    with pytest.raises(UsageError, match=f"{link} is a link that was handed in"):
        refuse_results_in(ann, ann / "build" / "grades", ("pictures",))
    (tmp_path / "alias").symlink_to(ann)
    (ann / link).unlink()
    refuse_results_in(tmp_path / "alias", tmp_path / "alias" / "build" / "grades", ("pictures",))
