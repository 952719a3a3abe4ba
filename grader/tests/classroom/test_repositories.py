"""What students have pushed is fetched from repositories that are theirs: none of it runs, and none of it leads out."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from class_fakes import FIRST
from test_nightly import Course

import raysteps.classroom.repositories
from raysteps.classroom.repositories import CannotFetch, Remotes, checked_address, fetch_all, newest_commit
from raysteps.classroom.roster import Student, read_roster
from raysteps.common.errors import UsageError
from raysteps.submission.entries import MAX_SOURCE

pytestmark = [
    pytest.mark.usefixtures("fake_grader"),
    pytest.mark.skipif(sys.platform == "win32", reason="a class is graded on Unix"),
]
_NAMES = {"camera_rays.cpp", "octree.cpp"}
_STEP = f"steps/{FIRST}"
_IDENTITY = {
    **{f"GIT_{who}_{what}": "x@example.edu" for who in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")},
    "GIT_CONFIG_GLOBAL": os.devnull,
}


def _git(folder: Path, *words: str) -> str:
    done = subprocess.run(
        ["git", "-c", "init.defaultBranch=main", "-c", "protocol.file.allow=always", "-C", str(folder), *words],
        env={**os.environ, **_IDENTITY},
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout.strip()


class Pushed:
    """A student's clone, and the bare repository that it is pushed to."""

    def __init__(self, root: Path, name: str) -> None:
        self.bare, self.clone = root / "remotes" / f"{name}.git", root / "clones" / name
        self.clone.mkdir(parents=True)
        self.bare.mkdir(parents=True)
        _git(self.bare, "init", "-q", "--bare")
        _git(self.clone, "init", "-q")
        _git(self.clone, "remote", "add", "origin", str(self.bare))

    def write(self, place: str, data: bytes) -> None:
        (self.clone / place).parent.mkdir(parents=True, exist_ok=True)
        (self.clone / place).write_bytes(data)

    def push(self, branch: str = "main") -> None:
        _git(self.clone, "add", "-A")
        _git(self.clone, "commit", "-q", "--allow-empty", "-m", "work")
        _git(self.clone, "push", "-q", "-f", "origin", f"HEAD:refs/heads/{branch}")


def _student(number: str, repository: str) -> Student:
    return Student(2, number, "", "", repository=repository)


def _fetched(tmp_path: Path, *students: Student, branch: str = "") -> tuple[Path, list[str], list[Student]]:
    said: list[str] = []
    remotes = Remotes(tmp_path / "fetched", branch, tmp_path / "remotes")
    found = fetch_all(remotes, students, _NAMES, said.append)
    return remotes.entries, said, found


