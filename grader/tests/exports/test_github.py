"""Classroom 50 and the older GitHub Classroom."""

import ast
import base64
import io
import json
import os
import re
import subprocess
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from export_documents import HOSTILE, document, full, mixed, step_result
from PIL import Image

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.markdown import prose
from raysteps.common.text import harmless_log
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.exports.autograders import classroom50_autograder, github_workflow
from raysteps.exports.formats import validate
from raysteps.exports.github import (
    output_line,
    release_assets,
    release_body,
    release_files,
    to_classroom50,
    to_legacy,
    whole_points,
)
from raysteps.exports.hosted import by_id, deliver_github, submitted_at
from raysteps.report.wording import total_words
from raysteps.results.model import Results

ENVIRONMENT = {
    "CLASSROOM": "graphics",
    "ASSIGNMENT": "raysteps",
    "SUBMISSION_TAG": "submit/2026-10-01T12-00-00Z-a1b2c3d",
    "COMMIT_URL": "https://github.com/o/r/commit/1",
    "RELEASE_URL": "https://github.com/o/r/releases/tag/1",
    "REVIEW_URL": "",
    "OWNER": "ann",
    "ASSIGNMENT_TYPE": "individual",
}
WHEN = datetime(2026, 10, 1, 14, 0, tzinfo=UTC)


def test_classroom50(steps: list[Step]) -> None:
    made = mixed(steps)
    result = to_classroom50(made, by_id(steps), ENVIRONMENT, WHEN)
    validate(result, "classroom50")
    assert result["datetime"] == "2026-10-01T14:00:00Z"
    assert result["review"] == ENVIRONMENT["COMMIT_URL"]
    assert (result["owner"], result["assignment_type"]) == ("ann", "individual")
    assert result["score"] == sum(test["score"] for test in result["tests"]) == round(made.total.points)
    assert result["max-score"] == sum(test["max-score"] for test in result["tests"]) == 120
    assert [test["passed"] for test in result["tests"]] == [True, *[False] * 4, True, *[False] * 3]


@pytest.mark.parametrize("share", [0.0, 0.1, 0.37, 0.5, 0.83, 0.99, 1.0])
def test_whole_points(steps: list[Step], share: float) -> None:
    made = document([step_result(step, share=share) for step in steps])
    pairs = whole_points(made)
    assert sum(points for points, _ in pairs) == int(made.total.points + 0.5)
    assert [most for _, most in pairs] == [10, 20, 15, 10, 15, 20, 10, 10, 10]
    for (points, most), result in zip(pairs, made.steps, strict=True):
        assert 0 <= points <= most
        assert abs(points - result.points) < 1


def test_what_the_runner_did_not_set_is_named(steps: list[Step]) -> None:
    with pytest.raises(UsageError, match="CLASSROOM, RELEASE_URL"):
        to_classroom50(mixed(steps), by_id(steps), {**ENVIRONMENT, "CLASSROOM": "", "RELEASE_URL": ""}, WHEN)


def test_numbers_must_be_whole(steps: list[Step]) -> None:
    result = to_classroom50(mixed(steps), by_id(steps), ENVIRONMENT, WHEN)
    result["tests"][0]["score"] = 2.5
    with pytest.raises(GraderFault, match=r"tests\[0\].score"):
        validate(result, "classroom50")


def test_legacy_output(steps: list[Step], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sink = tmp_path / "output"
    sink.write_text("before=1\n")
    monkeypatch.setenv("GITHUB_OUTPUT", str(sink))
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(tmp_path / "summary"))
    deliver_github(mixed(steps, HOSTILE), by_id(steps), None, tmp_path, tmp_path, legacy=True)
    first, second = sink.read_text().splitlines()
    assert first == "before=1"
    result = json.loads(base64.b64decode(second.removeprefix("result=")))
    validate(result, "github-legacy")
    assert result["status"] == "fail"
    assert result["max_score"] == 120
    assert "##[" not in json.dumps(result)
    assert not any(line.lstrip().startswith("::") for test in result["tests"] for line in test["message"].splitlines())
    assert result["tests"][1]["filename"] == "steps/02-intersection/intersection.cpp"
    assert (tmp_path / "summary").read_text().startswith("### ")


