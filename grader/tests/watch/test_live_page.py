"""The page of `watch` in a real browser: it changes when results change, and says when nobody watches any more."""

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from browser import Scheme, Watched, assert_accessible, assert_fits_all_screens
from watch_fakes import result_of

from raysteps.course.manifest import Step
from raysteps.progress.hints import Hint
from raysteps.results.model import Diagnosis
from raysteps.watch.page_state import PageServer, PageState, page_of, state_of
from raysteps.watch.step_view import StepView

if TYPE_CHECKING:
    from playwright.sync_api import Page


class Live:
    """A page with its server; `show` is what a run does."""

    def __init__(self, step: Step, out: Path) -> None:
        self.step = step
        self.out = out
        self.board = PageState(state_of(StepView(step, saved="12:00:00")))
        self.server = PageServer(self.board, page_of)

    def view(self, source: str, *, full: bool = False) -> StepView:
        result = result_of(self.step, source, self.out, full=full)
        return StepView(self.step, "idle", "", "12:00:00", 0.8, result, self.out, complete=True, full=full)

    def show(self, view: StepView) -> None:
        self.board.show(state_of(view))


@pytest.fixture
def live(steps: list[Step], tmp_path: Path) -> Iterator[Live]:
    found = Live(steps[0], tmp_path)
    yield found
    found.server.close()


@pytest.fixture
def pages(watched: Watched, live: Live) -> Watched:
    """The page may ask its own server, and nobody else."""
    watched.allowed.append(live.server.address)
    return watched


def _says(page: "Page", where: str, text: str) -> None:
    page.locator(where, has_text=text).first.wait_for()


def _failing(live: Live) -> StepView:
    view = live.view("// wrong", full=True)
    assert view.result is not None
    found = Diagnosis(
        "mistake", "left-right", "left and right <i>change places</i>", "It is a mirror image.", "A cross product."
    )
    view.result.diagnoses = [found]
    view.hints = [Hint(1, 3, "across  = 2 (x + 0.5) / width - 1\nupwards = 1")]
    return view


def test_it_follows_what_happens(live: Live, pages: Watched) -> None:
    page = pages.open(live.server.address)
    _says(page, "#watch-verdict", "Building")
    live.show(live.view("// wrong"))
    _says(page, "#watch-verdict", "1 of 2 tests right, 0 of 1 picture right.")
    _says(page, "#watch-words .panel", "2 == 1")
    _says(page, "#watch-words .watch-name", "it is <b>right</b>")
    _says(page, "#watch-first h2", "✗ wrong")
    page.locator("compare-pictures[data-state=ready]").wait_for()
    before = page.locator("img[data-role=mine]").get_attribute("src")
    live.show(live.view("// broken"))
    _says(page, "#watch-words pre", "1 | // broken")
    live.show(live.view("int right;"))
    _says(page, "#watch-verdict[data-tone=good]", "2 tests right, 1 picture right. (0.8 s)")
    page.locator("compare-pictures[data-state=ready]").wait_for()
    assert page.locator("img[data-role=mine]").get_attribute("src") != before
    assert page.locator("#watch-words .panel").count() == 0
    assert page.title() == "✓ 01 Camera rays"


def test_what_a_run_has_not_told_yet_stays(live: Live, pages: Watched) -> None:
    page = pages.open(live.server.address)
    live.show(live.view("// wrong"))
    page.locator("compare-pictures[data-state=ready]").wait_for()
    page.locator("compare-pictures").evaluate("element => { element.mark = 1; element.view = 'side'; }")
    live.show(StepView(live.step, saved="12:00:05"))
    _says(page, "#watch-doing[data-phase=looking]", "saved 12:00:05")
    assert page.locator("#watch-words .panel").count() == 1
    live.show(live.view("int right;"))
    _says(page, "#watch-verdict", "2 tests right")
    view = page.locator("compare-pictures")
    assert view.evaluate("element => [element.mark, element.view]") == [1, "side"]


def test_a_hint_of_sentences_is_seen_whole(live: Live, pages: Watched) -> None:
    page = pages.open(live.server.address, width=390)
    sentences = "A surface sends light to the eye in two ways: evenly to all sides, and as a highlight.\nOn what?"
    code = "for each light   l = unit(light.position - hit.position)\n  add diffuse      " + "and specular " * 9
    live.show(replace(live.view("// wrong"), hints=[Hint(1, 2, sentences), Hint(2, 2, code)]))
    _says(page, "#watch-words", "Hint 2 of 2")
    panels = page.locator(".panel:has(.watch-name:text('Hint'))")
    assert [panels.nth(at).locator("pre").count() for at in range(2)] == [0, 1]
    assert panels.first.evaluate("panel => panel.scrollWidth <= panel.clientWidth")


