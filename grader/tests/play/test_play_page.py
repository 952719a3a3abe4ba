"""The page to work in, in a real browser: write, compile, test, draw, stop."""

import os
import re
import signal
import subprocess
import sys
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.error import HTTPError
from urllib.request import urlopen

import pytest
from browser import Watched, assert_accessible, assert_large_enough, assert_no_sideways_scrolling
from play_pages import POINT, STARTED, save, source_of, status_says, write

from raysteps.cli.render import build_program
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.grading.build_messages import barred_message, missing_message, undefined_message
from raysteps.play.play_page import PlayServer, publish
from raysteps.report.wording import inspect_options
from raysteps.results.statuses import NOT_BUILT
from raysteps.submission.load import load_submission
from raysteps.toolchain.cmake import release_tree

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("play")]


@pytest.mark.skipif(sys.platform == "win32", reason="interrupts are another matter there")
def test_the_command_serves_the_page_until_it_is_ended(site: Path) -> None:
    words = [sys.executable, "-P", "-m", "raysteps", "play", "--no-open", "--port", "0"]
    hear = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)  # also where the tests run in the background
    program = subprocess.Popen(words, stdout=subprocess.PIPE, text=True, preexec_fn=hear)
    assert program.stdout is not None
    try:
        address = next(line for line in program.stdout if line.startswith("Page: ")).split()[1]
        with urlopen(address) as answer:
            assert answer.read() == (site / "index.html").read_bytes()
        with pytest.raises(HTTPError, match="404"):
            urlopen(f"{address}../../index.html")
        os.kill(program.pid, signal.SIGINT)
        program.communicate(timeout=60)
        assert program.returncode == 0
    finally:
        program.kill()


def test_the_right_lines_give_the_picture_and_stay(
    watched: Watched, page: "Page", solved: dict[str, str], steps: list[Step], tmp_path: Path
) -> None:
    from playwright.sync_api import expect

    right = solved["01-camera-rays"]
    save(page, right)
    status_says(page, r"Step 01 is right: 12 of 12 tests pass, 2 of 2 pictures are right\.")
    expect(page.locator("#play-first h3")).to_contain_text("✓ right")
    expect(page.locator("#play-first compare-pictures")).to_have_attribute("data-state", "ready")
    assert_accessible(page)
    page.reload()
    status_says(page, r"Step 01 is right", timeout=STARTED)
    assert POINT in source_of(page)
    with page.expect_download() as download:
        page.get_by_role("button", name="Save as zip").click()
    download.value.save_as(tmp_path / "my-steps.zip")
    handed_in = load_submission(tmp_path / "my-steps.zip", steps)
    assert handed_in.sources == {"01-camera-rays": right.encode()}


def test_a_mistake_is_told_as_the_grader_tells_it(page: "Page", solved: dict[str, str]) -> None:
    from playwright.sync_api import expect

    save(page, solved["01-camera-rays"].replace(POINT, "return ray.origin + ray.direction;"))
    status_says(page, r"11 of 12 tests pass, 2 of 2 pictures are right\.")
    failed = page.locator("#play-tests .panel")
    expect(failed).to_have_count(1)
    expect(failed).to_contain_text("point_at walks along the ray")
    expect(failed.locator("dd").first).to_have_text("point_at(ray, 0) = (1, 2, 3) within 0.00037")
    expect(failed).to_contain_text("expected: origin + distance * direction")
    failed.get_by_role("link", name="camera_rays_test.cpp:").click()
    test = page.get_by_role("dialog", name="steps/01-camera-rays/camera_rays_test.cpp")
    expect(test.locator("mark")).to_contain_text("point_at(ray")
    expect(test.locator("mark")).to_be_in_viewport()
    assert_accessible(page)
    test.get_by_role("button", name="Close").click()
    page.locator("#play-handout").get_by_role("link", name="framework/core/camera.hpp").click()
    header = page.get_by_role("dialog", name="framework/core/camera.hpp")
    expect(header).to_contain_text("struct ViewFrame {")
    page.keyboard.press("Escape")
    page.locator("#play-texts").get_by_role("link", name="camera_rays.hpp").click()
    expect(page.get_by_role("dialog")).to_contain_text("glm::vec3 point_at(const Ray& ray, float distance);")


