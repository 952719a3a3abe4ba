"""report.html: what it says, what it keeps to itself, and that it is safe to open."""

import io
import json
import re
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest
from browser import (
    OpenPage,
    Watched,
    assert_accessible,
    assert_fits_all_screens,
    assert_no_sideways_scrolling,
    broken_words,
)
from page_results import NASTY, document_of, idle_step, of_older_kit, passed_step, wrong_step
from rich.console import Console

from raysteps.cli import app as cli
from raysteps.course.manifest import Step
from raysteps.grading.withhold import withhold
from raysteps.images.compare import write_png
from raysteps.report.attempts import OwnProgress, note_attempt, read_attempts
from raysteps.report.student import parts_of, rest_of, student_page, try_student_page, write_student_page
from raysteps.report.terminal import print_details
from raysteps.report.wording import total_words
from raysteps.results.model import Diagnosis, Feedback, HiddenResult, Results, TestResult
from raysteps.results.store import write_results


def _mixed(steps: list[Step], folder: Path, name: str = "ann") -> Results:
    """Two steps right, step 03 and the bonus 08 wrong, the others not started."""
    known = {step.number: step for step in steps}
    results = [passed_step(known[number], folder) for number in ("01", "02")]
    results.append(wrong_step(known["03"], folder))
    results += [idle_step(known[number]) for number in ("04", "05", "06", "07")]
    results += [wrong_step(known["08"], folder), idle_step(known["09"])]
    return document_of(results, name)


@pytest.mark.parametrize(("width", "scheme"), [(360, "light"), (1440, "dark")])
def test_it_is_clean_and_what_students_wrote_stays_text(
    open_page: OpenPage, steps: list[Step], tmp_path: Path, width: int, scheme: str
) -> None:
    document = _mixed(steps, tmp_path, NASTY)
    page = open_page(write_student_page(document, tmp_path, steps), width=width, scheme=scheme)
    assert page.inner_text("h1") == NASTY
    page.get_by_role("button", name="Unfold all").click()
    page.evaluate("document.querySelectorAll('details').forEach(details => { details.open = true; })")
    said = page.locator("#step-03").inner_text()
    for text in (
        f"a test {NASTY}",
        f"said {NASTY}",
        f"a == {NASTY}",
        f"direction (1, 0, 0) {NASTY}",
        f"unused {NASTY}",
    ):
        assert text in said
    assert_accessible(page)
    assert_no_sideways_scrolling(page)
    if width == 360:
        assert_fits_all_screens(page)  # once: it is a long page


def test_code_in_a_message_is_set_as_code(steps: list[Step], tmp_path: Path) -> None:
    document = _mixed(steps, tmp_path)
    wrong = next(result for result in document.steps if result.id.startswith("03"))
    wrong.messages = ["Keep nothing in a `static` variable; `a<b>` is no name, and one ` stays."]
    wrong.diagnoses = [Diagnosis("mistake", "one", "`n` is not of unit length", "dark", "no", "Look at `n`.")]
    page = student_page(document, tmp_path, steps)
    for words in (
        "in a <code>static</code> variable; <code>a&lt;b&gt;</code> is no name, and one ` stays.",
        "<code>n</code> is not of unit length",
        "Look at <code>n</code>.",
    ):
        assert words in page


def test_samples_are_drawn_beside_their_density(open_page: OpenPage, steps: list[Step], tmp_path: Path) -> None:
    document = _mixed(steps, tmp_path)
    page = open_page(write_student_page(document, tmp_path, steps))
    drawing = page.locator("#step-03").get_by_role("img", name="30 instead of 10; 10 instead of 10; 0 instead of 10")
    heights = [bar.bounding_box()["height"] for bar in drawing.locator("rect").all()]  # type: ignore[index]
    line = drawing.locator("path").bounding_box()
    box = drawing.bounding_box()
    assert line is not None
    assert box is not None
    assert heights == pytest.approx([box["height"], box["height"] / 3, 0, 0], abs=2)
    middle = line["y"] + line["height"] / 2  # as wide as it is drawn
    assert middle - box["y"] == pytest.approx(box["height"] * 2 / 3, abs=2)
    for item in (item for step in document.steps for item in step.hidden if item.histogram):
        assert item.histogram is not None
        item.histogram.counts = []
    assert 'class="spread"' not in student_page(document, tmp_path, steps)


