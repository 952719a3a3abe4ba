"""The page of a pixel's inside, in a real browser."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from browser import OpenPage, assert_accessible, assert_fits_all_screens, assert_large_enough
from inspect_records import ball_record, lamp_record
from play_pages import middle

from raysteps.inspector.divergence import find_divergence
from raysteps.inspector.model import Number
from raysteps.inspector.pixel_page import write_page
from raysteps.report.page import pixel_data

if TYPE_CHECKING:
    from playwright.sync_api import Page

_COUNT_COLORS = """() => {
    const canvas = document.querySelector('canvas');
    return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
        const flat = document.createElement('canvas');
        flat.width = canvas.width; flat.height = canvas.height;
        document.querySelector('pixel-inside').view.paint();
        const pen = flat.getContext('2d', { willReadFrequently: true });
        pen.drawImage(canvas, 0, 0);
        const bytes = pen.getImageData(0, 0, flat.width, flat.height).data;
        const amounts = { orange: 0, white: 0, drawn: 0 };
        for (let i = 0; i < bytes.length; i += 4) {
            const [r, g, b, a] = bytes.slice(i, i + 4);
            amounts.drawn += a > 0;
            amounts.white += r > 240 && g > 240 && b > 240;
            amounts.orange += r > 240 && g > 140 && g < 175 && b < 70;
        }
        done(amounts);
    })));
}"""


@pytest.fixture
def page(tmp_path: Path, open_page: OpenPage) -> "Page":
    write_page(ball_record(), None, None, tmp_path / "inside.html")
    return open_page(tmp_path / "inside.html")


def test_rays_and_the_box_of_the_moment_are_drawn(page: "Page") -> None:
    page.locator("[data-part=boxes]").fill("1")
    amounts = page.evaluate(_COUNT_COLORS)
    assert amounts["drawn"] > 5000
    assert amounts["white"] > 100, "the chosen eye ray"
    assert amounts["orange"] > 100, "the box of the moment"
    page.locator("[data-part=boxes]").fill("0")
    assert page.evaluate(_COUNT_COLORS)["orange"] < amounts["orange"] / 4


def test_the_scrubber_and_the_tree_follow_each_other(page: "Page") -> None:
    output = page.locator("[data-part=box]")
    assert output.inner_text() == "Box 2 of 2, level 1: missed."
    page.locator("[data-part=boxes]").focus()
    page.keyboard.press("ArrowLeft")
    assert output.inner_text() == "Box 1 of 2, level 0: entered."
    page.get_by_text("2 boxes in their order").click()
    assert page.locator("li[aria-current]").get_attribute("data-box") == "1"
    page.locator("li[data-box='2']").click()
    assert output.inner_text() == "Box 2 of 2, level 1: missed."


def test_a_ray_is_chosen_in_the_tree(page: "Page") -> None:
    page.get_by_role("button", name="Show the reflected ray, depth 2 on the stage").click()
    assert page.locator("[data-part=ray]").inner_text() == "reflected ray, depth 2"
    assert page.locator("[data-part=box]").inner_text() == "No boxes were asked for this ray."


@pytest.mark.parametrize(
    ("scene", "at", "goal"), [("ball.nff", 0.0, 1), ("ball.nff", 4.0, 4), ("ball.nff", 3.8, 3.8), ("ball.pbrt", 4.0, 1)]
)
def test_the_stage_looks_at_what_is_hit(
    scene: str, at: float, goal: float, tmp_path: Path, open_page: OpenPage
) -> None:
    """But not at what lies far behind the point that the camera looks at, if it is not just a direction."""
    record = ball_record()
    record.scene = scene
    record.camera["at"] = [0, 0, at]
    write_page(record, None, None, tmp_path / "inside.html")
    page = open_page(tmp_path / "inside.html")
    assert page.evaluate("document.querySelector('pixel-inside').view.orbit.at") == pytest.approx([0, 0, goal])


def test_a_shadow_ray_to_a_sample_of_a_lamp_is_chosen(tmp_path: Path, open_page: OpenPage) -> None:
    mine, reference = lamp_record(lit=False), lamp_record()
    write_page(mine, reference, find_divergence(mine, reference), tmp_path / "inside.html")
    page = open_page(tmp_path / "inside.html")
    rays = "(name) => document.querySelector('pixel-inside').spaces[name].rays.map(({ id, role }) => [id, role])"
    shown = [page.evaluate(rays, name) for name in ("mine", "reference")]
    bounce = ["eye-reflect", "reflect"]
    assert shown == [
        [["eye", "eye"], ["eye-lamp1", "blocked"], bounce],
        [["eye", "eye"], ["eye-lamp1", "lit"], bounce],
    ]
    entry = page.locator("#reference-eye-lamp1.parts")  # open, as the difference is there
    assert "visible" in entry.locator("summary").inner_text()
    entry.get_by_role("button", name="Show the shadow ray to lamp 1 on the stage").click()
    assert page.locator("[data-part=ray]").inner_text() == "shadow ray to lamp 1"
    assert page.evaluate("document.querySelector('pixel-inside').ray.end") == pytest.approx([0, 0, 8.001])
    said = page.locator("#mine-eye").inner_text()
    assert "lamp 1, blocked by surface 1 (sphere) at distance 4: at (0, 0, 8)" in said
    assert "pdf 1 per steradian; would bring (0.60161, 0.26738, 0.066845), not added" in said
    assert "lamp 2, brings nothing: at (0, 0, -8)" in said
    assert "and 3 more samples of lamps, not kept" in said
    assert_accessible(page)


def test_without_a_tree_nothing_is_said_of_boxes(tmp_path: Path, open_page: OpenPage) -> None:
    """As before step 06."""
    record = ball_record()
    record.ray.boxes = []
    write_page(record, None, None, tmp_path / "inside.html")
    page = open_page(tmp_path / "inside.html")
    assert "box" not in page.locator(".stage").inner_text()
    assert not page.get_by_role("button", name="Play").is_visible()
    assert not page.get_by_role("slider").is_visible()
    assert page.get_by_role("button", name="From the side").is_visible()


def test_a_finger_scrolls_past_the_stage_and_turns_it_sideways(tmp_path: Path, open_page: OpenPage) -> None:
    write_page(ball_record(), None, None, tmp_path / "inside.html")
    page = open_page(tmp_path / "inside.html", width=320, height=568, touch=True)
    where = "() => document.querySelector('pixel-inside').view.orbit.from"
    start = page.evaluate(where)
    session = page.context.new_cdp_session(page)

    def swipe(across: float, down: float) -> None:
        x, y = middle(page.locator("canvas"))
        for at in range(5):
            points = [{"x": x + at * across, "y": y + at * down}]
            session.send(
                "Input.dispatchTouchEvent", {"type": "touchMove" if at else "touchStart", "touchPoints": points}
            )
        session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})

    swipe(-20, 0)
    turned = page.evaluate(where)
    assert turned != start
    assert page.evaluate("scrollY") == 0
    swipe(0, -30)
    page.wait_for_function("scrollY > 40")
    assert page.evaluate(where) == pytest.approx(turned)
    assert_large_enough(page)


def test_what_is_drawn_stays_for_who_prints_the_page(page: "Page") -> None:
    """Then no frame comes in which it would be drawn again."""
    page.evaluate(_COUNT_COLORS)
    later = _COUNT_COLORS.replace("document.querySelector('pixel-inside').view.paint();", "")
    assert later != _COUNT_COLORS
    assert page.evaluate(later)["drawn"] > 5000


def test_the_stage_stays_dark_with_the_colours_of_a_system(page: "Page") -> None:
    """The eye ray is white."""
    page.emulate_media(forced_colors="active")
    assert page.locator("canvas").evaluate("one => getComputedStyle(one).backgroundColor") == "rgb(42, 45, 49)"


def test_the_view_turns_by_keys_and_by_dragging(page: "Page") -> None:
    where = "() => document.querySelector('pixel-inside').view.orbit.from"
    start = page.evaluate(where)
    page.locator("canvas").focus()
    page.keyboard.press("ArrowLeft")
    turned = page.evaluate(where)
    assert turned != start
    canvas = page.locator("canvas").bounding_box()
    assert canvas is not None
    page.mouse.move(canvas["x"] + 100, canvas["y"] + 100)
    page.mouse.down()
    page.mouse.move(canvas["x"] + 160, canvas["y"] + 120)
    page.mouse.up()
    dragged = page.evaluate(where)
    assert dragged != turned
    page.get_by_role("button", name="From the eye").click()
    assert page.evaluate(where) == pytest.approx([0, 0, 5])


@pytest.mark.parametrize("wrong", ["nan", "inf", "-inf"])
def test_numbers_that_are_none_are_drawn_somewhere(wrong: Number, tmp_path: Path, open_page: OpenPage) -> None:
    record = ball_record()
    ray, shadow = record.ray, record.ray.lights[0].rays[0]
    assert ray.hit is not None
    ray.hit.position = shadow.origin = ray.bounces[0].direction = [wrong, 0, wrong]
    shadow.limit = ray.boxes[0].min[1] = record.frame.half_width = wrong
    write_page(record, None, None, tmp_path / "inside.html")
    page = open_page(tmp_path / "inside.html")
    assert page.evaluate(_COUNT_COLORS)["drawn"] > 5000
    numbers = page.evaluate("JSON.stringify(document.querySelector('pixel-inside').spaces)")
    assert "null" not in numbers.replace('"hit":null', "").replace('"level":null', "")


def test_what_a_scene_is_called_stays_text(page: "Page") -> None:
    assert page.locator(".facts dd").first.inner_text() == "scenes/ball & <sky>.nff"


@pytest.mark.parametrize(("width", "scheme"), [(360, "dark"), (1440, "light")])
def test_two_trees_beside_each_other(tmp_path: Path, open_page: OpenPage, width: int, scheme: str) -> None:
    mine, reference = ball_record(lit=False), ball_record()
    divergence = find_divergence(mine, reference)
    assert divergence is not None
    write_page(mine, reference, divergence, tmp_path / "both.html")
    page = open_page(tmp_path / "both.html", width=width, scheme=scheme)
    assert "First difference" in page.locator(".divergence-note").inner_text()
    marked = page.locator(".ray.parts")
    assert [marked.nth(i).get_attribute("data-ray") for i in range(2)] == ["eye-light1", "eye-light1"]
    page.locator("button[data-space=reference]").click()
    assert page.evaluate("document.querySelector('pixel-inside').name") == "reference"
    assert_accessible(page)
    assert_fits_all_screens(page)


def test_rays_that_are_deep_in_the_tree_fit_with_large_text(tmp_path: Path, open_page: OpenPage) -> None:
    record = ball_record()
    (ray,) = record.ray.bounces
    for depth in range(3, 7):
        deeper = replace(ray, depth=depth, bounces=[])
        ray.bounces = [deeper]
        ray = deeper
    write_page(record, None, None, tmp_path / "inside.html")
    page = open_page(tmp_path / "inside.html")
    page.evaluate("document.querySelectorAll('details').forEach(details => { details.open = true; })")
    assert page.get_by_text("reflected ray, depth 6").first.is_visible()
    assert_fits_all_screens(page)


def test_without_scripts_the_tree_says_it_in_words(tmp_path: Path, open_page: OpenPage) -> None:
    write_page(ball_record(), None, None, tmp_path / "inside.html")
    page = open_page(tmp_path / "inside.html", scripts=False)
    page.locator("summary", has_text="eye ray").first.wait_for()
    page.locator('[data-part="stage"]').wait_for(state="hidden")
    said = "<noscript><p>The rays in three dimensions need scripts."  # which a browser of tests does not show
    assert said in (tmp_path / "inside.html").read_text("utf-8")


def test_without_webgl_the_tree_is_still_there(page: "Page") -> None:
    page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    page.reload()
    assert "shows no WebGL" in page.get_by_role("status").inner_text()
    assert not page.locator("canvas").is_visible()
    assert page.get_by_text("meets surface 0 (sphere) at distance 4").is_visible()


def test_without_webgl_nothing_asks_for_the_stage(page: "Page") -> None:
    page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    page.reload()
    assert not page.locator("button[data-show]").first.is_visible()
    assert_accessible(page)


_STAGE = """() => {
    const { view, ray } = document.querySelector('pixel-inside');
    return [ray.id, view.orbit.from, document.querySelector('[data-part=boxes]').value, view.solid];
}"""


def test_a_stage_that_is_taken_away_comes_back_as_it_was(page: "Page") -> None:
    page.locator("[data-part=boxes]").fill("1")
    page.locator("[data-part=solid]").check()
    page.locator("canvas").focus()
    page.keyboard.press("ArrowLeft")
    before, amounts = page.evaluate(_STAGE), page.evaluate(_COUNT_COLORS)
    page.evaluate("""() => {
        const canvas = document.querySelector('canvas');
        window.loss = canvas.getContext('webgl').getExtension('WEBGL_lose_context');
        window.loss.loseContext();
    }""")
    trouble = page.locator("[data-part=trouble]")
    trouble.wait_for()
    assert "has taken the stage away. The tree of rays tells the same in words." in trouble.inner_text()
    assert not page.locator("canvas").is_visible()
    assert not page.locator("button[data-show]").first.is_visible()
    assert page.get_by_text("meets surface 0 (sphere) at distance 4").is_visible()
    assert_accessible(page)
    page.evaluate("() => window.loss.restoreContext()")
    page.locator("canvas").wait_for()
    assert not trouble.is_visible()
    assert page.evaluate(_STAGE) == before
    assert page.evaluate(_COUNT_COLORS) == amounts
    page.get_by_role("button", name="Show the reflected ray, depth 2 on the stage").click()
    assert page.locator("[data-part=ray]").inner_text() == "reflected ray, depth 2"


@pytest.mark.parametrize(("width", "scheme"), [(390, "dark"), (1400, "light")])
def test_the_picture_is_there_with_its_pixel_marked(
    tmp_path: Path, open_page: OpenPage, width: int, scheme: str
) -> None:
    pixels = np.full((12, 16, 3), 90, dtype=np.uint8)
    pixels[6, 8] = (10, 200, 10)
    picture = pixel_data(pixels)
    pictures = {"mine": picture, "reference": picture}
    write_page(ball_record(lit=False), ball_record(), None, tmp_path / "both.html", pictures)
    page = open_page(tmp_path / "both.html", width=width, scheme=scheme)
    drawn = page.get_by_role("img", name="my picture, pixel (8, 6) of 16 x 12 marked")
    box, mark = drawn.bounding_box(), drawn.locator("rect").first.bounding_box()
    assert box is not None
    assert mark is not None
    assert mark["x"] - box["x"] == pytest.approx(8 / 16 * box["width"], abs=4)
    assert mark["y"] - box["y"] == pytest.approx(6 / 12 * box["height"], abs=4)
    assert page.locator("figcaption").all_inner_texts() == [
        "mine, pixel (8, 6) of 16 x 12",
        "reference, pixel (8, 6) of 16 x 12",
    ]
    assert_accessible(page)
    assert page.evaluate("document.documentElement.scrollWidth <= window.innerWidth")
