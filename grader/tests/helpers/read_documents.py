"""Which documents of the kit each file of tests really opens in the processes of the tests. It is written where pytest
keeps what it knows between runs; `./raysteps test` compares it with what it takes to be read there."""

import json
import os
import re
import sys
from collections import defaultdict
from collections.abc import Generator
from pathlib import Path
from typing import Any, TypeAlias

import pytest

FOLDER = "documents"  # of pytest's cache
_MAY_BE, _IS_DOCUMENT = re.compile(r"docs\b|[.]md$"), re.compile(r"docs/|.*[.]md$")


_Key: TypeAlias = tuple[str, str]


def _key(fixture: pytest.FixtureDef[Any]) -> _Key:
    """Where it is defined, and its name, which a parameter of other tests may have, too."""
    return fixture.baseid, fixture.argname


class ReadDocuments:
    """A plugin. What is read for a fixture that many tests share is read for each of them."""

    def __init__(self, root: Path, out: Path) -> None:
        self._root, self._out = root.resolve(), out
        self._opened: set[str] = set()
        self._file = ""
        self._by_file: defaultdict[str, set[str]] = defaultdict(set)
        self._by_fixture: defaultdict[_Key, set[str]] = defaultdict(set)
        self._users: defaultdict[_Key, set[str]] = defaultdict(set)
        sys.addaudithook(self._note)

    def _note(self, event: str, arguments: tuple[Any, ...]) -> None:
        if event == "open" and isinstance(arguments[0], str | os.PathLike) and _MAY_BE.search(str(arguments[0])):
            path = Path(arguments[0]).resolve()
            if path.is_relative_to(self._root) and _IS_DOCUMENT.match(place := path.relative_to(self._root).as_posix()):
                self._opened.add(place)

    def _were_read_by(self, found: set[str]) -> None:
        """All that were opened since this was said last."""
        found |= self._opened
        self._opened.clear()

    @pytest.hookimpl(wrapper=True)
    def pytest_make_collect_report(self, collector: pytest.Collector) -> Generator[None, Any, Any]:
        """A file of tests is imported."""
        report = yield
        self._were_read_by(self._by_file[collector.nodeid.partition("::")[0]])
        return report

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Function) -> Generator[None, Any, Any]:
        """A test runs."""
        self._file = item.nodeid.partition("::")[0]
        for definitions in item._fixtureinfo.name2fixturedefs.values():
            for fixture in definitions:
                self._users[_key(fixture)].add(self._file)
        done = yield
        self._were_read_by(self._by_file[self._file])
        return done

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(self, fixturedef: pytest.FixtureDef[Any]) -> Generator[None, Any, Any]:
        """A fixture is made."""
        self._were_read_by(self._by_file[self._file])
        made = yield
        shared = fixturedef.scope != "function"
        self._were_read_by(self._by_fixture[_key(fixturedef)] if shared else self._by_file[self._file])
        return made

    def pytest_sessionfinish(self) -> None:
        """All ran."""
        for fixture, files in self._users.items():
            for file in files:
                self._by_file[file] |= self._by_fixture[fixture]
        found = {file: sorted(places) for file, places in self._by_file.items() if places}
        (self._out / f"{os.getpid()}.json").write_text(json.dumps(found), encoding="utf-8")
