"""A plugin of pytest that writes down in which files something failed."""

from pathlib import Path

import pytest

from raysteps.common.files import write_json

_OPTION = "--failed-files"


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(_OPTION, type=Path, help="where to write the list")


def pytest_configure(config: pytest.Config) -> None:
    if config.getoption(_OPTION) and not hasattr(config, "workerinput"):  # once, not in each process of xdist
        config.pluginmanager.register(_Failed(config.getoption(_OPTION)))


class _Failed:
    def __init__(self, path: Path) -> None:
        self._path = path
        self._files: set[str] = set()

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed:
            self._files.add(report.nodeid.partition("::")[0])

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        if report.failed:
            self._files.add(report.nodeid.partition("::")[0])

    def pytest_sessionfinish(self) -> None:
        write_json(self._path, sorted(self._files))
