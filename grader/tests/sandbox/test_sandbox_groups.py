"""Control groups, version 2, on a folder that stands for the kernel's."""

from pathlib import Path

import pytest

from raysteps.common.errors import GraderFault
from raysteps.sandbox import cgroups
from raysteps.sandbox.cgroups import Cgroup, Parents, find_parents
from raysteps.sandbox.monitor import Usage
from raysteps.sandbox.task import Limits


@pytest.fixture
def parents(tmp_path: Path) -> Parents:
    return Parents(tmp_path, tmp_path, tmp_path, unified=True)


def _content(path: Path) -> str:
    return path.read_text(encoding="ascii")


def test_limits_of_version_2(parents: Parents, tmp_path: Path) -> None:
    group = Cgroup(parents, "one", Limits(memory_mb=3, processes=7))
    assert group.folders == [tmp_path / "one"]
    assert _content(tmp_path / "one" / "memory.max") == str(3 << 20)
    assert _content(tmp_path / "one" / "pids.max") == "8"
    group.join(123)
    assert _content(tmp_path / "one" / "cgroup.procs") == "123"


def test_usage_of_version_2(parents: Parents, tmp_path: Path) -> None:
    group = Cgroup(parents, "one", Limits())
    (tmp_path / "one" / "cpu.stat").write_text("usage_usec 1500000\nuser_usec 9\n", encoding="ascii")
    (tmp_path / "one" / "memory.events").write_text("low 0\noom 3\noom_kill 0\n", encoding="ascii")
    assert group.usage() == Usage(cpu_seconds=1.5, out_of_memory=False)
    (tmp_path / "one" / "memory.events").write_text("low 0\noom 3\noom_kill 1\n", encoding="ascii")
    assert group.usage().out_of_memory


@pytest.mark.parametrize("unified", [False, True])
def test_a_victim_of_others_is_no_glutton(tmp_path: Path, *, unified: bool) -> None:
    group = Cgroup(Parents(tmp_path, tmp_path, tmp_path, unified=unified), "one", Limits(memory_mb=400))
    folder = tmp_path / "one"
    events, peak = ("memory.events", "memory.peak") if unified else ("memory.oom_control", "memory.max_usage_in_bytes")
    (folder / events).write_text("oom_kill 0\n", encoding="ascii")
    group.require_memory_of_the_machine()
    (folder / events).write_text("oom_kill 1\n", encoding="ascii")
    (folder / peak).write_text(f"{400 << 20}\n", encoding="ascii")
    group.require_memory_of_the_machine()
    (folder / peak).write_text(f"{40 << 20}\n", encoding="ascii")
    with pytest.raises(GraderFault, match="had no more memory"):
        group.require_memory_of_the_machine()


def test_an_older_kernel_tells_only_that_the_limit_was_met(parents: Parents, tmp_path: Path) -> None:
    group = Cgroup(parents, "one", Limits())
    (tmp_path / "one" / "memory.events").write_text("max 5\noom 1\noom_kill 1\n", encoding="ascii")
    group.require_memory_of_the_machine()
    (tmp_path / "one" / "memory.events").write_text("max 0\noom 0\noom_kill 1\n", encoding="ascii")
    with pytest.raises(GraderFault):
        group.require_memory_of_the_machine()


def test_the_nearest_group_that_passes_memory_and_processes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own = tmp_path / "user.slice" / "session.scope"
    own.mkdir(parents=True)
    (own / "cgroup.subtree_control").write_text("", encoding="ascii")
    (own.parent / "cgroup.subtree_control").write_text("cpu memory pids\n", encoding="ascii")
    (tmp_path / "cgroup.subtree_control").write_text("memory pids\n", encoding="ascii")
    monkeypatch.setattr(cgroups, "_mounted", lambda: ({}, tmp_path))
    monkeypatch.setattr(cgroups, "_own_paths", lambda: {"": "user.slice/session.scope"})
    found = [parents.memory for parents in cgroups._candidates()]
    assert found == [own.parent, tmp_path]


def test_a_place_where_groups_cannot_be_made_is_not_taken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cgroups, "_mounted", lambda: ({"memory": tmp_path / "m", "pids": tmp_path / "p"}, None))
    monkeypatch.setattr(cgroups, "_own_paths", dict)
    assert find_parents() is None