def test_an_error_stands_at_its_line(page: "Page", solved: dict[str, str]) -> None:
    from playwright.sync_api import expect

    wrong = solved["01-camera-rays"].replace(POINT, "return ray.orgin;") + "auto twice(glm::vec3 v) { return 2 * v; }\n"
    line = next(at for at, text in enumerate(wrong.splitlines(), start=1) if "orgin" in text)
    expect(page.locator("#play-stale")).to_be_hidden()
    save(page, wrong)
    status_says(page, r"It does not compile\.")
    expect(page.locator("#play-stale")).to_be_visible()
    expect(page.locator("#play-problems")).to_contain_text("no member named 'orgin' in 'raysteps::Ray'")
    expect(page.locator("#play-problems strong", has_text="write 2.0F, not 2 or 2.0")).to_have_count(1)
    expect(page.locator(".cm-lintRange-error").first).to_have_text("orgin")
    page.locator("#play-problems button").first.click()
    expect(page.locator(".cm-activeLine")).to_have_text("    return ray.orgin;")
    expect(page.locator("#play-problems button").first).to_have_text(f"camera_rays.cpp:{line}")


def test_what_the_linker_misses_is_told_as_the_native_kit_tells_it(page: "Page", solved: dict[str, str]) -> None:
    from playwright.sync_api import expect

    right = solved["01-camera-rays"]
    problems = page.locator("#play-problems")
    save(page, right.replace("glm::vec3 point_at(", "glm::vec3 point_on("))
    point = "point_at(const Ray&, float)"
    expect(problems).to_have_text(missing_message((point,)), timeout=STARTED)
    status_says(page, r"It does not compile\.")
    save(page, right[: right.index("namespace")])
    expect(problems).to_contain_text(missing_message((point, ""))[-40:], timeout=STARTED)
    expect(problems).to_contain_text(" and ")
    helper = "float far(float);\n"
    declared = right.replace("namespace raysteps {", f"namespace raysteps {{ {helper}", 1)
    save(page, declared.replace(POINT, "return far(distance) * ray.direction;"))
    expect(problems).to_have_text(undefined_message(("far(float)",)), timeout=STARTED)


def test_what_the_manifest_bars_is_refused_as_the_grader_refuses_it(
    page: "Page", solved: dict[str, str], steps: list[Step]
) -> None:
    """Also where a name is put together: the object tells what the step calls."""
    from playwright.sync_api import expect

    step = steps[8]
    own = "std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {"
    theirs = "if (bvh.nodes.size() == 1) { return JOIN(closest_hit_, in_octree)(Node{}, ray); }"
    right = '#include "steps/06-octree/octree.hpp"\n' + solved[step.id]
    page.evaluate("location.hash = '#09'")
    expect(page.locator("#play-file")).to_have_text(f"steps/{step.path.as_posix()}")
    save(page, right.replace(own, f"#define JOIN(a, b) a##b\n{own} {theirs}"))
    status_says(page, r"It does not compile\.", timeout=STARTED)
    message = barred_message(step, "06-octree", ["closest_hit_in_octree"]).removeprefix(NOT_BUILT)
    expect(page.locator("#play-problems")).to_contain_text(message, timeout=STARTED)
    save(page, right)
    status_says(page, r"Step 09 is right", timeout=STARTED)


