"""The page of the finale in a browser."""

from pathlib import Path

import numpy as np
import pytest
from browser import OpenPage, assert_accessible, assert_fits_all_screens

from raysteps.course.manifest import Step
from raysteps.finale.finale_page import Finale, Station, finale_page
from raysteps.finale.own_pictures import CountedPicture, LargePicture
from raysteps.results.model import Work

_SCRIPT = "<script>alert(1)</script>"


@pytest.fixture
def page_file(tmp_path: Path, steps: list[Step]) -> Path:
    picture = np.full((90, 160, 3), 60, np.uint8)
    stations = [
        Station(step, None if step.index == 8 else picture, _SCRIPT if step.index > 6 else "") for step in steps
    ]
    counted = [
        CountedPicture("every surface", Work(100, 170_000, 0, 0, 0, 0)),
        CountedPicture("octree", Work(100, 950, 3960, 8, 9, 10)),
    ]
    large = LargePicture(picture, 9, Work(100, 950, 3960, 0, 0, 0), {"shadow rays": 60, "refracted rays": 0}, 1.0, 7)
    finale = Finale(_SCRIPT, _SCRIPT, "Ray traced.", large, stations, counted, "./raysteps")
    path = tmp_path / "finale.html"
    path.write_text(finale_page(finale), encoding="utf-8")
    return path


@pytest.mark.parametrize(("width", "scheme"), [(390, "light"), (1400, "dark")])
def test_it_is_accessible_and_never_wider_than_the_screen(
    open_page: OpenPage, page_file: Path, width: int, scheme: str
) -> None:
    page = open_page(page_file, width=width, scheme=scheme)
    assert page.inner_text("h1") == _SCRIPT
    for part in (page.locator(".work .scroll"), page.locator(".next pre")):
        assert part.evaluate("box => box.scrollWidth <= box.clientWidth"), "nothing is cut off"
    assert_accessible(page)
    assert_fits_all_screens(page)


def test_it_shows_the_way_and_what_a_tree_spares(open_page: OpenPage, page_file: Path) -> None:
    page = open_page(page_file)
    assert page.locator(".station").count() == 9
    assert "With 60 shadow rays that makes 100 rays and 4.91 thousand tests." in page.inner_text("figcaption")
    assert page.locator(".station img").count() == 8
    assert page.inner_text(".station.open h3") == "08 Refraction bonus"
    assert page.inner_text(".work tbody tr:nth-child(2) td:last-child") == "97.1 %"
    assert page.get_attribute(".work tbody tr:nth-child(2) rect", "width") == "2.89"


def test_printed_it_is_a_poster(open_page: OpenPage, page_file: Path) -> None:
    page = open_page(page_file)
    page.emulate_media(media="print")
    assert page.is_visible(".hero img")
    assert page.is_visible("h1")
    for part in (".way", ".work", ".next", ".page-foot"):
        assert not page.is_visible(part)
