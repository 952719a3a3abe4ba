"""Commands and numbers of the pages that students read are those of a students' kit with right steps."""

import json
import sys
from pathlib import Path
from typing import Any

import pytest
from doc_commands import Shown, missing, shown_in
from handout_counts import wrong_counts
from typed_commands import Typed, mentioned, typed

from raysteps.common.process import run
from raysteps.course.manifest import Step

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("students_kit")]

_TYPED = {"check", "compare", "inspect", "render"}  # the others wait for keys, change files or need a window


@pytest.fixture(scope="module")
def solved_kit(students_kit: Path, steps: list[Step], solved: dict[str, str]) -> Path:
    """The references as a student's own steps."""
    for step in steps:
        (students_kit / "steps" / step.path).write_text(solved[step.id], encoding="utf-8")
    return students_kit


@pytest.fixture(scope="module")
def checked(solved_kit: Path) -> str:
    """What one `check` of all steps prints: for each step the same as a check of that step."""
    return _printed(solved_kit, "check")


def _printed(root: Path, *words: str) -> str:
    """By the modules of the kit, and no others."""
    start = f"import sys; sys.path[0] = {str(root / 'grader' / 'src')!r}; sys.argv = ['raysteps', *{list(words)!r}]"
    program = f"{start}; import runpy; runpy.run_module('raysteps', run_name='__main__', alter_sys=False)"
    outcome = run(["env", "COLUMNS=120", "CI=1", sys.executable, "-c", program], seconds=900, cwd=root)
    assert outcome.code == 0, f"{words}: {outcome.stdout}{outcome.stderr}"
    return outcome.stdout + outcome.stderr


def _to_type(page: Path, text: str) -> list[Typed]:
    """In their order: a picture is rendered before it is compared."""
    blocks = [one for block in typed(page, text) for one in block]
    spans = [one for one in mentioned(page, text) if one.words[1:2] == ("compare",) and "reference/" in str(one.words)]
    known = [one for one in [*blocks, *spans] if not one.is_synopsis and one.words[0] == "./raysteps"]
    return [one for one in known if _TYPED.intersection(one.words[1:2])]


def test_the_commands_of_its_pages_do_what_the_pages_say(solved_kit: Path, checked: str, steps: list[Step]) -> None:
    pages = [*(solved_kit / "steps" / step.id / "README.md" for step in steps)]
    pages += [solved_kit / "docs" / f"{name}.md" for name in ("inspect", "maps")]
    said: dict[tuple[str, ...], str] = {}
    compared = 0
    for page in pages:
        text = page.read_text(encoding="utf-8")
        shown = {output.command: output for output in shown_in(page.relative_to(solved_kit), text)}
        for one in _to_type(page.relative_to(solved_kit), text):
            words = one.words[1:]
            if words not in said:
                said[words] = checked if words[0] == "check" else _printed(solved_kit, *words)
            wrong = missing(shown.get(one, Shown(one, ())).lines, said[words])
            assert wrong == "", f"{one}: this line was not printed, or not in its place\n{said[words]}"
            if words[0] == "compare":
                assert said[words].startswith("0 of 19200 pixels"), one
                compared += 1
    assert compared == len(steps)
    assert len(said) > 35


def test_the_counts_in_its_tables_are_its_own(solved_kit: Path, checked: str, steps: list[Step]) -> None:
    def stats(args: list[str]) -> dict[str, Any]:
        _printed(solved_kit, "render", *args, "-o", "counted.png", "--stats", "counted.json")
        found = json.loads((solved_kit / "counted.json").read_text(encoding="utf-8"))
        assert isinstance(found, dict)
        return found

    assert "passed" in checked
    structures = set(_printed(solved_kit, "render", "--list-accel").split())
    for step in (step for step in steps if step.is_about_a_tree):
        text = (solved_kit / "steps" / step.id / "README.md").read_text(encoding="utf-8")
        assert wrong_counts(text, step, structures, stats, lambda args: _printed(solved_kit, "inspect", *args)) == []


def test_what_students_read_names_no_command_of_the_whole_kit(solved_kit: Path) -> None:
    """Not in remarks of the manifests or contracts, either."""
    texts = [path for path in (solved_kit / "steps").rglob("*") if path.suffix in (".toml", ".hpp", ".cpp", ".md")]
    assert len(texts) > 36
    for path in texts:
        text = path.read_text(encoding="utf-8")
        assert not [word for word in ("raysteps dev", "raysteps grade", "the judge") if word in text], path
