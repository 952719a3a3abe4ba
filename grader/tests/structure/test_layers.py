"""Arrows run one way only: core <- io, core <- steps (contracts) <- render <- inspect <- view <- apps."""

import re
from pathlib import Path

import pytest

from raysteps.course.project import Project

pytestmark = pytest.mark.portable

_INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)
_LAYERS = ("core", "io", "render", "inspect", "view", "wide", "apps", "worker", "remote", "testing", "web")
_ALLOWED = {
    "core": {"core"},
    "io": {"core", "io"},
    "render": {"core", "io", "steps", "render"},
    "inspect": {"core", "io", "steps", "render", "inspect"},
    "view": {"core", "io", "steps", "render", "inspect", "view"},
    "wide": {"core", "steps", "render", "wide"},
    "apps": {"core", "io", "steps", "render", "inspect", "view", "apps"},
    "worker": {"core", "io", "steps", "worker"},
    "remote": {"core", "steps", "render", "remote"},
    "testing": {"core", "testing"},
    "web": {"core", "io", "steps", "render", "web"},
}


def _sources(folder: Path) -> list[Path]:
    return sorted(path for path in folder.rglob("*") if path.suffix in (".hpp", ".cpp"))


def _layer(include: str) -> str | None:
    """The layer that an include belongs to; nothing for libraries."""
    first = include.split("/", 1)[0]
    return first if first in (*_LAYERS, "steps", "solutions", "bench") else None


def _includes(path: Path) -> list[str]:
    return _INCLUDE.findall(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("layer", _LAYERS)
def test_framework(project: Project, layer: str) -> None:
    files = _sources(project.root / "framework" / layer)
    assert files, f"framework/{layer} is empty"
    for path in files:
        allowed = set(_ALLOWED[layer])
        if path.name.endswith("_test.cpp") or path.name.startswith("test_"):
            allowed |= {"testing"} if layer in ("core", "io", "testing") else {"testing", "io", "render"}
        for include in _includes(path):
            found = _layer(include)
            assert ".." not in include, f"{path}: {include}"
            assert found is None or found in allowed, f"{path}: {layer} must not include {include}"
            assert not include.endswith(".cpp"), f"{path}: {include}"


def test_only_the_window_itself_knows_windows(project: Project) -> None:
    for path in _sources(project.root / "framework"):
        if not path.name.startswith("window"):
            assert not [name for name in _includes(path) if name.startswith(("GLFW/", "GL/"))], path


def test_the_benchmarks_stand_on_everything_and_nothing_stands_on_them(project: Project) -> None:
    files = _sources(project.root / "bench")
    assert files, "bench is empty"
    for path in files:
        for include in _includes(path):
            found = _layer(include)
            assert found in (None, "core", "io", "steps", "render", "bench"), f"{path}: must not include {include}"
            assert not include.endswith(".cpp"), f"{path}: {include}"


@pytest.mark.parametrize("room", ["steps", "solutions"])
def test_steps_know_core_and_earlier_contracts(project: Project, room: str) -> None:
    for path in _sources(project.root / room):
        step = path.relative_to(project.root / room).parts[0]
        for include in _includes(path):
            found = _layer(include)
            if found == "steps":
                assert include.split("/")[1] <= step, f"{path}: {include} belongs to a later step"
                assert include.endswith(".hpp"), f"{path}: {include}"
            elif path.name == "worker.cpp":  # how the judge asks a step of one's own
                assert found in (None, "core", "worker"), f"{path}: {include}"
            elif path.name.endswith("_test.cpp"):
                assert found in (None, "core", "testing"), f"{path}: {include}"
            else:
                assert found in (None, "core"), f"{path}: {include}"
