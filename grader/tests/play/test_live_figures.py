"""Live figures: dragged in a real browser, they say the numbers of the handouts, by what the student wrote."""

import re
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, TypeAlias

import pytest
from browser import Watched, assert_accessible, assert_no_sideways_scrolling
from play_pages import drag, middle, save, says, with_packages

from raysteps.course.manifest import Step, kit_steps
from raysteps.course.project import Project
from raysteps.course.settings import COURSE_VARIABLE
from raysteps.course.stubs import without_markers
from raysteps.play.packages import registry_of
from raysteps.play.play_page import PlayPage, PlayServer

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("play")]

Opened: TypeAlias = "Callable[..., Page]"


@pytest.fixture(scope="module")
def steps(project: Project) -> list[Step]:
    """Of both parts."""
    return kit_steps(project)


@pytest.fixture(scope="module")
def solved(project: Project, steps: list[Step]) -> dict[str, str]:
    return {step.id: without_markers((project.solutions / step.path).read_text("utf-8")) for step in steps}


@pytest.fixture(scope="module")
def server(project: Project, tmp_path_factory: pytest.TempPathFactory) -> Iterator[PlayServer]:
    """The page of a course with both parts."""
    course = tmp_path_factory.mktemp("course") / "course.toml"
    course.write_text("parts = [1, 2]\n", encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch, with_packages():
        patch.setenv(COURSE_VARIABLE, str(course))
        found = PlayServer(PlayPage(project, registry_of(None)).make())
    yield found
    found.close()


@pytest.fixture
def opened(watched: Watched, server: PlayServer) -> Opened:
    """The page at a step, when its stub was compiled."""

    def at(number: str, width: int = 1440, *, touch: bool = False) -> "Page":
        watched.allowed.append(server.address)
        page = watched.open(f"{server.address}#{number}", width=width, touch=touch)
        says(page.locator("#play-status"), r"\d+ of \d+ tests pass")
        return page

    return at


def _figure(page: "Page", name: str) -> "Locator":
    return page.locator(f"[data-figure={name}]")


def _words(page: "Page", name: str) -> "Locator":
    return _figure(page, name).locator(".live-says")


def _states(project: Project, step: Step, words: str) -> str:
    """A pattern for words that the handout states, too."""
    text = (project.steps / step.id / "README.md").read_text("utf-8")
    assert words in re.sub(r"\s+", " ", text)
    return re.escape(words)


def test_the_camera_is_the_students(
    opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]
) -> None:
    page = opened("01")
    words = _words(page, "camera")
    says(words, "It waits for view_frame and primary_ray: not written yet")
    to_come = _figure(page, "camera").get_by_text("To be drawn here")
    assert to_come.nth(1).locator("..").inner_text().endswith("From the eye: the window and the centres of its pixels.")
    tip = _figure(page, "camera").get_by_role("slider", name="Tip of the camera's up")
    assert tip.count() == 0, "nothing is there to drag"
    assert_accessible(page)
    right = solved["01-camera-rays"]
    save(page, right)
    direction = _states(project, steps[0], "(0.8018, 0.2673, -0.5345)")
    says(words, rf"half_width 2, half_height 1\. The ray through pixel \(3, 0\) has the direction {direction}")
    pixel_y = page.get_by_role("slider", name="Pixel y", exact=True)
    pixel_y.press("ArrowRight")
    says(words, r"pixel \(3, 1\) has the direction \(0\.8018, -0\.2673, -0\.5345\)")
    pixel_y.press("ArrowLeft")
    says(words, rf"pixel \(3, 0\) has the direction {direction}")
    angle = page.get_by_role("slider", name="Angle", exact=True)
    angle.fill("60")  # the window of the second question is 1.15 high
    says(words, r"half_width 1\.1547, half_height 0\.5774")
    angle.press("End")  # 130 degrees: no further
    says(words, r"half_height 2\.1445")
    assert not to_come.nth(1).is_visible()
    for _ in range(6):
        tip.press("ArrowRight")
    says(words, r"up \(0\.5, 0\.866, 0\); ")  # it leans by 30 degrees
    drag(page, tip, (400, 0))
    says(words, r"up \(0\.9\d+, 0\.\d+, 0\); ")
    page.get_by_role("slider", name="up leans by", exact=True).fill("0")
    says(words, r"up \(0, 1, 0\); ")
    page.get_by_role("slider", name="Width").fill("8")
    page.get_by_role("slider", name="Pixel x", exact=True).fill("7")
    says(words, r"pixel \(7, 0\)")
    page.get_by_role("slider", name="Width").fill("2")
    says(words, r"pixel \(1, 0\)")
    assert_accessible(page)
    _figure(page, "camera").get_by_role("button", name="Back to the start").click()
    says(words, direction)
    save(page, right.replace("glm::tan(", "2.0F * glm::tan("))
    says(words, r"half_width 4, half_height 2")


