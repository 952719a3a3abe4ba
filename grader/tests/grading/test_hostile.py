"""Grades each attack of the corpus as an ordinary user, a sample as root: none of them pays, none of them hurts."""

import json
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Sources
from hostile.build import Attack, read_corpus
from hostile.ordinary import KIT_VARIABLE, same_tests_as_ordinary_user
from hostile.planting import Listener, planted
from hostile.running import Graded, Range
from hostile.traces import Traces
from PIL import Image

from raysteps.common.documents import as_text
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.sandbox import users
from raysteps.sandbox.detect import find_sandbox
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Sandbox, Task
from raysteps.toolchain import build_kit as kit_building
from raysteps.toolchain.kit_artifacts import BuiltKit

CORPUS = read_corpus()
_IS_ORDINARY = os.geteuid() != 0
_ALL = "RAYSTEPS_ALL_ATTACKS"  # set it to grade all of them as root, too
# Kinds that may end otherwise for root: processes, devices, what is shared, limits of a user, users and namespaces.
_DEPENDS_ON_THE_USER = {2, 4, 19, 21, 22, 24, 25, 26, 27, 28, 29, 31}
_AT_ONCE = 3
_SLACK = 6.0  # seconds, for what the grader and the kernel do around a program on a machine that is busy with others
_NUMBERS_WITHOUT_ENTRY = {33}  # docs/hostile.md says why
_USUAL = ["failed", "crashed", "timeout", "partial"]
_CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff]")


def _sample() -> list[Attack]:
    """The first of each kind, and all whose end may depend on who grades."""
    first = {number: attack for attack in reversed(CORPUS) for number in attack.numbers}
    return [one for one in CORPUS if one in first.values() or _DEPENDS_ON_THE_USER.intersection(one.numbers)]


ATTACKS = CORPUS if _IS_ORDINARY or _ALL in os.environ else _sample()
pytestmark = pytest.mark.xdist_group("hostile")  # the corpus is graded once


# Where it all happens


@pytest.fixture(scope="module")
def sandbox() -> Sandbox:
    found = find_sandbox()
    if not found.isolation.strong:
        pytest.skip("the corpus is for a strong sandbox; without one it would do harm")
    return found


@pytest.fixture(scope="module")
def temporary() -> Iterator[Path]:
    """All temporary files of the grader go here, so that what is left can be seen."""
    with (
        tempfile.TemporaryDirectory(prefix="hostile-", dir=tempfile.gettempdir()) as name,
        pytest.MonkeyPatch.context() as patch,
    ):
        Path(name).chmod(0o755)
        inner = Path(name, "temporary")
        inner.mkdir(mode=0o755)
        patch.setattr(tempfile, "tempdir", str(inner))
        yield Path(name)


@pytest.fixture(scope="module")
def own_kit(request: pytest.FixtureRequest, project: Project, steps: list[Step], temporary: Path) -> BuiltKit:
    """A copy, in which a secret can be planted. Root builds it; an ordinary user gets it."""
    given = os.environ.get(KIT_VARIABLE)
    if given is None:
        given = str(request.getfixturevalue("kit").folder)
    folder = temporary / "kit" / Path(given).name
    shutil.copytree(given, folder)
    return kit_building._load(project, steps, folder)


@pytest.fixture(scope="module")
def ordinary_user(
    request: pytest.FixtureRequest, own_kit: BuiltKit, sandbox: Sandbox
) -> Iterator[subprocess.Popen[str] | None]:
    """The same tests as another user, who grades all attacks; started first because it takes longest."""
    if _IS_ORDINARY or not _chosen(request, test_the_same_as_an_ordinary_user.__name__):
        yield None
        return
    with same_tests_as_ordinary_user(own_kit, Path(__file__)) as process:
        yield process


@pytest.fixture(scope="module")
def traces(temporary: Path, ordinary_user: subprocess.Popen[str] | None) -> Traces:
    lent = range(users._FIRST, users._FIRST + users._COUNT)
    own = range(os.geteuid(), os.geteuid() + 1)
    spared = set() if ordinary_user is None else {ordinary_user.pid}
    return Traces(temporary / "temporary", lent if os.geteuid() == 0 else own, lambda: spared)


@pytest.fixture(scope="module")
def place(own_kit: BuiltKit, temporary: Path, solved: Sources) -> Iterator[Range]:
    folder = temporary / "attacks"
    folder.mkdir()
    listener = Listener(temporary)
    try:
        with planted(own_kit, temporary) as secret:
            yield Range(own_kit, secret, listener, solved, folder)
    finally:
        listener.close()


@pytest.fixture(scope="module")
def before(traces: Traces, place: Range) -> set[str]:
    """With the server that forks keepers, which stays as long as this process."""
    LimitsOnly().run(Task(("/bin/true",)))
    return traces.now()


class Batch:
    """Attacks, some at a time: they mostly wait."""

    def __init__(self, pool: ThreadPoolExecutor, place: Range, sandbox: Sandbox, attacks: list[Attack]) -> None:
        self._futures = {attack.name: pool.submit(place.grade, attack, sandbox) for attack in attacks}

    def graded(self, attack: Attack) -> Graded:
        return self._futures[attack.name].result()

    def wait(self) -> None:
        wait(self._futures.values())


