"""The comparison of two pictures, in a browser, with pictures whose every pixel is known."""

import io
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
import pytest
from browser import OpenPage, assert_accessible, assert_fits_all_screens, assert_no_sideways_scrolling
from PIL import Image

from raysteps.report import page as pages
from raysteps.report.page import COMPARE_SCRIPTS, COMPARE_STYLES, PictureData, flip_map, picture_data, pixel_data

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

Pixels = npt.NDArray[np.uint8]
_WIDTH, _HEIGHT = 32, 24
_FIRST, _WORST = (20, 3), (5, 17)  # x, y of the pixels that are planted
_COMMAND = "./raysteps inspect scenes/lessons/three-spheres.nff {x} {y} --step 3 --size 32x24 --against reference"


def _reference() -> Pixels:
    y, x = np.mgrid[0:_HEIGHT, 0:_WIDTH]
    return np.stack([x * 7, y * 9, 90 + 0 * x], axis=2).astype(np.uint8)


def _mine() -> Pixels:
    """Like the reference, but for one pixel by 10, one by 150, and one by as little as is forgiven."""
    pixels = _reference()
    pixels[_FIRST[1], _FIRST[0], 1] += 10
    pixels[_WORST[1], _WORST[0], 2] += 150
    pixels[0, 0, 0] += 2
    return pixels


def _data(folder: Path, pixels: Pixels | None) -> PictureData | None:
    if pixels is None:
        return None
    data = io.BytesIO()
    Image.fromarray(pixels).save(data, format="PNG")
    path = folder / "picture.png"
    path.write_bytes(data.getvalue())
    return picture_data(path)


def _element(
    folder: Path, label: str, reference: Pixels | None, mine: Pixels | None, group: str | None = None, **more: Any
) -> str:
    flip = flip_map(reference, mine) if reference is not None and mine is not None else None
    shown = {"reference": _data(folder, reference), "mine": _data(folder, mine)}
    shown["flip"] = pixel_data(flip) if flip is not None else None
    macro: Any = pages._environment().get_template("compare.html.j2").module
    names = {"reference": "reference", "mine": "yours"}
    return str(macro.compare(label, shown, names, group=group, inspect=_COMMAND, **more))


def _page(folder: Path, *elements: str) -> Path:
    text = pages.render_page("base", "Pictures", {}, COMPARE_SCRIPTS, COMPARE_STYLES)
    path = folder / "pictures.html"
    path.write_text(text.replace("</main>", "".join(elements) + "</main>"), encoding="utf-8")
    return path


@pytest.fixture
def planted(tmp_path: Path) -> Path:
    """A page with one comparison."""
    return _page(tmp_path, _element(tmp_path, "balls", _reference(), _mine()))


def _ready(page: "Page", at: int = 0) -> "Locator":
    element = page.locator("compare-pictures").nth(at)
    element.scroll_into_view_if_needed()
    page.locator(f"compare-pictures >> nth={at} >> .compare-count:not(:text('are read'))").wait_for()
    _settled(page)
    return element


def _settled(page: "Page") -> None:
    page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def _place(element: "Locator", x: float, y: float) -> tuple[float, float]:
    """The middle of a pixel on the screen, while the whole picture is seen."""
    box = element.locator(".compare-stage").bounding_box()
    assert box is not None
    return box["x"] + (x + 0.5) / _WIDTH * box["width"], box["y"] + (y + 0.5) / _HEIGHT * box["height"]


def _stage(element: "Locator") -> Pixels:
    """The colours on the stage in the middle of each pixel, while the whole picture is seen."""
    script = """(element, [width, height]) => {
        const canvas = element.querySelector(".compare-stage canvas");
        const copy = document.createElement("canvas").getContext("2d");
        copy.imageSmoothingEnabled = false;
        copy.drawImage(canvas, 0, 0, width, height);
        return [...copy.getImageData(0, 0, width, height).data];
    }"""
    values = element.evaluate(script, [_WIDTH, _HEIGHT])
    return np.array(values, dtype=np.uint8).reshape(_HEIGHT, _WIDTH, 4)[:, :, :3]