def test_legacy_status(steps: list[Step], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = full(steps)
    made.steps[7].status, made.steps[7].points = "not-started", 0.0
    assert to_legacy(made, by_id(steps))["status"] == "pass", "a bonus need not be started"
    assert output_line({"version": 1}).count("\n") == 1
    monkeypatch.delenv("GITHUB_OUTPUT", raising=False)
    with pytest.raises(UsageError, match="GITHUB_OUTPUT"):
        deliver_github(made, by_id(steps), None, tmp_path, tmp_path, legacy=True)


def _git(folder: Path, *words: str, stdin: str = "") -> str:
    environment = {**os.environ, "GIT_COMMITTER_DATE": "2026-09-30T10:00:00+02:00", "GIT_CONFIG_GLOBAL": "/dev/null"}
    command = ["git", "-c", "user.name=a", "-c", "user.email=a@x", *words]
    return subprocess.run(
        command, cwd=folder, check=True, env=environment, input=stdin, stdout=subprocess.PIPE, text=True
    ).stdout.strip()


_WHEN = datetime(2026, 9, 30, 8, 0, tzinfo=UTC)


def _is_now(when: datetime) -> bool:
    return abs(when - datetime.now(UTC)) < timedelta(minutes=1)


@pytest.mark.parametrize("kind", ["sha1", "sha256"])
@pytest.mark.parametrize("usual", ["sha1", "sha256"])
def test_the_commit_says_when(tmp_path: Path, kind: str, usual: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GIT_DEFAULT_HASH", usual)
    _git(tmp_path, "init", "-q", f"--object-format={kind}")
    _git(tmp_path, "commit", "-q", "--allow-empty", "-m", "x")
    assert submitted_at(tmp_path) == _WHEN
    _git(tmp_path, "pack-refs", "--all", "--prune")
    _git(tmp_path, "repack", "-a", "-d", "-q")
    assert submitted_at(tmp_path) == _WHEN, "packed"
    _git(tmp_path, "checkout", "-q", "--detach")
    assert submitted_at(tmp_path) == _WHEN, "no branch, as where a workflow has checked it out"


def test_the_commit_is_found_where_git_finds_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    first, elsewhere, beside = tmp_path / "first", tmp_path / "store", tmp_path / "first" / "beside"
    first.mkdir()
    _git(first, "init", "-q", "-b", "main", f"--separate-git-dir={elsewhere}")
    _git(first, "commit", "-q", "--allow-empty", "-m", "x")
    assert submitted_at(first) == _WHEN, "as in a submodule"
    _git(first, "worktree", "add", "-q", str(beside))
    (beside / "steps").mkdir()
    for packed in (False, True):
        if packed:
            _git(first, "pack-refs", "--all", "--prune")
        assert submitted_at(beside) == _WHEN, "a work tree of its own"
        assert submitted_at(beside / "steps" / ".." / "steps") == _WHEN, "a folder in it"
    _git(first, "symbolic-ref", "refs/heads/other", "refs/heads/main")
    (elsewhere / "HEAD").write_text("ref: refs/heads/other\n", encoding="ascii")
    others = "".join(f"{number:040x} refs/tags/{number}\n" for number in range(40_000))
    packed_references = elsewhere / "packed-refs"
    packed_references.write_text(others + packed_references.read_text(), encoding="ascii")
    assert submitted_at(first) == _WHEN, "a name for a name, in a long list"
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    "head", ["", "ref: refs/heads/main", "ref: refs/heads/\0", "ref: refs/heads/again", "0" * 40, "é" * 40]
)
def test_what_is_no_commit_is_as_old_as_the_grade(
    tmp_path: Path, head: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert _is_now(submitted_at(tmp_path))
    (tmp_path / ".git" / "refs" / "heads").mkdir(parents=True)
    (tmp_path / ".git" / "refs" / "heads" / "again").write_text("ref: refs/heads/again\n", encoding="ascii")
    (tmp_path / ".git" / "HEAD").write_text(head, encoding="utf-8")
    assert _is_now(submitted_at(tmp_path))
    assert capsys.readouterr().err.count("the result has the time of grading") == 2


@pytest.mark.parametrize("place", ["nowhere", "\0", "."])
def test_a_store_that_is_none_is_as_old_as_the_grade(tmp_path: Path, place: str) -> None:
    (tmp_path / ".git").write_text(f"gitdir: {place}\n", encoding="ascii")
    assert _is_now(submitted_at(tmp_path))


@pytest.mark.skipif(os.name == "nt", reason="the program is a shell's")
def test_a_repository_names_no_program_to_ask_when(tmp_path: Path) -> None:
    """Git starts what a configuration names to look at a signature."""
    _git(tmp_path, "init", "-q")
    _git(tmp_path, "commit", "-q", "--allow-empty", "-m", "x")
    head, _, words = _git(tmp_path, "cat-file", "commit", "HEAD").partition("\n\n")
    signed = f"{head}\ngpgsig -----BEGIN PGP SIGNATURE-----\n \n -----END PGP SIGNATURE-----\n\n{words}\n"
    _git(tmp_path, "update-ref", "HEAD", _git(tmp_path, "hash-object", "-w", "-t", "commit", "--stdin", stdin=signed))
    program, mark = tmp_path / "verify", tmp_path / "started"
    program.write_text(f"#!/bin/sh\ntouch '{mark}'\n", encoding="ascii")
    program.chmod(0o755)
    _git(tmp_path, "config", "log.showSignature", "true")
    _git(tmp_path, "config", "gpg.program", str(program))
    assert submitted_at(tmp_path) == _WHEN
    assert not mark.exists()
    _git(tmp_path, "show", "-s", "HEAD")
    assert mark.exists(), "this is how it would be started"


@pytest.mark.parametrize("legacy", [False, True])
def test_workflow(legacy: bool) -> None:
    text = github_workflow("org/kit.private", ["--minutes", "9", "--seed", "5"], legacy=legacy).decode()
    assert "repository: org/kit.private\n" in text
    assert "--run ../submission" in text
    assert "--minutes 9 --seed 5" in text
    assert "@" not in text.replace("actions/checkout@v4", "").replace("upload-artifact@v4", "").replace(
        "reporter@v1", ""
    )
    assert ("--legacy" in text) == legacy
    for bad in (None, "kit", "a/b\n- run: evil", "a/b c", "../x"):
        with pytest.raises(UsageError, match="--kit"):
            github_workflow(bad, [], legacy=legacy)


def test_autograder_is_python() -> None:
    words = ["--minutes", "9", "--limit", "memory_mb='512'"]
    text = classroom50_autograder(words).decode()
    found = next(node for node in ast.parse(text).body if isinstance(node, ast.Assign))
    assert ast.literal_eval(found.value) == words


def test_no_form_of_a_command_is_left() -> None:
    assert harmless_log("a ##[set-output name=x]1\n  ::error::b\nc::d ###[x\r ::e") == (
        "a # #[set-output name=x]1\n  : :error::b\nc::d ## #[x\r : :e"
    )


def _with_pictures(made: Results, folder: Path) -> Results:
    for result in made.steps:
        for image in result.images:
            for kind in ("mine", "reference", "difference"):
                setattr(image, kind, f"pictures/{result.id}-{image.name}-{kind}.png")
                (folder / "pictures").mkdir(exist_ok=True)
                Image.new("RGB", (40, 30), (9, 9, 9)).save(folder / getattr(image, kind))
    return made


def test_the_release_gets_the_report_and_a_picture_per_step(steps: list[Step], tmp_path: Path) -> None:
    files = release_files(_with_pictures(mixed(steps), tmp_path), by_id(steps), tmp_path)
    with_pictures = [step.id for step in steps if step.index not in (7, 8)]  # not built, not begun
    assert set(files) == {"raysteps-report/report.html", *(f"raysteps-report/{name}.png" for name in with_pictures)}
    for name in with_pictures:
        with Image.open(io.BytesIO(files[f"raysteps-report/{name}.png"])) as picture:
            assert picture.height > 60 * len(next(step for step in steps if step.id == name).images)
    assert b"secret" not in files["raysteps-report/report.html"], "a hidden case"
    assert sum(map(len, files.values())) < 10 << 20


def test_the_files_are_those_that_the_documents_tell_to_publish(steps: list[Step], project: Project) -> None:
    """By Classroom 50's limits: at most 50 relative paths of 8 KiB in all, whose last parts are different, of letters,
    digits and `._-`, and not the runner's own."""
    paths = release_assets(step.id for step in steps)
    names = [path.rpartition("/")[2] for path in paths]
    assert len(paths) <= 50
    assert sum(len(path.encode()) for path in paths) <= 8192
    assert len(set(names)) == len(names)
    assert all(re.fullmatch(r"[A-Za-z0-9_-][A-Za-z0-9._-]*[A-Za-z0-9_-]", name) and ".." not in name for name in names)
    assert not {"result.json", "release-body.md"} & set(names)
    text = (project.root / "docs" / "exports.md").read_text()
    told = re.search(r'"release_assets": (\[[^]]*\])', text)
    assert told is not None
    assert json.loads(told[1]) == paths


def test_the_release_says_what_is_wrong(steps: list[Step], tmp_path: Path) -> None:
    made = mixed(steps, HOSTILE + "\n````\n# a heading\n| a | b |\n[x](javascript:alert)\n@everybody")
    files = ["raysteps-report/report.html", "raysteps-report/02-intersection.png"]
    listed = json.dumps([*files, "raysteps-report/03-phong-shading.png"])
    body = release_body(made, by_id(steps), files, {**ENVIRONMENT, "RELEASE_ASSETS": listed})
    assert body.startswith(f"### {total_words(made.total)}\n")
    assert "| 02 Intersection | partly right |" in body
    text = prose(body)
    assert "https://github.com/o/r/releases/download/1/report.html" in body
    assert body.count("releases/download/1/02-intersection.png") == 2, (
        "the picture, and the link where it cannot be seen"
    )
    assert "03-phong-shading.png" not in body, "it was not made"
    for said in ("script", "heading", "javascript", "everybody", "evil"):
        assert said in body
        assert said not in text, "what a program says is only a block of code"
    assert "secret" not in body


@pytest.mark.parametrize("assets", ["", "[", "{}", '["other.png"]'])
def test_there_are_no_links_to_what_is_not_published(steps: list[Step], assets: str) -> None:
    environment = {**ENVIRONMENT, "RELEASE_ASSETS": assets}
    assert "releases/download" not in release_body(mixed(steps), by_id(steps), release_assets(["01-x"]), environment)


def test_a_release_has_its_limit(steps: list[Step]) -> None:
    made = mixed(steps, "x " * 30_000)
    for result in made.steps:
        result.messages *= 30
        result.tests *= 40
    assert len(release_body(made, by_id(steps), (), ENVIRONMENT)) < 125_000