def test_code_that_hangs_or_crashes_ends_no_page(opened: Opened, solved: dict[str, str]) -> None:
    page = opened("07")
    words = _words(page, "tone")
    right = solved["07-tone-mapping"]
    begin = "Color tone_map(const Color& color) {"
    assert begin in right
    save(page, right.replace(begin, f"{begin} volatile bool on = color.r > 4.0F; while (on) {{}}"))
    says(words, r"Is there an endless loop\?")
    save(page, right.replace(begin, f"{begin} if (color.r > 4.0F) {{ __builtin_trap(); }}"))
    says(words, r"Your code crashed: unreachable")
    save(page, right.replace(begin, f"{begin} if (color.r > 4.0F) {{ throw 4; }}"))
    says(words, r"Your code gave up: something was thrown")
    save(page, f"#include <cstdlib>\n{right}".replace(begin, f"{begin} if (color.r > 4.0F) {{ std::exit(0); }}"))
    says(words, r"Your code ended the program before there was an answer")
    save(page, right)
    says(words, r"bytes \(191, 153, 51\)")


def test_a_ray_meets_the_sphere_and_the_triangle_of_the_handout(
    opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]
) -> None:
    page = opened("02")
    sphere, triangle = _words(page, "sphere"), _words(page, "triangle")
    says(sphere, "It waits for Sphere::intersect: not written yet")
    save(page, solved["02-intersection"])
    assert _states(project, steps[1], "distance = 6, position = (4, 2, 7), normal = (3, 0, 4) / 5 = (0.6, 0, 0.8)")
    says(sphere, r"a hit at the distance 6, position \(4, 2, 7\), normal \(0\.6, 0, 0\.8\), from the front")
    assert _states(project, steps[1], "t = 5, position = (1, 1, 0)")
    says(triangle, r"along \(0\.6, 0, -0\.8\): a hit at the distance 5, position \(1, 1, 0\), normal \(0, 0, 1\)")
    origin = _figure(page, "sphere").get_by_role("slider", name="Origin of the ray")
    for _ in range(20):
        origin.press("ArrowDown")  # to z = 3, where it is aimed at, and inside
    origin.press("ArrowUp")
    says(sphere, r"From \(4, 2, 3\.5\) along \(0, 0, -1\): a hit at the distance 4\.5, .* from the back")
    drag(page, origin, (200, 0))
    says(sphere, r"From \(10, 2, 3\.5\)")
    assert_accessible(page)


def test_the_tone_curve_is_dragged_by_a_finger(
    opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]
) -> None:
    page = opened("07", width=390, touch=True)
    words = _words(page, "tone")
    says(words, "It waits for tone_map and to_byte: not written yet")
    save(page, solved["07-tone-mapping"])
    worked = _states(project, steps[6], "(191, 153, 51)")
    says(words, rf"becomes \(0\.75, 0\.6, 0\.2\), bytes {worked}.* it would be \(255, 255, 64\)")
    assert _states(project, steps[6], "(255, 255, 64)")
    red = _figure(page, "tone").get_by_role("slider", name="Light, red", exact=True).first
    red.scroll_into_view_if_needed()
    x, y = middle(red)
    touch = page.context.new_cdp_session(page)
    for kind, at in (("touchStart", x), ("touchMove", x + 40), ("touchMove", 385)):
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": at, "y": y}]})
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    says(words, r"The light \(5, 1\.5, 0\.25\) becomes \(0\.8333, ")
    page.get_by_role("slider", name="Exposure").fill("0")
    says(words, r"bytes \(0, 0, 0\)")
    assert_no_sideways_scrolling(page)
    assert_accessible(page)