def _seen(element: "Locator", x: int, y: int) -> list[int]:
    return _colour(_stage(element), x, y)


def _zoom(element: "Locator") -> float:
    """How much larger than the whole picture in the stage; what is shown is percent of the picture's own size."""
    width = element.locator(".compare-stage").evaluate("stage => stage.clientWidth")
    shown = element.locator(".compare-zoom").inner_text()
    assert shown.endswith(" %")
    return round(float(shown[:-2]) / 100 / (float(width) / _WIDTH), 2)


def _colour(pixels: Pixels, x: int, y: int) -> list[int]:
    return [int(value) for value in pixels[y, x]]


def _words(colour: list[int]) -> str:
    return " ".join(str(value) for value in colour)


def test_the_divider_follows_the_mouse_and_parts_the_pictures(open_page: OpenPage, planted: Path) -> None:
    page = open_page(planted)
    element = _ready(page)
    divider = element.get_by_role("slider", name="Divider between reference and yours")
    assert divider.get_attribute("aria-valuenow") == "50"
    assert _seen(element, *_WORST) == _colour(_reference(), *_WORST)
    box = divider.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(*_place(element, 2, 12), steps=4)
    page.mouse.up()
    _settled(page)
    assert divider.get_attribute("aria-valuenow") == "8"
    assert _seen(element, *_WORST) == _colour(_mine(), *_WORST)
    assert _seen(element, *_FIRST) == _colour(_mine(), *_FIRST)


def test_the_divider_follows_the_keys(open_page: OpenPage, planted: Path) -> None:
    page = open_page(planted)
    divider = _ready(page).get_by_role("slider")
    divider.focus()
    for key, value in (("ArrowLeft", "48"), ("PageUp", "58"), ("ArrowRight", "60"), ("End", "100"), ("Home", "0")):
        page.keyboard.press(key)
        assert divider.get_attribute("aria-valuenow") == value
    assert divider.get_attribute("aria-valuetext") == "0 % reference, 100 % yours"


def test_the_readout_tells_the_pixel_under_the_pointer(open_page: OpenPage, planted: Path) -> None:
    page = open_page(planted)
    element = _ready(page)
    page.evaluate("addEventListener('pixel', event => { window.told = event.detail; })")
    for x, y in ((0, 0), _FIRST, _WORST, (31, 23)):
        page.mouse.move(*_place(element, x, y))
        reference, mine = _colour(_reference(), x, y), _colour(_mine(), x, y)
        cells = element.locator(".compare-readout td").all_inner_texts()
        assert cells[:3] == [f"x {x}, y {y}", _words(reference), _words(mine)]
        largest = max(abs(a - b) for a, b in zip(mine, reference, strict=True))
        assert cells[3].endswith(f"(largest {largest})")
        assert page.evaluate("window.told") == {"x": x, "y": y, "reference": reference, "mine": mine}


