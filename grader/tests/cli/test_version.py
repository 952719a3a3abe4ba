"""One version for the command line, reports, releases, the package and the C++ programs."""

import re
import tomllib

import pytest
from update_kits import STEPS

from raysteps import __version__
from raysteps.cli.app import main
from raysteps.common.documents import as_text
from raysteps.course.project import Project
from raysteps.release.kit_pages import pyproject
from raysteps.results.model import Results
from raysteps.results.store import parse_results
from raysteps.updater.release_list import Release, encoded, parse

pytestmark = pytest.mark.portable


def test_the_command_line_tells_it(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="0"):
        main(["--version"])
    assert capsys.readouterr().out == f"raysteps {__version__}\n"


def test_the_package_and_cmake_read_it(project: Project) -> None:
    text = (project.root / "grader" / "pyproject.toml").read_text(encoding="utf-8")
    for form in (text, pyproject(text).decode()):
        table = tomllib.loads(form)
        assert table["project"]["dynamic"] == ["version"]
        assert table["tool"]["setuptools"]["dynamic"]["version"] == {"attr": "raysteps.__version__"}
    source = (project.root / "grader" / "src" / "raysteps" / "__init__.py").read_text(encoding="utf-8")
    assert re.findall(r'^__version__ = "(\d+\.\d+\.\d+)"$', source, re.MULTILINE) == [__version__]  # CMake's form


def test_results_tell_it_and_older_ones_need_not() -> None:
    results = Results.of("ann", [])
    assert results.version == __version__
    told = as_text(results).replace(f'"version": "{__version__}",', "")
    assert parse_results(told.encode()).version == ""


def test_releases_tell_it_and_older_ones_need_not() -> None:
    data = encoded(Release("Course", "abc", STEPS, ()))
    assert parse(data, "here").version == __version__
    assert parse(data.replace(f' "version": "{__version__}",\n'.encode(), b""), "here").version == ""


def test_the_changelog_begins_with_this_version(project: Project) -> None:
    text = (project.root / "CHANGELOG.md").read_text(encoding="utf-8")
    heads = re.findall(r"^## (.+)$", text, re.MULTILINE)
    assert re.fullmatch(rf"\[{re.escape(__version__)}\] - (unreleased|\d{{4}}-\d\d-\d\d)", heads[0])
