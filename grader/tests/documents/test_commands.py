"""Whatever the documents tell people to type can be typed."""

from pathlib import Path

import pytest
from doc_commands import all_commands, complaint
from typed_commands import typed

from raysteps.course.project import Project

pytestmark = pytest.mark.portable


def test_every_command_of_the_documents_can_be_read(project: Project) -> None:
    commands = all_commands(project)
    assert len(commands) > 150
    assert [f"{one}: {wrong}" for one in commands if (wrong := complaint(project, one))] == []


@pytest.mark.parametrize(
    "wrong",
    [
        "./raysteps chekc 01",
        "./raysteps render scenes/lessons/glass.nff -o a.png --steps 3",
        "./raysteps render scenes/lessons/glass.nff -o a.png --accel fast",
        "./raysteps render scenes/lessons/no-such.nff -o a.png",
        "./raysteps inspect SCENE X Y [--colour]",
        "python scenes/generate.py pyramids -o a.nff",
        "rayspets check 01",
    ],
)
def test_a_wrong_command_is_found(project: Project, wrong: str) -> None:
    [[one]] = typed(Path("README.md"), f"text\n\n```sh\n{wrong}\n```\n")
    assert complaint(project, one)


def test_lines_that_belong_together_are_one_command() -> None:
    text = "```sh\n# a remark\nSEED=7 ./raysteps check \\\n    01  # one step\ncd a && tar xf b\n```\n"
    assert [one.words for one in typed(Path("a.md"), text)[0]] == [
        ("./raysteps", "check", "01"),
        ("cd", "a"),
        ("tar", "xf", "b"),
    ]


def test_a_block_within_a_list_is_a_block() -> None:
    text = "1. Do this:\n\n   ```\n   ./raysteps list\n   cd a \\\n     b\n   ```\n"
    assert [one.words for one in typed(Path("a.md"), text)[0]] == [("./raysteps", "list"), ("cd", "a", "b")]
