"""The pages of a students' kit tell people to type only what can be typed there."""

import ast
import json
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from dataclasses import replace
from datetime import date
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest
from doc_commands import complaint
from typed_commands import Typed, mentioned, typed

from raysteps.cli.app import new_parser
from raysteps.common.errors import GraderFault
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.grading.scoring import max_points
from raysteps.release.build_release import first_steps, write_release
from raysteps.release.kit_pages import as_printed, for_students, readme
from raysteps.toolchain.kit_artifacts import BuiltKit

_NEEDS_REFERENCE = re.compile(r"--impl[ =]reference|--against\b|--accel[ =](?:boxes|wide)\S*|--spd\b")
_OF_A_STEP = ("check", "hint", "reset", "watch")


@pytest.fixture(scope="module", params=["1-4", "all"])
def released(
    request: pytest.FixtureRequest, kit: BuiltKit, steps: list[Step], tmp_path_factory: pytest.TempPathFactory
) -> Path:
    folder = tmp_path_factory.mktemp("course") / "kit"
    write_release(kit, first_steps([] if request.param == "all" else [request.param], steps), "Graphics 101", folder)
    return folder


def _imported(path: Path, *, at_once: bool) -> Iterator[str]:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in tree.body if at_once else ast.walk(tree):
        match node:
            case ast.Import():
                yield from (alias.name.partition(".")[0] for alias in node.names)
            case ast.ImportFrom(module=str(module), level=0):
                yield module.partition(".")[0]


def test_it_installs_what_it_imports_and_nothing_else(released: Path) -> None:
    table = tomllib.loads((released / "grader" / "pyproject.toml").read_text(encoding="utf-8"))
    usual, play = table["project"]["dependencies"], table["project"]["optional-dependencies"]["play"]
    brought = packages_distributions()

    def imported(*, at_once: bool) -> set[str]:
        paths = (released / "grader" / "src").rglob("*.py")
        modules = {name for path in paths for name in _imported(path, at_once=at_once)}
        others = modules - sys.stdlib_module_names - {"raysteps", "markupsafe"}  # Jinja2 brings MarkupSafe
        return {name.lower().replace("_", "-") for module in others for name in brought[module][:1]}

    assert imported(at_once=False) == {re.split("[=;]", name)[0] for name in [*usual, *play]}
    assert not imported(at_once=True) & {re.split("[=;]", name)[0] for name in play}


def _numbers(root: Path) -> list[str]:
    return sorted(path.parent.name[:2] for path in root.glob("steps/*/step.toml"))


def _unknown_step(root: Path, one: Typed) -> str:
    """A step that this kit does not have, in the words of a command."""
    numbers = _numbers(root)
    words = list(one.words)
    if "--step" in words[:-1]:
        number = words[words.index("--step") + 1]
        if number.isdecimal() and int(number) > int(numbers[-1]):
            return f"this kit ends with step {numbers[-1]}"
    if len(words) > 2 and words[1] in _OF_A_STEP and re.fullmatch("[0-9]{2}", words[2]) and words[2] not in numbers:
        return f"this kit has no step {words[2]}"
    return ""


def _wrong(root: Path, page: Path, text: str) -> list[str]:
    """All that this page says and the kit does not have."""
    found = [f"{page}: {words[0]}" for words in _NEEDS_REFERENCE.finditer(text)]
    parser = new_parser(Project(root))
    for one in [*(one for block in typed(page, text) for one in block), *mentioned(page, text)]:
        wrong = complaint(Project(root), one, parser) or _unknown_step(root, one)
        found += [f"{one}: {wrong}"] if wrong else []
    return found


def test_every_command_of_every_page_can_be_typed_there(released: Path) -> None:
    pages = sorted(released.rglob("*.md"))
    assert len(pages) > 12
    texts = {page.relative_to(released): page.read_text(encoding="utf-8") for page in pages}
    assert sum(len(block) for page, text in texts.items() for block in typed(page, text)) > 30
    assert [wrong for page, text in texts.items() for wrong in _wrong(released, page, text)] == []
    assert not [page for page, text in texts.items() if "<!--" in text]


_WRITES = ("-o", "--out", "--stats", "--json", "--html", "--screenshot")


def _helps(root: Path) -> Iterator[str]:
    parsers = new_parser(Project(root))._subparsers
    assert parsers is not None
    for action in parsers._group_actions:
        assert isinstance(action.choices, dict)
        yield from (" ".join(parser.format_help().split()) for parser in action.choices.values())


