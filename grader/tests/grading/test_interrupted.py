"""Who is interrupted waits for no program that hangs, and leaves nothing behind."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import Sources

from raysteps.toolchain.kit_artifacts import BuiltKit

_PATIENCE = 300.0  # seconds; the program that hangs may take two thousand
_SCRIPT = """
import sys
from pathlib import Path

from raysteps.course.project import Project
from raysteps.grading.pipeline import grade_submission
from raysteps.results.settings import Settings
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
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment) as process:
        assert process.stdout is not None
        told = process.stdout.readline()
        process.send_signal(signal.SIGINT)
        try:
            _, said = process.communicate(timeout=_PATIENCE)
        finally:
            process.kill()
    assert told == b"it runs\n", said.decode()
    assert said.rstrip().endswith(b"KeyboardInterrupt"), said.decode()
    assert list(temporary.iterdir()) == []
