"""The page of a class in a browser: sorted, filtered, without names, and never run by a name."""

from pathlib import Path

import pytest
from browser import OpenPage, assert_accessible, assert_fits_all_screens, assert_no_sideways_scrolling, broken_words
from class_documents import STEPS, document, many, missing, result, student, submission
from playwright.sync_api import Page

from raysteps.common.text import searchable, tenths
from raysteps.report.class_page import write_class_report

_FIRST, _SECOND = STEPS[0]["id"], STEPS[1]["id"]
_SCRIPT = "<script>alert(1)</script>"
_UNIT = "the normal is not of unit length"


def _page(folder: Path) -> Path:
    for name in ("ann", "bob"):
        (folder / "submissions" / name).mkdir(parents=True)
        (folder / "submissions" / name / "report.html").touch()
    late = {"days": 2, "percent": 20, "points": 8, "deadline": "d", "words": "w"}
    facts = document(
        [
            submission("ann", {_FIRST: result(10, 10), _SECOND: result(9, 20)}, mistakes={_SECOND: [_UNIT]}),
            submission("bob", {_FIRST: result(10, 10), _SECOND: result(0, 20, "crashed")}, late=late, final=8),
            submission("script", {_FIRST: result(2, 10)}, students=[student(_SCRIPT, "4711", "José.Groß@example.edu")]),
            submission("dot", {_FIRST: result(8, 10)}, outdated=True),
            missing("eve", "fault", fault="eve is in the way"),
        ],
        late_policy="percent_per_day = 10\n# without eve",
        students_without_submission=[{**student("Fay"), "note": ""}],
    )
    return write_class_report(facts, folder)


def _names(page: Page) -> list[str]:
    """Of the rows that are shown, in their order."""
    return page.eval_on_selector_all(  # type: ignore[no-any-return]
        ".class-table tbody tr:not([hidden]) th > :first-child", "all => all.map(one => one.textContent)"
    )


def _sort(page: Page, column: int) -> str | None:
    name = f".class-table th[data-column='{column}']"
    heading = page.locator(name)
    before = heading.get_attribute("aria-sort")
    heading.get_by_role("button").click()
    page.wait_for_selector(f"{name}[aria-sort]:not([aria-sort='{before}'])")
    return heading.get_attribute("aria-sort")


@pytest.mark.parametrize(("width", "scheme"), [(360, "light"), (1440, "dark")])
def test_it_is_accessible_and_never_wider_than_the_screen(
    open_page: OpenPage, tmp_path: Path, width: int, scheme: str
) -> None:
    page = open_page(_page(tmp_path), width=width, scheme=scheme)
    for box in page.locator(".group").all():
        box.evaluate("element => { element.open = true; }")
    assert_accessible(page)
    page.check("#hide-names")
    assert_accessible(page)
    page.uncheck("#hide-names")
    assert_fits_all_screens(page)


def test_on_a_phone_names_and_totals_stay_while_the_steps_scroll_by_keys(open_page: OpenPage, tmp_path: Path) -> None:
    page = open_page(write_class_report(many(3), tmp_path), width=390, height=844)
    box = page.get_by_role("region", name="Table of submissions")
    box.scroll_into_view_if_needed()
    assert broken_words(page, ".table-box thead, .table-box td") == []
    box.evaluate("box => { window.moved = new Promise(done => { box.onscroll = () => done(box.scrollLeft); }); }")
    box.focus()
    page.keyboard.press("ArrowRight")
    assert page.evaluate("window.moved") > 0
    head = box.locator("thead").bounding_box()
    assert head is not None
    for column in (".who", ".total"):
        edges = box.locator(f"thead {column}").bounding_box()
        assert edges is not None
        assert edges["x"] >= 0
        assert edges["x"] + edges["width"] <= 390
        assert edges["height"] >= head["height"] - 1, "no heading that scrolls below it looks out above it"
    rows = box.locator("tbody tr").evaluate_all("all => all.map(one => one.getBoundingClientRect().height)")
    assert all(height == round(height) for height in rows), "else a row covers the line of the one above"
    assert_no_sideways_scrolling(page)