def test_a_picture_that_waits_for_unwritten_code_is_not_called_wrong(
    open_page: OpenPage, steps: list[Step], tmp_path: Path
) -> None:
    document = _mixed(steps, tmp_path)
    result = next(step for step in document.steps if step.status == "partial" and len(step.images) > 1)
    result.images[0].waits_for = result.images[0].message = "closest_hit"
    page = open_page(write_student_page(document, tmp_path, steps))
    pictures = page.locator(f"#step-{result.id[:2]} details.picture")
    names = [picture.locator("h5").inner_text() for picture in pictures.all()]
    assert names == [image.name for image in (*result.images[1:], result.images[0])]
    last = pictures.last
    assert "waits" in last.locator("> summary").inner_text()
    assert "wrong" not in last.locator("> summary").inner_text()
    assert last.get_attribute("open") is None
    assert "wrong" in pictures.first.locator("> summary").inner_text()
    listed = page.get_by_role("navigation", name="Your pictures").get_by_role("link", name=result.images[0].name)
    assert "wrong" not in listed.first.text_content().split()  # type: ignore[union-attr]


def test_pixels_of_a_noisy_picture_are_said_to_differ_by_chance(
    open_page: OpenPage, steps: list[Step], tmp_path: Path
) -> None:
    document = _mixed(steps, tmp_path)
    result = next(step for step in document.steps if step.status == "partial")
    image = result.images[0]
    image.noisy = True
    page = open_page(write_student_page(document, tmp_path, steps))
    pictures = page.locator(f"#step-{result.id[:2]} details.picture")
    picture = pictures.filter(has=page.locator("h5", has_text=image.name))
    picture.scroll_into_view_if_needed()
    said = picture.locator(".compare-count:has-text('differ by chance')")
    said.wait_for()
    assert "fewer pixels" not in said.inner_text()  # what is counted in parts is no number of pixels
    image.passed, image.message, image.outcome = True, "", "ok"
    assert "no more off than chance explains" in student_page(document, tmp_path, steps)


def test_a_script_in_the_report_is_stopped_by_its_policy(watched: Watched, steps: list[Step], tmp_path: Path) -> None:
    path = write_student_page(_mixed(steps, tmp_path), tmp_path, steps)
    text = path.read_text(encoding="utf-8").replace("<main", "<script>document.title = 'taken'</script><main")
    path.write_text(text, encoding="utf-8")
    watched.expected = "script-src|Content Security Policy"
    assert watched.open(path).title() == "Raysteps: ann"


def test_it_tells_what_to_do_next_and_how_the_points_come_about(
    open_page: OpenPage, steps: list[Step], tmp_path: Path
) -> None:
    document = _mixed(steps, tmp_path)
    page = open_page(write_student_page(document, tmp_path, steps))
    todo = page.get_by_role("region", name="Next thing to do")
    assert "03 Phong shading" in todo.inner_text()
    assert "Most likely: the normal is not of length 1" in todo.inner_text()
    assert todo.locator("code").inner_text() == "./raysteps check 03"
    strip = page.get_by_role("navigation", name="Steps").get_by_role("link")
    assert strip.count() == len(steps)
    assert "partly right" in strip.nth(2).inner_text()
    total = document.total
    regular = total.points - total.bonus.points
    assert page.get_by_role("img", name=f"{regular:g} of 100 points").count() == 1
    sums = page.locator(".arithmetic tfoot td").all_inner_texts()
    assert sum(float(text) for text in sums[:-1]) == pytest.approx(total.points, abs=0.05)
    assert "× 45 % of 15" in page.locator("#step-03 .parts").inner_text()  # noqa: RUF001
    assert [page.locator(f"#step-0{at}").evaluate("step => step.open") for at in (1, 3, 4)] == [False, True, False]
    strip.nth(3).click()
    assert page.locator("#step-04").evaluate("step => step.open")


