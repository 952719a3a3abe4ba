"""Which modules of the grader go out, and what they need."""

import ast
import re
import sys
import tomllib
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest

from raysteps.cli.app import COMMANDS
from raysteps.common.errors import GraderFault
from raysteps.course.project import Project
from raysteps.release.contents import needed_modules, package_files
from raysteps.release.kit_pages import pyproject
from raysteps.report.wording import after_the_last

# What goes out of the grader. A new room, or a new module in a room of which a part stays, is a decision: may those who
# solve the steps read it?
_ROOMS = {
    ".", "bootstrap", "cli", "common", "course", "finale", "grading", "images", "inspector", "models", "play",
    "play/static", "progress", "report", "report/static", "report/templates", "results", "sandbox", "submission",
    "toolchain", "updater", "watch",
}  # fmt: skip
_PARTS = {
    "cli": {
        "app", "check", "compare_pictures", "convert", "finale", "inspect", "play", "render", "report", "steps",
        "todo_steps", "update", "view", "watch",
    },
    "course": {"manifest", "project", "stubs"},
    "grading": {"build_messages", "images", "scoring", "self_check", "step", "unit_tests"},
    "inspector": {"model", "pixel_page", "records"},
}  # fmt: skip


@pytest.fixture(scope="module")
def out(project: Project) -> list[Path]:
    return package_files(project.root / "grader" / "src")


def test_which_modules_go_out_is_settled(project: Project, out: list[Path]) -> None:
    package = project.root / "grader" / "src" / "raysteps"
    assert {path.parent.relative_to(package).as_posix() for path in out} == _ROOMS
    for room, names in _PARTS.items():
        found = {path.stem for path in out if path.parent == package / room and path.suffix == ".py"}
        assert found == {*names, "__init__"}, room


def test_the_page_names_the_commands_that_go_out(project: Project) -> None:
    page = (project.root / "docs" / "release.md").read_text(encoding="utf-8")
    row = page.partition("| `grader/` | the commands ")[2].partition(", with the modules")[0]
    assert set(re.findall(r"`([\w-]+)`", row)) == {one.name for one in COMMANDS if one.kit != "whole"}


def _distribution(text: str) -> str:
    return re.split(r"[^\w-]", text, maxsplit=1)[0].lower().replace("_", "-")


def test_a_perfect_report_offers_only_commands_of_a_students_kit(out: list[Path]) -> None:
    there = {path.stem for path in out if path.parent.name == "cli"}
    assert {command.split()[1] for command, _ in after_the_last()} <= there


def test_the_package_names_all_that_its_modules_import(project: Project, out: list[Path]) -> None:
    table = tomllib.loads(pyproject((project.root / "grader" / "pyproject.toml").read_text(encoding="utf-8")).decode())
    listed = [table["project"]["dependencies"], *table["project"]["optional-dependencies"].values()]
    named = {_distribution(text) for some in listed for text in some}
    imported = set()
    for path in (path for path in out if path.suffix == ".py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            words = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            words += [node.module] if isinstance(node, ast.ImportFrom) and node.module and not node.level else []
            imported |= {word.partition(".")[0] for word in words}
    foreign = imported - set(sys.stdlib_module_names) - {"raysteps"}
    assert "numpy" in foreign
    of = packages_distributions()
    missing = {name for name in foreign if not named.intersection(map(_distribution, of.get(name, [name])))}
    assert missing <= {"markupsafe"}, "imported, and not named in pyproject.toml"  # Jinja2 is made of it


def test_a_module_for_students_that_needs_answers_is_found(tmp_path: Path) -> None:
    room = tmp_path / "raysteps"
    for name in ("", "judge", "cli"):
        (room / name).mkdir(exist_ok=True)
        (room / name / "__init__.py").write_text("")
    (room / "judge" / "plan.py").write_text("")
    (room / "cli" / "app.py").write_text("def later() -> None:\n    from raysteps.judge import plan\n")
    assert [path.name for path in needed_modules(tmp_path)] == ["__init__.py", "__init__.py", "app.py"]
    (room / "cli" / "app.py").write_text("from raysteps.judge import plan\n")
    with pytest.raises(GraderFault, match="which students do not get"):
        needed_modules(tmp_path)
