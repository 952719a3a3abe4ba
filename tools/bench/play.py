"""The command `bench play`: how long people wait in the page to work in, and how its live figures move."""

import os
import re
import shutil
import statistics
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console

from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step, choose, kit_steps
from raysteps.course.mutants import reference_source
from raysteps.course.project import Project
from raysteps.course.settings import COURSE_VARIABLE
from raysteps.play.packages import registry_of
from raysteps.play.play_page import PlayPage, PlayServer
from raysteps.toolchain.cmake import release_tree
from tools.bench.model import FigureRow, PlayNumbers, SaveRow, Spread, keep
from tools.bench.programs import machine, variable
from tools.bench.tables import median, terminal_table

if TYPE_CHECKING:  # only this command waits for it
    from playwright.sync_api import Browser, Page

_NAMES = ("chromium", "chromium-browser", "google-chrome")
_MILLISECONDS = 180_000  # until a step was tested and drawn
_BEFORE_SAVE = 2000  # milliseconds that the text is there: then what it includes is compiled, as while somebody types
_NUMBER = re.compile(r"\d")
_SUMMED = "() => /tests pass|does not compile/.test(document.getElementById('play-status').textContent)"


@contextmanager
def _both_parts() -> Iterator[None]:
    """A course that has all steps, whatever that of this kit has."""
    with tempfile.TemporaryDirectory(prefix="raysteps-") as name:
        course = Path(name) / "course.toml"
        course.write_text("parts = [1, 2]\n", encoding="utf-8")
        with variable(COURSE_VARIABLE, str(course)):
            yield


@contextmanager
def _chromium() -> "Iterator[Browser]":
    program = next(filter(None, map(shutil.which, _NAMES)), None)
    if program is None:
        raise UsageError("no Chromium here; install the package chromium")
    from playwright.sync_api import sync_playwright

    as_root = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=["--disable-gpu", *as_root])
        yield browser
        browser.close()


def _memory(browser: "Browser") -> int:
    """Of the processes that run pages, in bytes; what they share counts by their parts. 0 where nobody tells."""
    told = browser.new_browser_cdp_session().send("SystemInfo.getProcessInfo")
    total = 0
    for process in told["processInfo"]:
        path = Path(f"/proc/{process['id']}/smaps_rollup")
        if process["type"] == "renderer" and path.is_file():
            lines = path.read_text(encoding="utf-8").splitlines()
            total += sum(1024 * int(line.split()[1]) for line in lines if line.startswith("Pss:"))
    return total


def _drawn(page: "Page", step: Step, text: str | None = None) -> float:
    """Seconds from a save, or from the choice of the step, to its first picture."""
    from playwright.sync_api import expect

    if text is not None:
        page.locator(".cm-content").click()
        page.keyboard.press("ControlOrMeta+a")
        page.keyboard.insert_text(text)
        page.wait_for_timeout(_BEFORE_SAVE)
        page.evaluate("() => document.querySelectorAll('.play-picture').forEach(one => delete one.dataset.seconds)")
        page.keyboard.press("ControlOrMeta+s")
    picture = page.locator(f"#picture-{step.images[0].name}")
    expect(picture).to_have_attribute("data-seconds", _NUMBER, timeout=_MILLISECONDS)
    page.wait_for_function(_SUMMED, timeout=_MILLISECONDS)
    return float(picture.get_attribute("data-seconds") or "nan")


def _visited(browser: "Browser", address: str, first: Step) -> "tuple[Page, int, float]":
    """The page, opened for the first time, with the bytes that came and the seconds until there was a picture."""
    page = browser.new_page()
    page.set_default_timeout(_MILLISECONDS)
    loaded: list[int] = []
    page.on("response", lambda answer: loaded.append(int(answer.headers.get("content-length", 0))))  # of workers, too
    start = time.monotonic()
    page.goto(f"{address}#{first.number}")
    _drawn(page, first)
    return page, sum(loaded), time.monotonic() - start


