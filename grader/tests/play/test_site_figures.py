"""Live figures on the site: opened as files, they say the numbers of the handouts, by the kit's own functions."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from browser import OpenPage, assert_accessible, assert_no_sideways_scrolling
from play_pages import drag, says, with_packages

from raysteps.cli.app import main
from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step, kit_steps
from raysteps.course.project import Project
from raysteps.play.packages import registry_of
from raysteps.release.leaks import unexpected_content
from tools.website import command
from tools.website.live_figures import check_live, in_one_script, make_live_figures

pytestmark = [pytest.mark.xdist_group("play")]
_DRAWN = ".live[data-state=drawn]"
_IS_ABOVE_ALL = """handle => {
    const { x, y, width, height } = handle.getBoundingClientRect();
    return handle.contains(document.elementFromPoint(x + width / 2, y + height / 2));
}"""


def test_a_module_and_what_it_imports_become_one_script() -> None:
    texts = {
        "a.js": 'import { two, Three } from "./b-c.js";\nimport { one } from "./d.js";\nsay(two, new Three(one));\n',
        "b-c.js": 'import { one } from "./d.js";\nexport const two = one + 1;\nexport class Three {}\n',
        "d.js": "export const one = 1;\n",
    }
    made = in_one_script("a.js", texts.__getitem__)
    assert re.findall(r"const (of_\w+) = \(", made) == ["of_d", "of_b_c", "of_a"]
    assert "const { two, Three } = of_b_c;\nconst { one } = of_d;\nsay(" in made
    assert "return { two, Three };" in made
    assert not re.search(r"\b(?:import|export)\b", made)
    with pytest.raises(ValueError, match=r"a\.js: expected imports and exports by their names alone"):
        in_one_script("a.js", {"a.js": 'import "./b.js";\n'}.__getitem__)


def test_a_students_kit_has_none(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="the reference's functions, which this kit does not have"):
        check_live(Project(tmp_path))


def test_what_they_lack_is_said_before_anything_is_made(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def refuse(*_: object) -> None:
        raise UsageError("no network")

    monkeypatch.setattr(command, "make_live_figures", refuse)
    monkeypatch.setattr(command, "command_page", lambda *_: pytest.fail("pages were made before"))
    assert main(["docs", "--live", "--out", str(tmp_path / "out")]) == 2
    assert "no network" in "".join(capsys.readouterr())
    assert list(tmp_path.iterdir()) == []


@pytest.fixture(scope="module")
def handout(project: Project, tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Its page, by the number of its step."""
    out = tmp_path_factory.mktemp("site") / "out"
    with with_packages():
        make_live_figures(project, registry_of(None), lambda text: None)  # which the command then finds made
    assert main(["docs", "--live", "--out", str(out)]) == 0
    steps: dict[str, Step] = {step.number: step for step in kit_steps(project)}
    return lambda number: out / "steps" / steps[number].id / "README.html"


def _stated(project: Project, number: str, words: str) -> str:
    """A pattern for words that the handout states, too."""
    (text,) = project.steps.glob(f"{number}-*/README.md")
    assert words in re.sub(r"\s+", " ", text.read_text("utf-8"))
    return re.escape(words)


@pytest.mark.slow
def test_a_dragged_figure_says_what_the_handout_says(
    handout: Callable[[str], Path], project: Project, open_page: OpenPage
) -> None:
    page = open_page(handout("01"))
    words = page.locator("[data-figure=camera] .live-says")
    says(words, "It is being made ready")  # far below what is seen
    words.scroll_into_view_if_needed()
    direction = _stated(project, "01", "(0.8018, 0.2673, -0.5345)")
    says(words, rf"half_width 2, half_height 1\. The ray through pixel \(3, 0\) has the direction {direction}")
    assert page.locator(".live h3").all_inner_texts() == ["The kit's camera"]
    page.get_by_role("slider", name="Pixel y", exact=True).press("ArrowRight")
    says(words, r"pixel \(3, 1\) has the direction \(0\.8018, -0\.2673, -0\.5345\)")
    tip = page.locator("[data-figure=camera]").get_by_role("slider", name="Tip of the camera's up")
    drag(page, tip, (400, 0))
    says(words, r"up \(0\.9\d+, 0\.\d+, 0\); ")
    page.get_by_role("button", name="Back to the start").click()
    says(words, rf"pixel \(3, 0\) has the direction {direction}")


@pytest.mark.slow
def test_each_handout_has_its_figures(handout: Callable[[str], Path], project: Project, open_page: OpenPage) -> None:
    for step in kit_steps(project):
        page = open_page(handout(step.number))
        page.locator(".live").first.scroll_into_view_if_needed()
        for figure in page.locator(".live").all():
            figure.scroll_into_view_if_needed()
            figure.and_(page.locator(_DRAWN)).wait_for()
        assert not page.locator(".live").filter(has_text=re.compile(r"\byours?\b", re.IGNORECASE)).all()
        above = page.locator("section:has(> h2:text-matches('^A worked example')) > .live")
        assert above.count() == page.locator(".live").count() > 0


@pytest.mark.slow
def test_a_release_may_not_hold_their_program(handout: Callable[[str], Path]) -> None:
    program = handout("01").parents[2] / "_static" / "live-program.js"
    assert "something compiled" in (unexpected_content(program.read_bytes()) or "")


@pytest.mark.slow
@pytest.mark.parametrize(("number", "width", "scheme"), [("06", 1440, "light"), ("02", 390, "dark")])
def test_everybody_can_use_them(
    handout: Callable[[str], Path], open_page: OpenPage, number: str, width: int, scheme: str
) -> None:
    page = open_page(handout(number), width=width, scheme=scheme, touch=width < 500)
    page.locator(".live").first.scroll_into_view_if_needed()
    page.locator(_DRAWN).first.wait_for()
    assert_accessible(page)
    assert_no_sideways_scrolling(page)
    words = page.locator(".live .live-says").first
    before = words.inner_text()
    page.locator(".live svg").first.evaluate("one => one.scrollIntoView({ behavior: 'instant' })")
    assert page.locator(".live-handle").first.evaluate(_IS_ABOVE_ALL)
    page.locator(".live-handle").first.press("ArrowRight")
    page.wait_for_function("before => document.querySelector('.live-says').textContent !== before", arg=before)
    page.emulate_media(media="print")
    assert not page.locator(".live").first.is_visible()
    assert page.locator("article img").first.is_visible()
