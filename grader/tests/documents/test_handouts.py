"""The handouts: complete, true to the tests, and without the answer."""

import json
import re
import shlex
import subprocess
from pathlib import Path
from typing import Any

import pytest
from handout_counts import wrong_counts
from inspect_programs import open_workshop

from raysteps.cli.app import new_parser
from raysteps.cli.render import take_impl
from raysteps.course.manifest import Step, choose, kit_steps
from raysteps.course.project import Project, here
from raysteps.course.stubs import without_markers
from raysteps.toolchain.kit_artifacts import BuiltKit

_SECTIONS = [
    "What you will see",
    "Time and prerequisites",
    "Think first",
    "The idea",
    "The maths",
    "Your functions",
    "A worked example",
    "Check yourself",
    "Wrong pictures and their causes",
    "Inspect it",
    "Going further",
    "How it is graded",
    "Sources",
]
_STEPS = kit_steps(here())
_EACH = pytest.mark.parametrize("step", _STEPS, ids=[step.id for step in _STEPS])


def _handout(project: Project, step: Step) -> str:
    return (project.steps / step.id / "README.md").read_text(encoding="utf-8")


def _sections(text: str) -> dict[str, str]:
    """By their headings, in order."""
    parts = re.split(r"^## (.+)$", text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def _cases(project: Project, step: Step) -> list[str]:
    """The names of the step's visible tests."""
    sources = [path.read_text(encoding="utf-8") for path in sorted((project.steps / step.id).glob("*_test.cpp"))]
    return [name for source in sources for name in re.findall(r'^TEST_CASE\("([^"]+)"', source, re.MULTILINE)]


def _commands(text: str) -> list[list[str]]:
    """The words after ./raysteps of every line in a block of code, and of every such piece within a line."""
    blocks = re.findall(r"^```\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    lines = [line for block in blocks for line in block.splitlines()]
    lines += re.findall(
        r"`((?:RAYSTEPS_SEED=\d+ )?\./raysteps [^`]+)`", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    )
    found = [re.sub(r"^RAYSTEPS_SEED=\d+ ", "", line) for line in lines]
    return [shlex.split(line)[1:] for line in found if line.startswith("./raysteps ")]


@_EACH
def test_a_handout_has_all_sections_in_order(project: Project, step: Step) -> None:
    found = list(_sections(_handout(project, step)))
    assert [name for name in found if name in _SECTIONS] == _SECTIONS


@_EACH
def test_a_handout_tells_of_every_function(project: Project, step: Step) -> None:
    functions = _sections(_handout(project, step))["Your functions"]
    for name in step.functions:
        assert f"`{name}(" in functions, name


@_EACH
def test_a_worked_example_is_a_visible_test(project: Project, step: Step) -> None:
    example = " ".join(_sections(_handout(project, step))["A worked example"].split())
    groups = re.findall(r"Tests?(?: with these numbers)?: ((?:`[^`]+`(?: and )?)+)", example)
    named = [name for group in groups for name in re.findall(r"`([^`]+)`", group)]
    assert named, "name the test that checks these numbers"
    assert set(named) <= set(_cases(project, step))


@_EACH
def test_what_check_prints_has_the_right_numbers(project: Project, step: Step) -> None:
    printed = _sections(_handout(project, step))["Check yourself"]
    assert f"{step.id} {step.title}: passed, {step.points:g} of {step.points:g}" in printed
    assert f"  tests    all {len(_cases(project, step))} passed" in printed
    image = step.images[0]
    right = "0.00% wrong" if image.max_noise is None else "no more off than chance explains"
    assert f"  picture  {image.name}  {right}" in printed


@_EACH
def test_a_handout_tells_how_its_step_is_graded(project: Project, step: Step) -> None:
    graded = " ".join(_sections(_handout(project, step))["How it is graded"].split())
    assert graded.startswith(f"{step.points:g} points")
    for share, words in (
        (step.weight_tests, "are for the tests"),
        (step.weight_images, "for the pictures"),
        (step.weight_hidden, "for inputs and scenes that you do not see"),
        (step.weight_together, "for working with your own steps"),
    ):
        assert f"{100 * share:g} % {words}" in graded, words
    weights = zip(step.functions, step.function_weights, strict=True)
    worth = ", ".join(f"`{name}` {weight:g}" for name, weight in weights)
    assert f"{worth}, of {sum(step.function_weights):g} parts" in graded


@_EACH
def test_a_handout_shows_the_step_and_wrong_pictures(project: Project, step: Step) -> None:
    parts = _sections(_handout(project, step))
    assert f"/figures/{step.number}-after.png" in parts["What you will see"]
    assert parts["Wrong pictures and their causes"].count("![wrong: ") >= 6
    assert "/figures/" in parts["The idea"] + parts["The maths"]


@_EACH
def test_a_handout_asks_before_it_tells(project: Project, step: Step) -> None:
    """Questions, each with an answer that unfolds and says what is wrong with others."""
    asked = _sections(_handout(project, step))["Think first"]
    unfolds = r"^<details><summary>Answer</summary>\n\n(.+?)\n\n</details>$"
    answers = re.findall(unfolds, asked, re.MULTILINE | re.DOTALL)
    questions = re.split(r"<details>.*?</details>", asked, flags=re.DOTALL)[:-1]
    assert 2 <= len(answers) == asked.count("<details>") == len(questions)
    assert all("?" in question for question in questions)
    assert all("If you said" in answer for answer in answers)
    assert asked.count("\n**What do you expect") == 1


@_EACH
def test_hints_are_a_question_an_idea_and_pseudocode(project: Project, step: Step) -> None:
    """And the pseudocode stands in the last hint alone."""
    question, idea, code = step.hints
    assert "?" in question
    others = re.sub(r"\s", "", question + idea + _handout(project, step))
    for line in code.splitlines():
        for piece in re.split(r";  |  +", line):
            bare = re.sub(r"\s", "", piece)
            assert len(bare) < 20 or "=" not in bare or bare not in others, piece
    assert code.count("=") + code.count(":") > 3
    assert "=" not in question + idea


@_EACH
def test_no_handout_gives_a_line_of_the_solution_away(project: Project, step: Step) -> None:
    text = re.sub(r"\s|F\b", "", _handout(project, step))
    source = without_markers((project.solutions / step.path).read_text(encoding="utf-8"))
    for line in source.splitlines():
        code = re.sub(r"\s|F\b|//.*", "", line)
        assert len(code) < 26 or code.startswith("#include") or code not in text, line


def test_what_students_read_of_step_01_says_window_as_its_handout_does(project: Project) -> None:
    texts = [*(project.steps / "01-camera-rays").iterdir(), project.root / "framework" / "core" / "camera.hpp"]
    assert [path.name for path in texts if "image plane" in path.read_text(encoding="utf-8").lower()] == []
    assert "window" in _handout(project, _STEPS[0])


def test_every_command_line_of_a_handout_can_be_read(project: Project, kit: BuiltKit) -> None:
    raytrace = kit.reference("raytrace")
    seen = set()
    for step in _STEPS:
        for words in _commands(_handout(project, step)):
            seen.add(words[0])
            for word in words:
                assert not word.startswith("scenes/") or (project.root / word).is_file(), word
            if words[0] == "render":
                _, args = take_impl(words[1:])
                outcome = subprocess.run([raytrace, *args, "--help"], capture_output=True, text=True, check=False)
                assert outcome.returncode == 0, (words, outcome.stderr)
                continue
            arguments = new_parser(project).parse_args(words)
            if words[0] == "check":
                assert [one.id for one in choose(_STEPS, arguments.steps)] == [step.id]
            if words[0] == "hint":
                assert [one.id for one in choose(_STEPS, [arguments.step])] == [step.id]
    assert {"check", "render", "inspect", "hint", "watch"} <= seen


@pytest.mark.slow
def test_counts_in_the_tables_of_a_handout_are_counted(project: Project, kit: BuiltKit, tmp_path: Path) -> None:
    """In a students' kit, test_typed_in_students_kit asks the same."""
    inspect = open_workshop(project, tmp_path).reference("inspect")

    def printed(program: Path, args: list[str]) -> str:
        return subprocess.run([program, *args], capture_output=True, text=True, check=True, cwd=project.root).stdout

    def stats(args: list[str]) -> dict[str, Any]:
        file = tmp_path / "stats.json"
        printed(raytrace, [*args, "--quiet", "-o", str(tmp_path / "x.png"), "--stats", str(file)])
        found = json.loads(file.read_text(encoding="utf-8"))
        assert isinstance(found, dict)
        return found

    raytrace = kit.reference("raytrace")
    structures = set(printed(raytrace, ["--list-accel"]).split())
    for step in (step for step in _STEPS if step.is_about_a_tree):
        text = re.sub(
            r"<!-- students' kit:.*?-->|<!-- whole kit -->|<!-- end -->", "", _handout(project, step), flags=re.S
        )
        assert wrong_counts(text, step, structures, stats, lambda args: printed(inspect, args)) == []
        raised = re.sub(r"(\d) surfaces and", r"\g<1>7 surfaces and", text)
        assert len(wrong_counts(raised, step, structures, stats, lambda args: printed(inspect, args))) > 1


def test_a_line_that_cannot_be_read_is_found(kit: BuiltKit) -> None:
    raytrace: Path = kit.reference("raytrace")
    outcome = subprocess.run([raytrace, "x.nff", "--steps", "3", "--help"], capture_output=True, check=False)
    assert outcome.returncode == 2
    assert _commands("```\n./raysteps check 01\n```\nand `./raysteps list`") == [["check", "01"], ["list"]]