def test_the_readout_tells_the_same_by_keys(open_page: OpenPage, planted: Path) -> None:
    page = open_page(planted)
    element = _ready(page)
    element.locator(".compare-stage").focus()
    for key in ["ArrowRight"] * (_FIRST[0] - _WIDTH // 2) + ["ArrowUp"] * (_HEIGHT // 2 - _FIRST[1]):
        page.keyboard.press(key)
    assert element.locator(".compare-readout td").first.inner_text() == f"x {_FIRST[0]}, y {_FIRST[1]}"
    assert f"pixel {_FIRST[0]}, {_FIRST[1]}" in element.locator(".hidden-text").inner_text()
    page.keyboard.press("Enter")
    assert f"three-spheres.nff {_FIRST[0]} {_FIRST[1]} --step" in element.locator("code").inner_text()


def test_zoom_and_pan_are_shared_in_a_group_and_only_there(open_page: OpenPage, tmp_path: Path) -> None:
    elements = [_element(tmp_path, f"picture {group}", _reference(), _mine(), group) for group in ("a", "a", "b")]
    page = open_page(_page(tmp_path, *elements), height=2600)
    first, second, other = (_ready(page, at) for at in range(3))
    for _ in range(2):
        first.get_by_role("button", name="Zoom in").click()
    first.locator(".compare-stage").focus()
    for _ in range(3):
        page.keyboard.press("Shift+ArrowRight")
    _settled(page)
    assert _zoom(first) == _zoom(second) > _zoom(other) == 1
    texts = []
    for element in (first, second, other):
        page.mouse.move(*_place(element, 3, 3))
        texts.append(element.locator(".compare-readout td").first.inner_text())
    assert texts[0] == texts[1] != texts[2] == "x 3, y 3"
    page.keyboard.press("0")
    _settled(page)
    assert _zoom(second) == 1


def test_wheel_zooms_at_the_pointer_and_all_views_share_it(open_page: OpenPage, planted: Path) -> None:
    page = open_page(planted)
    element = _ready(page)
    place = element.locator(".compare-readout td").first
    page.mouse.move(*_place(element, *_WORST))
    page.mouse.wheel(0, -300)
    _settled(page)
    assert _zoom(element) == 1  # the page scrolls until the picture was chosen
    page.evaluate("scrollTo(0, 0)")
    page.mouse.click(*_place(element, *_WORST))
    page.mouse.wheel(0, -600)
    _settled(page)
    zoomed = _zoom(element)
    assert zoomed > 2
    page.mouse.move(1, 1)
    page.mouse.move(*_place(element, *_WORST))
    assert place.inner_text() == f"x {_WORST[0]}, y {_WORST[1]}"
    for key in "2345":
        page.keyboard.press(key)
        _settled(page)
        assert _zoom(element) == pytest.approx(zoomed / 2 if key == "3" else zoomed, abs=0.02)  # two share the stage


def test_two_fingers_zoom(open_page: OpenPage, planted: Path) -> None:
    page = open_page(planted, width=360, touch=True)
    element = _ready(page)
    x, y = _place(element, 16, 12)
    session = page.context.new_cdp_session(page)
    for kind, apart in (("touchStart", 20), ("touchMove", 40), ("touchMove", 60)):
        points = [{"x": x - apart, "y": y, "id": 1}, {"x": x + apart, "y": y, "id": 2}]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    _settled(page)
    assert _zoom(element) == 3


def test_what_is_pressed_is_seen_with_the_colours_of_a_system(open_page: OpenPage, planted: Path) -> None:
    page = open_page(planted)
    element = _ready(page)
    page.emulate_media(forced_colors="active")
    color = "one => getComputedStyle(one).backgroundColor"
    on, off = (element.locator(f"button[aria-pressed={state}]").first.evaluate(color) for state in ("true", "false"))
    assert on != off
    stage = element.locator(".compare-stage").evaluate(color)
    assert stage == "rgb(42, 45, 49)", "white pictures are told from it"


def test_on_paper_both_pictures_are_there_seen_or_not(open_page: OpenPage, planted: Path) -> None:
    page = open_page(planted)
    element = _ready(page)
    page.emulate_media(media="print")
    pictures = element.locator(":scope > img")
    assert [one.is_visible() for one in pictures.all()] == [True, True, False], "FLIP needs its legend"
    assert not element.locator(".compare-show").is_visible()
    assert element.locator(".compare-count").is_visible()
    named = "one => [getComputedStyle(one, '::before').content, getComputedStyle(one, '::after').content]"
    assert element.evaluate(named) == ['"reference"', '"yours"']
    element.evaluate("one => one.dataset.state = 'waiting'")
    assert not element.locator(".compare-count").is_visible()


def test_difference_and_flip_are_brightest_at_the_planted_error(open_page: OpenPage, planted: Path) -> None:
    page = open_page(planted)
    element = _ready(page)
    element.get_by_role("button", name="Difference").click()
    _settled(page)
    assert _seen(element, *_FIRST) == [0, 80, 0]
    assert _seen(element, *_WORST) == [0, 0, 255]
    assert _seen(element, 0, 0) == [16, 0, 0]
    assert _seen(element, 12, 12) == [0, 0, 0]
    element.get_by_role("button", name="FLIP").click()
    _settled(page)
    heat = _stage(element).sum(axis=2, dtype=int)
    assert np.unravel_index(heat.argmax(), heat.shape) == (_WORST[1], _WORST[0])
    assert heat[10, 28] == 0
    assert element.get_by_text("1 different").is_visible()


def test_first_and_worst_lead_to_the_command_which_is_copied(open_page: OpenPage, planted: Path) -> None:
    page = open_page(planted)
    element = _ready(page)
    assert element.locator(".compare-count").inner_text().startswith("2 of 768 pixels differ (0.26 %)")
    copy = element.get_by_role("button", name="Copy")
    assert element.locator("code").inner_text() == _COMMAND.format(x=_WORST[0], y=_WORST[1])  # before one is chosen
    assert copy.is_enabled()
    for name, (x, y) in (("First wrong pixel", _FIRST), ("Worst pixel", _WORST)):
        element.get_by_role("button", name=name).click()
        _settled(page)
        command = _COMMAND.format(x=x, y=y)
        assert element.locator("code").inner_text() == command
        assert element.locator(".compare-readout td").first.inner_text() == f"x {x}, y {y}"
    copy.click()
    element.get_by_role("button", name="Copied").wait_for()
    assert page.evaluate("navigator.clipboard.readText()") == command


def test_without_a_clipboard_the_command_is_selected(open_page: OpenPage, planted: Path) -> None:
    gone = "Object.defineProperty(navigator, 'clipboard', {value: undefined}); document.execCommand = () => false;"
    page = open_page(planted, before=gone)
    element = _ready(page)
    element.get_by_role("button", name="Worst pixel").click()
    element.get_by_role("button", name="Copy").click()
    element.get_by_role("button", name="Selected").wait_for()
    assert page.evaluate("getSelection().toString()") == _COMMAND.format(x=_WORST[0], y=_WORST[1])


def test_numbers_stand_on_large_pixels(open_page: OpenPage, planted: Path) -> None:
    page = open_page(
        planted,
        before="""
        const write = CanvasRenderingContext2D.prototype.fillText;
        CanvasRenderingContext2D.prototype.fillText = function (text, ...rest) {
            (window.written ??= new Set()).add(text);
            write.call(this, text, ...rest);
        };""",
    )
    element = _ready(page)
    element.get_by_role("button", name="Side by side").click()
    assert page.evaluate("window.written === undefined")
    element.get_by_role("button", name="Worst pixel").click()
    for _ in range(3):
        element.get_by_role("button", name="Zoom in").click()
    _settled(page)
    assert page.evaluate("['90', '240', '153'].every(text => window.written.has(text))")


def test_blinking_stops_and_waits_for_those_who_want_no_motion(open_page: OpenPage, planted: Path) -> None:
    page = open_page(planted, calm=True)
    element = _ready(page)
    element.get_by_role("button", name="Blink").click()
    assert element.get_by_role("button", name="Play").is_visible()
    assert element.locator(".compare-name.left").inner_text() == "reference"
    element.get_by_role("button", name="Swap").click()
    _settled(page)
    assert element.locator(".compare-name.right").inner_text() == "yours"
    assert _seen(element, *_WORST) == _colour(_mine(), *_WORST)
    element.get_by_role("button", name="Play").click()
    element.locator(".compare-name.left:text('reference')").wait_for()
    element.locator(".compare-name.right:text('yours')").wait_for()
    element.get_by_role("button", name="Pause").click()


def test_equal_unequal_and_missing_pictures(open_page: OpenPage, tmp_path: Path) -> None:
    elements = [
        _element(tmp_path, "same", _reference(), _reference()),
        _element(tmp_path, "smaller", _reference(), _mine()[:10, :10].copy()),
        _element(tmp_path, "missing", _reference(), None),
    ]
    page = open_page(_page(tmp_path, *elements), height=2600)
    same, smaller, missing = (_ready(page, at) for at in range(3))
    assert same.locator(".compare-count").inner_text().startswith("No difference")
    assert same.get_by_role("button", name="Worst pixel").is_disabled()
    assert re.search("reference is 32 . 24, yours is 10 . 10", smaller.locator(".compare-count").inner_text())
    assert missing.locator(".compare-name.right").inner_text() == "yours: no picture"
    for element in (smaller, missing):
        assert element.get_by_role("button", name="Side by side").get_attribute("aria-pressed") == "true"
        assert element.get_by_role("button", name="Slider").is_disabled()
    page.mouse.move(*_place(missing, 2, 12))
    assert missing.locator(".compare-readout td").nth(2).inner_text() == "no pixel"
    assert_accessible(page)


def test_pictures_can_be_replaced_and_are_read_only_when_seen(open_page: OpenPage, tmp_path: Path) -> None:
    element = _element(tmp_path, "balls", _reference(), _mine())
    page = open_page(_page(tmp_path, *[element] * 12))
    _ready(page).get_by_role("button", name="FLIP").click()
    states = page.evaluate("[...document.querySelectorAll('compare-pictures')].map(({dataset}) => dataset.state)")
    assert states[-1] == "waiting"
    other = _data(tmp_path, _reference())
    assert other is not None
    page.evaluate(
        "src => document.querySelector('compare-pictures')"
        ".setPictures({reference: {src, name: 'before'}, mine: {src, name: 'after'}})",
        other.src,
    )
    first = _ready(page)
    assert page.evaluate("document.querySelector('compare-pictures').view") == "slider"  # there is no map of these
    assert first.locator(".compare-count").inner_text().startswith("No difference")
    assert first.get_by_role("slider", name="Divider between before and after").count() == 1


@pytest.mark.parametrize(("width", "scheme"), [(360, "dark"), (1440, "light")])
def test_every_view_is_accessible_at_every_width(open_page: OpenPage, planted: Path, width: int, scheme: str) -> None:
    page = open_page(planted, width=width, scheme=scheme)
    element = _ready(page)
    for name in ("Slider", "Blink", "Side by side", "Difference", "FLIP"):
        element.get_by_role("button", name=name).click()
        _settled(page)
        assert_no_sideways_scrolling(page)
    for summary in element.locator("summary").all():
        summary.click()
    assert_accessible(page)
    assert_fits_all_screens(page)


def test_at_100_percent_a_pixel_of_the_picture_is_one_of_the_page(open_page: OpenPage, tmp_path: Path) -> None:
    wide = np.tile(_reference(), (80, 100, 1))
    page = open_page(_page(tmp_path, _element(tmp_path, "large", wide, wide)))
    element = _ready(page)
    box = element.locator(".compare-stage").bounding_box()
    assert box is not None
    fit = min(box["width"] / wide.shape[1], box["height"] / wide.shape[0])
    assert element.locator(".compare-zoom").inner_text() == f"{round(fit * 100)} %"
    element.get_by_role("button", name="Zoom in").click()
    _settled(page)
    assert element.locator(".compare-zoom").inner_text() == f"{round(fit * 200)} %"
    place = element.locator(".compare-readout td").first
    left, middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(left, middle)
    first = int(place.inner_text().split()[1].rstrip(","))
    page.mouse.move(left + 100, middle)
    second = int(place.inner_text().split()[1].rstrip(","))
    assert second - first == pytest.approx(100 / (2 * fit), abs=1.01)


def _divider(element: "Locator") -> float:
    """Where the divider stands, in pixels of the picture, when all of it is seen."""
    split = element.get_by_role("slider", name="Divider between reference and yours").evaluate(
        "divider => parseFloat(divider.style.left) / 100"
    )
    return float(split * _WIDTH)


def test_the_divider_never_hides_the_chosen_pixel(open_page: OpenPage, planted: Path) -> None:
    page = open_page(planted, width=500)
    element = _ready(page)
    middle = _WIDTH // 2
    divider = element.get_by_role("slider", name="Divider between reference and yours")
    element.locator(".compare-stage").focus()
    page.keyboard.press("ArrowUp")  # from the middle, where the divider stands
    page.keyboard.press("Enter")
    _settled(page)
    assert _divider(element) < middle - 1
    divider.focus()
    places = []
    for key in ["ArrowRight"] * 30 + ["ArrowLeft"] * 30:
        page.keyboard.press(key)
        places.append(_divider(element))
    assert max(places) > middle + 2
    assert min(places) < middle - 1
    assert not [place for place in places if middle - 0.5 < place < middle + 1.5]
    element.get_by_role("button", name="Worst pixel").click()  # zooms, so that the pixel stands in the middle
    _settled(page)
    stage = element.locator(".compare-stage").bounding_box()
    line = divider.bounding_box()
    assert stage is not None
    assert line is not None
    assert abs(line["x"] + line["width"] / 2 - (stage["x"] + stage["width"] / 2)) > 12


def test_exposure_gamma_and_channels_change_what_is_shown_and_no_number(open_page: OpenPage, planted: Path) -> None:
    page = open_page(planted)
    element = _ready(page)
    element.get_by_text("Exposure, gamma, channels").click()
    at = (4, 6)  # 28 54 90, left of the divider
    assert _seen(element, *at) == [28, 54, 90]
    exposure = element.get_by_role("slider", name="Exposure")
    exposure.focus()
    for _ in range(2):
        page.keyboard.press("ArrowRight")
    _settled(page)
    assert _seen(element, *at) == [56, 108, 180]
    assert "+1 stops" in element.locator(".compare-tone").inner_text()
    element.get_by_role("button", name="Green only").click()
    _settled(page)
    assert _seen(element, *at) == [108, 108, 108]
    element.get_by_role("button", name="As it is").click()
    element.get_by_role("slider", name="Gamma").fill("2")
    _settled(page)
    assert _seen(element, *at) == [round(255 * (value / 255) ** 0.5) for value in (28, 54, 90)]
    page.mouse.move(*_place(element, *at))
    assert element.locator(".compare-readout td").nth(1).inner_text() == "28 54 90"


def test_a_histogram_tells_how_many_pixels_are_how_far_off(open_page: OpenPage, planted: Path) -> None:
    element = _ready(open_page(planted))
    element.get_by_text("Histogram of the differences").click()
    rows = element.locator(".compare-histogram tbody tr").all_inner_texts()
    assert [row.split("\t") for row in rows] == [
        ["0 to 2 (right)", "766"],
        ["3 to 8", "0"],
        ["9 to 32", "1"],
        ["33 to 128", "0"],
        ["129 to 255", "1"],
    ]


def test_a_picture_that_a_grader_made_coarse_says_so(open_page: OpenPage, tmp_path: Path) -> None:
    page = open_page(_page(tmp_path, _element(tmp_path, "balls", _reference(), _mine(), share=0.25)))
    said = _ready(page).locator(".compare-count").inner_text()
    assert said.startswith("192 of 768 pixels differ (25.00 %)")
    assert "kept with fewer pixels" in said
    assert said.count("%") == 1
