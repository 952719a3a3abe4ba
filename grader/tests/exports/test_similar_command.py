"""The command `similar`: its page, its table, its JSON, and what strangers hand in."""

import argparse
import json
import random
from pathlib import Path
from typing import Any

import pytest
from browser import OpenPage, assert_accessible, assert_fits_all_screens
from conftest import Sources
from planted_copies import changed, honest_class, light
from rich.console import Console

from raysteps.cli import similar
from raysteps.common.documents import parse
from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.course.project import Project, here
from raysteps.exports.similar_pairs import Similarity
from raysteps.release.secrets import public_names

_STEP = "06-octree"
_SCRIPT = "</pre><script>alert(1)</script>"


def _similar(*words: str) -> int:
    parser = argparse.ArgumentParser()
    similar.add_arguments(parser)
    return similar.run(here(), parser.parse_args(words), Console(width=200))


def _hand_in(folder: Path, steps: list[Step], sources: Sources) -> None:
    for step in steps:
        if step.id in sources:
            path = folder / "steps" / step.path
            path.parent.mkdir(parents=True)
            path.write_text(sources[step.id], encoding="utf-8")


@pytest.fixture(scope="module")
def places(tmp_path_factory: pytest.TempPathFactory, project: Project, steps: list[Step]) -> Path:
    """`class`: ann, her copy bob, cy, and dot, who has a stub; `lastyear`: whom cy has copied, twice."""
    place = tmp_path_factory.mktemp("similar")
    draw = random.Random(5)
    public = frozenset(public_names(project))
    honest = [
        {step: text for step, text in one.items() if step in (_STEP, "02-intersection")}
        for one in honest_class(project, steps, ["corpus"], draw)
    ]
    copies = [{step: changed(text, light(public), draw) for step, text in one.items()} for one in honest]
    copies[0][_STEP] += f"// {_SCRIPT}\n"
    for name, sources in {"ann": honest[0], "bob": copies[0], "cy": copies[1], "eve": honest[2]}.items():
        _hand_in(place / "class" / name, steps, sources)
    for name in ("old", "older"):
        _hand_in(place / "lastyear" / name, steps, honest[1])
    (place / "class" / "notes.txt").write_text("nothing")
    return place


def _pairs(path: Path) -> list[tuple[str, str]]:
    document = parse(path.read_bytes(), Similarity, complete=True)
    return [(one.first, one.second) for one in document.pairs if one.likeness >= document.look_from]