def test_git_takes_no_notice_of_what_commands_make(project: Project, released: Path, tmp_path: Path) -> None:
    """By themselves, and where the pages say so. A scene of one's own is no such thing."""
    made = {
        "three-spheres-1.ppm",
        "grades/results.json",
        "gallery/index.html",
    }  # S in a window; the whole kit
    for root in (project.root, released):
        made |= {name for text in _helps(root) for name in re.findall(r"\((build/\w+)\)", text)}
    for page in sorted(released.rglob("*.md")):
        text = page.read_text(encoding="utf-8")
        for one in [*(one for block in typed(page, text) for one in block), *mentioned(page, text)]:
            pairs = zip(one.words, one.words[1:], strict=False)
            made |= {word for option, word in pairs if option in _WRITES and not word.isupper()}
    made = {name for name in made if not re.search(r"[A-Z]{3}|\.(nff|pbrt)$", name)}
    assert {"out.png", "build/finale", "pixel.html"} <= made
    (tmp_path / ".gitignore").write_bytes((released / ".gitignore").read_bytes())
    subprocess.run(["git", "init", "--quiet", tmp_path], check=True)
    asked = ["git", "-C", str(tmp_path), "check-ignore", "--stdin"]
    ignored = subprocess.run(asked, input="\n".join(made), capture_output=True, text=True, check=True).stdout.split()
    assert set(ignored) == made


@pytest.mark.parametrize(
    "line",
    [
        "./raysteps demo",
        "./raysteps grade-class submissions",
        "./raysteps check 01 --seed 4",
        "./raysteps render scenes/lessons/glass.nff -o a.png --step 1 --impl reference",
        "./raysteps render scenes/lessons/glass.nff -o a.png --step 1 --accel boxes",
        "./raysteps inspect scenes/lessons/glass.nff 1 2 --against reference",
        "./raysteps render scenes/lessons/glass.nff -o a.png --step 10",
        "./raysteps check 10",
    ],
)
def test_what_the_kit_does_not_have_is_found(released: Path, line: str) -> None:
    for text in (f"words\n\n```\n{line}\n```\n", f"words `{line}` words\n"):
        assert _wrong(released, Path("README.md"), text), text


def test_an_editor_offers_the_steps_that_are_there(released: Path) -> None:
    for name in ("tasks", "launch"):
        table = json.loads((released / ".vscode" / f"{name}.json").read_text(encoding="utf-8"))
        (asked,) = [one for one in table["inputs"] if one["id"] == "step"]
        assert asked["options"] == _numbers(released)


def test_a_first_step_without_pictures(steps: list[Step]) -> None:
    """The README then shows how to draw that of the next step, or any."""
    bare = replace(steps[0], images=())
    assert f"render {steps[1].images[0].scene} -o first.png --step 2" in readme("Course", [bare, steps[1]]).decode()
    assert "-o first.png --step 1" in readme("Course", [bare]).decode()


def test_words_for_one_kind_of_kit() -> None:
    text = (
        "# A\n\nOne<!-- whole kit --> or `--impl reference`<!-- end -->.\n\n<!-- whole kit -->\nTwo\n\n```\nx\n```\n"
        "<!-- end -->\n<!-- students' kit:\nThree\nand four.\n-->\n\n- five<!-- students'\n  kit: , six -->\n"
        "\n| a | b<!-- whole kit --> |\n| c | d<!-- end --> |\n| e | f |\n\n```\ny\n\n\n\nz\n```\n"
    )
    assert for_students("a.md", text) == (
        "# A\n\nOne.\n\nThree\nand four.\n\n- five, six\n\n| a | b |\n| e | f |\n\n```\ny\n\n\n\nz\n```\n"
    )
    assert for_students("a.md", "as\n\n\n\nit was") == "as\n\n\n\nit was"


@pytest.mark.parametrize(
    "text",
    [
        "a <!-- whole kit --> b",
        "a <!-- end --> b",
        "<!-- whole kit -->\n<!-- whole kit -->\na\n<!-- end -->\n<!-- end -->\n",
    ],
)
def test_a_mark_without_its_partner_is_refused(text: str) -> None:
    with pytest.raises(GraderFault, match=r"a\.md: the mark"):
        for_students("a.md", text)


def test_a_printed_check_shows_the_points_that_students_see(steps: list[Step]) -> None:
    shown = "03-phong-shading Phong shading: passed, 15 of 15\n  tests    all 12 passed\n  hidden   all 8 passed\n"
    assert as_printed(shown, steps[2]) == (
        "03-phong-shading Phong shading: passed, 9.8 of 9.8\n  tests    all 12 passed\n"
    )


def test_the_readme_says_when_the_rest_follows(steps: list[Step]) -> None:
    soon, late = date(2026, 11, 2), date(2026, 11, 23)
    later = [(steps[4], late), (steps[2], soon), (steps[3], late)]
    page = readme("Graphics 101", steps[:2], "Autumn 2026", later).decode()
    assert page.startswith("# Graphics 101\n\nAutumn 2026.\n\n")
    assert "\n\nStep 3 follows on 2026-11-02, and steps 4-5 on 2026-11-23.\n\n## Begin" in page
    assert "follow" not in readme("Graphics 101", steps[:2]).decode().partition("## Begin")[0]


def test_every_handout_shows_such_a_check(released: Path, steps: list[Step]) -> None:
    for number in _numbers(released):
        step = next(step for step in steps if step.number == number)
        text = (released / "steps" / step.id / "README.md").read_text(encoding="utf-8")
        seen = max_points(step, judged=False)
        assert f": passed, {seen:g} of {seen:g}" in text
        assert "hidden   all" not in text