def test_before_there_is_a_picture_the_reference_is_shown(live: Live, pages: Watched) -> None:
    page = pages.open(live.server.address)
    view = live.view("int right;")
    assert view.result is not None
    view.result.status, view.result.tests = "not-started", []
    image = view.result.images[0]
    mine, image.mine, image.passed = image.mine, None, False
    live.show(view)
    _says(page, "#watch-first", "This is what it shall look like.")
    goal, compared = page.locator("img.watch-goal"), page.locator("compare-pictures")
    assert goal.is_visible()
    assert not compared.is_visible()
    image.mine, image.passed = mine, True
    live.show(view)
    compared.wait_for()
    assert compared.evaluate("element => element.view") == "slider"
    assert not goal.is_visible()


def test_a_picture_that_waits_is_not_called_wrong(live: Live, pages: Watched) -> None:
    page = pages.open(live.server.address)
    view = live.view("// wrong")
    assert view.result is not None
    view.result.images[0].waits_for = "primary_ray"
    view.result.images[0].message = "It waits for primary_ray, not written yet."
    for test in view.result.tests:
        test.waits_for = "" if test.passed else "primary_ray"
    live.show(view)
    _says(page, "#watch-words", "Tests: … 1 of 2 right, 1 wait")
    _says(page, "#watch-first h2", "… waits")
    _says(page, "#watch-first", "It waits for primary_ray")
    assert page.locator(".watch-bad").count() == 0


def test_another_step_takes_the_place_of_this_one(live: Live, pages: Watched, steps: list[Step]) -> None:
    page = pages.open(live.server.address)
    live.show(live.view("// wrong"))
    _says(page, "#watch-first h2", steps[0].images[0].name)
    live.show(StepView(steps[1]))
    _says(page, "h1", "02 Intersection")
    assert page.locator(".watch-pictures article, #watch-words .panel").count() == 0


def test_reloaded_it_is_the_same(live: Live, pages: Watched) -> None:
    live.show(_failing(live))
    page = pages.open(live.server.address)
    named = "Most likely: left and right <i>change places</i>"
    _says(page, "#watch-verdict", "2.5 of 10 points")
    _says(page, ".watch-name", named)
    page.locator("compare-pictures[data-state=ready]").wait_for()
    said = page.locator("main").inner_text()
    page.reload()
    _says(page, "#watch-verdict", "2.5 of 10 points")
    _says(page, ".watch-name", named)
    page.wait_for_function("said => document.querySelector('main').innerText === said", arg=said)


def test_it_says_when_nobody_watches_any_more(live: Live, pages: Watched) -> None:
    page = pages.open(live.server.address)
    live.show(live.view("int right;"))
    _says(page, "#watch-verdict", "2 tests right")
    live.server.close()
    _says(page, "#watch-doing[data-phase=over]", "Not watching any more.")
    _says(page, "#watch-verdict", "2 tests right")


@pytest.mark.parametrize(("width", "height"), [(1400, 900), (390, 844), (700, 900)])
def test_the_first_screen_shows_ones_own_picture(live: Live, pages: Watched, width: int, height: int) -> None:
    page = pages.open(live.server.address, width=width)
    page.set_viewport_size({"width": width, "height": height})
    view = _failing(live)
    view.result.images.append(replace(view.result.images[0], name="another"))  # type: ignore[union-attr]
    live.show(view)
    page.locator("compare-pictures[data-state=ready]").first.wait_for()
    box = page.locator(".compare-stage").first.bounding_box()
    assert box is not None
    assert box["height"] > 150
    frame = page.locator("#watch-first compare-pictures").bounding_box()
    assert frame is not None
    assert box["width"] > 0.95 * frame["width"], "nothing stands beside the picture"
    assert box["y"] + box["height"] <= height
    assert [one.inner_text().split()[0] for one in page.locator("#watch-pictures h2").all()] == ["another"]


def test_a_step_that_is_done_leads_to_the_next(live: Live, pages: Watched, steps: list[Step]) -> None:
    page = pages.open(live.server.address)
    live.show(replace(live.view("int right;", full=True), following=steps[1]))
    _says(page, "#watch-next", "Next: 02 Intersection. Press n in the terminal, or type ./raysteps watch 02")
    live.show(live.view("// wrong"))
    _says(page, "#watch-verdict", "1 of 2 tests right")
    assert not page.locator("#watch-next").is_visible()


@pytest.mark.parametrize(("width", "scheme"), [(360, "light"), (1440, "dark")])
def test_everybody_can_read_it(live: Live, pages: Watched, width: int, scheme: Scheme) -> None:
    broken = live.view("// broken")
    page = pages.open(live.server.address, width=width, scheme=scheme, calm=True)
    for view in (broken, live.view("int right;", full=True), replace(broken, gone=True), _failing(live)):
        live.show(view)
        text = json.loads(live.board.now().text)["verdict"]["text"]
        _says(page, "#watch-verdict", text)
        assert_accessible(page)
    assert_fits_all_screens(page)