# From a moved slider to the drawn answer, in milliseconds, one after the other.
_ANSWER_TIMES = """async (figure) => {
    const slider = figure.querySelector("input"), text = figure.querySelector(".live-says"), times = [];
    const [low, high] = [Number(slider.min), Number(slider.max)];
    for (let at = 0; at < 10; at++) {
        const drawn = new Promise((resolve, reject) => {
            setTimeout(() => reject(new Error(`no answer to move ${at}`)), 60000);
            const watch = new MutationObserver(() => { watch.disconnect(); resolve(); });
            watch.observe(text, { childList: true });
        });
        slider.value = low + (at % 2 ? 0.25 : 0.75) * (high - low);
        const start = performance.now();
        slider.dispatchEvent(new Event("input"));
        await drawn;
        times.push(performance.now() - start);
    }
    return times.sort((a, b) => a - b);
}"""


def _assert_each_move_is_answered(page: "Page", name: str) -> None:
    """One frame of a drag after the other. How long an answer takes is shown, and no check: others may work here."""
    times = _figure(page, name).evaluate(_ANSWER_TIMES)  # fails where a move has no answer
    print(f"{name}: {times[0]:.1f} ms at best, {times[len(times) // 2]:.1f} ms in the middle")


def _assert_accessible_in_the_dark(page: "Page") -> None:
    """On a phone."""
    page.emulate_media(color_scheme="dark")
    page.set_viewport_size({"width": 390, "height": 844})
    assert_no_sideways_scrolling(page)
    assert_accessible(page)


def test_a_ray_is_bent_by_glass_until_nothing_gets_out(
    opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]
) -> None:
    page = opened("08")
    words, figure = _words(page, "glass"), _figure(page, "glass")
    says(words, "It waits for transmitted_ray: not written yet")
    save(page, solved["08-refraction"])
    refracted = _states(project, steps[7], "(0.4, 0, -0.9165)")
    says(words, rf"From air, along \(0\.6, 0, -0\.8\), .* In glass it goes on along {refracted}")
    side = figure.get_by_role("slider", name="The ray comes from")
    side.press("ArrowRight")
    says(words, r"From glass, along \(0\.6, 0, -0\.8\), .* In air it goes on along \(0\.9, 0, -0\.4359\)")
    origin = figure.get_by_role("slider", name="Origin of the ray")
    mirrored = _states(project, steps[7], "(0.8, 0, 0.6)")
    for key in 4 * ["ArrowLeft", "ArrowDown"]:
        origin.press(key)
    says(words, rf"Nothing gets into air: it is mirrored, along {mirrored}")
    heard = figure.get_by_role("status")
    says(heard, rf"Nothing gets into air: it is mirrored, along {mirrored}")
    origin.scroll_into_view_if_needed()
    x, y = middle(origin)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 60, y, steps=4)
    says(words, r"In air it goes on along")
    says(heard, rf"Nothing gets into air: it is mirrored, along {mirrored}")  # read out when the drag has ended
    page.mouse.up()
    says(heard, r"In air it goes on along")
    _assert_each_move_is_answered(page, "glass")
    assert_accessible(page)


def test_a_larger_shine_makes_the_highlight_narrower(
    opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]
) -> None:
    page = opened("03")
    words, figure = _words(page, "phong"), _figure(page, "phong")
    says(words, "It waits for mirror, diffuse, specular and shade: not written yet")
    save(page, solved["03-phong-shading"])
    diffuse = _states(project, steps[2], "diffuse = (0.48, 0.24, 0)").removeprefix("diffuse\\ =\\ ")
    mirrored = _states(project, steps[2], "r = (-0.6, 0, 0.8)").removeprefix("r\\ =\\ ")
    says(words, rf"Diffuse {diffuse}\. The light is mirrored along {mirrored}, specular \(0\.32, 0\.32, 0\.32\)")
    assert _states(project, steps[2], "(0.80, 0.56, 0.32)")
    says(words, r"The sum is \(0\.8, 0\.56, 0\.32\)")
    shine = figure.get_by_role("slider", name="shine")
    shine.press("ArrowRight")
    says(words, r"specular \(0\.256, 0\.256, 0\.256\)")  # 0.5 times 0.8 to the third
    light = figure.get_by_role("slider", name="Light", exact=True)
    drag(page, light, (2000, 0))
    says(words, r"The light is mirrored along \(-0\.7071, 0, 0\.7071\)")
    _assert_each_move_is_answered(page, "phong")
    assert_accessible(page)


