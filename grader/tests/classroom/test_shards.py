"""A class that is graded in parts, and merged."""

import json
from pathlib import Path
from typing import Any

import pytest
from class_documents import without_times
from class_fakes import grade_class, write_entry

from raysteps.classroom.entries import Shard
from raysteps.common.errors import UsageError

pytestmark = pytest.mark.usefixtures("fake_grader")


@pytest.fixture
def handed_in(tmp_path: Path) -> Path:
    for number in range(9):
        write_entry(tmp_path / "in", f"s{number}", f"// points {number}\n")
    write_entry(tmp_path / "in", "S 8", "// points 3\n")
    write_entry(tmp_path / "in", "S?8", "// points 4\n")
    return tmp_path / "in"


@pytest.fixture
def roster(tmp_path: Path) -> Path:
    path = tmp_path / "roster.csv"
    path.write_text("id,name\n" + "".join(f"s{number},Student {number}\n" for number in range(12)))
    return path


def _document(out: Path) -> dict[str, Any]:
    document: dict[str, Any] = json.loads((out / "class.json").read_text())
    return document


def _comparable(out: Path) -> dict[str, Any]:
    document = _document(out)
    for submission in document["submissions"]:
        submission["run"] = submission["seconds"] = None
    return {key: value for key, value in document.items() if key not in ("run", "runs")}


def _files(out: Path) -> dict[str, object]:
    return {
        path.relative_to(out).as_posix(): without_times(json.loads(path.read_text()))
        if path.suffix == ".json"
        else path.read_bytes()
        for path in sorted((out / "submissions").rglob("*"))
        if path.is_file()
    }


def test_merged_shards_are_as_one_run(tmp_path: Path, handed_in: Path, roster: Path) -> None:
    whole, merged = tmp_path / "whole", tmp_path / "merged"
    shards = [tmp_path / f"shard{index}" for index in (1, 2, 3)]
    assert grade_class(handed_in, "--out", whole, "--roster", roster) == 0
    for index, shard in enumerate(shards, start=1):
        assert grade_class(handed_in, "--out", shard, "--roster", roster, "--shard", f"{index}/3") == 0
        assert 0 < len(_document(shard)["submissions"]) < 11
        assert _document(shard)["not_graded"] == []
    assert grade_class("--merge", *shards, "--out", merged) == 0
    assert _comparable(merged) == _comparable(whole)
    assert (merged / "results.csv").read_bytes() == (whole / "results.csv").read_bytes()
    assert _files(merged) == _files(whole)
    assert len(_document(merged)["submissions"]) == 11
    before = _document(merged)
    assert grade_class("--merge", *shards, "--out", merged) == 0  # again changes nothing
    assert _document(merged) == before


def test_a_missing_shard_is_seen(tmp_path: Path, handed_in: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shards = [tmp_path / f"shard{index}" for index in (1, 2, 3)]
    for index, shard in enumerate(shards, start=1):
        assert grade_class(handed_in, "--out", shard, "--shard", f"{index}/3") == 0
    assert grade_class("--merge", shards[0], shards[2], "--out", tmp_path / "merged") == 4
    assert "Missing: 2/3 of the shards" in capsys.readouterr().out
    lost = {one["name"] for one in _document(shards[1])["submissions"]}
    assert set(_document(tmp_path / "merged")["not_graded"]) == lost
    assert grade_class("--merge", shards[1], "--out", tmp_path / "merged") == 0
    assert _document(tmp_path / "merged")["not_graded"] == []
    assert len(_document(tmp_path / "merged")["submissions"]) == 11


def test_the_later_run_counts(tmp_path: Path, handed_in: Path) -> None:
    shards = [tmp_path / f"shard{index}" for index in (1, 2)]
    for index, shard in enumerate(shards, start=1):
        assert grade_class(handed_in, "--out", shard, "--shard", f"{index}/2") == 0
    merged = tmp_path / "merged"
    assert grade_class("--merge", *shards, "--out", merged) == 0
    name = _document(shards[0])["submissions"][0]["name"]
    write_entry(handed_in, _document(shards[0])["submissions"][0]["entry"], "// points 9.5\n")
    assert grade_class(handed_in, "--out", shards[0], "--shard", "1/2", "--resume") == 0
    assert grade_class("--merge", *shards, "--out", merged) == 0
    found = {one["name"]: one["points"] for one in _document(merged)["submissions"]}
    assert found[name] == 9.5
    assert [change["name"] for change in _document(merged)["changed"]] == [name]


def test_a_shard_may_be_empty(tmp_path: Path, handed_in: Path) -> None:
    empty = next(
        index for index in range(1, 900) if not any(Shard(index, 900).holds(path.name) for path in handed_in.iterdir())
    )
    assert grade_class(handed_in, "--out", tmp_path / "out", "--shard", f"{empty}/900") == 0
    assert _document(tmp_path / "out")["statistics"] == {"graded": 0, "mean": None, "median": None}


def test_usage(tmp_path: Path, handed_in: Path) -> None:
    out = tmp_path / "out"
    assert grade_class(handed_in, "--out", out) == 0
    with pytest.raises(UsageError, match=r"holds no class\.sqlite"):
        grade_class("--merge", tmp_path / "none", "--out", tmp_path / "merged")
    with pytest.raises(UsageError, match="merged into"):
        grade_class("--merge", out, "--out", out)
