"""Slips in a catalogue of known mistakes are told with their place."""

import re
from pathlib import Path

import pytest

from raysteps.common.errors import GraderFault
from raysteps.course.manifest import Step
from raysteps.course.mutants import read_mutants, reference_source
from raysteps.course.project import Project

pytestmark = pytest.mark.portable

_ENTRY = """
[[mutants]]
id = "NAME"
function = "view_frame"
name = "it is all wrong"
sees = "Nothing."
cause = "Who knows."
hint = "Look again."
find = '''
[[mutants]]
id = "no-entry"
find = 5'''
replace = "b"
"""


def _with(tmp_path: Path, step: Step, text: str) -> Project:
    path = tmp_path / "solutions" / step.id / "mutants.toml"
    path.parent.mkdir(parents=True)
    path.write_text(text, "utf-8")
    return Project(tmp_path)


@pytest.mark.parametrize(
    ("good", "slip", "told"),
    [
        ("sees =", "see =", "19:1: not a catalogue of mistakes: unknown key 'see'; did you mean sees?"),
        ("sees =", "# sees =", "15:1: not a catalogue of mistakes: sees is missing"),
        ('id = "two"', "", "15:1: not a catalogue of mistakes: id is missing"),
        ('id = "two"', 'id = "Two of them"', "16:1: not a catalogue of mistakes: id: expected a name of small letters"),
        ('id = "two"', 'id = "one"', "15:1: the id one occurs twice; expected another one"),
        ('"view_frame"', '"view_fram"', "15:1: two: view_fram is no function of the step; did you mean view_frame?"),
        ("[[mutants]]", "[mutants]", "15:1: is not TOML: [mutants] and [[mutants]] both stand there"),
    ],
)
def test_the_second_entry_is_named(tmp_path: Path, steps: list[Step], good: str, slip: str, told: str) -> None:
    second = _ENTRY.replace("NAME", "two").replace(good, slip, 1)
    project = _with(tmp_path, steps[0], _ENTRY.replace("NAME", "one") + second)
    with pytest.raises(GraderFault, match=f"mutants.toml:{re.escape(told)}"):
        read_mutants(project, steps[0])


def test_what_is_not_in_the_reference_is_told_with_its_entry(
    tmp_path: Path, project: Project, steps: list[Step]
) -> None:
    copy = _with(tmp_path, steps[0], _ENTRY.replace("NAME", "one") + _ENTRY.replace("NAME", "two"))
    _, second = read_mutants(copy, steps[0])
    with pytest.raises(GraderFault, match=r"mutants.toml:15:1: two: `find` occurs 0 times .*; copy it anew from there"):
        second.applied(reference_source(project, steps[0]))
