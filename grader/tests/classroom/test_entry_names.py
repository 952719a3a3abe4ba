"""The entries of a class: their order, their names, and which shard has them."""

import os
from collections import Counter
from pathlib import Path

import pytest
from class_fakes import close_to_looks

from raysteps.classroom.entries import Shard, list_entries, name_entries, newest_time, read_shard, safe_name, stem
from raysteps.common.errors import UsageError


@pytest.mark.parametrize(
    ("entry", "name"),
    [
        ("ann.zip", "ann"),
        ("ann.TAR.GZ", "ann"),
        (".zip", "zip"),
        ("Ann Lee_12_file", "Ann_Lee_12_file"),
        ("../../etc/passwd", "etc_passwd"),
        ("=cmd|' /C calc'!A0", "cmd____C_calc__A0"),
        ("José", "José"),
        ("Jose\u0301", "José"),
        ("\u202eevil", "evil"),
        ("...", "_"),
        ("CON", "_CON"),
        ("com1.zip", "_com1"),
    ],
)
def test_names_are_safe(entry: str, name: str) -> None:
    assert safe_name(stem(entry)) == name


def test_long_names_fit_into_a_file_system() -> None:
    name = safe_name("é" * 500)
    assert len(name.encode()) == 100
    assert set(name) == {"é"}


def test_entries_of_one_name_are_kept_apart() -> None:
    entries = ["ann", "ann.zip", "ANN.tar", "b c", "b?c", "dan"]
    names = name_entries(entries, {})
    assert len({name.casefold() for name in names.values()}) == len(entries)
    assert names["dan"] == "dan"
    assert all(names[entry] not in ("ann", "ANN", "b_c") for entry in entries[:5])
    assert names == name_entries(entries, {})


def test_a_name_stays_when_entries_are_added() -> None:
    known = name_entries(["ann.zip"], {})
    names = name_entries(["ann", "ann.zip"], known)
    assert names["ann.zip"] == "ann"
    assert names["ann"].startswith("ann-")


def test_listing(tmp_path: Path) -> None:
    for name in ("b", "a", "B", ".git", "__MACOSX"):
        (tmp_path / name).mkdir()
    roster = tmp_path / "roster.csv"
    roster.touch()
    (tmp_path / "z.zip").touch()
    os.mkdir(os.fsencode(tmp_path) + b"/\xff\xfe")  # noqa: PTH102
    listing = list_entries(tmp_path, [roster])
    assert [entry.label for entry in listing.entries] == ["B", "a", "b", "z.zip", "\\xff\\xfe"]
    assert listing.ignored == [".git", "__MACOSX", "roster.csv"]
    with pytest.raises(UsageError, match="holds no submission"):
        list_entries(tmp_path / "a", [])
    with pytest.raises(UsageError, match="expected a folder"):
        list_entries(tmp_path / "missing", [])


def test_a_link_to_another_entry_is_told_from_one_that_leads_elsewhere(tmp_path: Path) -> None:
    folder, store = tmp_path / "class", tmp_path / "store"
    for place in (folder / "alice" / "steps", store / "eve", store / "fay", store / "gil" / "steps"):
        place.mkdir(parents=True)
    for file in (folder / "bob.zip", folder / "alice" / "steps.zip"):
        file.touch()
    links: dict[str, str | Path] = {
        "direct": folder / "alice", "chained": folder / "direct", "inner.zip": folder / "alice" / "steps.zip",
        "relative": "alice/steps", "around": "../class/alice", "twin.zip": "bob.zip", "dangling": "alice/nothing",
        "eve": store / "eve", "fay": store / "fay", "nowhere": store / "nobody", "itself": "itself",
        "gil": store / "gil", "gus": store / "gil", "steps": store / "gil" / "steps",
    }  # fmt: skip
    for name, target in links.items():
        (folder / name).symlink_to(target)
    found = {entry.label: set(entry.leads_to) for entry in list_entries(folder, []).entries}
    assert {name for name, others in found.items() if not others} == {
        *("alice", "bob.zip", "eve", "fay", "nowhere", "itself"),
    }
    assert "alice" in found["direct"] & found["chained"] & found["inner.zip"] & found["relative"] & found["around"]
    assert found["twin.zip"] == {"bob.zip"}
    assert (found["gil"], found["gus"], found["steps"]) == ({"gus", "steps"}, {"gil", "steps"}, {"gil", "gus"})
    (folder / "all").symlink_to(".")
    assert {"alice", "bob.zip"} < set(
        next(one for one in list_entries(folder, []).entries if one.label == "all").leads_to
    )


def test_names_cannot_steer_a_terminal(tmp_path: Path) -> None:
    for name in ("\x1b[2Ja\nb\tc", "a b c", "\x07", "\x07\x07"):
        (tmp_path / name).mkdir()
    labels = [entry.label for entry in list_entries(tmp_path, []).entries]
    assert len(set(labels)) == 4
    assert all(label.strip() and label.isprintable() for label in labels)
    assert "a b c" in labels


def test_signs_that_nobody_sees_are_named(tmp_path: Path) -> None:
    """Else two entries look alike, or one turns the line of the table that it stands in."""
    for name in ("ann", "ann\u200b", "\u202enna"):
        (tmp_path / name).mkdir()
    assert [entry.label for entry in list_entries(tmp_path, []).entries] == ["ann", "ann⟨U+200B⟩", "⟨U+202E⟩nna"]


def test_shards_divide_a_class() -> None:
    labels = [f"student {number}" for number in range(1000)]
    shards = [read_shard(f"{index}/7") for index in range(1, 8)]
    held = Counter(label for shard in shards for label in labels if shard.holds(label))
    assert held == Counter(labels)
    assert all(100 < sum(map(shard.holds, labels)) < 190 for shard in shards)
    assert all(map(Shard().holds, labels))


@pytest.mark.parametrize("text", ["0/3", "4/3", "1", "a/b", "1/0", "-1/3", "1/3/5"])
def test_shards_that_make_no_sense(text: str) -> None:
    with pytest.raises(UsageError, match="such as 2/8"):
        read_shard(text)


def test_time_of_a_folder_is_that_of_its_newest_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "ann"
    (folder / "steps").mkdir(parents=True)
    for name, when in (("a.cpp", 1_000_000), ("steps/b.cpp", 2_000_000), (".DS_Store", 9_000_000)):
        (folder / name).touch()
        os.utime(folder / name, (when, when))
    (folder / "link").symlink_to("/etc/passwd")
    (folder / "closed").mkdir()
    (folder / "closed/c.cpp").touch()
    close_to_looks(folder / "closed", monkeypatch)
    assert newest_time(folder) == "1970-01-24T03:33:20+00:00"
    (tmp_path / "empty").mkdir()
    assert newest_time(tmp_path / "empty") == ""
    assert newest_time(tmp_path / "missing") == ""
