"""The names and tags of the visible tests, as the reference ran them: a students' kit cannot ask it again."""

import json
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_json
from raysteps.kit.project import Project

Tests = dict[str, dict[str, list[str]]]  # by step and name: the tags


def given_tests(project: Project) -> Path:
    return project.given / "tests.json"


def write_given_tests(project: Project, tests: Tests) -> None:
    write_json(given_tests(project), tests)


def read_given_tests(project: Project) -> Tests:
    path = given_tests(project)
    try:
        tests: Tests = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise GraderFault(f"{path}: expected the list of the tests; take it from a fresh copy of the kit") from error
    return tests
