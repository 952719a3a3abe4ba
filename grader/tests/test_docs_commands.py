"""Whatever the documents tell people to type can be typed, and does what they say."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from doc_commands import all_commands, blocks_of, complaint, outputs_of

from raysteps.kit.built_kit import BuiltKit
from raysteps.kit.project import Project
from raysteps.upkeep.site.shell import Typed, typed

# Why these are only read here, and not run.
_ONLY_READ = {
    "bench": "takes minutes",
    "compare": "needs two pictures; test_compare does it",
    "check": "builds and grades the steps of whoever runs the tests; test_grading does it with known ones",
    "demo": "takes a minute; ./raysteps test runs it",
    "dev": "takes minutes; ./raysteps test runs what matters",
    "docs": "test_site does it",
    "export": "needs graded submissions, or packs the whole kit; the tests of the exports do it",
    "figures": "takes minutes; ./raysteps test asks for --check",
    "gallery": "draws for a minute; test_gallery does it small",
    "grade": "takes half a minute; test_grading does it",
    "grade-class": "takes minutes; test_class_run does it",
    "hint": "notes which hints were read",
    "leaderboard": "needs graded submissions; test_leaderboard does it",
    "release": "has tests of its own",
    "replay": "needs a case that went wrong; test_replay does it",
    "report": "needs results; test_pages_student does it",
    "reset": "writes over a step",
    "test": "is what runs this",
    "update": "has tests of its own",
    "view": "opens a window; test_view does it on a screen that nobody sees",
    "watch": "runs until somebody ends it",
}
_RUN = ("inspect", "list", "next", "render")


def _is_run(one: Typed) -> bool:
    if one.words[:2] == ("python", "scenes/generate.py"):
        return "--update" not in one.words
    return one.words[0] == "./raysteps" and one.words[1] in _RUN and not one.is_synopsis


def _with_reference(one: Typed) -> list[str]:
    """The command, of the reference's steps: nobody knows what the student's are when the tests run."""
    words = list(one.words)
    if "--against" in words:
        at = words.index("--against")
        del words[at : at + 2]
    own = words[1] in ("inspect", "render") and "--impl" not in words
    return [*words, "--impl", "reference"] if own else words


def _run(project: Project, words: list[str], folder: Path) -> str:
    program = (
        [sys.executable, "-m", "raysteps"] if words[0] == "./raysteps" else [sys.executable, str(folder / words[1])]
    )
    rest = words[1:] if words[0] == "./raysteps" else words[2:]
    environment = {**os.environ, "PYTHONPATH": str(project.root / "grader" / "src")}
    done = subprocess.run(
        [*program, *rest], cwd=folder, env=environment, capture_output=True, text=True, check=False, timeout=300
    )
    assert done.returncode == 0, f"{' '.join(words)}: {done.stderr}"
    return done.stdout


def _missing(shown: tuple[str, ...], printed: str) -> str:
    """The first line that the program did not print, or not in its place. A line of dots stands for some lines, dots at
    an end for a rest."""
    lines = iter(line.rstrip() for line in printed.splitlines())
    for line in (one.rstrip() for one in shown):
        head = line.removesuffix("...")
        if head.strip() and not any(there == line or (head != line and there.startswith(head)) for there in lines):
            return line
    return ""


def test_every_command_of_the_documents_can_be_read(project: Project) -> None:
    commands = all_commands(project)
    assert len(commands) > 150
    assert [f"{one}: {wrong}" for one in commands if (wrong := complaint(project, one))] == []


def test_every_command_is_run_or_there_is_a_reason(project: Project) -> None:
    used = {one.words[1] for block in blocks_of(project) for one in block if one.words[0] == "./raysteps"}
    assert {"check", "watch", "render", "inspect"} <= used
    assert sorted(used - {*_ONLY_READ, *_RUN}) == [], "run these commands here, or say in _ONLY_READ why not"


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


def test_shown_output_is_compared() -> None:
    assert _missing(("one", "...", "three is ...", "four"), "one\ntwo\nthree is 3\nfour\n") == ""
    assert _missing(("one", "three", "two"), "one\ntwo\nthree\n") == "two"
    assert _missing(("on",), "one\n") == "on"


@pytest.mark.slow
def test_the_commands_do_what_the_documents_say(project: Project, kit: BuiltKit, tmp_path: Path) -> None:
    for name in ("scenes", "steps"):
        (tmp_path / name).symlink_to(project.root / name, target_is_directory=True)
    shown = {output.command: output.lines for output in outputs_of(project)}
    done: dict[tuple[str, ...], str] = {}
    compared = 0
    for one in (one for block in blocks_of(project) for one in block if _is_run(one)):
        words = _with_reference(one)
        if tuple(words) not in done:
            done[tuple(words)] = _run(project, words, tmp_path)
        if one in shown and "--against" not in one.words:
            assert _missing(shown[one], done[tuple(words)]) == "", str(one)
            compared += 1
    assert len(done) > 20
    assert compared > 5
