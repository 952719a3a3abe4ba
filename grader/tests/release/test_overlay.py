"""Files that take another's place in a students' kit: the one that they replace is there, and its header stays."""

import re

import pytest

from raysteps.course.manifest import read_steps
from raysteps.course.project import Project, here
from raysteps.release.contents import kit_contents

_OVERLAY = here().root / "grader" / "src" / "raysteps" / "release" / "overlay"
_REPLACED = sorted(path.relative_to(_OVERLAY).as_posix() for path in (_OVERLAY / "framework").rglob("*.cpp"))


@pytest.fixture(scope="module")
def contents() -> dict[str, bytes]:
    return kit_contents(here(), read_steps(here()), [])


def test_each_is_told_of(project: Project) -> None:
    assert len(_REPLACED) > 3
    told = (project.root / "docs" / "release.md").read_text(encoding="utf-8")
    assert [name for name in _REPLACED if f"| `{name.removeprefix('framework/')}` |" not in told] == []


@pytest.mark.parametrize("name", _REPLACED)
def test_it_replaces_a_file_of_the_framework(project: Project, contents: dict[str, bytes], name: str) -> None:
    whole = project.root / name
    assert whole.is_file(), f"{name}: expected the whole kit's file of that name"
    assert contents[name] == (_OVERLAY / name).read_bytes() != whole.read_bytes()
    headers = re.findall(r'#include "(\w+/\w+\.hpp)"', whole.read_text(encoding="utf-8"))
    assert headers, "it defines what no header declares"
    for declared in (f"framework/{header}" for header in headers):
        assert contents[declared] == (project.root / declared).read_bytes()
