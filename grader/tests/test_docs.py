"""The documents lead to what is there."""

from pathlib import Path

import pytest

from raysteps.kit.project import Project
from raysteps.upkeep.site.links import dead_links


def _documents(project: Project) -> list[Path]:
    folders = ("docs", "steps", "scenes", "solutions")
    found = [path for folder in folders for path in (project.root / folder).rglob("*.md")]
    return [project.root / "README.md", *found]


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
