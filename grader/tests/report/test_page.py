"""The shell of every page: its policy, its data, and that it asks nobody for anything."""

import json
from pathlib import Path

import pytest
from browser import OpenPage, Watched, assert_accessible, assert_no_sideways_scrolling

from raysteps.report.page import render_page

_NASTY = "</script><script>alert(1)</script> & \u2028 <!--"


def _page(folder: Path, **more: object) -> Path:
    path = folder / "page.html"
    path.write_text(render_page("base", _NASTY, {}, data={"name": _NASTY}, **more), encoding="utf-8")  # type: ignore[arg-type]
    return path


@pytest.mark.parametrize("width", [360, 1440])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_stays_text_and_data_stays_data(open_page: OpenPage, tmp_path: Path, width: int, scheme: str) -> None:
    page = open_page(_page(tmp_path), width=width, scheme=scheme)
    assert page.inner_text("h1").split() == _NASTY.split()
    assert json.loads(page.text_content("#data") or "") == {"name": _NASTY}
    assert page.locator("script").count() == 1
    assert_accessible(page)
    assert_no_sideways_scrolling(page)


def test_a_script_that_was_put_in_does_not_run(watched: Watched, tmp_path: Path) -> None:
    path = _page(tmp_path)
    text = path.read_text(encoding="utf-8")
    path.write_text(
        text.replace("</main>", "<script>window.ran = true</script><p onclick='1'></main>"), encoding="utf-8"
    )
    watched.expected = "script-src|Content Security Policy"
    page = watched.open(path)
    assert page.evaluate("window.ran === undefined")


@pytest.mark.parametrize("address", ["https://example.org/", "file-that-is-not-here.json"])
def test_a_page_may_ask_nobody(watched: Watched, tmp_path: Path, address: str) -> None:
    watched.expected = "connect-src|Content Security Policy"
    page = watched.open(_page(tmp_path))
    assert page.evaluate("address => fetch(address).then(() => 'answered', () => 'refused')", address) == "refused"
