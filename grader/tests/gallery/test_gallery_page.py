"""The gallery in a browser: walking, choosing both sides, scenes, and a student's pictures beside the reference's."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from browser import OpenPage, assert_accessible, assert_fits_all_screens
from playwright.sync_api import Page

from raysteps.cli.gallery import GalleryEntry, gallery_page
from raysteps.course.manifest import Step
from raysteps.gallery.shots import GalleryScene, Shot, WorkMap
from raysteps.images.compare import Pixels
from raysteps.results.model import Work

_SCRIPT = "<script>alert(1)</script>"
_SAME = {8: 7, 5: 4}  # steps that change nothing, counted from 0


def _picture(scene: int, step: int, *, mine: bool = False) -> Pixels:
    """A plain colour that says what it is a picture of."""
    return np.full((9, 12, 3), (10 * step, 100 * scene, 200 * mine), np.uint8)


def _work_map(name: str, tests: int) -> WorkMap:
    return WorkMap(name, np.full((9, 12, 3), tests % 256, np.uint8), Work(100, tests * 100, 0, 8, 9, 10))


def _scene(number: int, title: str, steps: list[Step], *, mine: bool) -> GalleryEntry:
    reference = [Shot(_picture(number, _SAME.get(step, step))) for step in range(len(steps))]
    own = [Shot(_picture(number, step, mine=True), "Unfinished: shade.") for step in range(len(steps))]
    own[3] = Shot(None, f"It does not build: {_SCRIPT}")
    work_maps = {6: [_work_map("every surface", 820), _work_map("octree", 3)]}
    return GalleryEntry(
        GalleryScene(title, title, f"About {title}.", Path("a.nff")), reference, work_maps, own if mine else []
    )


@pytest.fixture
def gallery(tmp_path: Path, steps: list[Step]) -> Path:
    path = tmp_path / "index.html"
    path.write_text(gallery_page(steps, [_scene(n, f"scene {n}", steps, mine=False) for n in (0, 1)]), "utf-8")
    return path


@pytest.fixture
def with_mine(tmp_path: Path, steps: list[Step]) -> Path:
    path = tmp_path / "index.html"
    path.write_text(gallery_page(steps, [_scene(0, _SCRIPT, steps, mine=True)]), "utf-8")
    return path


@pytest.fixture
def in_two_scenes(tmp_path: Path, steps: list[Step]) -> Path:
    """The first shows the steps up to 06, the second those from 05 on."""
    path = tmp_path / "index.html"
    scenes = [_scene(n, f"scene {n}", steps, mine=False) for n in (0, 1)]
    shown = (range(6), range(4, len(steps)))
    scenes = [
        replace(scene, reference=[shot if at in which else None for at, shot in enumerate(scene.reference)])
        for scene, which in zip(scenes, shown, strict=True)
    ]
    path.write_text(gallery_page(steps, scenes), "utf-8")
    return path


def _shown(page: Page) -> list[list[int]]:
    """The colours of the two pictures that are compared."""
    page.wait_for_selector("#picture[data-state=ready]")
    return page.evaluate(  # type: ignore[no-any-return]
        """async () => Promise.all(['reference', 'mine'].map(async (role) => {
            const image = document.querySelector(`#picture > img[data-role=${role}]`);
            await image.decode();
            const canvas = Object.assign(document.createElement('canvas'), { width: 1, height: 1 });
            canvas.getContext('2d').drawImage(image, 0, 0);
            return [...canvas.getContext('2d').getImageData(0, 0, 1, 1).data].slice(0, 3);
        }))"""
    )


def _colours(scene: int, left: int, right: int) -> list[list[int]]:
    return [[10 * step, 100 * scene, 0] for step in (left, right)]


@pytest.mark.parametrize(("width", "scheme"), [(360, "light"), (1440, "dark")])
def test_it_is_accessible_and_never_wider_than_the_screen(
    open_page: OpenPage, with_mine: Path, width: int, scheme: str
) -> None:
    page = open_page(with_mine, width=width, scheme=scheme)
    page.click("[data-go='5']")
    page.wait_for_selector("#picture[data-state=ready]")
    assert_accessible(page)
    assert_fits_all_screens(page)


def test_without_scripts_it_says_what_is_not_there(open_page: OpenPage, gallery: Path) -> None:
    page = open_page(gallery, scripts=False)
    assert page.locator("#picture img").first.is_visible()
    said = (
        "<noscript><p>The line, the walk and the other scenes need scripts."  # which a browser of tests does not show
    )
    assert said in gallery.read_text("utf-8")


def test_it_begins_with_the_first_and_the_last_and_then_walks(open_page: OpenPage, gallery: Path) -> None:
    page = open_page(gallery)
    assert _shown(page) == _colours(0, 0, 7)
    assert page.is_disabled("#previous")
    page.click("#next")
    assert _shown(page) == _colours(0, 0, 1)
    page.keyboard.press("n")
    assert _shown(page) == _colours(0, 1, 2)
    assert page.inner_text("#plate-title") == "03 Phong shading"
    page.keyboard.press("p")
    assert _shown(page) == _colours(0, 0, 1)
    page.keyboard.press("p")
    assert _shown(page) == _colours(0, 0, 7)
    for _ in range(8):
        page.click("#next")
    assert page.inner_text("#plate-title") == "09 Bounding volumes"
    assert page.is_disabled("#next")
    page.keyboard.press("n")
    assert page.inner_text("#plate-title") == "09 Bounding volumes"


def test_where_a_scene_ends_the_walk_goes_on_in_one_that_shows_the_next_step(
    open_page: OpenPage, in_two_scenes: Path
) -> None:
    page = open_page(in_two_scenes)
    assert _shown(page) == _colours(0, 0, 4)
    page.click("[data-go='5']")
    assert page.get_attribute("[data-scene='0']", "aria-pressed") == "true"
    page.click("#next")
    assert _shown(page) == _colours(1, 4, 6), "step 06 changes nothing in it"
    assert page.inner_text("#plate-title").startswith("07")
    assert page.inner_text("#scene-words") == "About scene 1."
    assert page.locator(".card.elsewhere").count() == 4
    page.click("[data-go='1']")
    assert _shown(page) == _colours(0, 0, 1)
    page.click("[data-scene='1']")
    assert _shown(page) == _colours(1, 4, 7), "the scene itself, before its walk"
    assert page.inner_text("#new").startswith("To the left, the scene after step 05")
    page.click("#next")
    page.click("#next")
    page.click("#previous")
    page.click("#previous")
    assert page.is_disabled("#previous")


def test_on_a_phone_the_strip_shows_the_whole_of_what_has_the_focus(open_page: OpenPage, gallery: Path) -> None:
    page = open_page(gallery, width=390, height=844, calm=True)
    strip = page.locator("#strip")
    strip.get_by_role("button").first.focus()
    for _ in range(strip.get_by_role("button").count()):
        box = page.locator(":focus").bounding_box()
        assert box is not None
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 390
        page.keyboard.press("Tab")


def test_both_sides_can_be_chosen_and_a_link_leads_to_them(open_page: OpenPage, gallery: Path) -> None:
    page = open_page(gallery)
    page.click("[data-side='left'][data-of='2']")
    page.click("[data-side='right'][data-of='6']")
    assert _shown(page) == _colours(0, 2, 6)
    assert page.get_attribute("[data-side='left'][data-of='2']", "aria-pressed") == "true"
    assert page.locator(".pick [aria-pressed=true]").count() == 2
    page.click("[data-go='4']")
    assert _shown(page) == _colours(0, 3, 4)
    page.click("[data-scene='1']")
    page.reload()
    assert _shown(page) == _colours(1, 3, 4)


def test_another_scene_brings_its_own_pictures(open_page: OpenPage, gallery: Path) -> None:
    page = open_page(gallery)
    first = page.get_attribute(".thumb img >> nth=3", "src")
    page.click("text=scene 1")
    assert _shown(page) == _colours(1, 0, 7)
    assert page.get_attribute(".thumb img >> nth=3", "src") != first
    assert page.inner_text("#scene-words") == "About scene 1."
    assert (page.get_attribute("#picture .compare-stage", "aria-label") or "").startswith("scene 1: ")
    page.keyboard.press("s")
    assert _shown(page) == _colours(0, 0, 7)


def test_a_step_that_saves_work_shows_it_beside_the_same_picture(open_page: OpenPage, gallery: Path) -> None:
    page = open_page(gallery)
    page.click("[data-go='5']")
    assert page.is_visible("#same")
    assert page.locator("#work figcaption").all_inner_texts() == [
        "every surface: 820 tests of surfaces per ray",
        "octree: 3.0 tests of surfaces per ray",
    ]
    page.click("#next")
    assert not page.is_visible("#same")
    assert not page.is_visible("#work")


def test_my_pictures_hang_beside_the_reference_and_a_missing_one_leaves_a_note(
    open_page: OpenPage, with_mine: Path
) -> None:
    page = open_page(with_mine)
    page.click("[data-go='2']")
    page.click("text=reference and yours")
    assert _shown(page) == [[20, 0, 0], [20, 0, 200]]
    assert page.inner_text("#note") == "Unfinished: shade."
    page.click("#next")
    assert not page.is_visible("#picture")
    assert page.inner_text("#empty") == f"yours: It does not build: {_SCRIPT}"
    page.click("#next")
    assert page.is_visible("#picture")
    assert _shown(page) == [[40, 0, 0], [40, 0, 200]]
    page.click("text=two steps")
    assert _shown(page) == _colours(0, 3, 4)
    assert page.inner_text("[data-scene='0']") == _SCRIPT


def test_the_page_keeps_pictures_that_are_alike_once(gallery: Path) -> None:
    text = gallery.read_text("utf-8")
    maps, plain = 2, 2
    assert text.count("data:image/png") == 2 * 7 + maps + plain


def test_without_scripts_two_pictures_and_the_words_are_seen(open_page: OpenPage, gallery: Path) -> None:
    gallery.write_text(gallery.read_text("utf-8").split('<script type="application/json"')[0], "utf-8")
    page = open_page(gallery)
    assert page.locator("#picture img >> visible=true").count() == 2
    assert page.locator(".card p >> visible=true").count() == 9


_SCALES = """(deltas) => {
    const stage = document.querySelector('#picture .compare-stage');
    const box = stage.getBoundingClientRect();
    const picture = { width: 12, height: 9 };
    const view = SharedView.of('gallery');
    const scale = () => new Pane({ left: 0, top: 0, width: box.width, height: box.height }, picture, view).scale;
    const seen = [scale()];
    stage.focus();
    for (const deltaY of deltas) {
        stage.dispatchEvent(new WheelEvent('wheel', { deltaY, ctrlKey: true, bubbles: true, cancelable: true,
            clientX: box.x + 0.4 * box.width, clientY: box.y + 0.4 * box.height }));
        seen.push(scale());
    }
    return [seen, window.devicePixelRatio, box.width, view.zoom];
}"""


@pytest.mark.parametrize("width", [1400, 1013, 390])
def test_pixels_take_whole_pixels_of_the_screen(open_page: OpenPage, gallery: Path, width: int) -> None:
    page = open_page(gallery, width=width)
    page.wait_for_selector("#picture[data-state=ready]")
    page.wait_for_function("document.querySelector('#picture').style.maxWidth !== ''")
    scales, ratio, wide, zoom = page.evaluate(_SCALES, [-40] * 30)
    assert all(scale * ratio == pytest.approx(round(scale * ratio), abs=1e-6) for scale in scales)
    assert wide == pytest.approx(12 * scales[0], abs=0.5), "no gap beside the whole picture"
    assert scales == sorted(scales)
    assert scales[-1] > 1.3 * scales[0], "small turns of the wheel add up"
    assert zoom > 1.3


@pytest.mark.parametrize(("scheme", "light"), [("light", True), ("dark", False)])
def test_it_is_as_light_as_the_system(open_page: OpenPage, gallery: Path, scheme: str, light: bool) -> None:
    page = open_page(gallery, scheme=scheme)
    paper = page.evaluate("getComputedStyle(document.body).backgroundColor.match(/[0-9]+/g).map(Number)")
    assert (min(paper[:3]) > 200) is light
    assert (max(paper[:3]) < 60) is not light
