"""A real headless Chromium for the tests of pages; whatever a page asks the network for fails its test."""

import os
import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeAlias

import pytest

if TYPE_CHECKING:  # the tests of everything else need not wait for these
    from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Error, Page, Request

Scheme = Literal["light", "dark"]
OpenPage: TypeAlias = "Callable[..., Page]"

# The shell is what has no window and none of the services around pages: a third of the processor time goes there.
_NAMES = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
_LOCAL = ("file:", "data:", "blob:", "about:")
_ARGUMENTS = [
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    # A page compiles WebAssembly for one test, which is over before it pays to optimise that, or what is never called.
    "--js-flags=--wasm-lazy-compilation,--liftoff-only",
]
_WATCH_POLICY = """addEventListener('securitypolicyviolation',
    event => console.error('policy: ' + event.violatedDirective + ' ' + event.blockedURI));"""


@pytest.fixture(scope="session")
def browser() -> "Iterator[Browser]":
    """One for all tests of a process."""
    program = next(filter(None, map(shutil.which, _NAMES)), None)
    if program is None:
        pytest.skip("no Chromium here; install the package chromium-headless-shell to test the pages")
    from playwright.sync_api import sync_playwright

    as_root = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=program, args=[*_ARGUMENTS, *as_root])
        yield chromium
        chromium.close()


class Watched:
    """Pages and what they did that they should not."""

    def __init__(self, browser: "Browser") -> None:
        self._browser = browser
        self._contexts: list[BrowserContext] = []
        self.troubles: list[str] = []
        self.allowed: list[str] = []  # beginnings of addresses, such as of a server that a test started
        self.expected = ""  # a pattern of the trouble that a test makes on purpose

    def open(
        self,
        where: Path | str,
        width: int = 1440,
        scheme: Scheme = "light",
        height: int = 900,
        *,
        calm: bool = False,
        touch: bool = False,
        scripts: bool = True,
        before: str = "",
    ) -> "Page":
        """Opens a file, or an address that the test allowed. `calm` is a reader who wants no motion, `touch` one with
        fingers, and without `scripts` one who has switched them off; `before` is a script that runs before those of the
        page."""
        context = self._browser.new_context(
            viewport={"width": width, "height": height},
            color_scheme=scheme,
            reduced_motion="reduce" if calm else "no-preference",
            has_touch=touch,
            java_script_enabled=scripts,
            permissions=["clipboard-read", "clipboard-write"],
        )
        self._contexts.append(context)
        context.add_init_script(_WATCH_POLICY + before)
        page = context.new_page()
        page.set_default_timeout(60_000)
        page.on("request", self._request)
        page.on("console", self._console)
        page.on("pageerror", self._error)
        page.goto(where if isinstance(where, str) else where.resolve().as_uri())
        return page

    def _request(self, request: "Request") -> None:
        if not request.url.startswith((*_LOCAL, *self.allowed)):
            self.troubles.append(f"asked for {request.url}")

    def _console(self, message: "ConsoleMessage") -> None:
        if message.type in ("error", "warning") and "GL Driver Message" not in message.text:  # the driver, not the page
            self.troubles.append(f"console: {message.text}")

    def _error(self, error: "Error") -> None:
        self.troubles.append(f"error: {error}")

    def close(self) -> None:
        while self._contexts:
            self._contexts.pop().close()


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_teardown(item: pytest.Item) -> None:
    """Pages are closed before what serves them: one that still loads when its server goes has trouble of nobody's."""
    for value in getattr(item, "funcargs", {}).values():
        if isinstance(value, Watched):
            value.close()


@pytest.fixture
def watched(browser: "Browser") -> Iterator[Watched]:
    """For tests that expect trouble, or allow a server: fails the test for any other trouble, and for a lack of it."""
    pages = Watched(browser)
    yield pages
    wanted = [trouble for trouble in pages.troubles if pages.expected and re.search(pages.expected, trouble)]
    assert [trouble for trouble in pages.troubles if trouble not in wanted] == []
    assert bool(wanted) == bool(pages.expected)


@pytest.fixture
def open_page(watched: Watched) -> OpenPage:
    """`open_page(path, width=, scheme=, height=, calm=)` opens a file in a page of its own."""
    return watched.open


