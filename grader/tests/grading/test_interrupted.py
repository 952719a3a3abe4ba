"""Who is interrupted waits for no program that hangs, and leaves nothing behind."""

import os
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Event, get_ident

import pytest
from conftest import Sources
from watch_fakes import is_running, wait_for

from raysteps.common.process import Outcome
from raysteps.grading.step import interruptible_map
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.monitor import descendants
from raysteps.sandbox.task import AccountingSandbox, Task, TaskResult
from raysteps.toolchain.compile import CompiledAhead, StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit

_PATIENCE = 300.0  # seconds; the program that hangs may take two thousand
_SCRIPT = """
import sys
from pathlib import Path

from raysteps.course.project import Project
from raysteps.grading.pipeline import grade_submission
from raysteps.results.model import Settings
from raysteps.sandbox.detect import find_sandbox
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.submission.load import Submission
from raysteps.toolchain.build_kit import build_kit

root, source, out, which = sys.argv[1:]
kit = build_kit(Project(Path(root)), lambda text: None)
sandbox = find_sandbox() if which == "found" else LimitsOnly()
kit = kit if which == "found" else kit.in_one_process()

class Telling:
    isolation = sandbox.isolation

    def run(self, task):
        if not task.tools:
            print("it runs", flush=True)
        return sandbox.run(task)

submission = Submission("jo", {"07-tone-mapping": Path(source).read_bytes()}, {})
grade_submission(kit, submission, Settings(only=("07-tone-mapping",), limits={"seconds": 500}), Telling(), Path(out))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
@pytest.mark.parametrize("which", ["found", "limits only"])
def test_what_hangs_is_ended(kit: BuiltKit, solved: Sources, tmp_path: Path, which: str) -> None:
    head = "Color tone_map(const Color& color) {\n"
    hangs = solved["07-tone-mapping"].replace(
        head, f"{head}    for (volatile int turn = 0; turn >= 0; turn = 1) {{\n    }}\n"
    )
    source, temporary = tmp_path / "tone_mapping.cpp", tmp_path / "temporary"
    source.write_text(hangs, encoding="utf-8")
    temporary.mkdir()
    words: list[str | Path] = [sys.executable, "-P", "-c", _SCRIPT, kit.project.root, source, tmp_path / "out", which]
    environment = os.environ | {"TMPDIR": str(temporary)}
    with subprocess.Popen(
        words,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=environment,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # where the tests run in the background
    ) as process:
        assert process.stdout is not None
        told = process.stdout.readline()
        started = descendants(process.pid) - {process.pid}
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        try:
            _, said = process.communicate(timeout=_PATIENCE)
        finally:
            process.kill()
    assert told == b"it runs\n", said.decode()
    assert said.rstrip().endswith(b"KeyboardInterrupt"), said.decode()
    assert list(temporary.iterdir()) == []
    wait_for(lambda: not any(map(is_running, started)))


@pytest.mark.skipif(sys.platform == "win32", reason="no thread can be sent a signal there")
def test_a_signal_that_another_thread_takes_is_heard() -> None:
    """Whoever waits is not woken by it."""
    heard = Event()

    def ask(_: int) -> bool:
        signal.pthread_kill(get_ident(), signal.SIGINT)
        return heard.wait(_PATIENCE)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # where the tests run in the background
    try:
        with ThreadPoolExecutor(1) as pool:
            try:
                with pytest.raises(KeyboardInterrupt):
                    interruptible_map(pool, ask, [1, 2])
            finally:
                heard.set()
    finally:
        signal.signal(signal.SIGINT, before)


def test_so_is_a_compiler_that_was_started_ahead(kit: BuiltKit, tmp_path: Path) -> None:
    """Where the steps wait for it, and whoever waits for the steps is interrupted."""
    step, runs = kit.steps[0], Event()

    class Compiler:
        isolation = LimitsOnly.isolation

        def run(self, task: Task) -> TaskResult:
            runs.set()
            assert task.abandoned.wait(_PATIENCE)
            return TaskResult(Outcome(-9, True, "", "", 1.0), {}, 1.0, "wall")

    counted = AccountingSandbox(Compiler())
    with ThreadPoolExecutor(1) as pool:
        build = StudentBuild(kit, counted, tmp_path)
        compiled = pool.submit(build.compile, step, b"int one;", kit.limits_of(step))
        assert runs.wait(_PATIENCE)
        with pytest.raises(KeyboardInterrupt), CompiledAhead({step.id: compiled}, counted).until_interrupted():
            raise KeyboardInterrupt
        with pytest.raises(KeyboardInterrupt):
            compiled.result()