def test_without_a_diagnosis_it_shows_what_is_wrong_first(steps: list[Step], tmp_path: Path) -> None:
    document = _mixed(steps, tmp_path)
    result = next(step for step in document.steps if step.status == "partial")

    def todo() -> str:
        return student_page(document, tmp_path, steps).partition('id="next"')[2].partition("</section>")[0]

    failed = next(test for test in result.tests if not test.passed)
    failed.name, failed.expanded = "the first test that fails", "a = 3"
    assert failed.name not in todo()
    result.diagnoses = []
    assert failed.name in todo()
    assert "a = 3" in todo()
    result.tests = [test for test in result.tests if test.passed]
    lost = next(item for item in result.hidden if item.given)
    lost.given = "the smallest input"
    assert "the smallest input" in todo()


def test_lines_of_a_source_keep_their_columns(open_page: OpenPage, steps: list[Step], tmp_path: Path) -> None:
    document = _mixed(steps, tmp_path)
    result = next(step for step in document.steps if step.status == "partial")
    code = "   25 | return 2 * v;\n      |          ^"
    result.diagnoses, result.messages = [], [f"It does not build: a.cpp:25:10: no match\n{code}\nWrite 2.0F."]
    page = open_page(write_student_page(document, tmp_path, steps), width=360)
    for place in (page.get_by_role("region", name="Next thing to do"), page.locator(f"#step-{result.id[:2]}")):
        assert place.locator("pre", has_text="return").inner_text() == code
        assert place.locator("p.said", has_text="Write").inner_text() == "Write 2.0F."
    assert_no_sideways_scrolling(page)


def test_its_pictures_are_compared_and_a_pixel_has_its_command(
    open_page: OpenPage, steps: list[Step], tmp_path: Path
) -> None:
    page = open_page(write_student_page(_mixed(steps, tmp_path), tmp_path, steps))
    element = page.locator("#step-03 compare-pictures").first
    element.scroll_into_view_if_needed()
    element.get_by_role("button", name="First wrong pixel").click()
    command = "./raysteps inspect scenes/lessons/three-spheres.nff 0 0 --step 3 --size 160x120"
    assert element.locator(".compare-command code").inner_text() == command