def test_an_endless_loop_stops_by_hand_and_by_itself(page: "Page", solved: dict[str, str]) -> None:
    from playwright.sync_api import expect

    loop = "volatile bool on = true; while (on) {} "
    save(page, solved["01-camera-rays"].replace(POINT, loop + POINT))
    status_says(page, r"Testing and drawing")
    page.get_by_role("button", name="Stop").click()
    status_says(page, r"Stopped\.")
    page.get_by_role("button", name="Run").click()
    status_says(page, r"11 of 12 tests pass, 2 of 2 pictures are right\.")
    expect(page.locator("#play-tests .panel")).to_contain_text("Is there an endless loop?")
    save(page, solved["01-camera-rays"])
    status_says(page, r"Step 01 is right")


def test_headers_are_those_that_the_source_includes(page: "Page", solved: dict[str, str]) -> None:
    """More than the stub has are compiled on top of its own; one of these that was taken away is missed."""
    from playwright.sync_api import expect

    right, own = solved["01-camera-rays"], "#include <glm/trigonometric.hpp>\n"
    assert own in right
    save(page, right.replace(own, f"{own}#include <array>\n") + "const std::array<int, 1> mine{};\n")
    status_says(page, r"Step 01 is right")
    save(page, right.replace(own, ""))
    status_says(page, r"It does not compile")
    expect(page.locator("#play-problems")).to_contain_text(
        "no member named 'radians' in namespace 'glm'", timeout=STARTED
    )
    save(page, right.replace(own, f"{own}#include <no/such.hpp>\n"))
    expect(page.locator("#play-problems")).to_contain_text("'no/such.hpp' file not found", timeout=STARTED)


_HEAR_STATUS = """() => {
    const status = document.getElementById("play-status");
    const heard = window.heard = [];
    new MutationObserver(() => heard.push(status.textContent)).observe(status, { childList: true });
}"""


def test_what_is_included_is_compiled_before_it_is_saved(page: "Page", solved: dict[str, str]) -> None:
    from playwright.sync_api import expect

    page.evaluate(_HEAR_STATUS)
    write(page, f"#include <array>\n{solved['01-camera-rays']}const std::array<int, 1> mine{{}};\n")
    expect(page.locator("#play-kept")).to_have_text("Kept in this browser.")
    page.keyboard.press("ControlOrMeta+s")
    status_says(page, r"Step 01 is right")
    heard = page.evaluate("window.heard")
    assert "Compiling ..." in heard
    assert not [words for words in heard if "Compiling what you include" in words]


def test_what_throws_and_what_crashes_is_told(page: "Page", solved: dict[str, str]) -> None:
    from playwright.sync_api import expect

    throws = "#include <stdexcept>\n" + solved["01-camera-rays"].replace(POINT, 'throw std::runtime_error("oh no");')
    save(page, throws)
    status_says(page, r"11 of 12 tests pass")
    expect(page.locator("#play-tests .panel")).to_contain_text("threw: oh no")
    deep = "return distance > 1e9F ? ray.origin : point_at(ray, distance + 1.0F) + ray.origin;"
    save(page, solved["01-camera-rays"].replace(POINT, deep))
    status_says(page, r"11 of 12 tests pass")
    expect(page.locator("#play-tests .panel")).to_contain_text("the program crashed (")
    expect(page.locator("#play-tests .panel")).to_contain_text("a recursion without an end).")
    told = f'std::puts("at 42"); std::fputs("at 43", stderr); {POINT}'
    save(page, throws.replace('throw std::runtime_error("oh no");', told))
    status_says(page, r"Step 01 is right", timeout=STARTED)
    page.get_by_text("What the programs print").click()
    expect(page.locator("#play-console")).to_have_text(re.compile(r"at 42\s+at 43"))


def test_a_start_that_failed_is_tried_again(watched: Watched, server: PlayServer) -> None:
    watched.allowed.append(server.address)
    page = watched.open("about:blank")
    page.route("**/clang.wasm.gz", lambda route: route.abort())
    page.goto(server.address)
    status_says(page, r"the compiler cannot be loaded: .* Press Run to try again")
    page.unroute("**/clang.wasm.gz")
    page.get_by_role("button", name="Run").click()
    status_says(page, r"0 of 12 tests pass, 0 of 2 pictures are right\.", timeout=STARTED)