def _files(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_the_newest_state_is_fetched(tmp_path: Path) -> None:
    ann = Pushed(tmp_path, "ann")
    ann.write(_STEP, b"// one\r\n\xff")
    ann.write("framework/core/ray.cpp", b"the kit's")
    ann.push()
    entries, said, students = _fetched(tmp_path, _student("4711", "ann.git"))
    assert said == []
    assert _files(entries) == {f"4711/{_STEP}": b"// one\r\n\xff"}, "byte by byte, and nothing but steps"
    assert students[0].submission == "4711"
    before = (entries / "4711").stat().st_ino
    _fetched(tmp_path, _student("4711", "ann.git"))
    assert (entries / "4711").stat().st_ino == before, "nothing new"
    ann.write(_STEP, b"// two\n")
    ann.push()
    _git(ann.clone, "commit", "-q", "--amend", "-m", "forced")
    _git(ann.clone, "push", "-q", "-f", "origin", "HEAD:main")
    _fetched(tmp_path, _student("4711", "ann.git"))
    assert _files(entries) == {f"4711/{_STEP}": b"// two\n"}
    assert sorted(path.name for path in (tmp_path / "fetched").iterdir()) == ["commits", "entries"]


def test_a_branch_a_team_and_who_left(tmp_path: Path) -> None:
    ann = Pushed(tmp_path, "ann")
    ann.write(_STEP, b"// main\n")
    ann.push()
    ann.write(_STEP, b"// hand-in\n")
    ann.push("hand-in")
    team = (_student("1", "ann.git"), _student("2", "ann.git"))
    entries, _, students = _fetched(tmp_path, *team, branch="hand-in")
    assert _files(entries) == {f"1_2/{_STEP}": b"// hand-in\n"}
    assert [student.submission for student in students] == ["1_2", "1_2"]
    entries, said, _ = _fetched(tmp_path, *team, branch="none")
    assert "there is no branch none in it yet" in said[0]
    assert _files(entries) == {f"1_2/{_STEP}": b"// hand-in\n"}, "what was there stays"
    entries, _, _ = _fetched(tmp_path, _student("2", "ann.git"))
    assert _files(entries) == {f"2/{_STEP}": b"// main\n"}


def test_a_repository_that_cannot_be_had_keeps_nobody_else(tmp_path: Path) -> None:
    ann = Pushed(tmp_path, "ann")
    ann.write(_STEP, b"// one\n")
    ann.push()
    Pushed(tmp_path, "empty")
    (tmp_path / "remotes" / "none").mkdir()
    names = ("none", "empty.git", "gone.git", "ext::sh -c 'touch /tmp/x'", "ann.git")
    entries, said, _ = _fetched(tmp_path, *(_student(str(at), name) for at, name in enumerate(names)))
    assert _files(entries) == {f"4/{_STEP}": b"// one\n"}
    assert [words.partition(":")[0] for words in said] == ["0", "1", "2", "3"]
    assert "no commit in it yet" in said[1]


@pytest.mark.parametrize(
    "text",
    [
        *("ext::sh -c touch% /tmp/x", "--upload-pack=touch /tmp/x", "-oProxyCommand=x", "file:///etc", "/etc"),
        *("http://example.edu/a.git", "git://example.edu/a.git", "ftp://example.edu/a", "fd::17/x", "https://"),
        *("https://user:word@example.edu/a.git", "https://-x/a", "ssh://-oProxyCommand=x/a", "ssh://host/-x y"),
        *("-x@host:a", "git@-host:a", "git@host:-a", "git@host:a;b", "git@host:$(x)", "https://host/a\n--exec=x"),
        *("../kit", "..", ".", "", "remotes/../../kit", "a\0b", "transport::https://example.edu/a.git", "host:a"),
    ],
)
def test_other_addresses_are_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "remotes").mkdir()
    (tmp_path / "kit").mkdir()
    for local in (None, tmp_path / "remotes"):
        with pytest.raises(UsageError, match="no address of a repository"):
            checked_address(text, local)


@pytest.mark.parametrize(
    "text",
    [
        *("https://github.com/course/steps-ann.git", "https://git.example.edu:8443/~ann/steps"),
        *("ssh://git@example.edu:2222/ann/steps.git", "git@github.com:course/steps-ann.git"),
    ],
)
def test_usual_addresses_are_taken_as_they_are(text: str) -> None:
    assert checked_address(text, None) == text


def test_a_link_in_the_local_folder_leads_nowhere_else(tmp_path: Path) -> None:
    (tmp_path / "remotes").mkdir()
    (tmp_path / "kit").mkdir()
    (tmp_path / "remotes" / "ann").symlink_to(tmp_path / "kit")
    with pytest.raises(UsageError):
        checked_address("ann", tmp_path / "remotes")