def test_columns_sort_both_ways_and_who_has_no_points_comes_last(open_page: OpenPage, tmp_path: Path) -> None:
    page = open_page(_page(tmp_path))
    total = len(STEPS) + 1
    assert _names(page) == ["ann", "bob", _SCRIPT, "dot", "eve"]
    assert _sort(page, total) == "descending"
    assert _names(page) == ["ann", "bob", "dot", _SCRIPT, "eve"]
    assert _sort(page, total) == "ascending"
    assert _names(page) == [_SCRIPT, "dot", "bob", "ann", "eve"]
    assert _sort(page, 0) == "ascending"
    assert _names(page) == [_SCRIPT, "ann", "bob", "dot", "eve"]
    assert page.locator("th[aria-sort]").count() == 1


def test_search_status_and_marks_filter(open_page: OpenPage, tmp_path: Path) -> None:
    page = open_page(_page(tmp_path))
    page.fill("#search", "4711 EXAMPLE")
    assert _names(page) == [_SCRIPT]
    assert page.inner_text("#shown") == "1 of 5 submissions"
    page.fill("#search", "none")
    assert _names(page) == []
    page.fill("#search", "JOSE\u0301 Groß")  # an accent of its own, as macOS writes it
    assert _names(page) == [_SCRIPT]
    page.click("text=Show all")
    page.select_option("#step", "1")
    assert _names(page) == ["ann", "bob"]
    page.select_option("#status", "crashed")
    assert _names(page) == ["bob"]
    page.select_option("#step", "0")
    assert _names(page) == []
    page.select_option("#status", "!passed")
    assert _names(page) == [_SCRIPT, "dot"]
    page.click("text=Show all")
    page.check("#look")
    assert _names(page) == ["dot", "eve"]
    page.click("text=Show all")
    page.check("#late")
    assert _names(page) == ["bob"]
    page.click("text=Show all")
    assert len(_names(page)) == 5


@pytest.mark.parametrize(
    ("name", "search"),
    [
        ("Jörg Müller", "muller jorg"),
        ("Jörg Müller", "MU\u0308LLER"),
        ("Łukasz Żółć", "lukasz zolc"),
        ("Lukasz Zolc", "łukasz żółć"),
        ("Søren Đorđe Straße", "soren dorde strasse"),
        ("İpek Y\u0131ld\u0131z", "ipek yildiz"),
        ("Þór Æsir", "thor aesir"),
        ("Nguyễn Thị Ánh", "nguyen thi anh"),
    ],
)
def test_search_needs_no_accents_and_no_foreign_keys(
    open_page: OpenPage, tmp_path: Path, name: str, search: str
) -> None:
    facts = document([submission("one", students=[student(name)]), submission("two", students=[student("Ann Lee")])])
    page = open_page(write_class_report(facts, tmp_path))
    page.fill("#search", search)
    assert _names(page) == [name]


def test_what_is_searched_for_is_made_alike_in_both_languages(open_page: OpenPage, tmp_path: Path) -> None:
    page = open_page(_page(tmp_path))
    letters = "".join(
        map(chr, [*range(0x21, 0x250), *range(0x1E00, 0x1F00), *range(0x3B1, 0x3C9), *range(0x410, 0x450)])
    )
    made = page.evaluate(
        """text => ClassFilter.prototype.searchable.call(
            { letters: JSON.parse(document.getElementById("data").textContent).letters }, text)""",
        letters,
    )
    assert made == searchable(letters)
    assert all(letter.isascii() for letter in searchable("łøđħŧßæœþð\u0131ŋƶÄéçŠž"))


@pytest.mark.parametrize("amount", [3, 40, 500])
def test_the_table_stands_on_the_first_screen(open_page: OpenPage, tmp_path: Path, amount: int) -> None:
    page = open_page(write_class_report(many(amount), tmp_path), width=1400, height=900)
    rows = page.locator(".class-table tbody tr")
    seen = rows.nth(min(amount, 10) - 1).bounding_box()
    assert seen is not None
    assert seen["y"] + seen["height"] <= 900
    assert page.locator(".tiles").bounding_box()["y"] < 300  # type: ignore[index]
    assert_no_sideways_scrolling(page)