# Moves the handle that the mouse holds round beside where it was, once in each frame; gives when each frame came in
# which the figure was drawn anew, in milliseconds.
_DRAG = """(figure, [x, y, moves]) => new Promise((resolve) => {
    const handle = figure.querySelector(".live-handle:focus");
    const frames = [];
    let isDrawn = false;
    const watch = new MutationObserver(() => { isDrawn = true; });
    watch.observe(figure.querySelector(".live-views"), { childList: true, subtree: true });
    const tick = (now) => {
        if (isDrawn) {
            frames.push(now);
        }
        isDrawn = false;
        if (moves-- === 0) {
            resolve(frames);
            return;
        }
        const [clientX, clientY] = [x + 40 * Math.cos(moves / 6) - 40, y + 40 * Math.sin(moves / 6)];
        handle.dispatchEvent(new PointerEvent("pointermove", { pointerId: 1, clientX, clientY }));  // the mouse is 1
        requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
})"""
_MOVES = 180


def _dragged(page: "Page", step: Step) -> Iterator[FigureRow]:
    """The figures of the step that is open, each by its first handle."""
    for figure in page.locator(".live").all():
        handle = figure.locator(".live-handle").first
        handle.scroll_into_view_if_needed()
        box = handle.bounding_box()
        assert box is not None
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        gaps = [after - before for before, after in pairwise(figure.evaluate(_DRAG, [x, y, _MOVES]))]
        page.mouse.up()
        most = statistics.quantiles(gaps, n=20)[-1]
        name = figure.get_attribute("data-figure") or ""
        yield FigureRow(step.id, name, 1000.0 / statistics.fmean(gaps), statistics.median(gaps), most)


def bench_play(project: Project, names: list[str], rounds: int, console: Console) -> int:
    """Measures, prints a table and writes build/bench/play.json."""
    if not project.has_reference:
        raise UsageError("bench play saves the reference's steps, which this kit does not have")
    with _both_parts():
        steps = choose(kit_steps(project), names)
        folder = PlayPage(project, registry_of(None), console.print).make()
    server = PlayServer(folder)
    rows, figures = [], []
    try:
        with _chromium() as browser:
            page, size, seconds = _visited(browser, server.address, steps[0])
            for step in steps:
                page.evaluate("number => { location.hash = number; }", step.number)
                _drawn(page, step)
                text = reference_source(project, step)
                first, *later = [_drawn(page, step, f"{text}// save {at}\n") for at in range(1 + rounds)]
                rows.append(SaveRow(step.id, first, Spread.of(later)))
                console.print(f"{step.id}: {first:.2f} s, then {rows[-1].later.median:.2f} s")
                for figure in _dragged(page, step):
                    figures.append(figure)
                    console.print(f"  {figure.figure}: {figure.per_second:.0f} frames a second")
            memory = _memory(browser)
            version = f"Chromium {browser.version}"
    finally:
        server.close()
    numbers = PlayNumbers(
        machine=machine(release_tree(project).folder),
        browser=version,
        first_bytes=size,
        first_seconds=seconds,
        memory_bytes=memory,
        rows=rows,
        figures=figures,
    )
    table = terminal_table("from a save to the first picture in the page to work in", ("step", "first", "later"))
    for row in rows:
        table.add_row(row.step, f"{row.first:.2f} s", median(row.later, 2, " s"))
    console.print(table)
    table = terminal_table("live figures, dragged", ("step", "figure", "frames per second", "median", "95 %"))
    for one in figures:
        table.add_row(one.step, one.figure, f"{one.per_second:.0f}", f"{one.median:.0f} ms", f"{one.most:.0f} ms")
    console.print(table)
    console.print(f"first visit: {size / 1e6:.1f} MB, {seconds:.1f} s; memory: {memory / 1e9:.2f} GB")
    keep(project, numbers, console)
    return 0