def test_nothing_in_a_repository_runs_or_leads_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Links, submodules, filters and hooks are only text."""
    touched = tmp_path / "touched"
    settings = tmp_path / "gitconfig"
    settings.write_text(
        f'[filter "x"]\n\tsmudge = touch {touched}\n\tprocess = touch {touched}\n'
        f"[core]\n\thooksPath = {tmp_path / 'hooks'}\n\tfsmonitor = touch {touched}\n"
    )
    (tmp_path / "hooks").mkdir()
    for hook in ("reference-transaction", "post-checkout", "post-merge", "fsmonitor-watchman"):
        (tmp_path / "hooks" / hook).write_text(f"#!/bin/sh\ntouch {touched}\n")
        (tmp_path / "hooks" / hook).chmod(0o755)
    other, ann = Pushed(tmp_path, "other"), Pushed(tmp_path, "ann")
    other.write(_STEP, b"// another's\n")
    other.push()
    ann.write(_STEP, b"// mine\n")
    ann.write(".gitattributes", b"*.cpp filter=x export-ignore\n")
    (ann.clone / "steps" / "06-octree").mkdir()
    (ann.clone / "steps" / "06-octree" / "octree.cpp").symlink_to("/etc/passwd")
    _git(ann.clone, "submodule", "add", "-q", "-f", str(other.bare), "module")
    ann.push()
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", str(settings))
    monkeypatch.setenv("GIT_DIR", str(tmp_path / "elsewhere"))
    entries, said, _ = _fetched(tmp_path, _student("1", "ann.git"))
    assert said == []
    assert _files(entries) == {f"1/{_STEP}": b"// mine\n"}
    assert not touched.exists()


def test_what_is_too_large_is_refused_by_the_reader_and_too_much_by_git(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ann = Pushed(tmp_path, "ann")
    ann.write(_STEP, b"x" * (MAX_SOURCE + 7))
    ann.push()
    entries, _, _ = _fetched(tmp_path, _student("1", "ann.git"))
    assert [len(data) for data in _files(entries).values()] == [MAX_SOURCE + 1]
    bob = Pushed(tmp_path, "bob")
    bob.write("film.mp4", os.urandom(3 << 20))
    bob.write(_STEP, b"// one\n")
    bob.push()
    monkeypatch.setattr(raysteps.classroom.repositories, "_MAX_PACK", 1 << 20)
    entries, said, _ = _fetched(tmp_path, _student("1", "ann.git"), _student("2", "bob.git"))
    assert said[0].startswith("2: nothing was fetched")
    assert not (entries / "2").exists()
    cy = Pushed(tmp_path, "cy")
    for at in range(201):
        cy.write(f"{at}/camera_rays.cpp", b"// one\n")
    cy.push()
    _, said, _ = _fetched(tmp_path, _student("3", "cy.git"))
    assert "more than 200 files that are called like steps" in said[0]


def test_a_remote_that_never_answers_is_given_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tools = tmp_path / "tools"
    tools.mkdir()
    (tools / "git").write_text("#!/bin/sh\nexec sleep 600\n")
    (tools / "git").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tools}:{os.environ['PATH']}")
    monkeypatch.setattr(raysteps.classroom.repositories, "_SECONDS", 0.2)
    with pytest.raises(CannotFetch, match="longer than"):
        newest_commit("https://example.edu/a.git", "")


def test_the_column_of_the_roster(tmp_path: Path) -> None:
    roster = tmp_path / "students.csv"
    roster.write_text("Student ID,Repository URL\n1,git@example.edu:ann/steps.git\n2,\n")
    assert [student.repository for student in read_roster(roster)] == ["git@example.edu:ann/steps.git", ""]


def test_nightly_from_repositories(tmp_path: Path) -> None:
    ann, bob = Pushed(tmp_path, "ann"), Pushed(tmp_path, "bob")
    for one in (ann, bob):
        one.write(_STEP, b"// points 2\n")
    ann.push()
    roster = tmp_path / "students.csv"
    roster.write_text("id,repository\n1,ann.git\n2,bob.git\n3,ext::x\n4,\n")
    course = Course(tmp_path)
    course.words = ["--git", "--local", tmp_path / "remotes", "--roster", roster, "--per-day", "1"]
    assert course.look() == 0
    assert course.points("1") == 2.0
    assert course.report("1")
    assert "2: nothing was fetched" in course.said
    assert "3: nothing was fetched" in course.said
    bob.push()
    ann.write(_STEP, b"// points 5\n")
    ann.push()
    assert course.look() == 0
    assert course.report("2")
    assert "waiting until" in course.said
    assert course.points("1") == 2.0