def test_only_a_report_beside_the_whole_kit_has_commands_of_the_whole_kit(
    steps: list[Step], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    document = _mixed(steps, tmp_path)
    write_results(document, tmp_path)
    own = student_page(document, tmp_path, steps, OwnProgress(has_reference=True))
    assert "./raysteps replay cases/03-mirror.json" in own
    assert "--against reference" in own
    assert try_student_page(tmp_path, steps, print) is not None
    handed_back = (tmp_path / "report.html").read_text(encoding="utf-8")
    offered = re.findall(r'(?:<code[^>]*>|inspect=")\./raysteps ([^<"]*)', handed_back)
    students = {"check", "finale", "inspect", "view", "watch"}
    assert {"check", "inspect"} <= {words.split()[0] for words in offered} <= students
    assert [words for words in offered if re.search("reference|cases/", words)] == []
    assert "direction (1, 0, 0)" in handed_back  # the input itself stays
    assert cli.main(["report", str(tmp_path)]) == 0
    assert (tmp_path / "report.html").read_text(encoding="utf-8") == handed_back


def test_a_report_of_everything_right_says_so(open_page: OpenPage, steps: list[Step], tmp_path: Path) -> None:
    document = document_of([passed_step(step, tmp_path) for step in steps])
    page = open_page(write_student_page(document, tmp_path, steps))
    todo = page.get_by_role("region", name="Next thing to do")
    assert "every step is right" in todo.inner_text()
    assert todo.locator("code").first.inner_text() == "./raysteps finale"
    assert "20 of 20 bonus points" in page.locator(".score").inner_text()
    party = page.get_by_role("region", name="Every step is right")
    assert party.locator("figure img").count() == len(steps)
    assert party.locator("figure img").first.bounding_box()["width"] > 300  # type: ignore[index]
    work = party.get_by_role("region", name="Work beside the reference").locator("tbody tr")
    assert work.count() == sum(case.max_share is not None for step in steps for case in step.images)
    assert work.first.locator("td").all_inner_texts() == ["4.9", "4.9"]
    assert_accessible(page)


@pytest.mark.parametrize(
    ("feedback", "seen", "unseen"),
    [
        (
            "full",
            ["direction (1, 0, 0)", "normal is not of length 1", "./raysteps check 03"],
            ["of seed"],
        ),
        ("diagnosis", ["normal is not of length 1", "mirror"], ["direction (1, 0, 0)", "replay"]),
        ("score", ["hidden cases"], ["normal is not of length 1", "<code>mirror", "direction (1, 0, 0)", "replay"]),
    ],
)
def test_what_the_results_withhold_is_not_in_the_page(
    steps: list[Step], tmp_path: Path, feedback: Feedback, seen: list[str], unseen: list[str]
) -> None:
    text = student_page(withhold(_mixed(steps, tmp_path), feedback), tmp_path, steps)
    assert [words for words in seen if words not in text] == []
    assert [words for words in unseen if words in text] == []


def test_it_stays_below_5_mb_and_right_pictures_are_left_out_first(steps: list[Step], tmp_path: Path) -> None:
    results = [(passed_step if step.number in "0103" else wrong_step)(step, tmp_path, (150, 200)) for step in steps]
    document = document_of(results)
    text = student_page(document, tmp_path, steps)
    assert len(text.encode()) < 5_000_000
    left_out = text.split('id="step-')
    assert "left out to keep this page small" in left_out[0]
    by_step = {part[:2]: part for part in left_out[1:]}
    assert "Left out" in by_step["01"]
    assert "Left out" not in by_step["02"]


def test_results_of_an_older_kit_still_make_a_page(steps: list[Step], tmp_path: Path) -> None:
    document = document_of([wrong_step(step, tmp_path) for step in steps])
    document = of_older_kit(document)
    assert document.version == ""
    assert "06 Octree" in student_page(document, tmp_path, steps)
    assert "03 phong shading" in student_page(document, tmp_path, [])


def test_results_without_a_step_make_a_page(steps: list[Step], tmp_path: Path) -> None:
    assert "these results hold no step" in student_page(document_of([]), tmp_path, steps)


def test_only_png_files_of_the_folder_are_shown(steps: list[Step], tmp_path: Path) -> None:
    folder = tmp_path / "results"
    document = document_of([wrong_step(steps[0], folder)])
    first, second = document.steps[0].images[:2]
    assert first.mine is not None
    assert second.mine is not None
    secret = tmp_path / "secret.png"
    secret.write_bytes((folder / first.mine).read_bytes())
    shown = student_page(document, folder, steps).count("data:image/png")
    first.mine = "../secret.png"
    (folder / second.mine).write_text("<svg onload='alert(1)'>", encoding="utf-8")
    assert student_page(document, folder, steps).count("data:image/png") == shown - 4  # two pictures and their maps


def test_steps_that_were_not_run_together_are_not_called_wrong(steps: list[Step], tmp_path: Path) -> None:
    step = steps[2]
    assert {part.said for part in parts_of(idle_step(step), step)} == {"not run"}
    result = passed_step(step, tmp_path)
    for passed, word in ((True, "right"), (False, "wrong")):
        result.cumulative.passed = passed
        assert parts_of(result, step)[-1].said == word


def test_a_student_kit_without_a_judge_has_no_hidden_part(steps: list[Step], tmp_path: Path) -> None:
    step = steps[2]
    result = passed_step(step, tmp_path)
    assert [part.name for part in parts_of(result, step)] == ["tests", "pictures", "hidden", "together"]
    assert rest_of(result, parts_of(result, step)) == 0
    result.max, result.points, result.hidden = 9.8, 9.8, []
    assert [part.name for part in parts_of(result, step)] == ["tests", "pictures", "together"]
    assert rest_of(result, parts_of(result, step)) == 0
    result.points = 9.0
    assert rest_of(result, parts_of(result, step)) == -0.8


def test_the_command_makes_the_page_of_a_folder(
    steps: list[Step], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_results(_mixed(steps, tmp_path), tmp_path)
    assert cli.main(["report", str(tmp_path)]) == 0
    made = (tmp_path / "report.html").read_text(encoding="utf-8")
    (tmp_path / "report.html").unlink()
    assert cli.main(["report", str(tmp_path / "results.json")]) == 0
    assert (tmp_path / "report.html").read_text(encoding="utf-8") == made
    assert cli.main(["report", str(tmp_path / "nowhere")]) == 2
    assert "expected a results.json" in capsys.readouterr().err


def test_trouble_with_the_page_is_told_and_costs_nothing(steps: list[Step], tmp_path: Path) -> None:
    (tmp_path / "results.json").write_text(json.dumps({"steps": []}), encoding="utf-8")
    told: list[str] = []
    assert try_student_page(tmp_path, steps, told.append) is None
    assert len(told) == 1
    assert not (tmp_path / "report.html").exists()


@pytest.mark.parametrize(("width", "height"), [(1400, 900), (390, 844)])
def test_the_first_screen_shows_the_picture_of_the_next_thing_to_do(
    open_page: OpenPage, steps: list[Step], tmp_path: Path, width: int, height: int
) -> None:
    page = open_page(write_student_page(_mixed(steps, tmp_path), tmp_path, steps), width=width, height=height)
    viewer = page.get_by_role("region", name="Your pictures")
    viewer.locator(".compare-count:has-text('differ')").wait_for()
    box = viewer.locator(".compare-stage").bounding_box()
    assert box is not None
    assert box["y"] + box["height"] <= height
    assert box["width"] > 0.5 * width
    assert viewer.locator("strong").inner_text().startswith("03 Phong shading: ")
    assert "99% of the pixels are wrong" in viewer.locator(".viewer-said").inner_text()
    assert "(99.00 %)" in viewer.locator(".compare-count").inner_text()
    assert_no_sideways_scrolling(page)


def test_without_scripts_no_room_is_left_for_the_viewer(open_page: OpenPage, steps: list[Step], tmp_path: Path) -> None:
    page = open_page(write_student_page(_mixed(steps, tmp_path), tmp_path, steps), width=1400, scripts=False)
    assert not page.get_by_role("heading", name="Your pictures").is_visible()
    box = page.locator(".next").bounding_box()
    assert box is not None
    assert box["width"] > 0.5 * 1400


@pytest.mark.parametrize("width", [360, 390])
def test_on_a_phone_every_table_is_seen_whole_and_breaks_no_word(
    open_page: OpenPage, steps: list[Step], tmp_path: Path, width: int
) -> None:
    results = [(wrong_step if step.number in ("03", "06") else passed_step)(step, tmp_path) for step in steps]
    page = open_page(write_student_page(document_of(results), tmp_path, steps), width=width, height=844)
    page.evaluate("document.querySelectorAll('details').forEach(details => { details.open = true; })")
    cut = "boxes => boxes.filter(box => box.scrollWidth > box.clientWidth).map(box => box.getAttribute('aria-label'))"
    assert page.locator(".scroll").count() > 2 * len(steps) - 5
    assert page.eval_on_selector_all(".scroll", cut) == []
    assert broken_words(page, ".scroll") == []
    assert_no_sideways_scrolling(page)
    assert_accessible(page)


def test_a_long_status_is_not_cut_on_the_card_of_its_step(
    open_page: OpenPage, steps: list[Step], tmp_path: Path
) -> None:
    results = [idle_step(step) for step in steps]
    results[1].status = "does-not-build"
    page = open_page(write_student_page(document_of(results), tmp_path, steps), width=1400)
    cut = "cards => cards.filter(card => card.scrollWidth > card.clientWidth).map(card => card.textContent)"
    assert page.eval_on_selector_all(".strip a", cut) == []


def test_the_list_of_pictures_is_walked_by_keys_and_begins_with_what_is_wrong(
    open_page: OpenPage, steps: list[Step], tmp_path: Path
) -> None:
    page = open_page(write_student_page(_mixed(steps, tmp_path), tmp_path, steps))
    viewer = page.get_by_role("region", name="Your pictures")
    links = viewer.get_by_role("navigation").get_by_role("link")
    assert links.count() == sum(len(step.images) for step in steps if step.number in ("01", "02", "03", "08"))
    signs = [text.split()[0] for text in links.all_inner_texts()]
    assert signs == sorted(signs, reverse=True)  # the crosses stand before the ticks
    assert links.nth(0).get_attribute("aria-current") == "true"
    viewer.get_by_role("button", name="Blink").click()
    title = viewer.locator("strong").inner_text()
    page.keyboard.press("n")
    assert viewer.locator("strong").inner_text() != title
    assert links.nth(1).get_attribute("aria-current") == "true"
    viewer.locator(".compare-count:has-text('differ')").wait_for()
    assert viewer.get_by_role("button", name="Blink").get_attribute("aria-pressed") == "true"
    links.last.click()
    viewer.locator(".compare-count.same").wait_for()
    assert_accessible(page)


def test_how_it_went_is_drawn_and_said_and_what_changed_is_marked(
    open_page: OpenPage, steps: list[Step], tmp_path: Path
) -> None:
    document = _mixed(steps, tmp_path)
    note_attempt(tmp_path, document_of([passed_step(steps[0], tmp_path)]), [steps[0].id], _at(1))
    note_attempt(tmp_path, document, [steps[2].id], _at(2))
    progress = OwnProgress(read_attempts(tmp_path), frozenset({steps[2].id}))
    page = open_page(write_student_page(document, tmp_path, steps, progress=progress), width=390)
    chart = page.get_by_role("img", name="Points over time: from 10 of 10 points on 2026-01-01 12:00 to")
    assert chart.locator("circle").count() == 2
    page.get_by_text("check by check").click()
    rows = page.locator(".attempts li")
    assert "2026-01-02 12:00" in rows.first.inner_text()
    assert rows.get_by_role("img", name="yours of 03 ").count() == 1
    assert "Changed since it was checked" in page.locator("#step-03").inner_text()
    assert page.locator(".changed").count() == 1
    assert_accessible(page)
    assert_no_sideways_scrolling(page)
    text = student_page(document, tmp_path, steps)
    assert "How it went" not in text
    assert "Changed since it was checked" not in text


def test_the_score_says_how_much_of_the_bonus_was_earned(steps: list[Step], tmp_path: Path) -> None:
    regular = [passed_step(step, tmp_path) for step in steps if not step.bonus]
    none, all_ = [idle_step(step) for step in steps if step.bonus], [passed_step(step, tmp_path) for step in steps[7:]]
    for bonus, words in ((none, "0 of 20 bonus points<"), (all_, "20 of 20 bonus points<")):
        text = student_page(document_of([*regular, *bonus]), tmp_path, steps)
        assert words in text
        assert f"bonus {words[:2].strip()} of 20" in text
    assert "bonus points" not in student_page(document_of(regular), tmp_path, steps)


def _at(day: int, hour: int = 12) -> datetime:
    return datetime(2026, 1, day, hour, tzinfo=UTC)


def test_the_history_stays_small_and_keeps_its_beginning(steps: list[Step], tmp_path: Path) -> None:
    document = document_of([wrong_step(steps[0], tmp_path, (120, 160))])
    for hour in range(24 * 3):
        document.total.points = hour
        note_attempt(tmp_path, document, [steps[0].id], _at(1 + hour // 24, hour % 24))
    kept = read_attempts(tmp_path)
    assert len(kept) == 40
    assert (kept[0].points, kept[-1].points) == (0, 71)
    assert [attempt.at for attempt in kept] == sorted(attempt.at for attempt in kept)
    assert (tmp_path / "history.json").stat().st_size < 1_000_000
    note_attempt(tmp_path, document, [steps[0].id], _at(4))
    assert read_attempts(tmp_path) == kept  # nothing has changed
    for wrong in ("<b>", "2026-13-45 99:99"):
        attempt = {"at": wrong, "points": 1, "max": 2}
        (tmp_path / "history.json").write_text(json.dumps({"schema": "raysteps/history/v1", "attempts": [attempt]}))
        assert read_attempts(tmp_path) == []


def test_a_crash_is_told_once_for_a_step(open_page: OpenPage, steps: list[Step], tmp_path: Path) -> None:
    result = wrong_step(steps[0], tmp_path)
    sentence = "The program crashed in the middle of the test (SIGSEGV)."
    result.tests = [TestResult(f"test {at}", False, sentence, outcome="crashed") for at in range(5)]
    result.hidden = [
        HiddenResult(f"scene {at}", "picture", 0.0, message=sentence, outcome="crashed") for at in range(3)
    ]
    result.messages = ["5 of 5 tests failed.", sentence]
    page = open_page(write_student_page(document_of([result]), tmp_path, steps))
    step = page.locator("#step-01").inner_text()
    assert step.count(sentence) == 1
    assert step.count("test 4") == step.count("scene 2") == 1
    assert step.count("crashed") == 6
    told = Console(file=io.StringIO(), width=200)
    print_details(told, document_of([result]), steps, tmp_path, str)
    printed = told.file.getvalue()  # type: ignore[attr-defined]
    assert printed.count(sentence) == 1
    assert "test 3: crashed" in printed


def test_sums_read_naturally(steps: list[Step], tmp_path: Path) -> None:
    bonus = document_of([wrong_step(step, tmp_path) for step in steps if step.bonus])
    assert re.fullmatch(r"[0-9.]+ of 20 bonus points of the visible part", total_words(bonus.total, visible_only=True))
    regular = document_of([passed_step(step, tmp_path) for step in steps])
    assert total_words(regular.total) == "100 of 100 points, and 20 of 20 bonus points"
    for results in (bonus, _mixed(steps, tmp_path)):
        for result in results.steps:
            parts = parts_of(result, next(step for step in steps if step.id == result.id))
            assert sum(round(part.earned * 10) for part in parts) == pytest.approx(result.points * 10, abs=1)
            assert sum(round(part.most * 10) for part in parts) == round(result.max * 10)


def test_a_larger_picture_stands_beside_those_that_are_compared(
    open_page: OpenPage, steps: list[Step], tmp_path: Path
) -> None:
    """Before them where they are right; in a report of everything right it is the one that is shown."""
    results = [passed_step(step, tmp_path) for step in steps]
    image = results[2].images[0]
    image.large = f"pictures/{results[2].id}/{image.name}-large.png"
    write_png(np.full((30, 40, 3), 90, dtype=np.uint8), tmp_path / image.large)
    page = open_page(write_student_page(document_of(results), tmp_path, steps))
    shown = page.get_by_role("region", name="Every step is right").locator("figure img").nth(2)
    assert (shown.get_attribute("width"), shown.get_attribute("height")) == ("40", "30")
    large = page.locator("details.picture:has(figure.large)").get_attribute("id")
    page.locator(f'.own a[href="#{large}"]').press("Enter")  # a click may miss what moves while pictures come
    page.locator(".viewer-room > figure:first-child + compare-pictures:last-child").wait_for()
    page.locator(".own a").first.press("Enter")
    page.locator(".viewer-room > compare-pictures:only-child").wait_for()
    assert_accessible(page)


def test_a_report_at_home_has_no_column_for_what_nobody_judges_there(steps: list[Step], tmp_path: Path) -> None:
    result = passed_step(steps[2], tmp_path)
    assert "Hidden</th>" in student_page(document_of([result]), tmp_path, steps)
    result.hidden, result.max, result.points = [], 9.8, 9.8
    text = student_page(document_of([result]), tmp_path, steps)
    assert "Tests</th>" in text
    assert "Hidden</th>" not in text
    assert "hidden by what was right" not in text
