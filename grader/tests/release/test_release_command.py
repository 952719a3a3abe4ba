"""The command `release`, as the documents have it, and what it leaves behind."""

import argparse
import re
import sys
import tomllib
from importlib.metadata import PackageNotFoundError, distribution
from itertools import chain
from pathlib import Path

import pytest
from doc_commands import all_commands
from rich.console import Console
from typed_commands import typed

from raysteps.cli.release import add_arguments, line_to_grade, refuse_inside
from raysteps.cli.release import run as run_release
from raysteps.common.errors import UsageError
from raysteps.common.process import Outcome, run
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.release.build_release import refuse_foreign_files


def test_the_folders_that_documents_name_can_be_written(project: Project) -> None:
    readme = project.root / "README.md"  # the site has a beginning of its own
    commands = [*all_commands(project), *chain(*typed(readme, readme.read_text(encoding="utf-8")))]
    found = [one for one in commands if one.words[:2] == ("./raysteps", "release") and not one.is_synopsis]
    outs = [Path(one.words[one.words.index("--out") + 1]) for one in found if "--out" in one.words]
    assert len(outs) >= 3
    for out in outs:
        refuse_inside(project, (project.root / out).resolve())
        refuse_foreign_files((project.root / out).resolve())


def test_a_release_among_the_files_of_the_kit_is_refused(tmp_path: Path) -> None:
    project = Project(tmp_path)
    for name in (".", "course", "new/kit", "build"):
        with pytest.raises(UsageError, match=r"lies in the kit's own folder; expected one elsewhere, such as \.\./"):
            refuse_inside(project, (tmp_path / name).resolve())
    for name in ("../course", "build/course"):
        refuse_inside(project, (tmp_path / name).resolve())


def test_a_page_to_work_in_lies_beside_the_release(project: Project, tmp_path: Path) -> None:
    """Refused before anything is built."""
    kit, out = project.root, tmp_path / "course"
    for place, said in (
        (out, "expected a folder beside the release, such as ../course-page"),
        (out / "play", "expected a folder beside the release, such as ../course-page"),
        (tmp_path, "expected a folder beside the release, such as ../course-page"),
        (kit / "play", "lies in the kit's own folder"),
        (kit / "docs", "lies in the kit's own folder"),
    ):
        with pytest.raises(UsageError, match=said):
            _run(project, "--out", str(out), "--play", str(place))
    (tmp_path / "full" / "a").mkdir(parents=True)
    with pytest.raises(UsageError, match="expected a new or an empty folder, or an older page to work in"):
        _run(project, "--out", str(out), "--play", str(tmp_path / "full"))
    assert [path.name for path in tmp_path.iterdir()] == ["full"]


def _run(project: Project, *words: str) -> int:
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    return run_release(project, parser.parse_args(words), Console(quiet=True))


def _release(project: Project, *words: str) -> Outcome:
    return run([sys.executable, "-P", "-m", "raysteps", "release", *words], seconds=900, cwd=project.root)


def _room(folder: Path, names: list[str]) -> Path:
    """A folder with these packages and those that they need, and no others."""
    waiting, done = list(names), set()
    folder.mkdir()
    while waiting:
        name = re.split(r"[^\w-]", waiting.pop(), maxsplit=1)[0].lower().replace("_", "-")
        if name in done:
            continue
        done.add(name)
        try:
            found = distribution(name)
        except PackageNotFoundError:  # for another system
            continue
        waiting += [text for text in found.requires or [] if "extra ==" not in text]
        for first in {Path(str(path)).parts[0] for path in found.files or []} - {"..", "__pycache__"}:
            (folder / first).symlink_to(Path(str(found.locate_file(first))))
    return folder


def _alone(root: Path, room: Path, *words: str) -> Outcome:
    """The kit in that folder, with Python's own modules and those that its pyproject.toml names."""
    roots = [str(root / "grader" / "src"), str(room)]
    start = f"import sys; sys.path[:0] = {roots!r}; sys.argv = ['raysteps', *{list(words)!r}]"
    program = f"{start}; import runpy; runpy.run_module('raysteps', run_name='__main__', alter_sys=False)"
    return run([sys.executable, "-I", "-S", "-c", program], seconds=900, cwd=root)


def test_the_line_that_grades_a_release_names_its_steps(steps: list[Step]) -> None:
    assert line_to_grade(steps[:4], steps) == "./raysteps grade-class submissions --out grades --only 1-4"
    assert line_to_grade(steps, steps) == "./raysteps grade-class submissions --out grades"


@pytest.mark.slow
def test_it_is_made_and_checked_in_an_empty_folder(
    project: Project, steps: list[Step], solved: dict[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "graphics-101"
    told = _release(project, "--out", str(out), "--steps", "1-4", "--course", "Graphics 101")
    assert told.code == 0, told.stdout + told.stderr
    assert "4 steps, no solution in any file" in told.stdout
    assert "of 55 points: ./raysteps grade-class submissions --out grades --only 1-4\n" in told.stdout
    assert [path.name for path in tmp_path.iterdir()] == ["graphics-101"]

    table = tomllib.loads((out / "grader" / "pyproject.toml").read_text(encoding="utf-8"))
    room = _room(tmp_path / "room", table["project"]["dependencies"])
    monkeypatch.delenv("PYTHONPATH", raising=False)
    stub = _alone(out, room, "check", "01")
    assert stub.code == 1, stub.stdout + stub.stderr
    assert "not started" in stub.stdout
    (out / "steps" / steps[0].path).write_text(solved[steps[0].id], encoding="utf-8")
    right = _alone(out, room, "check", "01")
    assert right.code == 0, right.stdout + right.stderr
    assert (out / "build" / "check" / "report.html").is_file()
    assert "next: ./raysteps watch 02" in _alone(out, room, "list").stdout


@pytest.mark.slow
def test_a_history_that_holds_a_solution_is_named(project: Project, solved: dict[str, str], tmp_path: Path) -> None:
    out = tmp_path / "course"
    assert _release(project, "--out", str(out), "--steps", "1").code == 0
    git: list[str | Path] = ["git", "-C", out, "-c", "user.name=a", "-c", "user.email=a@b.c"]
    (out / "notes.txt").write_text(solved["02-intersection"], encoding="utf-8")
    for words in (
        ["init", "-q"],
        ["add", "."],
        ["commit", "-qm", "a"],
        ["rm", "-q", "notes.txt"],
        ["commit", "-qm", "b"],
    ):
        assert run([*git, *words], seconds=60).code == 0
    before = (out / "README.md").read_bytes()
    for words in (["--out", str(out), "--steps", "1", "--course", "Two"], ["--check", str(out)]):
        told = _release(project, *words)
        assert told.code == 1, told.stdout + told.stderr
        assert "leak  .git, blob " in told.stdout
    assert "its history tells this for good" in _release(project, "--out", str(out), "--steps", "1").stdout
    assert (out / "README.md").read_bytes() == before