def test_a_threshold_too_small_brings_acne_and_one_too_large_light(
    opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]
) -> None:
    page = opened("04")
    words, figure = _words(page, "shadow"), _figure(page, "shadow")
    says(words, "It waits for shadow_ray and is_lit: not written yet")
    save(page, solved["04-shadows"])
    start = _states(project, steps[3], "(1, 2, 0.001)")
    direction = _states(project, steps[3], "(0.6001, 0, 0.7999)")
    says(words, rf"starts at {start} along {direction}: in shadow\. .* 0 are dark and 0 lit")
    threshold = figure.get_by_role("slider", name="Threshold")
    threshold.press("Home")
    says(words, r"starts at \(1, 2, 0\) .* 1\d{3} are dark and \d+ lit .* shadow acne")
    threshold.press("End")
    says(
        words,
        r"starts at \(1, 2, 0\.1\) .* \d\d? are dark and [1-9]\d\d lit .* lower than the threshold throws no shadow",
    )
    drag(page, figure.get_by_role("slider", name="Hit", exact=True), (2000, 0))
    says(words, r": lit\. ")
    _assert_each_move_is_answered(page, "shadow")
    assert_accessible(page)


def test_the_light_between_two_mirrors_grows_with_the_limit(
    opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]
) -> None:
    page = opened("05")
    words, figure = _words(page, "mirrors"), _figure(page, "mirrors")
    says(words, "It waits for trace: not written yet")
    save(page, solved["05-reflection"])
    assert _states(project, steps[4], "depth 1: 1.75")
    says(words, r"With a limit of 3, 1\.75 arrives")
    assert _states(project, steps[4], "depth 2: 1.5")
    limit = figure.get_by_role("slider", name="Limit of the depth").first
    limit.press("ArrowLeft")
    says(words, r"With a limit of 2, 1\.5 arrives")
    drag(page, limit, (2000, 0))
    says(words, r"With a limit of 8, 1\.99\d+ arrives")
    _assert_each_move_is_answered(page, "mirrors")
    assert_accessible(page)
    _assert_accessible_in_the_dark(page)


def test_boxes_light_up_along_a_ray_that_is_dragged(
    opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]
) -> None:
    page = opened("06")
    words, figure = _words(page, "octree"), _figure(page, "octree")
    says(words, "It waits for .*build_octree.*: not written yet")
    save(page, solved["06-octree"])
    assert _states(project, steps[5], "enter = 3.33, leave = 5")
    says(words, r"along \(0\.6, 0, -0\.8\): in the box from 3\.3333 to 5\. .* \d+ tests of boxes and \d+ of balls")
    aim = figure.get_by_role("slider", name="Where the ray is aimed at")
    drag(page, aim, (0, -2000))
    says(words, r"it misses the box\. No ball is hit, after \d+ tests of boxes and 0 of balls")
    assert figure.locator(".live-area").count() == 0
    for _ in range(8):
        aim.press("ArrowDown")
    says(words, r"in the box from")
    assert figure.locator(".live-area").count() > 1
    _assert_each_move_is_answered(page, "octree")
    assert_accessible(page)


