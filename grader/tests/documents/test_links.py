"""The documents lead to what is there, and can be read as they stand in an editor."""

import re
from pathlib import Path

import pytest

from raysteps.course.project import Project
from tools.website.documents import dead_links

pytestmark = pytest.mark.portable

_WIDEST = 120  # columns
_FENCED = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
_NOT_TO_BREAK = re.compile(r"\|.*|!\[.*\]\(\S+\)")  # a row of a table, a picture


def _documents(project: Project) -> list[Path]:
    folders = ("docs", "steps", "scenes", "solutions")
    found = [path for folder in folders for path in (project.root / folder).rglob("*.md")]
    return [*project.root.glob("*.md"), *found]


def test_every_link_within_the_kit_leads_somewhere(project: Project) -> None:
    documents = _documents(project)
    assert len(documents) > 15
    assert dead_links(project.root, [path.relative_to(project.root) for path in documents]) == []


@pytest.mark.parametrize(
    "command", ["dev check", "dev calibrate", "dev mistakes", "dev new", "export similarity", "replay"]
)
def test_the_commands_that_keep_grades_true_are_described(project: Project, command: str) -> None:
    texts = " ".join(document.read_text(encoding="utf-8") for document in _documents(project))
    assert f"./raysteps {command}" in texts


def test_no_line_is_wider_than_a_terminal(project: Project) -> None:
    """But for tables, pictures and what programs print."""
    for document in _documents(project):
        lines = _FENCED.sub("", document.read_text(encoding="utf-8")).splitlines()
        wide = [line for line in lines if len(line) > _WIDEST and not _NOT_TO_BREAK.fullmatch(line)]
        assert wide == [], document


def test_no_merge_was_left_half_done(project: Project) -> None:
    marks = re.compile(r"^(?:<{7}|>{7}|\|{7}) ", re.MULTILINE)
    assert [path.name for path in _documents(project) if marks.search(path.read_text("utf-8"))] == []


def test_the_paper_is_explained_where_it_is_first_named(project: Project) -> None:
    """Nobody else's paper, such as Whitted's, is called so."""
    linked = []
    for page in [project.root / "README.md", *project.steps.glob("*/README.md")]:
        text = page.read_text("utf-8")
        if first := re.search(r"\bthe\s+paper\b", text, re.IGNORECASE):
            links = re.finditer(r"\[[^]]*\]\((?:\S*/)?docs/paper\.md\)", text)
            assert any(first.start() in range(*link.span()) for link in links), page
            linked.append(page.parent.name[:2])
    assert set(linked) >= {"04", "05", "06", "07", "08", "09"}
