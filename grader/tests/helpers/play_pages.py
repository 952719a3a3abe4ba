"""What tests of the page to work in share: it is made where its packages can be had, typed into, and read."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import pytest

from raysteps.common.errors import UsageError

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
