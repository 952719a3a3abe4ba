"""The site: all documents, all commands, no dead link, and nothing from a network."""

import json
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

import pytest
from browser import OpenPage, assert_accessible, assert_fits_all_screens

from raysteps.cli.app import main, new_parser
from raysteps.common.errors import UsageError
from raysteps.common.markdown import BadFormula, anchors, formulas, mathml
from raysteps.course.manifest import kit_steps, read_steps
from raysteps.course.project import Project, here
from tools.website.build import SITE
from tools.website.documents import (
    CONTRACTS_PAGE,
    CORE_PAGE,
    api_pages,
    bad_formulas,
    command_page,
    dead_links,
    documents,
)

_TOGETHER = pytest.mark.xdist_group("site")


def test_dead_links_are_found(tmp_path: Path) -> None:
    (tmp_path / "a.md").write_text("# One\n[x](b.md#two) [y](b.md#three)\n![z](no.png) `[code](no.md)` [w](#one)\n")
    (tmp_path / "b.md").write_text("## Two\n```\n## Three\n```\n")
    found = dead_links(tmp_path, [Path("a.md")])
    assert [line.split(": ")[:2] for line in found] == [["a.md:2", "b.md#three"], ["a.md:3", "no.png"]]


def test_anchors_are_those_of_a_forge() -> None:
    text = "# A *b* `c_d`: e, f\n## Twice\n## Twice\n## [Text](x.md) & more\n"
    assert anchors(text) == {"a-b-c_d-e-f", "twice", "twice-1", "text--more"}


def test_every_formula_can_be_shown(project: Project) -> None:
    assert bad_formulas(project.root, documents(project)) == []


def test_formulas_are_told_from_other_dollars() -> None:
    assert formulas("$a + b$, $$c$$ and `$d` cost $5 or $HOME\n```\n$e$\n```\n") == ["a + b", "c"]


def test_a_place_where_no_folder_can_be_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    assert main(["docs", "--out", str(tmp_path / "notes.txt" / "site")]) == 2
    assert "is a file; expected a folder" in capsys.readouterr().err


@pytest.mark.parametrize("formula", [r"\nonsense{x}", r"\frac12", r"{a"])
def test_a_formula_that_cannot_be_shown_is_found(formula: str) -> None:
    with pytest.raises(BadFormula):
        mathml(formula, block=False)


def test_all_documents_are_on_the_site(project: Project) -> None:
    found = {str(path) for path in documents(project)}
    assert {f"docs/{path.name}" for path in (project.root / "docs").glob("*.md")} <= found
    assert {f"steps/{step.id}/README.md" for step in read_steps(project)} <= found


def test_the_page_of_commands_has_every_option(project: Project) -> None:
    page = command_page(project, new_parser(project))
    for command in ("watch", "grade-class", "export gradescope", "dev mistakes"):
        assert re.search(f"^##+ {command}$", page, re.MULTILINE)
    for option in ("--require-sandbox", "--late-policy", "--map-scale", "--screenshot"):
        assert option in page


def test_the_pages_of_headers_have_every_declaration_and_nothing_private(project: Project) -> None:
    pages = api_pages(project)
    contracts, core = pages[CONTRACTS_PAGE], pages[CORE_PAGE]
    for step in read_steps(project):
        assert f"## {step.number} {step.title}" in contracts
        assert [name for name in step.functions if name.rpartition(":")[2] not in contracts + core] == []
    assert "Box::clip" in contracts
    assert "virtual bool overlaps" in core
    assert not re.search("#include|private:|Fill fill_;", contracts + core)


def _written(folder: Path, *names: str) -> Path:
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(f"{folder.name} {name}", encoding="utf-8")
    return folder


def test_an_older_site_goes_and_what_else_lies_there_stays(tmp_path: Path) -> None:
    out = tmp_path / "out"
    SITE.put(_written(tmp_path / "first", "index.html", "docs/old/a.html"), out)
    _written(out, ".git/HEAD", "CNAME", "docs/mine.txt")
    SITE.check(out)
    SITE.put(_written(tmp_path / "second", "index.html", "docs/b.html"), out)
    left = {path.relative_to(out).as_posix() for path in out.rglob("*") if path.is_file()}
    assert left == {"index.html", "docs/b.html", ".raysteps-site.json", ".git/HEAD", "CNAME", "docs/mine.txt"}
    assert (out / "index.html").read_text() == "second index.html"
    assert not (out / "docs/old").exists()
    with pytest.raises(UsageError, match="CNAME: is not of an older site"):
        SITE.put(_written(tmp_path / "third", "CNAME"), out)
    assert (out / "CNAME").read_text() == "out CNAME"


def test_a_list_that_leads_out_of_the_site_deletes_nothing(tmp_path: Path) -> None:
    out = _written(tmp_path / "out", "index.html")
    _written(tmp_path, "precious.txt")
    listed = {"schema": "raysteps/site/v1", "files": ["../precious.txt", str(tmp_path / "precious.txt"), "index.html"]}
    (out / ".raysteps-site.json").write_text(json.dumps(listed))
    SITE.put(_written(tmp_path / "new", "index.html"), out)
    assert (tmp_path / "precious.txt").exists()


def test_a_folder_of_something_else_is_left_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "thesis.txt").write_text("years of work")
    assert main(["docs", "--out", str(tmp_path)]) == 2
    assert "expected a new or an empty folder" in capsys.readouterr().err
    assert main(["docs", "--out", str(tmp_path / "new"), "--gallery", str(tmp_path)]) == 2
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.txt"]


