"""The rooms of the page to work in, on wide screens and on a phone."""

from itertools import pairwise
from typing import TYPE_CHECKING

import pytest
from browser import (
    Watched,
    assert_accessible,
    assert_fits_all_screens,
    assert_large_enough,
    assert_no_sideways_scrolling,
    broken_words,
)
from play_pages import POINT, STARTED, save, status_says, write

from raysteps.play.play_page import PlayServer

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("play")]


_SIDE_BY_SIDE = """rooms => rooms.map((room) => document.querySelector(room).getBoundingClientRect()).every(
    (box, at, boxes) => box.width > 0 && (at === 0 || boxes[at - 1].right <= box.left))"""


def _wait_until_side_by_side(page: "Page", *rooms: str) -> None:
    """Until each ends where the next begins, or before."""
    page.wait_for_function(_SIDE_BY_SIDE, arg=list(rooms))


def test_a_text_to_read_stands_beside_what_is_written(page: "Page") -> None:
    """Where there is room; on a phone it lies over the page."""
    from playwright.sync_api import expect

    text, handout = page.locator("#play-reading"), page.locator("#play-handout")
    link = handout.get_by_role("link", name="camera_rays.hpp")
    link.click()
    expect(page.locator("#play-reading-text")).to_be_focused()
    assert_accessible(page)
    expect(handout).to_be_hidden()
    _wait_until_side_by_side(page, "#play-reading", "#play-source")
    write(page, "// while it can be read\n")
    expect(page.locator(".cm-content")).to_have_text("// while it can be read")
    expect(text).to_be_visible()
    page.locator("#play-reading-text").press("Escape")
    expect(text).to_be_hidden()
    expect(handout).to_be_visible()
    expect(link).to_be_focused()
    page.set_viewport_size({"width": 1920, "height": 1080})
    link.click()
    _wait_until_side_by_side(page, "#play-handout", "#play-reading", "#play-source")
    for width, height, is_modal in ((768, 1024, False), (390, 844, True)):
        page.set_viewport_size({"width": width, "height": height})
        page.wait_for_function(
            "wanted => document.querySelector('#play-reading').matches(':modal') === wanted", arg=is_modal
        )
        expect(text).to_be_in_viewport()
        assert_no_sideways_scrolling(page)
        assert_accessible(page)
    page.set_viewport_size({"width": 768, "height": 1024})
    page.locator("#play-step").select_option("02")
    expect(text).to_be_hidden()
    status_says(page, r"0 of \d+ tests pass", timeout=STARTED)  # or else the server ends while the page still loads


def test_the_page_fits_a_phone(watched: Watched, server: PlayServer) -> None:
    """The rooms stand below each other there, and what one needs in all of them stays in sight."""
    from playwright.sync_api import expect

    watched.allowed.append(server.address)
    no_folders = "delete window.showDirectoryPicker;"
    page = watched.open(server.address, width=390, scheme="dark", touch=True, before=no_folders)
    status_says(page, r"0 of 12 tests pass", timeout=STARTED)
    assert not page.locator("#play-folder").is_visible()
    more, others = page.get_by_role("button", name="More"), page.get_by_role("button", name="Save as zip")
    expect(others).to_be_hidden()
    more.tap()
    expect(others).to_be_in_viewport(ratio=1)
    more.tap()
    expect(others).to_be_hidden()
    assert page.locator(".play-bar").evaluate("bar => bar.scrollWidth <= bar.clientWidth")
    assert_no_sideways_scrolling(page)
    assert_accessible(page)
    assert_large_enough(page)

    def top(room: str) -> float:
        return float(page.locator(room).evaluate("room => room.getBoundingClientRect().top"))

    for title, room in [("Source", "#play-source"), ("Results", "#play-results"), ("Handout", "#play-handout")]:
        page.get_by_role("button", name=title, exact=True).tap()
        page.wait_for_function("room => document.querySelector(room).getBoundingClientRect().top < 200", arg=room)
        assert top(room) >= page.locator(".page-head").evaluate("head => head.getBoundingClientRect().bottom")
        expect(page.get_by_role("button", name="Run")).to_be_in_viewport(ratio=1)
        expect(page.locator("#play-status")).to_be_in_viewport()
    page.get_by_role("button", name="Hint").tap()
    expect(page.locator("#play-hints p")).to_be_in_viewport()
    expect(page.locator("#play-hints code").first).to_have_text("from")
    page.locator("#play-step").select_option("02")
    status_says(page, r"0 of 17 tests pass", timeout=STARTED)
    expect(page.locator("#play-handout h1")).to_be_in_viewport()