def test_a_sign_stays_beside_its_points(open_page: OpenPage, tmp_path: Path) -> None:
    page = open_page(write_class_report(many(40), tmp_path), width=1400, height=900)
    wrong = page.eval_on_selector_all(
        ".class-table tbody tr td[class]:not(.marks)",
        """cells => cells.map(cell => {
            return cell.scrollWidth > cell.clientWidth || getComputedStyle(cell).whiteSpace !== "nowrap";
        })""",
    )
    assert wrong
    assert not any(wrong)


@pytest.mark.parametrize("steps", [4, 5, 6, 7, 8, 9, 10, 11])
def test_no_card_stands_alone(open_page: OpenPage, tmp_path: Path, steps: int) -> None:
    some = [{**STEPS[0], "id": f"{number:02d}-step"} for number in range(1, steps + 1)]
    page = open_page(write_class_report(document([], steps=some), tmp_path), width=1400, height=900)
    tops = [box["y"] for card in page.locator(".card").all() if (box := card.bounding_box()) is not None]
    assert tops.count(tops[-1]) > 1


def test_a_common_mistake_shows_who_made_it(open_page: OpenPage, tmp_path: Path) -> None:
    page = open_page(_page(tmp_path))
    button = page.get_by_role("button", name=_UNIT)
    assert button.inner_text() == f"1 of 2: {_UNIT}"
    button.click()
    assert _names(page) == ["ann"]
    assert button.get_attribute("aria-pressed") == "true"
    button.click()
    assert len(_names(page)) == 5


def test_hidden_names_are_nowhere_to_be_seen_and_stay_with_their_rows(open_page: OpenPage, tmp_path: Path) -> None:
    page = open_page(_page(tmp_path))
    assert page.get_attribute("td ~ td >> xpath=ancestor::tr >> th a", "href") == "submissions/ann/report.html"
    page.fill("#search", "ann")
    page.check("#hide-names")
    for box in page.locator("details").all():
        box.evaluate("element => { element.open = true; }")
    seen = page.inner_text("body").lower()
    for name in ("ann", "bob", "dot", "eve", "fay", "4711", "alert"):
        assert name not in seen.replace("cannot", ""), name
    assert page.locator("a[href^=submissions]").count() == 0
    assert page.input_value("#search") == ""
    before = _names(page)
    assert sorted(before) == [f"student {number}" for number in range(1, 6)]
    page.fill("#search", before[1])
    assert _names(page) == [before[1]]
    page.fill("#search", "ann")
    assert _names(page) == []
    page.click("text=Show all")
    _sort(page, 1)
    hidden = _names(page)
    page.reload()
    assert _names(page) == before  # the address keeps the switch
    page.uncheck("#hide-names")
    named = dict(zip(_names(page), before, strict=True))
    assert page.locator("a[href^=submissions]").count() > 0
    _sort(page, 1)
    assert [named[name] for name in _names(page)] == hidden


def test_a_name_that_is_a_script_stays_text(open_page: OpenPage, tmp_path: Path) -> None:
    page = open_page(_page(tmp_path))
    assert page.get_by_text(_SCRIPT, exact=True).count() >= 1
    page.check("#hide-names")
    page.uncheck("#hide-names")
    assert page.locator(f"th:has-text('{_SCRIPT}')").count() == 1
    assert page.locator("script:text-is('alert(1)')").count() == 0


def test_without_scripts_the_table_can_be_read(open_page: OpenPage, tmp_path: Path) -> None:
    path = _page(tmp_path)
    path.write_text(path.read_text("utf-8").split('<script type="application/json"')[0], "utf-8")
    page = open_page(path)
    assert _names(page) == ["ann", "bob", _SCRIPT, "dot", "eve"]
    assert page.locator("#filters, #switches").locator("visible=true").count() == 0


def test_a_thousand_students_fit_into_a_small_page_and_sort(open_page: OpenPage, tmp_path: Path) -> None:
    facts = many(1000)
    path = write_class_report(facts, tmp_path)
    assert path.stat().st_size < 1_500_000
    page = open_page(path)
    _sort(page, len(STEPS) + 1)
    totals = page.eval_on_selector_all(
        ".class-table tbody tr", "all => all.map(one => Number(one.querySelector('.total').textContent))"
    )
    assert totals == sorted((float(tenths(one.points or 0)) for one in facts.submissions), reverse=True)
