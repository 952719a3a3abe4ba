"""The command `leaderboard`."""

import argparse
import json
import random
import shutil
import sqlite3
from collections.abc import Mapping
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from export_documents import document, step_result
from page_results import of_older_kit
from rich.console import Console

from raysteps.classroom.class_files import write_class
from raysteps.classroom.database import ClassDatabase, RegisteredEntry, RunFacts
from raysteps.classroom.jobs import JobResult
from raysteps.classroom.leaderboard import Leaderboard, print_board, rank, read_entries
from raysteps.cli.app import main
from raysteps.cli.leaderboard import add_arguments, run
from raysteps.common.documents import Malformed, as_text, convert
from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.results.model import Results, Settings, StepResult, Work

Document = dict[str, Any]


def _graded(steps: list[Step], name: str, tests: int = 1000, memory: int = 4000) -> Results:
    """Steps 06 and 09, with so many tests by 100 rays in each picture; the reference has 1000."""
    results = [step_result(step) for step in steps if step.limited_pictures]
    for image in (image for result in results for image in result.images):
        image.work = Work(100, tests // 4, tests - tests // 4, 9, 20, memory)
    return document(results, name)


def _class(folder: Path, results: Mapping[str, Results | str]) -> Path:
    """A graded class; a text is a fault, or `not graded`."""
    folder.mkdir()
    with closing(ClassDatabase(folder)) as database:
        entries = [RegisteredEntry(f"{name}.zip", name, "here") for name in results]
        run = database.begin_run(RunFacts("a", "kit", "/in", "1/1", Settings(), [], "", []), entries, [])
        for name, made in results.items():
            if isinstance(made, Results):
                database.record(run, JobResult(name, "graded", made), "key")
            elif made != "not graded":
                database.record(run, JobResult(name, "fault", None, fault=made), "key")
        database.end_run(run, "complete", {})
        write_class(database, folder)
    return folder


def _ranking(project: Project, out: Path, *words: str | Path) -> Document:
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    arguments = parser.parse_args([*map(str, words), "--json", str(out / "board.json")])
    assert run(project, arguments, Console(width=200)) == 0
    made: Document = json.loads((out / "board.json").read_text())
    return made


def _places(board: Document) -> list[tuple[int, str]]:
    return [(one["rank"], one["name"]) for one in board["ranked"]]


def _others(board: Document) -> dict[str, str]:
    return {one["name"]: one["reason"] for one in board["not_ranked"]}


def test_the_least_work_is_first_and_memory_decides_ties(tmp_path: Path, project: Project, steps: list[Step]) -> None:
    measured = {"ann": (2000, 1), "bob": (500, 9000), "cid": (500, 4000), "dan": (500, 4000), "eve": (1000, 4000)}
    measured["Cleo_Wu"] = (500, 4000)
    results = {name: _graded(steps, name, *numbers) for name, numbers in measured.items()}
    document = _ranking(project, tmp_path, _class(tmp_path / "class", results))
    assert [board["id"] for board in document["steps"]] == ["06-octree", "09-bvh"]
    for board in document["steps"]:
        assert _places(board) == [(1, "cid"), (1, "Cleo_Wu"), (1, "dan"), (4, "bob"), (5, "eve"), (6, "ann")]
        assert [one["work"] for one in board["ranked"]] == [0.5, 0.5, 0.5, 0.5, 1, 2]
        assert board["reference_bytes"] == 3000 * len(board["pictures"])
        assert board["not_ranked"] == []


def test_who_has_no_place_anywhere_is_told_once(
    tmp_path: Path, project: Project, steps: list[Step], capsys: pytest.CaptureFixture[str]
) -> None:
    wrong = _graded(steps, "wrong", 10)
    image = wrong.steps[0].images[1]
    image.passed, image.wrong_share, image.outcome = False, 0.2, "wrong"
    results: dict[str, Results | str] = {
        "right": _graded(steps, "right"),
        "wrong": wrong,
        "fault": "the moon is in the way",
        "later": "not graded",
    }
    document = _ranking(project, tmp_path, _class(tmp_path / "class", results))
    assert [sorted(_others(board)) for board in document["steps"]] == [["fault", "later", "wrong"], ["fault", "later"]]
    boards, nowhere = capsys.readouterr().out.split("Ranked in none of these steps\n")
    assert "wrong: " in boards
    assert "fault: " not in boards
    assert nowhere.count("fault: ") == nowhere.count("later: ") == 1


def test_only_right_pictures_are_ranked(
    tmp_path: Path, project: Project, steps: list[Step], capsys: pytest.CaptureFixture[str]
) -> None:
    wrong = _graded(steps, "wrong", 10)
    image = wrong.steps[0].images[1]
    image.passed, image.wrong_share, image.outcome = False, 0.2, "wrong"
    older = of_older_kit(_graded(steps, "older", 10))
    stub = document([StepResult(step.id, "not-started", 0.0, step.points, step.bonus) for step in steps], "stub")
    strange = replace(_graded(steps, "strange"), schema="raysteps/results/v0")  # type: ignore[arg-type]
    results: dict[str, Results | str] = {
        "wrong": wrong,
        "right": _graded(steps, "right"),
        "older": older,
        "stub": stub,
        "first": document([step_result(steps[0])], "first"),
        "fault": "the moon is in the way",
        "later": "not graded",
    }
    folder = _class(tmp_path / "class", results)
    octree, bvh = _ranking(project, tmp_path, folder)["steps"]
    reasons = {
        "wrong": "picture slivers-octree is not right",
        "older": "picture strands-octree has no counters, as when an older kit graded it; grade it again",
        "stub": "not started",
        "first": "the step was not graded",
        "fault": "not graded, because of a fault of the grader",
        "later": "not graded yet",
    }
    assert (_places(octree), _others(octree)) == ([(1, "right")], reasons)
    assert _places(bvh) == [(1, "wrong"), (2, "right")]
    shown = capsys.readouterr().out
    assert "wrong: picture slivers-octree is not right" in shown
    assert "A surface test and a box test weigh alike" in shown

    folder = _class(tmp_path / "strange", {"strange": strange})
    for name in ("class.sqlite", "class.json"):
        assert "of another form" in _others(_ranking(project, tmp_path, folder / name)["steps"][0])["strange"]


def test_every_form_of_a_class_gives_the_same(tmp_path: Path, project: Project, steps: list[Step]) -> None:
    results: dict[str, Results | str] = {
        "ann": _graded(steps, "ann", 700),
        "bob": _graded(steps, "bob", 600),
        "cid": "oops",
    }
    folder = _class(tmp_path / "class", results)
    expected = _ranking(project, tmp_path, folder)
    for place in ("class.json", "class.sqlite"):
        assert _ranking(project, tmp_path, folder / place) == expected
    copy = shutil.copy(folder / "class.sqlite", tmp_path)
    (folder / "class.sqlite").unlink()
    assert _ranking(project, tmp_path, folder) == expected
    with closing(sqlite3.connect(copy)) as connection, connection:
        connection.execute("UPDATE results SET document = CAST(x'7bff7d' AS TEXT) WHERE document != ''")
    with pytest.raises(UsageError, match="cannot be read as the database of a class: Could not decode"):
        read_entries([Path(copy)])


def test_results_in_any_order_give_the_same(tmp_path: Path, project: Project, steps: list[Step]) -> None:
    paths = []
    for name, tests in (("ann", 700), ("bob", 600), ("cid", 700)):
        paths.append(tmp_path / name / "results.json")
        paths[-1].parent.mkdir()
        paths[-1].write_text(as_text(_graded(steps, name, tests)))
    expected = _ranking(project, tmp_path, *paths, "--step", "6")
    assert [_places(board) for board in expected["steps"]] == [[(1, "bob"), (2, "ann"), (2, "cid")]]
    for seed in range(3):
        random.Random(seed).shuffle(paths)
        assert _ranking(project, tmp_path, *paths, "--step", "06-octree") == expected
    folders = [path.parent for path in paths]
    assert _ranking(project, tmp_path, *folders, "--step", "06") == expected


def test_names_that_occur_twice_are_told_apart(tmp_path: Path, project: Project, steps: list[Step]) -> None:
    for name, tests in (("a.json", 700), ("b.json", 600)):
        (tmp_path / name).write_text(as_text(_graded(steps, "steps", tests)))
    board = _ranking(project, tmp_path, tmp_path / "a.json", tmp_path / "b.json")["steps"][0]
    assert [name for _, name in _places(board)] == [f"steps ({tmp_path / name})" for name in ("b.json", "a.json")]


def test_anonymous(tmp_path: Path, project: Project, steps: list[Step], capsys: pytest.CaptureFixture[str]) -> None:
    results: dict[str, Results | str] = {
        "ann": _graded(steps, "ann", 700),
        "bob": _graded(steps, "bob", 600),
        "cid": "oops",
        "dan": "oops",
    }
    document = _ranking(project, tmp_path, _class(tmp_path / "class", results), "--anonymous")
    said = json.dumps(document) + capsys.readouterr().out.replace(str(tmp_path), "")
    assert not [name for name in results if name in said]
    assert "2 submissions: not graded, because of a fault of the grader" in said
    assert [one["rank"] for one in document["steps"][0]["ranked"]] == [1, 2]


def test_an_empty_class(tmp_path: Path, project: Project, capsys: pytest.CaptureFixture[str]) -> None:
    document = _ranking(project, tmp_path, _class(tmp_path / "class", {}))
    assert all(board["ranked"] == board["not_ranked"] == [] for board in document["steps"])
    assert "06 Octree: nobody is ranked\n  there is no submission" in capsys.readouterr().out


def test_a_narrow_terminal_has_room_for_what_decides(
    tmp_path: Path, project: Project, steps: list[Step], capsys: pytest.CaptureFixture[str]
) -> None:
    board = rank(read_entries([_class(tmp_path / "class", {"ann": _graded(steps, "ann", 700)})]), steps[8])
    for width, shown in ((80, False), (120, True)):
        print_board(Console(width=width), board, anonymous=False)
        text = capsys.readouterr().out
        assert ("mountain-bvh" in text) == shown
        assert all(word in text for word in ("ann", "0.700", "20.0 kB", "15.0 kB"))


def test_kits_that_differ_are_named(
    tmp_path: Path, project: Project, steps: list[Step], capsys: pytest.CaptureFixture[str]
) -> None:
    results = {"ann": _graded(steps, "ann"), "bob": replace(_graded(steps, "bob"), kit="other")}
    assert _ranking(project, tmp_path, _class(tmp_path / "class", results))["steps"][0]["kits"] == ["abc123", "other"]
    assert "Graded by 2 kits (abc123, other)" in capsys.readouterr().out


def test_the_example_in_the_documents_is_one(project: Project) -> None:
    text = (project.root / "docs" / "formats.md").read_text(encoding="utf-8")
    example = json.loads(text.split("## Leaderboard")[1].split("```json")[1].split("```")[0])
    assert convert(example, Leaderboard).steps[0].ranked[0].name == "ann"
    with pytest.raises(Malformed, match="names where they are hidden"):
        convert({**example, "anonymous": True}, Leaderboard)


def test_usage(tmp_path: Path, project: Project, steps: list[Step], capsys: pytest.CaptureFixture[str]) -> None:
    folder = _class(tmp_path / "class", {"ann": _graded(steps, "ann")})
    for words, said in (
        ([folder, "--step", "02"], "--step: in 02-intersection no work is counted; expected 06-octree and 09-bvh"),
        ([folder, "--step", "77"], "there is no step '77'"),
        ([tmp_path], f"{tmp_path}: holds none of class.sqlite, class.json, results.json; expected the folder"),
        ([tmp_path / "none"], f"{tmp_path / 'none'}: is not there; expected the folder"),
        ([folder / "results.csv"], "is not JSON"),
        ([folder, "--json", folder], "cannot be written"),
    ):
        assert main(["leaderboard", *map(str, words)]) == 2, words
        assert said in capsys.readouterr().err
    assert main(["leaderboard", str(folder)]) == 0


def test_a_class_names_only_results_of_its_own(tmp_path: Path, project: Project, steps: list[Step]) -> None:
    folder = _class(tmp_path / "class", {"ann": _graded(steps, "ann")})
    facts = json.loads((folder / "class.json").read_text())
    facts["submissions"][0]["results"] = "../other/results.json"
    (folder / "class.json").write_text(json.dumps(facts))
    with pytest.raises(UsageError, match="outside of its folder"):
        _ranking(project, tmp_path, folder / "class.json")
