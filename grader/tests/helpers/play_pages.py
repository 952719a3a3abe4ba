"""What tests of the page to work in share: it is made where its packages can be had, typed into, and read."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from browser import Watched

from raysteps.common.errors import UsageError
from raysteps.course.project import Project
from raysteps.play.packages import registry_of
from raysteps.play.play_page import PlayPage, PlayServer

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

STARTED = 120_000  # milliseconds until a compiler that is new to the browser has compiled something


@contextmanager
def with_packages() -> Iterator[None]:
    """Skips the test where the page's packages are not there and no network is."""
    try:
        yield
    except UsageError as error:
        if "cannot be loaded down" not in str(error):
            raise
        pytest.skip(str(error))


def says(room: "Locator", pattern: str, timeout: float = STARTED) -> None:
    """Waits until it does."""
    from playwright.sync_api import expect

    expect(room).to_have_text(re.compile(pattern), timeout=timeout)


def write(page: "Page", text: str) -> None:
    """In place of all that is there."""
    page.locator(".cm-content").click()
    page.keyboard.press("ControlOrMeta+a")
    page.keyboard.insert_text(text)


def save(page: "Page", text: str) -> None:
    """Writes, and saves."""
    write(page, text)
    page.keyboard.press("ControlOrMeta+s")


def drag(page: "Page", handle: "Locator", to: "Locator | tuple[float, float]") -> None:
    """To the middle of something, or by so many pixels. Where the page moves meanwhile the handle is not caught, and so
    does not get the focus: then once more."""
    page.evaluate("document.activeElement?.blur()")
    for _ in range(50):
        handle.scroll_into_view_if_needed()
        x, y = middle(handle)
        page.mouse.move(x, y)
        page.mouse.down()
        if page.evaluate("document.activeElement !== document.body"):
            break
        page.mouse.up()
    else:
        raise AssertionError(f"{handle} was not caught")
    to_x, to_y = (x + to[0], y + to[1]) if isinstance(to, tuple) else middle(to)
    page.mouse.move(to_x, to_y, steps=4)
    page.mouse.up()


def middle(thing: "Locator") -> tuple[float, float]:
    box = thing.bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


# The whole page, served, with step 01 in its editor.

POINT = "return ray.origin + distance * ray.direction;"  # of its reference


@pytest.fixture(scope="session")
def site(project: Project) -> Path:
    """Made once, whatever tests want of it."""
    with with_packages():
        return PlayPage(project, registry_of(None)).make()


@pytest.fixture
def server(site: Path) -> Iterator[PlayServer]:
    found = PlayServer(site)
    yield found
    found.close()


@pytest.fixture
def page(watched: Watched, server: PlayServer) -> "Page":
    """Step 01, when its stub was compiled, tested and drawn."""
    watched.allowed += [server.address, f"blob:{server.address.rstrip('/')}"]
    page = watched.open(server.address)
    status_says(page, r"0 of 12 tests pass, 0 of 2 pictures are right\.", timeout=STARTED)
    return page


def status_says(page: "Page", pattern: str, timeout: float = 60_000) -> None:
    """Waits until the status line of the page does."""
    says(page.locator("#play-status"), pattern, timeout)


def source_of(page: "Page") -> str:
    """What is seen in the editor."""
    return str(
        page.evaluate("document.getElementById('play-editor').shadowRoot.querySelector('.cm-content').innerText")
    )