# All rules, and the nodes of what they find only: to tell what passed costs more than to look. Without `preload`, axe
# asks for no style sheets, which files may not.
_AXE = {"preload": False, "resultTypes": ["violations"]}


def assert_accessible(page: "Page") -> None:
    """What axe-core finds in the page as it is now."""
    from axe_playwright_python.sync_playwright import Axe

    results = Axe().run(page, options=_AXE)
    assert results.violations_count == 0, results.generate_report()


_BROKEN_WORDS = """boxes => boxes.flatMap(box => [...box.querySelectorAll('th, td')]).flatMap(cell => {
    const walk = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT);
    const broken = [];
    while (walk.nextNode()) {
        for (const {0: word, index} of walk.currentNode.data.matchAll(/[\\w.]+/g)) {
            const range = document.createRange();
            range.setStart(walk.currentNode, index);
            range.setEnd(walk.currentNode, index + word.length);
            const tops = [...range.getClientRects()].map(box => Math.round(box.top));
            broken.push(...(new Set(tops).size > 1 ? [word] : []));
        }
    }
    return broken;
})"""


def broken_words(page: "Page", boxes: str) -> list[str]:
    """In tables: those of which a part stands in another line."""
    return page.eval_on_selector_all(boxes, _BROKEN_WORDS)  # type: ignore[no-any-return]


def assert_no_sideways_scrolling(page: "Page") -> None:
    """A page may be long; it may not be wider than the screen."""
    wide, width = page.evaluate("[document.documentElement.scrollWidth, document.documentElement.clientWidth]")
    assert wide <= width, "the page is wider than the screen"


_SMALL = """least => [...document.querySelectorAll('button, select, input, summary, [role=slider]')]
    .filter(one => one.checkVisibility({ visibilityProperty: true }) && !one.closest('.hidden-text'))
    .map(one => [one, one.getBoundingClientRect()])
    .filter(([one, { width, height }]) => width < least || height < least)
    .filter(([one]) => !one.matches('label [type=checkbox]'))
    .map(([one, { width, height }]) => `${one.outerHTML.slice(0, 80)}: ${width} x ${height}`)"""


def assert_large_enough(page: "Page", least: float = 24) -> None:
    """For a finger: buttons and their like are so many pixels wide and high (WCAG 2.5.8); a box to check has its words
    to press."""
    assert page.evaluate(_SMALL, least) == []


_CUT = """() => [...document.body.querySelectorAll('*')].filter(one => {
    const { overflowX, overflowY, clipPath, display } = getComputedStyle(one);
    const hides = [overflowX, overflowY].map(how => ['hidden', 'clip'].includes(how));
    return one.textContent.trim() && one instanceof HTMLElement && clipPath === 'none' && display !== 'inline'
        && (hides[0] && one.scrollWidth > one.clientWidth + 1 || hides[1] && one.scrollHeight > one.clientHeight + 1)
        && one.checkVisibility({ visibilityProperty: true }) && !one.closest('.hidden-text, [aria-hidden=true]');
}).map(one => one.outerHTML.slice(0, 120))"""

# Phones, tablets and screens of all kinds; some are half of another one, as at 200 %.
_SIZES = ((320, 568), (390, 844), (640, 360), (768, 1024), (1024, 600), (1280, 720), (1920, 1080), (2560, 1440))
_LARGE_TEXT = ((320, 568), (1024, 600))


def assert_fits_all_screens(page: "Page") -> None:
    """From a small phone to a large screen, and with text twice as large: no scrolling sideways, no text that is cut
    off, and nothing too small to be pressed."""

    def look(width: int, height: int) -> None:
        page.set_viewport_size({"width": width, "height": height})
        page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        assert_no_sideways_scrolling(page)
        assert page.evaluate(_CUT) == [], f"cut off at {width} x {height}"
        assert_large_enough(page)

    for size in _SIZES:
        look(*size)
    page.evaluate("document.documentElement.style.fontSize = '200%'")
    for size in _LARGE_TEXT:
        look(*size)
    page.evaluate("document.documentElement.style.fontSize = ''")