def test_each_cut_has_its_cost(opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]) -> None:
    page = opened("09", width=390)
    words, figure = _words(page, "cuts"), _figure(page, "cuts")
    says(words, "It waits for split_cost and surface_area: not written yet|It waits for surface_area and split_cost")
    save(page, solved["09-bvh"])
    assert _states(project, steps[8], "1 + 3.6 + 0.4 = 5")
    says(words, r"The area of the whole: 40\. Left 9 in a box of 16, right 1 in a box of 16: the cut costs 5\.")
    assert _states(project, steps[8], "the cost is 1 + 2 + 4.75 = 7.75")
    figure.get_by_role("slider", name="Cut at x").fill("0.55")
    says(words, r"Left 5 in a box of 16, right 5 in a box of 38: the cut costs 7\.75")
    drag(page, figure.get_by_role("slider", name="Cut", exact=True), (120, 0))
    says(words, r"Left 9 in a box of 16, right 1 in a box of 16: the cut costs 5\.")
    last = figure.get_by_role("slider", name="The last surface", exact=True)
    last.press("ArrowLeft")
    says(words, r"The area of the whole: 38\. ")
    _assert_each_move_is_answered(page, "cuts")
    assert_no_sideways_scrolling(page)
    assert_accessible(page)
    _assert_accessible_in_the_dark(page)


def test_stratified_points_leave_less_to_chance(
    opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]
) -> None:
    page = opened("10")
    words, figure = _words(page, "samples"), _figure(page, "samples")
    says(words, "It waits for stratified_samples.*: not written yet")
    says(_words(page, "filter"), "It waits for tent_filter.*: not written yet")
    save(page, solved["10-sampling"])
    assert _states(project, steps[9], "Two, always.")
    says(words, r"4 points, stratified: 2 see white, and the pixel shows 0\.5\. .* off by 0 \(")
    kind = figure.get_by_role("slider", name="Points", exact=True)
    kind.press("ArrowLeft")
    says(words, r"4 points, anywhere: .* off by 0\.[23]\d* \(")
    kind.press("End")
    figure.get_by_role("slider", name="Points along each side").press("End")
    says(words, r"64 points, Halton's: 32 see white, .* off by 0 \(")
    drag(page, figure.get_by_role("slider", name="Edge, above").first, (2000, 0))
    says(words, r"Of the pixel 0\.75 is white")
    weighed = _words(page, "filter")
    assert _states(project, steps[9], "(0.375 · 0.9 + 0.75 · 0.3) / (0.375 + 0.75) = 0.5625 / 1.125 = 0.5")
    says(weighed, r"Weights 0\.375 and 0\.75\. The mean is 0\.5, and the screen is sent 0\.735")
    _figure(page, "filter").get_by_role("slider", name="Filter").press("ArrowRight")
    _figure(page, "filter").get_by_role("slider", name="Second sample").last.fill("0")
    says(weighed, r"and 0\.8889\. ")  # Mitchell's, in the middle
    _assert_each_move_is_answered(page, "filter")
    assert_accessible(page)
    _assert_accessible_in_the_dark(page)


def test_a_point_of_a_mesh_is_lifted_and_a_pixel_has_its_level(
    opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]
) -> None:
    page = opened("11")
    words, level = _words(page, "mesh"), _words(page, "level")
    says(words, "It waits for barycentric.*: not written yet")
    says(level, "It waits for build_pyramid.*: not written yet")
    save(page, solved["11-meshes"])
    weights = _states(project, steps[10], "(0, 0.5, 0.5)")
    assert _states(project, steps[10], "(0.331, 0.331, 0.884)")
    lifted = _states(project, steps[10], "(2.36, 2.36, 0.96)")
    says(words, rf"Weights {weights}, normal \(0\.3313, 0\.3313, 0\.8835\)\. Lifted: {lifted}")
    point = _figure(page, "mesh").get_by_role("slider", name="Point", exact=True)
    drag(page, point, (-2000, 2000))
    says(words, r"Weights \(1, 0, 0\), normal \(0, 0, 1\)\. Lifted: \(0, 0, 0\)")
    drag(page, point, (2000, -100))  # no farther than to the long edge
    says(words, r"Weights \(0, ")
    assert _states(project, steps[10], "It covers 16 · 0.25 = 4 texels.")
    says(level, r"The pixel covers 4 texels: level 2 of 0 to 6\. The picture takes your level")
    drag(page, _figure(page, "level").get_by_role("slider", name="Distance of the hit").first, (2000, 0))
    says(level, r"covers 20 texels: level 4\.3219 ")
    _figure(page, "level").get_by_role("slider", name="The picture takes the level").press("Home")
    says(level, r"a level 6 finer than yours: the squares break up into noise")
    _assert_each_move_is_answered(page, "level")
    assert_accessible(page)
    _assert_accessible_in_the_dark(page)