@pytest.fixture(scope="module")
def batch(request: pytest.FixtureRequest, place: Range, sandbox: Sandbox, before: set[str]) -> Iterator[Batch]:
    """The attacks whose tests were chosen."""
    attacks = [_attack_of(item) for item in _chosen(request, test_attack.__name__)]
    with ThreadPoolExecutor(max_workers=_AT_ONCE) as pool:
        yield Batch(pool, place, sandbox, attacks)
        pool.shutdown(cancel_futures=True)


def _chosen(request: pytest.FixtureRequest, test: str) -> list[pytest.Function]:
    items = [item for item in request.session.items if isinstance(item, pytest.Function)]
    return [item for item in items if item.originalname == test]


def _attack_of(item: pytest.Function) -> Attack:
    attack = item.callspec.params["attack"]
    assert isinstance(attack, Attack)
    return attack


# What must be true of every attack


def _strings(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for key, inner in value.items():
            yield key
            yield from _strings(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from _strings(inner)


def _check_words(out: Path) -> None:
    document = json.loads((out / "results.json").read_text(encoding="utf-8"))
    for text in _strings(document):
        assert _CONTROL.search(text) is None, repr(text[:300])
        assert len(text) <= 70_000
    assert (out / "results.json").stat().st_size < 1 << 20


def _check_secret(graded: Graded, secret: str) -> None:
    hidden = secret.encode()
    for path in graded.out.rglob("*"):
        if path.is_file():
            data = path.read_bytes()
            if path.suffix == ".png":
                data += np.asarray(Image.open(path)).tobytes()
            assert hidden not in data, path
    assert secret not in graded.refused
    assert not [run.command for run in graded.runs if run.leaked]


def _slow(graded: Graded) -> list[str]:
    """What took longer than it may."""
    slow = [f"{run.command} ran {run.seconds:.1f} s" for run in graded.runs if run.seconds > run.limit + _SLACK]
    if graded.seconds >= sum(run.limit for run in graded.runs) + _SLACK and not graded.refused:
        slow.append(f"it was graded in {graded.seconds:.1f} s")
    return slow


@pytest.mark.parametrize("attack", ATTACKS, ids=lambda attack: attack.name)
def test_attack(attack: Attack, batch: Batch, place: Range, sandbox: Sandbox) -> None:
    seen = batch.graded(attack)
    _check_attack(attack, seen, place)
    if _slow(seen):  # what the attack did, it does again; other programs on the machine may have been in the way
        batch.wait()
        again = place.grade(attack, sandbox, f"{attack.name}-again")
        assert not _slow(again), _slow(seen)
        _check_attack(attack, again, place)


def _check_attack(attack: Attack, seen: Graded, place: Range) -> None:
    assert not seen.trace.exists()
    _check_secret(seen, place.planted.text)
    if attack.refused:
        assert attack.refused in seen.refused
        return
    assert not seen.refused
    assert seen.taken >= {*attack.honest, *attack.beside}
    _check_words(seen.out)
    for results in seen.results:
        result = next(step for step in results.steps if step.id == attack.step)
        report = as_text(results)
        assert attack.least <= result.points <= attack.most, report
        assert result.status in (attack.status or _USUAL), report
        assert attack.note in " ".join(result.messages), report
        for step in results.steps:
            if step.id in attack.honest:
                assert (step.status, step.points) == ("passed", step.max), report
        if attack.submission:
            assert results.submission == attack.submission
        assert results.isolation.strong


def test_nothing_is_heard(batch: Batch, place: Range) -> None:
    batch.wait()
    assert not place.listener.heard


def test_nothing_is_left_behind(batch: Batch, traces: Traces, before: set[str]) -> None:
    batch.wait()
    assert not traces.left_since(before)


# What must be true of the corpus


@pytest.mark.parametrize("attack", [attack for attack in ATTACKS if attack.outside], ids=lambda attack: attack.name)
def test_an_attack_is_real(attack: Attack, place: Range, temporary: Path) -> None:
    """Without a sandbox it reaches its aim; else its failure in one would prove nothing."""
    folder = temporary / f"{attack.name}-socket"
    folder.mkdir()
    listener = Listener(folder)
    try:
        graded = replace(place, listener=listener).grade(attack, LimitsOnly(), f"{attack.name}-outside")
    finally:
        listener.close()
    assert graded.results[0].steps[0].points > 0, graded.results[0].steps[0].messages


def test_every_kind_of_attack_has_an_entry() -> None:
    for attacks in (CORPUS, _sample()):
        numbers = {number for attack in attacks for number in attack.numbers}
        assert numbers | _NUMBERS_WITHOUT_ENTRY == set(range(1, 39))
    for attack in CORPUS:
        assert int(attack.name[:2]) in attack.numbers, attack.name


def test_the_page_names_every_attack(project: Project) -> None:
    page = (project.root / "docs" / "hostile.md").read_text(encoding="utf-8")
    missing = [attack.name for attack in CORPUS if f"`{attack.name}`" not in page]
    assert not missing


@pytest.mark.skipif(_IS_ORDINARY, reason="for root, who can become somebody else")
def test_the_same_as_an_ordinary_user(ordinary_user: subprocess.Popen[str] | None) -> None:
    assert ordinary_user is not None
    output, _ = ordinary_user.communicate(timeout=1800)
    assert ordinary_user.returncode == 0, output[-8000:]
    passed = re.search(r"(\d+) passed", output)
    assert passed is not None, output[-2000:]
    assert int(passed[1]) >= len(CORPUS), output[-2000:]  # each attack is a test
