"""The tags of the visible tests."""

import re

import pytest

from raysteps.course.manifest import kit_steps
from raysteps.course.project import Project

pytestmark = pytest.mark.portable

_CASE = re.compile(r'TEST_CASE\(\s*"(?P<name>[^"]*)",\s*"(?P<tags>(?:\[[^\[\]"]*\])+)"\)')


def test_every_visible_test_names_its_step_and_functions_of_it(project: Project) -> None:
    for step in kit_steps(project):
        asked: set[str] = set()
        for path in sorted((project.steps / step.id).glob("*_test.cpp")):
            text = path.read_text(encoding="utf-8")
            cases = list(_CASE.finditer(text))
            assert len(cases) == text.count("TEST_CASE("), path
            for case in cases:
                tags = set(case["tags"][1:-1].split("]["))
                functions = tags & set(step.functions)
                assert functions, f"{case['name']}: tag it with the function that it tests"
                assert tags == {step.id, *functions}, case["name"]
                asked |= functions
        assert asked == set(step.functions), step.id
