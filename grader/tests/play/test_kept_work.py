"""What is written in the page to work in is kept: in the browser, as a zip, in a folder, and by one tab of two."""

import zipfile
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from browser import Watched, assert_accessible
from play_pages import POINT, STARTED, save, source_of, status_says, write

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.stubs import pristine_stub
from raysteps.play.play_page import PlayServer
from raysteps.submission.load import load_submission

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("play")]


def _begin_again(page: "Page") -> None:
    page.get_by_role("button", name="Begin again").click()
    page.locator("dialog").get_by_role("button", name="Begin again").click()


def test_the_stub_comes_back_and_what_was_written(page: "Page", project: Project, steps: list[Step]) -> None:
    from playwright.sync_api import expect

    back = page.get_by_role("button", name="Bring back what I wrote")
    expect(back).to_be_hidden()
    save(page, "int broken")
    status_says(page, r"It does not compile\.")
    _begin_again(page)
    status_says(page, r"0 of 12 tests pass")
    expect(page.locator("#play-tests summary").first).to_have_text(
        "12 tests wait for a function that is not written yet"
    )
    stub = pristine_stub(project, steps[0]).split()
    assert source_of(page).split() == stub
    _begin_again(page)  # where nothing was written, nothing is lost
    page.reload()
    status_says(page, r"0 of 12 tests pass", timeout=STARTED)
    assert source_of(page).split() == stub
    assert_accessible(page)
    back.focus()
    page.keyboard.press("Enter")
    status_says(page, r"It does not compile\.")
    assert source_of(page).split() == ["int", "broken"]
    expect(back).to_be_hidden()
    expect(page.locator(".cm-content")).to_be_focused()
    _begin_again(page)
    status_says(page, r"0 of 12 tests pass")
    save(page, "int other")
    status_says(page, r"It does not compile\.")
    back.click()  # and what was written meanwhile takes its place
    expect(page.locator(".cm-content")).to_have_text("int broken")
    back.click()
    expect(page.locator(".cm-content")).to_have_text("int other")


def test_every_step_keeps_its_text_when_steps_change_quickly(
    page: "Page", project: Project, steps: list[Step], tmp_path: Path
) -> None:
    from playwright.sync_api import expect

    texts = ["// mine", *(pristine_stub(project, step) for step in steps[1:3])]
    write(page, texts[0])
    page.evaluate("""() => {
        addEventListener("hashchange", () => { location.hash = "#03"; }, { once: true });
        location.hash = "#02";
    }""")
    page.wait_for_function("location.hash === '#03'")
    for number in (3, 2, 1, 2, 3):
        page.evaluate("number => { location.hash = `#0${number}`; }", number)
        expect(page.locator("#play-file")).to_have_text(f"steps/{steps[number - 1].path.as_posix()}")
        expect(page.locator("#play-step")).to_have_value(f"0{number}")
        begins = 30  # words: the editor holds no more of a long text than is seen
        assert source_of(page).split()[:begins] == texts[number - 1].split()[:begins]
    with page.expect_download() as download:
        page.get_by_role("button", name="Save as zip").click()
    download.value.save_as(tmp_path / "my-steps.zip")
    assert load_submission(tmp_path / "my-steps.zip", steps).sources == {steps[0].id: texts[0].encode()}


def test_what_is_typed_just_before_the_page_goes_is_kept(page: "Page") -> None:
    from playwright.sync_api import expect

    write(page, "// of the last moment\n")
    page.reload()
    expect(page.locator(".cm-content")).to_contain_text("// of the last moment")
    write(page, "// later\n")
    expect(page.locator("#play-kept")).to_have_text("Kept in this browser.")
    page.reload()  # what was left before does not come again
    expect(page.locator(".cm-content")).to_contain_text("// later")
    _begin_again(page)
    status_says(page, r"0 of 12 tests pass", timeout=STARTED)
    expect(page.locator("#play-kept")).to_be_empty()


# A browser without room: it takes a text, and cannot write it.
_FULL = """isFull => {
    const full = IDBObjectStore.prototype;
    full.taken ??= full.put;
    full.put = isFull ? function put(...what) {
        const request = this.taken(...what);
        this.transaction.abort();
        return request;
    } : full.taken;
}"""


def test_what_cannot_be_kept_is_told_and_tried_again(page: "Page", tmp_path: Path) -> None:
    from playwright.sync_api import expect

    kept = page.locator("#play-kept")
    page.evaluate(_FULL, True)
    write(page, "// not kept\n")
    expect(kept).to_contain_text("Not kept: this browser cannot")
    page.locator("#play-step").select_option("02")
    status_says(page, r"Step 02 is not opened: what you wrote here would be lost\.")
    expect(page.locator("#play-step")).to_have_value("01")
    with page.expect_download() as download:
        page.get_by_role("button", name="Save as zip").click()
    download.value.save_as(tmp_path / "my-steps.zip")
    with zipfile.ZipFile(tmp_path / "my-steps.zip") as archive:
        assert archive.read(archive.namelist()[0]) == b"// not kept\n"
    page.evaluate(_FULL, False)
    page.keyboard.press("ControlOrMeta+s")
    expect(kept).to_have_text("Kept in this browser.")


