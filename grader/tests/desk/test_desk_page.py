"""The desk in a real browser, by keyboard alone and by mouse."""

import json
import re
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit
from urllib.request import url2pathname

import pytest
from browser import Scheme, Watched, assert_accessible, assert_fits_all_screens
from class_fakes import grade_class, write_entry

from raysteps.classroom.database import ClassDatabase, RegisteredEntry, RunFacts
from raysteps.classroom.jobs import JobResult
from raysteps.common.local_server import shown_in_browser
from raysteps.desk.desk import Desk, DeskServer
from raysteps.results.model import Diagnosis, Results, Settings, StepResult

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = pytest.mark.usefixtures("fake_grader")

_STEP = "01-camera-rays"
_NASTY = '<img src=x onerror="document.title=1"><script>document.title=2</script>'
_CODE = f"// points 4\nint first = 1;\n// {_NASTY}\nint third = 3;\n"


@pytest.fixture
def grades(tmp_path: Path) -> Path:
    for name, code in (("ann", _CODE), ("bob", _CODE), ("eve", _CODE)):
        write_entry(tmp_path / "in", name, code)
    roster = tmp_path / "roster.csv"
    roster.write_text(f'id,name,submission\n1,"Ann {_NASTY.replace(chr(34), chr(34) * 2)}",ann\n', encoding="utf-8")
    assert grade_class(tmp_path / "in", "--out", tmp_path / "out", "--roster", roster) == 0
    return tmp_path / "out"


@pytest.fixture
def server(grades: Path) -> Iterator[DeskServer]:
    desk = Desk(grades, "Ada")
    found = DeskServer(desk)
    yield found
    found.close()
    desk.close()


@pytest.fixture
def pages(watched: Watched, server: DeskServer) -> Iterator[Watched]:
    """The page may ask its own server, and nobody else; it is closed first, as it asks whether files are written."""
    watched.allowed.append(server.address)
    yield watched
    watched.close()


def _open(pages: Watched, server: DeskServer, name: str = "", **how: Any) -> "Page":
    page = pages.open(server.address + (f"#{name}" if name else ""), **how)
    page.locator("tbody tr").first.wait_for(state="attached")
    if name:
        _is_open(page, name)
    return page


def _is_open(page: "Page", name: str) -> None:
    page.locator(f"#submission[data-name={name}] .desk-head").wait_for()


def _press(page: "Page", *keys: str) -> None:
    for key in keys:
        page.keyboard.press(key)


def _results(grades: Path, server: DeskServer, name: str = "ann") -> dict[str, Any]:
    assert server.desk.writer.wait() == "written"
    found: dict[str, Any] = json.loads((grades / "submissions" / name / "results.json").read_text())
    return found


def _shows(page: "Page", *names: str) -> None:
    """Waits until the table has these rows in this order, by the beginnings of their names. Rows out of sight have no
    inner text."""
    from playwright.sync_api import expect

    rows = page.locator("tbody tr:not([hidden]) th a")
    expect(rows).to_have_text([re.compile(rf"^\s*{name}") for name in names], timeout=60_000)


def _has_focus(page: "Page", selector: str) -> None:
    """Waits until it has."""
    from playwright.sync_api import expect

    expect(page.locator(selector)).to_be_focused(timeout=60_000)


def test_a_comment_by_keyboard_alone(pages: Watched, server: DeskServer, grades: Path) -> None:
    page = _open(pages, server)
    _has_focus(page, "tbody tr:first-child a")
    _press(page, "j", "k", "j", "Enter")
    _is_open(page, "bob")
    assert re.search(r", Camera rays: \w+", page.locator(".desk-tab").first.text_content() or "")  # no sign alone
    _press(page, "l", "ArrowDown", "c")
    page.keyboard.type("why one? just asking")
    _press(page, "Control+Enter")
    card = page.locator(".desk-lines li:nth-child(2) .desk-card")
    assert "why one? just asking" in card.inner_text()
    _has_focus(page, ".desk-lines li:nth-child(2) .line-number")  # one goes on where one was
    _press(page, "r")
    page.locator("#read[aria-pressed=true]").wait_for()
    _press(page, "n")
    _is_open(page, "eve")
    comment = _results(grades, server, "bob")["steps"][0]["review"]["comments"][0]
    assert (comment["line"], comment["text"], comment["author"]) == (2, "why one? just asking", "Ada")