def test_a_lamp_is_sampled_from_a_place_that_is_dragged(
    opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]
) -> None:
    page = opened("12")
    words, figure = _words(page, "lamp"), _figure(page, "lamp")
    says(words, "It waits for solid_angle_pdf.*: not written yet")
    says(_words(page, "lens"), "It waits for lens_ray: not written yet")
    begin = "Color sampled_light(const HitRecord& hit, const Color& radiance, const LightSample& sample) {"
    stub = f'{begin} RAYSTEPS_TODO("12-soft-light", "sampled_light"); return k_black;'
    assert begin in solved["12-soft-light"]
    save(page, '#include "core/unfinished.hpp"\n' + solved["12-soft-light"].replace(begin, stub))
    says(words, r"The numbers wait for sampled_light: not written yet\.")
    assert figure.get_by_role("slider", name="Lit place").is_visible(), "what is drawn can be dragged"
    save(page, solved["12-soft-light"])
    assert _states(project, steps[11], "1.273 · 25 / 0.8 = 39.79")
    assert _states(project, steps[11], "20 · 1 / π · 0.8 / 39.79 = 0.128")
    says(words, r"the density 39\.7887 by solid angle; .* middle brings 0\.128\. .* 100 .* 0\.12\d*\. [45]\d of")
    figure.get_by_role("slider", name="Turned by").fill("180")
    says(words, r"density 0 by solid angle; .* brings 0\. .* is 0, with 100 that bring nothing")
    figure.get_by_role("slider", name="Lamp", exact=True).last.press("End")
    says(words, r"Each point that is seen has the density 31\.751\d ")  # 1 / (2 pi (1 - cos)), sin = 0.1
    drag(page, figure.get_by_role("slider", name="Lit place"), (2000, 0))
    says(words, r"density 25\.385 ")
    lens = _words(page, "lens")
    direction = _states(project, steps[11], "(0.6, 0, -0.8)")
    sharp = _states(project, steps[11], "(3, 0, -4)")
    says(lens, rf"direction {direction}\. .* all rays meet at {sharp}\. On the wall, 7 away, .*: blurred")
    _figure(page, "lens").get_by_role("slider", name="Wall at").fill("4")
    says(lens, r"On the wall, 4 away, they are up to 0 from \(3, 0, -4\): sharp")
    _assert_each_move_is_answered(page, "lamp")
    assert_accessible(page)
    _assert_accessible_in_the_dark(page)
    save(page, solved["12-soft-light"].replace("std::sqrt(u.x)", "u.x"))  # too many in the middle
    _figure(page, "lamp").get_by_role("button", name="Back to the start").click()
    says(words, r"density 39\.7887 .* [23]\d of them lie in the outer half of it, evenly spread it is 50")


def test_directions_follow_the_normal_and_paths_end_by_chance(
    opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]
) -> None:
    page = opened("13")
    words, figure = _words(page, "cosine"), _figure(page, "cosine")
    says(words, "It waits for cosine_direction.*: not written yet")
    says(_words(page, "roulette"), "It waits for path_light.*: not written yet")
    save(page, solved["13-path-tracing"])
    assert _states(project, steps[12], "0.8 / pi = 0.2546")
    weight = _states(project, steps[12], "(0.72, 0.4, 0.08)")
    says(words, rf"u = \(0\.36, 0\.25\) .* rises by 0\.8 along the normal\. .* 0\.2546, and the weight {weight}\.")
    says(words, r"Of all 200, (9|10)\d lie in the outer half of the circle, evenly spread it is 100\.")
    drag(page, figure.get_by_role("slider", name="Tip of the normal"), (0, 2000))
    says(figure.locator("output").first, "180°")
    says(words, r"rises by 0\.8 along the normal")
    figure.get_by_role("slider", name="u", exact=True).press("ArrowDown")
    says(words, r"u = \(0\.36, 0\.2\) ")
    paths = _words(page, "roulette")
    says(paths, r"0\.8 goes on with a probability of 0\.8\. The mean .* is [45]\.\d+, .* average is 5\. They meet 4 ")
    share = _figure(page, "roulette").get_by_role("slider", name="Share that is sent on").last
    share.press("End")
    says(paths, r"0\.95 goes on with a probability of 0\.95\. .* right on average is 20\. They meet 4 ")
    share.press("Home")
    says(paths, r"The mean of 500 paths is 1, right on average is 1\.")
    _assert_each_move_is_answered(page, "cosine")
    assert_accessible(page)
    _assert_accessible_in_the_dark(page)


