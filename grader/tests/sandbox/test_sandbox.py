"""Every sandbox runs honest programs, and holds those that are not."""

import os
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from types import SimpleNamespace

import pytest
from sandboxes import (
    PROGRAM,
    Misbehave,
    any_sandbox,
    control_groups,
    hostile,
    misbehave,
    processes_running,
    sandbox,
    secret,
)
from watch_fakes import wait_for

from raysteps.course.project import here
from raysteps.sandbox.lockdown import syscall_filter
from raysteps.sandbox.monitor import descendants
from raysteps.sandbox.task import Input, Limits, Output, Sandbox, Task, TaskResult, Word
from raysteps.sandbox.task_dir import fresh_task_dir

__all__ = ["any_sandbox", "hostile", "misbehave", "sandbox", "secret"]  # pytest finds fixtures by name


def _compile(sandbox: Sandbox, source: Path, *options: str) -> TaskResult:
    return sandbox.run(Task(("c++", *options, "-c", Input(source), "-o", Output("out.o")), tools=True))


# Honest programs


def test_a_copied_program_runs_whatever_starts_at_that_moment() -> None:
    """A child has, until it is another program, all that this process has open: also a copy that is being written."""
    done = threading.Event()
    program = Path(shutil.which("true") or "")

    def start_others() -> None:
        while not done.is_set():
            subprocess.run([program], check=True)

    with ThreadPoolExecutor() as pool, fresh_task_dir(user=None) as place:
        others = [pool.submit(start_others) for _ in range(4)]
        try:
            for _ in range(400):
                subprocess.run([place.copied(program, program.name, to_run=True)], check=True)
        finally:
            done.set()
        for other in others:
            other.result()


def test_a_program_reads_and_writes(any_sandbox: Sandbox, hostile: Path, tmp_path: Path) -> None:
    scene = tmp_path / "scene.nff"
    scene.write_text("sphere\n", encoding="ascii")
    read = any_sandbox.run(Task((Input(hostile), "read", Input(scene, "0.nff"))))
    assert (read.outcome.code, read.outcome.stdout, read.stopped) == (0, "sphere\n", "")
    echo = any_sandbox.run(Task((Input(hostile), "echo"), stdin=b"hello\n" * 100_000))
    assert echo.outcome.stdout == "hello\n" * 100_000
    written = any_sandbox.run(Task((Input(hostile), "write", Output("a.ppm"), "2")))
    assert written.outcome.code == 0
    assert written.outputs == {"a.ppm": b"x" * (2 << 20)}
    nothing = any_sandbox.run(Task((Input(hostile), "code", "0", Output("a.ppm"))))
    assert nothing.outputs == {}


@pytest.mark.parametrize("code", [0, 1, 3, 127])
def test_exit_codes(any_sandbox: Sandbox, misbehave: Misbehave, code: int) -> None:
    outcome = misbehave(any_sandbox, "code", str(code)).outcome
    assert (outcome.code, outcome.signal_name, outcome.timed_out) == (code, None, False)


@pytest.mark.parametrize("number", [signal.SIGSEGV, signal.SIGABRT, signal.SIGKILL])
def test_signals(any_sandbox: Sandbox, misbehave: Misbehave, number: signal.Signals) -> None:
    assert misbehave(any_sandbox, "signal", str(int(number))).outcome.signal_name == number.name


def test_compiling_and_linking(any_sandbox: Sandbox, tmp_path: Path) -> None:
    source = tmp_path / "one.cpp"
    source.write_text("#include <vector>\nint main() { return int(std::vector<int>{4, 3}.size()); }\n")
    compiled = _compile(any_sandbox, source)
    assert compiled.outcome.code == 0, compiled.outcome.stderr
    object_file = tmp_path / "one.o"
    object_file.write_bytes(compiled.outputs["out.o"])
    linked = any_sandbox.run(Task(("c++", Input(object_file), "-o", Output("one")), tools=True))
    assert linked.outcome.code == 0, linked.outcome.stderr
    program = tmp_path / "one"
    program.write_bytes(linked.outputs["one"])
    program.chmod(0o700)
    assert any_sandbox.run(Task((Input(program),))).outcome.code == 2