def test_any_web_space_will_do(watched: Watched, site: Path, tmp_path: Path, solved: dict[str, str]) -> None:
    """A plain server of files, which knows nothing of the page; and the page lies below a path. Then without it."""
    publish(site, tmp_path / "of a course" / "play")

    class Plain(SimpleHTTPRequestHandler):
        def log_message(self, format: str, *args: object) -> None:  # noqa: A002  (the name that it has)
            """Says nothing."""

        def end_headers(self) -> None:
            """Some servers tell of a packed file that it is packed."""
            if self.path.endswith("system.tar.gz"):
                self.send_header("Content-Encoding", "gzip")
            super().end_headers()

    with ThreadingHTTPServer(("127.0.0.1", 0), partial(Plain, directory=tmp_path)) as server:
        threading.Thread(target=server.serve_forever, args=(0.1,), daemon=True).start()
        address = f"http://127.0.0.1:{server.server_address[1]}"
        folder = f"{address}/of%20a%20course/play/"
        watched.allowed += [folder, f"blob:{address}"]
        page = watched.open(folder)
        status_says(page, r"0 of 12 tests pass", timeout=STARTED)
        save(page, solved["01-camera-rays"])
        status_says(page, r"Step 01 is right")
        server.shutdown()
    page.reload()  # without a network
    status_says(page, r"Step 01 is right", timeout=STARTED)
    assert POINT in source_of(page)


def test_a_step_that_cannot_be_loaded_can_be_chosen_again(watched: Watched, page: "Page") -> None:
    from playwright.sync_api import expect

    watched.expected = "net::ERR_FAILED"
    write(page, "// of step 01\n")
    page.route("**/steps/02.html", lambda route: route.abort())
    page.locator("#play-step").select_option("02")
    status_says(page, r"Step 02 cannot be loaded\. Is there a network")
    expect(page.locator("#play-step")).to_have_value("01")
    expect(page.locator(".cm-content")).to_contain_text("// of step 01")
    page.unroute("**/steps/02.html")
    page.locator("#play-step").select_option("02")
    status_says(page, r"Step 02: 0 of 17 tests pass", timeout=STARTED)
    expect(page.locator("#play-file")).to_contain_text("02-intersection")
    expect(page.locator("#play-kept")).to_be_empty()


# A mistake in each step: what is written instead of what, the test that says so, and what it expected.
_MISTAKES = {
    2: ("nearer > 0.0F ? nearer : ", "", "Sphere: head-on the nearer of the two points", "distance"),
    3: ("fill.kd * cosine", "cosine", "diffuse: kd times colours times cosine", "= (0.4, 0.4, 0.32) within 0.0001"),
    4: (" + k_shadow_threshold * hit.normal", "", "shadow_ray: starts just off the surface", "> 0.0"),
    5: ("depth > tracer", "depth >= tracer", "trace: the deepest ray is still followed but not the next one", "1"),
    6: ("1.0F / ray.direction", "ray.direction", "Box::clip: slanted hit and miss", "part.has_value() = true"),
    7: ("c / (c + 1.0F)", "c / 2.0F", "tone_map: c / (c + 1) at known values", "0.5"),
}


@pytest.mark.parametrize("number", _MISTAKES)
def test_every_step_can_be_done(page: "Page", steps: list[Step], solved: dict[str, str], number: int) -> None:
    from playwright.sync_api import expect

    step = steps[number - 1]
    page.locator("#play-step").select_option(step.number)
    status_says(
        page,
        rf"Step {step.number}: 0 of \d+ tests pass, 0 of {len(step.images)} pictures are right\.",
        timeout=STARTED,
    )
    right, wrong, test, expected = _MISTAKES[number]
    assert right in solved[step.id]
    save(page, solved[step.id].replace(right, wrong))
    panel = page.locator("#play-tests .panel").filter(has_text=test)
    expect(panel.locator("dd").first).to_contain_text(expected, timeout=STARTED)
    save(page, solved[step.id])
    status_says(page, rf"Step {step.number} is right", timeout=STARTED)
    expect(panel).to_have_count(0)