def test_a_copy_is_found_and_told(places: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    page, facts = tmp_path / "similar.html", tmp_path / "similar.json"
    assert _similar(str(places / "class"), "--out", str(page), "--json", str(facts)) == 0
    said = capsys.readouterr()
    assert _pairs(facts) == [("ann", "bob")]
    document: dict[str, Any] = json.loads(facts.read_bytes())
    assert document["submissions"] == ["ann", "bob", "cy", "eve"]
    assert document["pairs_compared"] == 6
    assert document["pairs"][0]["longest_passage"] > 100
    assert "1 pair of 6 from likeness 30 on" in said.out
    assert "never a verdict" in said.out
    assert f"Page: {page}" in said.out
    assert "notes.txt is left out" in said.err
    text = page.read_text(encoding="utf-8")
    assert _SCRIPT not in text
    assert "&lt;/pre&gt;&lt;script&gt;alert(1)" in text


def test_copies_are_told_to_be_the_same_however_little_they_hold(
    tmp_path: Path, steps: list[Step], solved: Sources, capsys: pytest.CaptureFixture[str]
) -> None:
    """Likeness, which is less for little code, is not said to be a per cent of it."""
    facts, page = tmp_path / "similar.json", tmp_path / "page.html"
    for name in ("ann", "bob"):
        _hand_in(tmp_path / "class" / name, steps, {step.id: solved[step.id] for step in steps[:2]})
    assert _similar(str(tmp_path / "class"), "--out", str(page), "--json", str(facts)) == 0
    (pair,) = parse(facts.read_bytes(), Similarity, complete=True).pairs
    assert (pair.whole.first, pair.whole.second) == (1, 1)
    assert 0.3 < pair.likeness < 0.9
    row = next(line for line in capsys.readouterr().out.splitlines() if "ann" in line and "bob" in line)
    cells = [cell.strip() for cell in row.strip("│").split("│")]
    assert cells == [str(int(100 * pair.likeness)), "ann", "bob", "all", "100 %", "100 %", cells[6], "2 of 2"]
    text = page.read_text(encoding="utf-8")
    assert "2 of 2 files the same, letter by letter" in text
    assert f"likeness {int(100 * pair.likeness)}, most in" in text
    assert "100 % of the first is in the second, 100 % of the second in the first" in text
    assert f"{int(100 * pair.likeness)} %" not in text


def test_a_share_is_rounded_as_it_is_written() -> None:
    for percent in range(101):
        assert similar._percent(percent / 100) == similar._percent_at_most(percent / 100) == percent
    assert (similar._percent(0.2899), similar._percent_at_most(0.2901)) == (28, 30)


def test_an_earlier_term_is_compared_with_this_one_only(places: Path, tmp_path: Path) -> None:
    facts = tmp_path / "similar.json"
    words = ["--before", str(places / "lastyear"), "--out", str(tmp_path / "page.html"), "--json", str(facts)]
    assert _similar(str(places / "class"), *words) == 0
    found = {frozenset(pair) for pair in _pairs(facts)}
    assert found == {frozenset(pair) for pair in (("ann", "bob"), ("cy", "lastyear/old"), ("cy", "lastyear/older"))}
    assert json.loads(facts.read_bytes())["groups"] == [["cy", "lastyear/old", "lastyear/older"]]


def test_whoever_has_the_kits_solution_is_told_with_the_option(
    tmp_path: Path, steps: list[Step], solved: Sources
) -> None:
    facts, page = tmp_path / "similar.json", str(tmp_path / "page.html")
    _hand_in(tmp_path / "class" / "ann", steps, {_STEP: solved[_STEP]})
    _hand_in(tmp_path / "class" / "bob", steps, {steps[1].id: solved[steps[1].id]})
    folder = str(tmp_path / "class")
    assert _similar(folder, "--out", page, "--json", str(facts)) == 0
    assert _pairs(facts) == []
    assert _similar(folder, "--solutions", "--steps", "6", "--out", page, "--json", str(facts)) == 0
    assert _pairs(facts) == [("ann", "the kit's reference")]


@pytest.mark.parametrize("inside", ["", "submissions"])
def test_results_are_not_what_was_handed_in(places: Path, tmp_path: Path, inside: str) -> None:
    (tmp_path / "grades" / "submissions").mkdir(parents=True)
    (tmp_path / "grades" / "class.sqlite").touch()
    for words in ([str(tmp_path / "grades" / inside)], [str(places / "class"), "--before", str(tmp_path / "grades")]):
        with pytest.raises(UsageError, match=r"holds the results of a class, .*; expected the folder of what was han"):
            _similar(*words, "--out", str(tmp_path / "page.html"))


def test_one_alone_cannot_be_compared(places: Path, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="holds 0 submissions with work; expected two"):
        _similar(str(places / "class"), "--steps", "5", "--out", str(tmp_path / "page.html"))
    assert not (tmp_path / "page.html").exists()


_HOSTILE = {
    "same": "a " * 500_000,
    "line": "int a;" * 170_000,
    "open": '"' * 1_000_000,
    "nested": "(" * 1_000_000,
    "lines": "\n" * 1_000_000,
    "macros": "".join(f"#define A{at} A{at + 1} A{at + 1}\n" for at in range(30_000)),
    "markup": _SCRIPT * 30_000,
    "words": " ".join(f"w{at}(+-{at % 7})" for at in range(60_000)),
}


def test_hostile_files_cost_little_and_make_no_large_page(tmp_path: Path, steps: list[Step]) -> None:
    step = next(step for step in steps if step.id == _STEP)
    for name, text in _HOSTILE.items():
        for twin in ("one", "two"):
            _hand_in(tmp_path / "class" / f"{name}-{twin}", [step], {_STEP: text[: 1 << 20]})
    odd = tmp_path / "class" / "bytes" / "steps" / step.path
    odd.parent.mkdir(parents=True)
    odd.write_bytes(b"int \xff\xfe = 3;" * 10_000)
    page = tmp_path / "page.html"
    assert _similar(str(tmp_path / "class"), "--out", str(page)) == 0
    assert page.stat().st_size < 20_000_000
    too_long = 2 * (len(_HOSTILE) - 1) + 1  # in empty lines is no word; and the bytes
    assert page.read_text(encoding="utf-8").count("look at it yourself") == too_long
    assert _SCRIPT not in page.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def page(places: Path) -> Path:
    path = places / "similar.html"
    assert _similar(str(places / "class"), "--before", str(places / "lastyear"), "--out", str(path)) == 0
    return path


@pytest.mark.parametrize(("width", "scheme"), [(390, "light"), (1400, "dark")])
def test_it_is_accessible_and_never_wider_than_the_screen(
    open_page: OpenPage, page: Path, width: int, scheme: str
) -> None:
    shown = open_page(page, width=width, scheme=scheme)
    assert_accessible(shown)
    shown.locator("details.pair").first.evaluate("element => { element.open = true; }")
    assert_accessible(shown)
    assert_fits_all_screens(shown)


def test_no_number_is_broken_and_a_long_name_is(open_page: OpenPage, page: Path) -> None:
    shown = open_page(page, width=320)
    heights = shown.eval_on_selector_all(
        ".tiles dd", "all => all.map(one => { one.textContent = '100'; return one.getClientRects()[0].height; })"
    )
    assert max(heights) < 40, "one line of 20 pixels"
    name = shown.locator(".pairs-table tbody th").first
    name.evaluate("one => { one.textContent = 'x'.repeat(200); }")
    box = name.bounding_box()
    assert box is not None
    assert box["width"] < 320


def test_a_number_leads_to_the_other_side(open_page: OpenPage, page: Path) -> None:
    shown = open_page(page)
    row = shown.locator(".pairs-table tbody tr").first
    row.get_by_role("link").focus()
    shown.keyboard.press("Enter")
    number = row.get_by_role("link").get_attribute("href")
    shown.wait_for_selector(f"details[open] {number}")
    mark = shown.locator(f"{number} mark").first
    link = mark.get_by_role("link")
    other = link.get_attribute("href")
    assert other is not None
    link.focus()
    shown.keyboard.press("Enter")
    shown.wait_for_selector(f"mark{other}:target")
    assert shown.locator(f"mark{other}").get_by_role("link").get_attribute("href") == f"#{mark.get_attribute('id')}"
    assert "alert(1)" in (shown.text_content("main") or "")  # a text, and no script


def test_names_can_be_hidden(open_page: OpenPage, page: Path) -> None:
    shown = open_page(page)
    assert "lastyear/old" in shown.inner_text("main")
    shown.check("#hide-names")
    words = shown.inner_text(".pairs-table")
    assert "student 1" in words
    for name in ("ann", "bob", "lastyear"):
        assert name not in words
    shown.uncheck("#hide-names")
    assert "lastyear/old" in shown.inner_text(".pairs-table")