def test_what_is_missing_is_named(
    project: Project, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tools.website.build.find_spec", lambda name: None)
    assert main(["docs", "--out", str(tmp_path / "new")]) == 2
    line = capsys.readouterr().err.splitlines()[-1]
    assert line.strip() == f'"{sys.executable}" -m pip install -e "{project.root / "grader"}[docs]"'
    assert not (tmp_path / "new").exists()


_PAGE = '<!doctype html><title>play</title><pre><script type="application/json" id="data">{"model":"stub"}</script>'


def _page_in(folder: Path) -> Path:
    """One with the files that make it a page, and nothing in them."""
    folder.mkdir()
    (folder / "index.html").write_text(_PAGE, encoding="utf-8")
    for name in ("clang.wasm.gz", "system.tar.gz", "kit.tar.gz"):
        (folder / name).touch()
    return folder


def test_only_a_page_without_solutions_is_taken_in(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "no page").mkdir()
    assert main(["docs", "--out", str(tmp_path / "new"), "--play", str(tmp_path / "no page")]) == 2
    assert "expected a page to work in; make one in a students' kit" in capsys.readouterr().err
    assert main(["docs", "--out", str(tmp_path / "new"), "--play", str(_page_in(tmp_path / "page"))]) == 2
    assert "must not be published: clang.wasm.gz: is not packed as the page packs it" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


class _Links(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.targets: list[str] = []
        self.ids: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.targets.append(value)
            if name == "id" and value:
                self.ids.add(value)


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built once, with a gallery and a page to work in."""
    folder = tmp_path_factory.mktemp("site")
    (folder / "gallery").mkdir()
    (folder / "gallery" / "index.html").write_text("<!doctype html><title>gallery</title>", encoding="utf-8")
    made_before = ["--gallery", str(folder / "gallery"), "--play", str(_page_in(folder / "made"))]
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("tools.website.command.find_leaks", lambda *_: [])
        assert main(["docs", "--out", str(folder / "out"), *made_before]) == 0
    return folder / "out"


@_TOGETHER
def test_the_site_has_the_page_to_work_in_and_leads_there(site: Path) -> None:
    assert (site / "play" / "kit.tar.gz").is_file()
    assert (site / "play" / "index.html").read_text(encoding="utf-8") == _PAGE
    assert '<a href="../play/index.html">The page to work in</a>' in (site / "docs" / "play.html").read_text("utf-8")


@_TOGETHER
def test_every_link_of_every_page_leads_somewhere_within_the_site(site: Path) -> None:
    pages: dict[Path, _Links] = {}
    for path in site.rglob("*.html"):
        pages[path] = _Links()
        pages[path].feed(path.read_text(encoding="utf-8"))
    assert len(pages) > 30
    for path, page in pages.items():
        for target in page.targets:
            if re.match(r"https?:|data:|mailto:", target):
                continue
            name, _, anchor = target.partition("#")
            there = (path.parent / unquote(name.partition("?")[0])).resolve() if name else path
            assert there.exists(), f"{path.relative_to(site)}: {target}"
            if anchor and there in pages:
                assert unquote(anchor) in pages[there].ids, f"{path.relative_to(site)}: {target}"


@_TOGETHER
def test_pages_show_all_without_a_network(site: Path, open_page: OpenPage) -> None:
    with_figures, with_formulas = (f"steps/{step.id}/README" for step in kit_steps(here()) if step.index in (2, 10))
    for name, width, scheme in (("index", 1440, "light"), (with_figures, 360, "dark"), (with_formulas, 1440, "light")):
        page = open_page(site / f"{name}.html", width=width, scheme=scheme)
        assert_accessible(page)
        assert_fits_all_screens(page)
        broken = "[...document.images].filter(i => i.loading !== 'lazy' && !i.naturalWidth).map(i => i.src)"
        assert page.evaluate(broken) == []
    page = open_page(site / "docs/mistakes/04-shadows.html", width=360)
    words, picture = (page.locator(f"article tbody td:nth-child({column})").first.bounding_box() for column in (3, 1))
    assert words is not None
    assert picture is not None
    assert words["y"] > picture["y"], "words stand below their pictures on a phone"
    assert_fits_all_screens(page)
    page = open_page(site / f"{with_formulas}.html")
    page.emulate_media(media="print")
    assert not page.locator(".skip-to-content").is_visible(), "it would lie on the text of each printed page"
    style = "one => [getComputedStyle(one).whiteSpace, getComputedStyle(one).breakInside]"
    assert page.locator(".highlight pre").first.evaluate(style)[0] == "pre-wrap"
    assert page.locator("article table").first.evaluate(style)[1] == "auto"
    page.emulate_media(media="screen")
    shown = page.locator("math").first.bounding_box()
    assert shown is not None
    assert shown["width"] > 5


@_TOGETHER
def test_the_words_of_options_are_found(site: Path) -> None:
    left_out = (site / "_static" / "language_data.js").read_text(encoding="utf-8").partition("]")[0]
    assert '"the"' in left_out
    assert '"against"' not in left_out
    assert '"against":' in (site / "searchindex.js").read_text(encoding="utf-8")


@_TOGETHER
def test_search_works_in_pages_that_were_opened_as_files(site: Path, open_page: OpenPage) -> None:
    page = open_page(site / "index.html")
    page.locator("input[name=q]").first.fill("acne")
    page.keyboard.press("Enter")
    page.locator("#search-results li a", has_text="Step 04").first.click()
    assert "/steps/04-shadows/README.html" in page.url