def test_one_tab_writes_and_the_other_reads(page: "Page", server: PlayServer, solved: dict[str, str]) -> None:
    from playwright.sync_api import expect

    first, second = page, page.context.new_page()
    second.goto(server.address)
    expect(first.locator("#play-elsewhere")).to_be_hidden()
    expect(second.locator("#play-elsewhere")).to_be_visible()
    stub = source_of(second)
    write(second, "// lost\n")
    assert source_of(second) == stub
    second.get_by_role("button", name="Write here instead").click()
    expect(first.locator("#play-elsewhere")).to_be_visible()
    expect(second.locator("#play-elsewhere")).to_be_hidden()
    write(first, "// lost\n")
    save(second, solved["01-camera-rays"])
    status_says(second, r"Step 01 is right", timeout=STARTED)
    second.close()
    expect(first.locator("#play-elsewhere")).to_be_hidden()
    assert POINT in source_of(first), "what the other tab wrote"
    save(first, f"{solved['01-camera-rays']}// mine\n")
    status_says(first, r"Step 01 is right")


def test_a_saved_zip_is_opened_and_the_next_step_comes(
    page: "Page", steps: list[Step], solved: dict[str, str], tmp_path: Path
) -> None:
    from playwright.sync_api import expect

    first, second = steps[:2]
    saved = tmp_path / "saved.zip"
    with zipfile.ZipFile(saved, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(f"mine/steps/{first.path.as_posix()}", solved[first.id])
        archive.writestr(second.file, "// of step 02, by its name alone\n")
        archive.writestr("notes.txt", "no step")
    write(page, "// what was there\n")
    expect(page.locator("#play-next")).to_be_hidden()
    page.locator("#play-zip").set_input_files(saved)
    status_says(page, r"Step 01 is right")
    expect(page.locator("#play-kept")).to_have_text("saved.zip: taken from it: step 01, 02.")
    page.get_by_role("button", name="Next step").click()
    expect(page.locator("#play-step")).to_have_value("02")
    status_says(page, r"It does not compile\.", timeout=STARTED)
    assert source_of(page).startswith("// of step 02")
    page.locator("#play-step").select_option("01")
    status_says(page, r"Step 01 is right", timeout=STARTED)
    page.get_by_role("button", name="Bring back what I wrote").click()
    status_says(page, r"It does not compile\.")
    expect(page.locator("#play-next")).to_be_hidden()
    assert source_of(page).startswith("// what was there")
    (tmp_path / "no.zip").write_text("no zip")
    page.locator("#play-zip").set_input_files(tmp_path / "no.zip")
    status_says(page, r"no\.zip cannot be read\. Expected a zip that this page saved, or one that you hand in\.")


# The browser's own folder in place of one that a reader would choose; and what another program does there.
_PICKER = """window.showDirectoryPicker = async () =>
    (await navigator.storage.getDirectory()).getDirectoryHandle("course", { create: true });"""
_FILE = """async ([path, text]) => {
    const names = path.split("/");
    let folder = await window.showDirectoryPicker();
    for (const name of names.slice(0, -1)) folder = await folder.getDirectoryHandle(name, { create: true });
    const file = await folder.getFileHandle(names.at(-1), { create: true });
    if (text === null) return (await file.getFile()).text();
    const stream = await file.createWritable();
    await stream.write(text);
    return stream.close();
}"""


def test_a_folder_on_disk_and_the_page_follow_each_other(
    watched: Watched, server: PlayServer, steps: list[Step], solved: dict[str, str]
) -> None:
    from playwright.sync_api import expect

    first, second = (f"steps/{step.path.as_posix()}" for step in steps[:2])
    right = solved[steps[0].id]
    watched.allowed += [server.address, f"blob:{server.address.rstrip('/')}"]
    page = watched.open(server.address, before=_PICKER)
    kept, both, back = (page.locator(f"#play-{name}") for name in ("kept", "both", "back"))
    status_says(page, r"0 of 12 tests pass", timeout=STARTED)

    def on_disk(path: str, text: str | None = None) -> str:
        return str(page.evaluate(_FILE, [path, text]))

    on_disk(second, "// of the native kit\r\n")
    save(page, right)
    status_says(page, r"Step 01 is right")
    page.get_by_role("button", name="Link a folder").click()
    expect(kept).to_have_text("Saved in course.")
    assert on_disk(first) == right, "what is in the page only"
    status_says(page, r"Step 01 is right")

    on_disk(first, right.replace("\n", "\r\n") + "// native\r\n")
    page.evaluate("dispatchEvent(new Event('focus'))")
    expect(kept).to_have_text("Taken from course, where it was changed.")
    status_says(page, r"Step 01 is right")
    on_disk(first, "// theirs\n")
    save(page, f"{right}// mine\n")
    expect(both).to_be_visible()
    assert on_disk(first) == "// theirs\n", "as long as nobody has said which one"
    assert_accessible(page)
    page.get_by_role("button", name="Keep what is here").click()
    expect(kept).to_have_text("Saved in course.")
    assert on_disk(first) == f"{right}// mine\n"
    expect(back).to_be_visible()  # theirs
    on_disk(first, "// theirs again\n")
    write(page, "// mine again\n")
    page.evaluate("dispatchEvent(new Event('focus'))")
    page.get_by_role("button", name="Take the file").click()
    status_says(page, r"It does not compile\.")
    assert source_of(page).split() == ["//", "theirs", "again"]
    back.click()
    expect(kept).to_have_text("Saved in course.")
    assert on_disk(first) == "// mine again\n"

    page.reload()
    unlink = page.get_by_role("button", name="Unlink course")
    expect(unlink).to_be_visible()
    page.locator("#play-step").select_option("02")
    expect(page.locator(".cm-content")).to_have_text("// of the native kit")
    unlink.click()
    expect(page.get_by_role("button", name="Link a folder")).to_be_visible()