def test_rough_metal_answers_for_an_eye_that_is_dragged(
    opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]
) -> None:
    page = opened("14")
    fresnel, words = _words(page, "fresnel"), _words(page, "metal")
    says(fresnel, "It waits for fresnel_dielectric and fresnel_schlick: not written yet")
    says(words, "It waits for ggx_distribution.*: not written yet")
    save(page, solved["14-materials"])
    rims = "Glass mirrors 4 % of the light that comes straight on, and all of what comes along its surface."
    assert _states(project, steps[13], rims)
    says(fresnel, r"At 0° glass mirrors 0\.04 of .* outside, and 0\.04 of .* inside\. Metal mirrors 0\.6\.")
    angle = _figure(page, "fresnel").get_by_role("slider", name="Angle", exact=True)
    for _ in range(9):
        angle.press("ArrowRight")
    says(fresnel, r"At 45° glass mirrors 0\.0502 of .* and 1 of that from inside: none gets out\.")
    drag(page, angle, (2000, 0))
    says(fresnel, r"At 90° glass mirrors 1 of .* Metal mirrors 1\.")
    assert _states(project, steps[13], "D = 0.25 / (pi · 0.0625) = 1.2732")
    assert _states(project, steps[13], "f = 1.2732 / (4 · 1.0680 · 0.8 · 0.8) = 0.4657")
    assert _states(project, steps[13], "1.2314 / (4 · 0.8) = 0.3848")
    says(words, r"is \(0, 0, 1\): D = 1\.2732, its density 1\.2314\. Λ .* is 0\.034\. f = 0\.4657, .* 0\.3848\.")
    figure = _figure(page, "metal")
    figure.get_by_role("slider", name="Roughness alpha").press("Home")
    says(words, r"D = 127\.\d+, .* (All|149) of 150 paths go on")
    figure.get_by_role("slider", name="Roughness alpha").press("End")
    figure.get_by_role("slider", name="Eye", exact=True).press("ArrowLeft")
    says(words, r"D = 0\.3183, .* 89 of 150 paths go on, the others lead below")
    _assert_each_move_is_answered(page, "metal")
    assert_accessible(page)
    _assert_accessible_in_the_dark(page)


def test_two_ways_to_a_lamp_share_its_light(
    opened: Opened, project: Project, steps: list[Step], solved: dict[str, str]
) -> None:
    page = opened("15")
    words, ways = _words(page, "weights"), _words(page, "ways")
    says(words, "It waits for balance_heuristic and power_heuristic: not written yet")
    says(ways, "It waits for sphere_pdf.*: not written yet")
    save(page, solved["15-mis"])
    says(page.locator("#play-status"), "Step 15 is right")  # its picture, too, of a scene in pbrt's format
    assert _states(project, steps[14], "3² / (3² + 1²) = 0.9")
    says(words, r"density 3, by the other way with 1: the weight is 0\.75 by the balance heuristic, 0\.9 by the power")
    own = _figure(page, "weights").get_by_role("slider", name="Its own density").first
    drag(page, own, (-2000, 0))
    says(words, r"density 0, .* the weight is 0 by the balance heuristic, 0 by the power")
    assert _states(project, steps[14], "1 / 1.2566 = 0.7958")
    says(ways, r"A sample of the lamp has the density 0\.7958\. ")
    _figure(page, "ways").get_by_role("slider", name="Radius of the lamp").press("Home")
    says(ways, r"has the density 127\.\d+\. .* counts 0\.99\d*, and a path that meets it 0\.\d+\.$|counts 1, ")
    _assert_each_move_is_answered(page, "ways")
    assert_accessible(page)
    _assert_accessible_in_the_dark(page)