def test_folders_are_inputs(any_sandbox: Sandbox, tmp_path: Path) -> None:
    (tmp_path / "include" / "core").mkdir(parents=True, mode=0o700)
    (tmp_path / "include" / "core" / "a.hpp").write_text("inline int a() { return 1; }\n")
    (tmp_path / "b.cpp").write_text('#include "core/a.hpp"\nint b() { return a(); }\n')
    folder = Input(tmp_path / "include")
    task = Task(("c++", "-c", "-I", folder, Input(tmp_path / "b.cpp"), "-o", Output("b.o")), tools=True)
    ran = any_sandbox.run(task)
    assert ran.outcome.code == 0, ran.outcome.stderr


def test_the_environment_is_empty(any_sandbox: Sandbox, misbehave: Misbehave, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TOKEN", "secret")
    names = {line.partition("=")[0] for line in misbehave(any_sandbox, "environment").outcome.stdout.splitlines()}
    assert names <= {"LC_ALL", "HOME", "PWD", "TMPDIR"}


def test_no_open_files_but_its_own(any_sandbox: Sandbox, misbehave: Misbehave, tmp_path: Path) -> None:
    with (tmp_path / "open").open("w") as file:
        file.write("x")
        words = misbehave(any_sandbox, "files", Output("a")).outcome.stdout.split()
    assert words[:3] == ["0", "1", "2"]
    assert len(words) == 4


# What must not be seen or reached


def test_network_is_refused(sandbox: Sandbox, misbehave: Misbehave) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = str(server.getsockname()[1])
        assert misbehave(sandbox, "connect", port).outcome.code == 1


def test_nobody_outside_is_written_to(sandbox: Sandbox, misbehave: Misbehave) -> None:
    """By one of two sockets that belong to each other, to one that has a name in a folder of everybody's."""
    with tempfile.TemporaryDirectory(dir="/tmp") as folder, socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as heard:
        Path(folder).chmod(0o755)
        path = Path(folder, "socket")
        heard.bind(str(path))
        path.chmod(0o666)
        heard.settimeout(0.1)
        assert misbehave(sandbox, "send", str(path)).outcome.code == 1
        with pytest.raises(TimeoutError):
            heard.recv(10)


def test_a_program_cannot_read_secrets(sandbox: Sandbox, misbehave: Misbehave, secret: Path) -> None:
    solution = next(here().solutions.rglob("*.cpp"))
    for path in (secret, solution, Path("/etc/passwd")):
        assert path.read_text(encoding="utf-8")
        ran = misbehave(sandbox, "read", str(path))
        assert (ran.outcome.code, ran.outcome.stdout) == (1, "refused\n")


def test_no_other_process_tells_of_the_grader(
    sandbox: Sandbox, hostile: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first process inside is bubblewrap's own, and it is as readable as any."""
    monkeypatch.setenv("TOKEN", "trap-for-cheats")
    scene = tmp_path / "trap-for-cheats.nff"
    scene.write_text("sphere\n", encoding="ascii")
    for file in ("/proc/1/environ", "/proc/1/cmdline", "/proc/1/maps"):
        said = sandbox.run(Task((Input(hostile, PROGRAM), "read", file, Input(scene, "1.nff"))))
        assert "trap" not in said.outcome.stdout + said.outcome.stderr


def test_a_neutral_name_is_all_that_is_told(sandbox: Sandbox, hostile: Path, tmp_path: Path) -> None:
    scene = tmp_path / "trap-for-cheats.nff"
    scene.write_text("sphere\n", encoding="ascii")
    for file in ("/proc/self/mountinfo", "/proc/self/cmdline", "/proc/self/environ"):
        task = Task((Input(hostile, PROGRAM), "read", file), inputs=(Input(scene, "1.nff"),))
        said = sandbox.run(task).outcome.stdout
        assert said
        assert "trap" not in said


@pytest.mark.parametrize(
    "text",
    [
        '#include "{}"\n',
        'asm(".incbin \\"{}\\"");\n',
        '#if __has_include("{}")\n#error the answer is known\n#endif\nint a = ;\n',
    ],
)
def test_a_source_cannot_read_secrets(sandbox: Sandbox, secret: Path, tmp_path: Path, text: str) -> None:
    source = tmp_path / "spy.cpp"
    source.write_text(text.format(secret), encoding="ascii")
    ran = _compile(sandbox, source)
    assert ran.outcome.code != 0
    assert "answer" not in ran.outcome.stderr + ran.outcome.stdout
    assert ran.outputs == {}


def test_the_test_framework_is_hidden(sandbox: Sandbox, tmp_path: Path) -> None:
    source = tmp_path / "listener.cpp"
    source.write_text(
        "#if __has_include(<catch2/catch_all.hpp>) || __has_include(<catch2/catch.hpp>)\n#error found\n#endif\n"
    )
    assert "found" not in _compile(sandbox, source).outcome.stderr


def test_the_grader_cannot_be_killed(sandbox: Sandbox, misbehave: Misbehave) -> None:
    with subprocess.Popen(["sleep", "30"]) as bystander:
        ran = misbehave(sandbox, "kill", str(bystander.pid))
        assert ran.outcome.code == 1
        assert bystander.poll() is None
        bystander.kill()


# Limits


def test_sleeping_is_ended(any_sandbox: Sandbox, misbehave: Misbehave) -> None:
    """It would never end by itself."""
    ran = misbehave(any_sandbox, "stubborn", wall_seconds=1)
    assert ran.stopped == "wall"
    assert ran.outcome.timed_out


def test_an_interrupt_is_for_the_grader_alone(any_sandbox: Sandbox, hostile: Path) -> None:
    """A terminal sends it to the whole group, and what a sandbox consists of must not die before what it holds."""
    name, before = f"{PROGRAM}-held", descendants(os.getpid())
    task = Task((Input(hostile, name), "stubborn"), Limits(wall_seconds=600, cpu_seconds=600))
    with ThreadPoolExecutor(1) as pool:
        ran = pool.submit(any_sandbox.run, task)
        try:
            wait_for(lambda: bool(processes_running(name)))
            for pid in descendants(os.getpid()) - before:
                with suppress(ProcessLookupError):
                    if os.getpgid(pid) == os.getpgrp():
                        os.kill(pid, signal.SIGINT)
        finally:
            task.abandoned.set()
    assert ran.result().stopped == "wall"
    assert processes_running(name) == []


@pytest.mark.parametrize("processes", [1, 2])
def test_computing_is_ended(any_sandbox: Sandbox, misbehave: Misbehave, processes: int) -> None:
    ran = misbehave(any_sandbox, "spin", str(processes), cpu_seconds=1)
    assert ran.stopped == "cpu"
    assert not ran.outcome.timed_out
    assert 0.9 < ran.cpu_seconds < 3


def test_cpu_time_is_told(any_sandbox: Sandbox, misbehave: Misbehave) -> None:
    ran = misbehave(any_sandbox, "spin", "1", "0.3")
    assert ran.outcome.code == 0
    assert 0.3 <= ran.cpu_seconds < 1.5


@pytest.mark.parametrize("eaters", [0, 6])
def test_memory_is_limited(any_sandbox: Sandbox, misbehave: Misbehave, eaters: int) -> None:
    many = [str(eaters)] if eaters else []
    words = ("eat", "100" if eaters else "6000", *many)
    ran = misbehave(any_sandbox, *words, memory_mb=300)
    assert ran.outcome.code != 0
    assert ran.stopped != "wall"
    assert "full" not in ran.outcome.stdout
    if eaters:
        assert ran.stopped == "memory"


def test_the_kernel_ends_a_submission_before_a_grader(sandbox: Sandbox, misbehave: Misbehave) -> None:
    if sandbox.isolation.name != "bubblewrap":
        pytest.skip("only a strong sandbox keeps a neighbour's memory from a grader")
    assert misbehave(sandbox, "read", "/proc/self/oom_score_adj").outcome.stdout == "1000\n"
    assert misbehave(sandbox, "spare").outcome.code == 1


def test_memory_that_no_process_owns_is_refused(sandbox: Sandbox, misbehave: Misbehave) -> None:
    assert misbehave(sandbox, "hoard", "40").outcome.code == 1


def test_no_task_tells_another_anything_by_the_files_of_the_machine(sandbox: Sandbox, misbehave: Misbehave) -> None:
    """Not by locks, watches or the times of devices, which would stay; nor does it get what else it has no use for."""
    if syscall_filter() is None:
        pytest.skip("there is no filter for this machine")
    before = Path("/dev/null").stat().st_mtime_ns
    assert misbehave(sandbox, "ask").outcome.stdout == ""
    assert Path("/dev/null").stat().st_mtime_ns == before


def _filtered(machine: str, number: int, *arguments: int) -> bool:
    """Whether the filter lets this call go, as the kernel would run it."""
    architecture = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}[machine]
    call = struct.pack("<IIQ6Q", number, architecture, 0, *arguments, *[0] * (6 - len(arguments)))
    steps = struct.iter_unpack("=HBBI", syscall_filter() or b"")
    held = to_skip = 0
    for code, if_true, if_false, value in steps:
        if to_skip:
            to_skip -= 1
        elif code == 0x20:
            held = int.from_bytes(call[value : value + 4], "little")
        elif code == 0x06:
            return bool(value == 0x7FFF0000)
        else:
            holds = {0x15: held == value, 0x35: held >= value, 0x45: held & value != 0}[code]
            to_skip = if_true if holds else if_false
    raise AssertionError("the filter has no end")


@pytest.mark.skipif(sys.platform != "linux", reason="filters are for Linux")
def test_an_argument_is_never_taken_for_the_number_of_a_call(monkeypatch: pytest.MonkeyPatch) -> None:
    """Such as flags that are as large as the number of openat, behind which a mode lies that nobody set."""
    monkeypatch.setattr(os, "uname", lambda: SimpleNamespace(machine="x86_64"))
    opening, clone, prlimit, fcntl, ioctl, waiting, unbuffered = 2, 56, 302, 72, 16, 0x101000, 0x4000
    for allowed in (
        (opening, 0, os.O_WRONLY | os.O_NOCTTY, waiting),
        (opening, 0, 0o200000),
        (clone, opening, waiting),
        (prlimit, 0, 5),
        (fcntl, 3, 2, waiting),
        (fcntl, 3, 1030, unbuffered),
        (fcntl, 3, 4, os.O_NONBLOCK),
        (ioctl, 1, 0x5401),
    ):
        assert _filtered("x86_64", *allowed), allowed
    for refused in (
        (opening, 0, waiting),
        (opening, 0, unbuffered),
        (257, 0, 0, unbuffered),
        (clone, 0x20000000),
        (prlimit, 1),
        (fcntl, 3, 6),
        (fcntl, 3, 4, unbuffered),
        (ioctl, 3, 0x40086602),
        (ioctl, 3, 0x401C5820),
    ):
        assert not _filtered("x86_64", *refused), refused
    monkeypatch.setattr(os, "uname", lambda: SimpleNamespace(machine="aarch64"))
    assert _filtered("aarch64", 56, 0, 0, 0x4000), "a folder"
    assert _filtered("aarch64", 25, 3, 4, 0x4000)
    for refused in ((56, 0, 0, 0x10000), (25, 3, 4, 0x10000), (29, 3, 0x40086602)):
        assert not _filtered("aarch64", *refused), refused


def test_processes_are_limited(sandbox: Sandbox, misbehave: Misbehave) -> None:
    born = int(misbehave(sandbox, "bear", "100", processes=20).outcome.stdout)
    assert 10 <= born <= 20


def test_a_fork_bomb_is_held(sandbox: Sandbox, misbehave: Misbehave) -> None:
    ran = misbehave(sandbox, "bomb", processes=20, wall_seconds=1)
    assert ran.stopped == "wall"
    assert processes_running(PROGRAM) == []


def test_a_neighbours_bomb_takes_no_threads(sandbox: Sandbox, misbehave: Misbehave) -> None:
    if sandbox.isolation.name == "landlock":
        pytest.skip("without another user or a namespace, the kernel counts the processes of all tasks together")
    neighbour = threading.Thread(target=misbehave, args=(sandbox, "bomb"), kwargs={"processes": 30, "wall_seconds": 3})
    neighbour.start()
    while neighbour.is_alive() and len(processes_running(PROGRAM)) < 20:
        time.sleep(0.01)
    ran = misbehave(sandbox, "threads", "25", processes=30)
    neighbour.join()
    assert ran.outcome.stdout == "25\n"


def test_a_daemon_does_not_hold_the_grader(any_sandbox: Sandbox, misbehave: Misbehave) -> None:
    """Who waited for it would be stopped by the clock."""
    ran = misbehave(any_sandbox, "daemon")
    assert (ran.outcome.code, ran.outcome.stdout, ran.stopped) == (0, "done\n", "")
    assert processes_running(PROGRAM) == []


def test_a_flood_is_capped(any_sandbox: Sandbox, misbehave: Misbehave) -> None:
    ran = misbehave(any_sandbox, "flood", output_kb=100)
    assert ran.outcome.code == 0
    assert ran.outcome.stdout == "x" * (100 << 10)


@pytest.mark.parametrize("folder", ["/tmp", "/dev/shm", "/", "/in", "/var/tmp", "."])
def test_scratch_is_limited(sandbox: Sandbox, misbehave: Misbehave, folder: str) -> None:
    assert int(misbehave(sandbox, "fill", folder, tmp_mb=8).outcome.stdout) <= 8


def test_a_file_is_limited(any_sandbox: Sandbox, misbehave: Misbehave) -> None:
    ran = misbehave(any_sandbox, "write", Output("big"), "20", file_mb=5)
    assert ran.outcome.code == 1
    assert len(ran.outputs["big"]) == 5 << 20


@pytest.mark.parametrize("way", ["link", "fifo"])
def test_an_output_is_a_regular_file_or_nothing(any_sandbox: Sandbox, hostile: Path, secret: Path, way: str) -> None:
    target = [str(secret)] if way == "link" else []
    command: tuple[Word, ...] = (Input(hostile), way, *target, Output("out"))
    ran = any_sandbox.run(Task(command, limits=Limits(wall_seconds=5), tools=True))
    assert ran.outcome.code == 0
    assert ran.outputs == {}


def _traces(folder: Path) -> tuple[str, list[Path], set[str]]:
    """Mounts, temporary files, and control groups of this process."""
    return Path("/proc/self/mounts").read_text(encoding="utf-8"), list(folder.iterdir()), control_groups()


def test_nothing_is_left_behind(
    any_sandbox: Sandbox, misbehave: Misbehave, secret: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = secret.parent
    monkeypatch.setattr("tempfile.tempdir", str(folder))
    before = _traces(folder)
    misbehave(any_sandbox, "daemon")
    misbehave(any_sandbox, "stubborn", wall_seconds=0.5)
    misbehave(any_sandbox, "fill", ".", tmp_mb=4)
    misbehave(any_sandbox, "write", Output("a"), "1")
    assert _traces(folder) == before
    assert processes_running(PROGRAM) == []


def test_what_a_run_costs(any_sandbox: Sandbox, misbehave: Misbehave, capsys: pytest.CaptureFixture[str]) -> None:
    outcomes = [misbehave(any_sandbox, "code", "0").outcome for _ in range(10)]
    assert {outcome.code for outcome in outcomes} == {0}
    seconds = [outcome.seconds for outcome in outcomes]
    with capsys.disabled():
        print(f"  one run, {any_sandbox.isolation.name}: {min(seconds) * 1000:.1f} ms ", end="")
