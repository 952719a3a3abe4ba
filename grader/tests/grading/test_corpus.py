"""Students' work that was written from the handouts and headers alone, with the verdict decided beforehand.

A few entries of each run, of some of the steps, drawn by a seed that is printed; RAYSTEPS_CORPUS=all grades every
one."""

import os
import random
import tomllib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest
from conftest import MakeSubmission

from raysteps.course.mutants import replaced_once
from raysteps.grading.pipeline import grade_submission
from raysteps.results.model import Settings, StepResult
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.submission.load import load_submission
from raysteps.toolchain.kit_artifacts import BuiltKit

pytestmark = pytest.mark.slow

_FOLDERS = [Path(__file__).parents[1] / name for name in ("corpus", "second_corpus")]  # two people's, apart
_ALL = os.environ.get("RAYSTEPS_CORPUS", "") == "all"
_RUN = "PYTEST_XDIST_TESTRUNUID"  # the same in all processes of a run, which must choose the same tests
_SEED = os.environ.get("RAYSTEPS_CORPUS_SEED") or os.environ.get(_RUN) or str(random.SystemRandom().randrange(10**9))
_GRADED_WITH = 20261123  # near the edge of a band the cases matter
_AS_KNOWN = 0.3  # points
_EACH = 1  # entries of each kind and step
_STEPS = 9  # of a run that does not grade all


@dataclass(frozen=True)
class Entry:
    """One file for one step. `known`: where the verdict is missed, the points that it has, or why."""

    step: str
    kind: str  # right, wrong or half
    name: str
    source: str
    low: float = 0.0
    high: float = 0.0
    known: float | str | None = None

    def fits(self, result: StepResult) -> bool:
        if self.kind == "right":
            return result.status == "passed"
        if self.kind == "wrong":
            return result.points < result.max
        return self.low <= result.points <= self.high


def _changed(sources: dict[str, str], entry: dict[str, Any]) -> str:
    source = sources[entry["of"]]
    for edit in entry["edits"]:
        source = replaced_once(source, edit["find"], edit["replace"], f"{entry['id']}: {edit['find']!r}")
    return source


def _of_files(folder: Path, table: dict[str, Any]) -> list[Entry]:
    """Each in a file of its own."""
    return [
        Entry(
            folder.name,
            one["kind"],
            one["id"],
            (folder / one["kind"] / f"{one['id']}.cpp").read_text(encoding="utf-8"),
            one.get("low", 0.0),
            one.get("high", 0.0),
        )
        for one in table["entry"]
    ]


def _of_edits(folder: Path, table: dict[str, Any]) -> list[Entry]:
    """The right ones in files, the others as changes of them."""
    sources = {path.stem: path.read_text(encoding="utf-8") for path in sorted(folder.glob("right/*.cpp"))}
    found = [Entry(folder.name, "right", name, source) for name, source in sources.items()]
    for kind in ("wrong", "half"):
        for one in table.get(kind, []):
            band = (one.get("low", 0.0), one.get("high", 0.0))
            found.append(Entry(folder.name, kind, one["id"], _changed(sources, one), *band))
    return found


def _entries(folder: Path) -> list[Entry]:
    table = tomllib.loads((folder / "corpus.toml").read_text(encoding="utf-8"))
    known = table.get("known", {})
    found = _of_files(folder, table) if "entry" in table else _of_edits(folder, table)
    assert known.keys() <= {one.name for one in found}
    return [replace(one, known=known.get(one.name)) for one in found]


_CORPUS = [one for room in _FOLDERS for folder in sorted(room.iterdir()) for one in _entries(folder)]


def _rounds() -> list[list[Entry]]:
    """Entries of different steps, which are graded together."""
    draw = random.Random(_SEED)
    columns: dict[tuple[str, str], list[Entry]] = {}
    for one in _CORPUS:
        columns.setdefault((one.step, one.kind), []).append(one)
    rounds: list[list[Entry]] = []
    for kind in ("right", "wrong", "half"):
        of_steps = [list(entries) for (_, its), entries in columns.items() if its == kind]
        for entries in of_steps:
            draw.shuffle(entries)
        of_steps = of_steps if _ALL else draw.sample(of_steps, min(_STEPS, len(of_steps)))
        most = max(map(len, of_steps)) if _ALL else _EACH
        rounds += [[entries[at] for entries in of_steps if at < len(entries)] for at in range(most)]
    return rounds


@pytest.mark.parametrize("entries", _rounds(), ids=lambda entries: f"{entries[0].kind}-{entries[0].name}")
def test_the_verdict_is_the_one_decided_beforehand(
    entries: list[Entry], whole_kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission
) -> None:
    print(f"RAYSTEPS_CORPUS_SEED={_SEED} draws the same")
    submission = load_submission(make_submission("corpus", {one.step: one.source for one in entries}), whole_kit.steps)
    settings = Settings(seed=_GRADED_WITH, only=tuple(one.step for one in entries), feedback="score")
    results = grade_submission(whole_kit.in_one_process(), submission, settings, LimitsOnly(), tmp_path / "out")
    graded = {result.id: result for result in results.steps}
    for one in entries:
        result = graded[one.step]
        place = f"{one.step}: {one.kind} {one.name}: {result.points} of {result.max} points, {result.status}"
        if one.kind == "half":
            place += f"; fair are {one.low} to {one.high}, known are {one.known}"
        assert one.fits(result) == (one.known is None), place
        if isinstance(one.known, float):
            assert abs(result.points - one.known) <= _AS_KNOWN, place


def test_there_is_enough_of_each_kind() -> None:
    amounts = [sum(one.kind == kind for one in _CORPUS) for kind in ("right", "wrong", "half")]
    assert amounts[0] >= 90
    assert amounts[1] >= 90
    assert amounts[2] >= 86
