"""The documents lead to what is there."""

import re
from pathlib import Path

import pytest

from raysteps.kit.project import Project

_LINK = re.compile(r"\]\(([^)\s#]+)(?:#[^)]*)?\)")


def _documents(project: Project) -> list[Path]:
    folders = ("docs", "steps", "scenes", "solutions")
    found = [path for folder in folders for path in (project.root / folder).rglob("*.md")]
    return [project.root / "README.md", *found]


def test_every_link_within_the_kit_leads_somewhere(project: Project) -> None:
    documents = _documents(project)
    assert len(documents) > 15
    for document in documents:
        for target in _LINK.findall(document.read_text(encoding="utf-8")):
            if "://" not in target:
                assert (document.parent / target).exists(), f"{document}: {target}"


@pytest.mark.parametrize(
    "command", ["dev check", "dev calibrate", "dev mistakes", "dev new", "export similarity", "replay"]
)
def test_the_commands_that_keep_grades_true_are_described(project: Project, command: str) -> None:
    texts = " ".join(document.read_text(encoding="utf-8") for document in _documents(project))
    assert f"./raysteps {command}" in texts