def test_the_browser_is_led_to_the_page_by_a_file_of_ones_own(
    pages: Watched, server: DeskServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    with shown_in_browser(server.address):
        assert server.token not in opened[0]
        path = Path(url2pathname(urlsplit(opened[0]).path))
        assert [one.stat().st_mode & 0o077 for one in (path, path.parent)] == [0, 0]
        page = pages.open(path)
        page.wait_for_url(server.address)
        page.locator("tbody tr").first.wait_for()
    assert not path.parent.exists()


def test_points_with_a_reason_and_back(pages: Watched, server: DeskServer, grades: Path) -> None:
    page = _open(pages, server, "ann")
    _press(page, "p")
    page.keyboard.type("7.5")
    _press(page, "Control+Enter")
    assert page.evaluate("document.activeElement.validity.valueMissing")  # no reason, no change
    page.keyboard.type("it was my fault")
    _press(page, "Control+Enter")
    page.locator(".desk-reason", has_text="Ada: it was my fault").wait_for()
    assert "7.5 points (4 by the grader)" in page.locator(".desk-points").inner_text()
    results = _results(grades, server)
    assert results["total"]["points"] == 7.5
    assert results["steps"][0]["review"]["overrides"][0]["reason"] == "it was my fault"
    page.locator("[data-part=step]").click()
    page.get_by_role("button", name="Take the change back").click()
    page.locator(".desk-points", has_text="4 points").wait_for()
    assert _results(grades, server)["total"]["points"] == 4
    page.locator(".desk-parts summary", has_text="History").click()
    assert "taken back" in page.locator(".desk-history").inner_text()


def test_points_for_the_whole_may_be_less_than_none(pages: Watched, server: DeskServer, grades: Path) -> None:
    page = _open(pages, server, "ann")
    _press(page, "0", "p")
    page.keyboard.type("-1.5")
    _press(page, "Tab")
    page.keyboard.type("a file was missing")
    _press(page, "Control+Enter")
    page.locator(".desk-side", has_text="-1.5 points: a file was missing").wait_for()
    assert _results(grades, server)["total"]["points"] == 2.5


def test_a_request_and_its_answer(pages: Watched, server: DeskServer, grades: Path) -> None:
    page = _open(pages, server, "ann")
    _press(page, "g")
    page.keyboard.type("was that right?")
    _press(page, "Control+Enter")
    page.locator(".badge", has_text="request: open").wait_for()
    _press(page, "u")
    page.locator("#asks").check()
    _shows(page, "Ann")
    assert page.locator("tbody tr:not([hidden]) .desk-mark").all_inner_texts() == ["1 open request"]
    _press(page, "Escape", "Enter")
    page.locator("tbody tr:not([hidden]) a").press("Enter")
    _is_open(page, "ann")
    _press(page, "a")
    page.keyboard.type("It was.")
    _press(page, "Control+Enter")
    page.locator(".badge", has_text="request: answered").wait_for()
    assert _results(grades, server)["steps"][0]["review"]["requests"][0]["answer"] == "It was."


def test_a_request_about_a_step_that_was_not_graded_stands_with_the_whole(
    pages: Watched, server: DeskServer, grades: Path
) -> None:
    asked = {"kind": "request", "author": "Ada", "step": "14-materials", "text": "and this one?"}
    server.desk.say("ann", asked)
    page = _open(pages, server, "ann")
    assert page.locator(".desk-card").count() == 0
    _press(page, "a")
    card = page.locator(".desk-card", has_text="and this one?")
    assert "On 14-materials, which was not graded this time." in card.inner_text()
    page.keyboard.type("Later.")
    _press(page, "Control+Enter")
    page.locator(".badge", has_text="request: answered").wait_for()
    (thread,) = server.desk.submission("ann")["threads"]
    assert (thread["step"], thread["answer"]) == ("14-materials", "Later.")


def test_by_mouse_at_a_line_and_dropped_again(pages: Watched, server: DeskServer, grades: Path) -> None:
    page = _open(pages, server, "ann")
    page.locator(".desk-lines li:nth-child(4) .line-number").click()
    page.locator("textarea").fill("not this")
    _press(page, "Escape")
    page.locator("textarea").wait_for(state="detached")
    page.locator(".desk-lines li:nth-child(4) .line-number").click()
    page.locator("textarea").fill("this")
    page.get_by_role("button", name=re.compile("^Save")).click()
    card = page.locator(".desk-lines li:nth-child(4) .desk-card")
    card.wait_for()
    card.get_by_role("button", name="Take back").click()
    page.locator(".desk-talk .desk-card.withdrawn").wait_for()
    assert _results(grades, server)["steps"][0]["review"] is None


def test_strangers_words_are_only_words(pages: Watched, server: DeskServer, grades: Path) -> None:
    page = _open(pages, server, "ann")
    assert page.locator(".desk-lines li:nth-child(3) code").inner_text() == f"// {_NASTY}"
    assert _NASTY in page.locator("#submission-title").inner_text()
    _press(page, "c")
    page.keyboard.type(_NASTY)
    _press(page, "Control+Enter")
    page.locator(".desk-card").wait_for()
    assert page.locator("main img, main script").count() == 0
    assert _NASTY in page.title()
    _results(grades, server)
    report = pages.open(grades / "submissions" / "ann" / "report.html")
    assert report.locator(".by-hand .said").inner_text() == _NASTY
    assert report.locator(".by-hand img").count() == 0


def _say_after_bob(page: "Page", server: DeskServer) -> None:
    """Ada saves 8 points; while she was typing, Bob gave 5."""
    _press(page, "p")
    server.desk.say("ann", {"kind": "points", "author": "Bob", "step": _STEP, "points": 5, "text": "from bob"})
    page.keyboard.type("8")
    _press(page, "Tab")
    page.keyboard.type("from ada")
    _press(page, "Control+Enter")


def test_who_was_slower_sees_what_was_written_and_may_replace_it(
    pages: Watched, server: DeskServer, grades: Path
) -> None:
    pages.expected = "409"
    page = _open(pages, server, "ann")
    _say_after_bob(page, server)
    trouble = page.locator("form [role=alert]", has_text="Bob has changed this meanwhile")
    trouble.wait_for()
    assert "5 from bob" in trouble.inner_text()
    _press(page, "Control+Enter")
    page.locator(".desk-reason", has_text="Ada: from ada").wait_for()
    assert _results(grades, server)["total"]["points"] == 8
    page.locator(".desk-parts summary", has_text="History").click()
    assert page.locator(".desk-history li").count() == 2


def test_a_change_by_somebody_else_stops_no_later_one(pages: Watched, server: DeskServer, grades: Path) -> None:
    pages.expected = "409"
    server.desk.say("ann", {"kind": "comment", "author": "Ada", "step": _STEP, "text": "first"})
    page = _open(pages, server, "ann")
    _say_after_bob(page, server)
    page.locator("form [role=alert]", has_text="Bob has changed this meanwhile").wait_for()
    _press(page, "Escape")
    page.locator(".desk-reason", has_text="Bob: from bob").wait_for()  # as it is now
    page.locator(".desk-card").get_by_role("button", name="Take back").click()
    page.locator(".desk-card.withdrawn").wait_for()
    assert _results(grades, server)["steps"][0]["review"]["comments"] == []


_ELSEWHERE = {
    "another form": lambda page: page.locator("#request").click(),
    "another line": lambda page: page.locator(".desk-lines li:nth-child(4) .line-number").click(),
    "a tab": lambda page: page.locator(".desk-tab", has_text="Whole").click(),
    "read": lambda page: page.locator("#read").click(),
    "the next one": lambda page: page.get_by_role("button", name="Next", exact=True).click(),
    "a key": lambda page: page.locator("#submission-title").press("j"),
    "the class": lambda page: page.locator("#submission-title").press("u"),
    "back": lambda page: page.go_back(),
}


@pytest.mark.parametrize("way", _ELSEWHERE)
def test_words_that_are_not_saved_stay(pages: Watched, server: DeskServer, way: str) -> None:
    page = _open(pages, server)
    page.locator("tbody a").first.click()
    _is_open(page, "ann")
    _press(page, "c")
    page.keyboard.type("half a thou")
    _ELSEWHERE[way](page)
    page.locator("form [role=alert]", has_text="not saved yet").wait_for()
    _has_focus(page, "textarea")
    assert page.locator("textarea").input_value() == "half a thou"
    assert page.url.endswith("#ann")
    page.keyboard.type("ght")
    _press(page, "Control+Enter")
    page.locator(".desk-card", has_text="half a thought").wait_for()
    _press(page, "c", "Escape", "j")  # a form without words of one's own goes
    _is_open(page, "bob")


def test_a_save_that_is_pressed_twice_saves_once(pages: Watched, server: DeskServer, grades: Path) -> None:
    page = _open(pages, server, "ann")
    _press(page, "c")
    page.keyboard.type("once")
    page.locator("textarea").evaluate(
        """field => [1, 2].forEach(() => field.dispatchEvent(
            new KeyboardEvent("keydown", {key: "Enter", ctrlKey: true, bubbles: true, cancelable: true})))"""
    )
    page.locator(".desk-card").wait_for()
    _press(page, "r")  # answered after both
    page.locator("#read[aria-pressed=true]").wait_for()
    assert page.locator(".desk-card").count() == 1


def test_filters_and_the_order_of_the_table_lead_from_one_to_the_next(
    pages: Watched, server: DeskServer, grades: Path
) -> None:
    server.desk.say("bob", {"kind": "read", "author": "Ada"})
    page = _open(pages, server)
    page.locator("#unread").check()
    _shows(page, "Ann", "eve")
    page.locator("thead button", has_text="submission").click()
    page.locator("thead button", has_text="submission").click()
    _shows(page, "eve", "Ann")
    page.locator("tbody tr:not([hidden]) a").first.click()
    _is_open(page, "eve")
    assert "1 of 2" in page.locator(".desk-head").inner_text()
    _press(page, "j")
    _is_open(page, "ann")
    _press(page, "j")
    _is_open(page, "eve")
    _press(page, "/")
    _has_focus(page, "#search")
    page.keyboard.type("ann")
    _shows(page, "Ann")
    _press(page, "Enter", "Enter")
    _is_open(page, "ann")


def _with_mistakes(out: Path, titles: dict[str, str], *messages: str) -> None:
    """A class that nobody graded: who made which mistake in step 01, and what is said of it."""
    entries = [RegisteredEntry(name, name, "here") for name in titles]
    steps = [{"id": _STEP, "title": "Camera rays", "points": 10, "bonus": False}]
    with closing(ClassDatabase(out)) as database:
        run = database.begin_run(RunFacts("u", "kit", "/in", "1/1", Settings(), steps, "", []), entries, [])
        for name, title in titles.items():
            found = [Diagnosis("mistake", "m", title)] if title else []
            results = Results.of(
                name, [StepResult(_STEP, "partial", 5, 10, False, diagnoses=found, messages=[*messages])]
            )
            database.record(run, JobResult(name, "graded", results, worker="w"), "key", sources={_STEP: b"int a;\n"})
        database.end_run(run, "complete", {})


def test_the_same_mistake_leads_to_the_next_who_made_it(watched: Watched, tmp_path: Path) -> None:
    _with_mistakes(tmp_path, {"a": "it is slow", "b": "it is red", "c": "", "d": "it is slow"})
    with closing(Desk(tmp_path, "Ada")) as desk, closing(DeskServer(desk)) as server:
        watched.allowed.append(server.address)
        page = _open(watched, server, "a")
        _press(page, "m")
        _is_open(page, "d")
        page.get_by_role("button", name="Next with this mistake").click()
        _is_open(page, "a")
        _press(page, "j")
        _is_open(page, "b")
        _press(page, "m")
        page.locator("#trouble", has_text="Nobody else").wait_for()
        watched.close()


def test_what_the_compiler_said_keeps_its_columns(watched: Watched, tmp_path: Path) -> None:
    _with_mistakes(
        tmp_path, {"a": ""}, "It does not build: a.cpp:1:5: expected `;`\n   1 | int a\n     |     ^", "Look up."
    )
    with closing(Desk(tmp_path, "Ada")) as desk, closing(DeskServer(desk)) as server:
        watched.allowed.append(server.address)
        page = _open(watched, server, "a")
        assert page.locator(".desk-side .said code").all_inner_texts() == [";"]
        assert page.locator(".desk-side pre").inner_text() == "   1 | int a\n     |     ^"
        assert page.locator(".desk-side .said").last.inner_text() == "Look up."
        assert_accessible(page)
        watched.close()


def test_without_scripts_the_desk_says_what_it_needs(pages: Watched, server: DeskServer) -> None:
    assert "needs scripts" in pages.open(server.address, scripts=False).locator("noscript").inner_text()


def test_help_tells_all_keys(pages: Watched, server: DeskServer) -> None:
    page = _open(pages, server, "ann")
    _press(page, "?")
    text = page.locator("#help").inner_text()
    for key in ("j k", "n", "m", "r", "c", "p", "g", "a", "u", "/", "Ctrl + Enter"):
        assert key in text
    assert_accessible(page)
    _press(page, "Escape")
    page.locator("#help").wait_for(state="hidden")


def test_help_that_is_longer_than_the_screen_begins_at_its_beginning(pages: Watched, server: DeskServer) -> None:
    page = _open(pages, server, "ann", width=360, height=640)
    for key in ("?", ""):
        if key:
            _press(page, key)
        else:
            page.locator("#help-open").click()
        _has_focus(page, "#help-title")
        seen = page.locator("#help").evaluate("help => [help.scrollTop, help.scrollHeight > help.clientHeight]")
        assert seen == [0, True]
        _press(page, "Tab")
        _has_focus(page, "#help button")
        _press(page, "Escape")


def test_without_a_name_nothing_is_written(pages: Watched, server: DeskServer) -> None:
    page = _open(pages, server, "ann")
    page.locator("#author").fill(" ")
    page.locator("#submission-title").focus()
    _press(page, "c")
    page.keyboard.type("who am I?")
    _press(page, "Control+Enter")
    page.locator("form [role=alert]", has_text="Say who you are").wait_for()
    _has_focus(page, "#author")
    page.keyboard.type("Ada")
    page.get_by_role("button", name=re.compile("^Save")).click()
    page.locator(".desk-card", has_text="who am I?").wait_for()


@pytest.mark.parametrize(("width", "scheme"), [(390, "light"), (1400, "dark")])
def test_axe_and_the_width(pages: Watched, server: DeskServer, grades: Path, width: int, scheme: Scheme) -> None:
    for said in (
        {"kind": "comment", "step": _STEP, "line": 2, "text": "why?"},
        {"kind": "points", "step": _STEP, "part": "hidden", "points": 2, "text": "because"},
        {"kind": "request", "step": _STEP, "text": "was it?"},
    ):
        server.desk.say("ann", {**said, "author": "Ada"})
    page = _open(pages, server, width=width, scheme=scheme)
    assert_accessible(page)
    assert_fits_all_screens(page)
    page.set_viewport_size({"width": width, "height": 900})
    page.locator("tbody a").first.click()
    _is_open(page, "ann")
    page.locator(".desk-card").first.wait_for()
    _press(page, "p")
    assert_accessible(page)
    assert_fits_all_screens(page)
    _results(grades, server)
    for path in (grades / "submissions" / "ann" / "report.html", grades / "class.html"):
        made = pages.open(path, width=width, scheme=scheme)
        assert_accessible(made)
        assert_fits_all_screens(made)


def test_the_page_of_the_class_shows_whose_points_were_changed(
    pages: Watched, server: DeskServer, grades: Path
) -> None:
    server.desk.say("bob", {"kind": "points", "author": "Ada", "points": 2, "text": "nice"})
    _results(grades, server)
    page = pages.open(grades / "class.html")
    page.locator("#changed").check()
    shown = page.locator("tbody tr:not([hidden])")
    assert shown.count() == 1
    assert "bob" in shown.inner_text()
    assert "6" in shown.locator(".total").first.inner_text()