@pytest.mark.parametrize(("width", "height"), [(320, 568), (640, 360)])
def test_what_the_compiler_says_is_in_sight_on_a_small_screen(
    watched: Watched, server: PlayServer, solved: dict[str, str], width: int, height: int
) -> None:
    """640 x 360 is half of a usual screen at 200 %. The caret stays between what lies over the page at its edges."""
    from playwright.sync_api import expect

    watched.allowed.append(server.address)
    page = watched.open(server.address, width=width, height=height)
    status_says(page, r"0 of 12 tests pass", timeout=STARTED)
    expect(page.locator("#play-problems")).to_have_attribute("tabindex", "-1")  # nothing stands there to scroll
    save(page, "int unused;\n" * 30 + solved["01-camera-rays"].replace(POINT, "return ray.orgin;"))
    status_says(page, r"It does not compile\.")
    expect(page.get_by_role("button", name="Run")).to_be_in_viewport(ratio=1)
    assert_no_sideways_scrolling(page)
    head, problems, line = page.locator(".page-head"), page.locator("#play-problems"), page.locator(".cm-activeLine")
    expect(problems).to_have_attribute("tabindex", "0")
    for key in ("ControlOrMeta+Home", "ControlOrMeta+End"):
        page.keyboard.press(key)
        expect(problems.get_by_role("button").first).to_be_in_viewport(ratio=1)
        page.wait_for_function(
            """([line, above, below]) => {
                const { top, bottom } = line.getBoundingClientRect();
                const { top: most } = below.getBoundingClientRect();
                return above.getBoundingClientRect().bottom <= top && bottom <= most;
            }""",
            arg=[one.element_handle() for one in (line, head, problems)],
        )


def test_on_a_small_laptop_the_results_scroll_past_a_wide_editor(page: "Page") -> None:
    """They stand below the handout there; a text to read takes the place of both."""
    from playwright.sync_api import expect

    page.set_viewport_size({"width": 1024, "height": 600})
    editor, results = page.locator("#play-editor"), page.locator("#play-first")
    assert editor.evaluate("editor => editor.clientWidth") > 500
    for title, room in (("Results", results), ("Handout", page.locator("#play-handout h1"))):
        page.get_by_role("button", name=title, exact=True).click()
        expect(room).to_be_in_viewport()
        expect(editor).to_be_in_viewport(ratio=1)
    page.locator("#play-texts").get_by_role("link").first.click()
    expect(page.locator("#play-reading-text")).to_be_focused()
    _wait_until_side_by_side(page, "#play-reading", "#play-source")
    expect(page.locator("#play-reading")).to_be_in_viewport(ratio=1)
    expect(results).to_be_hidden()
    assert page.evaluate("document.documentElement.scrollHeight - innerHeight") <= 0


def test_rooms_scroll_and_the_page_does_not(page: "Page") -> None:
    """On a wide screen; and what is said of a pixel stands together, however high the stage beside it is."""
    from playwright.sync_api import expect

    page.mouse.move(700, 20)  # above the rooms
    page.mouse.wheel(0, 3000)
    assert page.evaluate("document.documentElement.scrollHeight - innerHeight") <= 0
    assert broken_words(page, "#play-handout table") == []
    assert_fits_all_screens(page)
    page.set_viewport_size({"width": 1440, "height": 900})
    page.get_by_role("button", name="Look inside pixel").first.click()
    lines = page.locator("#play-inside .trees > *")
    expect(lines.last).to_contain_text("shows the direction of its eye ray", timeout=STARTED)
    boxes = lines.evaluate_all("all => all.map(one => one.getBoundingClientRect()).map(box => [box.top, box.bottom])")
    assert max(below[0] - above[1] for above, below in pairwise(boxes)) < 40