def test_a_pixel_is_followed_to_its_end(
    page: "Page", steps: list[Step], solved: dict[str, str], project: Project
) -> None:
    from playwright.sync_api import expect

    step = steps[5]
    page.locator("#play-step").select_option(step.number)
    status_says(page, rf"Step {step.number}: 0 of \d+ tests pass", timeout=STARTED)
    save(page, solved[step.id])
    status_says(page, rf"Step {step.number} is right", timeout=STARTED)
    picture = page.locator("#play-first .play-picture")
    stage = picture.locator(".compare-stage").bounding_box()
    assert stage is not None
    page.mouse.click(stage["x"] + 0.4 * stage["width"], stage["y"] + 0.55 * stage["height"])
    button = picture.get_by_role("button", name="Look inside pixel")
    x, y = re.findall(r"\d+", button.inner_text())
    button.click()
    dialog = page.get_by_role("dialog", name=f"Inside pixel ({x}, {y}) of {step.images[0].name}")
    rays = dialog.locator(".ray-title")
    expect(rays.first).to_have_text("eye ray", timeout=STARTED)

    case = step.images[0]
    program = build_program(release_tree(project), "inspect", "reference")
    words = [program, project.root / case.scene, x, y, *inspect_options(case.args)]
    native = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    lines = [" ".join(line.split()) for line in native.splitlines() if line.strip()]
    shown = dialog.locator("summary, .inside-line, div.ray, .boxes li")
    found = [" ".join(text.removesuffix(_SHOW).split()) for text in shown.evaluate_all(_TEXTS)]
    texts = ["\n".join(one[1:]) for one in (found, lines)]  # the first line says where the scene lies
    words_here, words_there = (re.sub(_NUMBER, "#", text) for text in texts)
    assert words_here == words_there, "what the native program prints"
    here, there = ([float(number) for number in re.findall(_NUMBER, text)] for text in texts)
    assert here == pytest.approx(there, rel=1e-3, abs=1e-4)  # mirrors amplify how a sine is rounded
    assert rays.count() == len([line for line in lines if re.match(r".* ray\b.* from ", line)])

    boxes = dialog.locator(".boxes").first
    boxes.locator("summary").click()
    box = boxes.locator("li[data-box]").last
    box.click()
    expect(dialog.locator("[data-part=box]")).to_have_text(
        re.compile(rf"Box {box.get_attribute('data-box')} of \d+, .*: entered\.")
    )
    dialog.get_by_role("button", name="Show the reflected ray, depth 2").click()
    expect(dialog.locator("[data-part=ray]")).to_have_text("reflected ray, depth 2")
    assert_accessible(page)
    page.emulate_media(color_scheme="dark")
    page.set_viewport_size({"width": 320, "height": 568})
    assert_no_sideways_scrolling(page)
    assert_accessible(page)
    assert_large_enough(page)
    dialog.evaluate("dialog => dialog.scrollTo(0, dialog.scrollHeight)")
    expect(dialog.get_by_role("button", name="Close")).to_be_in_viewport(ratio=1)
    page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    expect(button).to_be_focused()
    rooms = "one => [one.clientWidth, one.querySelector('compare-pictures').clientWidth]"
    whole, comparison = picture.evaluate(rooms)
    assert comparison == whole, "below its title, not beside what stands at its right"

    save(page, "int broken")
    status_says(page, r"It does not compile\.", timeout=STARTED)
    expect(button).to_be_disabled()


_NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]\d+)?"
_SHOW = " Show the shadow ray on the stage"
_TEXTS = "found => found.map(element => element.textContent)"
