"""Arrows between the rooms of the Python package run one way, and no module is reached in a circle."""

import ast
from collections import Counter
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from raysteps.course.project import Project

# From the ground up: a room imports from rooms of earlier lines, never from its own line or a later one.
_FLOORS = (
    {"__init__", "common", "bootstrap"},
    {"course", "updater"},
    {"sandbox", "submission"},
    {"results", "toolchain"},
    {"images", "judge"},
    {"diagnosis", "report"},
    {"grading"},
    {"classroom", "finale", "gallery", "models", "play", "progress"},
    {"desk", "exports", "inspector", "release", "watch"},
    {"cli"},
    {"__main__", "tools"},
)
# The first of all rooms hands over to the last, once everything is there.
_HANDS_OVER = {("raysteps.bootstrap.start", "raysteps.cli.app")}


def _modules(project: Project) -> dict[str, Path]:
    source = project.root / "grader" / "src"
    paths = [(source, path) for path in source.rglob("*.py")]
    paths += [(project.root, path) for path in (project.root / "tools").rglob("*.py")]
    found = {".".join(path.relative_to(base).with_suffix("").parts): path for base, path in paths}
    return {name.removesuffix(".__init__"): path for name, path in found.items()}


def _imports(modules: dict[str, Path], name: str, *, at_once: bool) -> Iterator[str]:
    """What a module imports, wherever it does so; with `at_once`, only what it needs to be imported itself."""
    tree = ast.parse(modules[name].read_text(encoding="utf-8"))
    for node in tree.body if at_once else ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module is not None:
            for alias in node.names:
                whole = f"{node.module}.{alias.name}"
                yield whole if whole in modules else node.module
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


def _room(module: str) -> str:
    first, _, rest = module.partition(".")
    return "tools" if first == "tools" else rest.partition(".")[0] or "__init__"


@pytest.fixture(scope="module")
def modules(project: Project) -> dict[str, Path]:
    found = _modules(project)
    assert len(found) > 200
    return found


def test_every_room_has_its_floor(modules: dict[str, Path]) -> None:
    assert {_room(name) for name in modules} == set().union(*_FLOORS)


def test_arrows_between_rooms_run_one_way(modules: dict[str, Path]) -> None:
    floor = {room: number for number, rooms in enumerate(_FLOORS) for room in rooms}
    wrong = [
        (name, other)
        for name in modules
        for other in _imports(modules, name, at_once=False)
        if other in modules
        and _room(name) != _room(other)
        and floor[_room(other)] >= floor[_room(name)]
        and _room(other) != "__init__"
        and (name, other) not in _HANDS_OVER
    ]
    assert wrong == []


def test_no_module_is_imported_in_a_circle(modules: dict[str, Path]) -> None:
    graph = {name: set(_imports(modules, name, at_once=True)) & modules.keys() - {name} for name in modules}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(f"in a circle: {' -> '.join(error.args[1])}")


def test_the_package_names_no_tool_but_in_the_table_of_commands(modules: dict[str, Path]) -> None:
    """Whoever installs the package has no tools."""
    named = {
        name
        for name, path in modules.items()
        if _room(name) != "tools"
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value.startswith("tools.")
    }
    assert named == {"raysteps.cli.app"}


def test_a_name_of_a_file_says_which_one_it_is(modules: dict[str, Path]) -> None:
    names = Counter(path.name for path in modules.values() if path.name != "__init__.py")
    assert [name for name, many in names.items() if many > 3] == []
