"""Grades attacks with the real grader, and keeps what the grader's sandbox saw."""

import os
import re
import socket
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from hostile.build import Attack, Facts, lay_out
from hostile.planting import Listener, Planted
from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.grading.pipeline import grade_submission
from raysteps.images.render import reference_picture
from raysteps.results.model import Results, Settings
from raysteps.sandbox.task import Isolation, Sandbox, Task, TaskResult
from raysteps.submission.load import load_submission
from raysteps.toolchain.kit_artifacts import BuiltKit

# Enough for honest programs on a busy machine; attacks that take all that they get name less.
_LIMITS = {"seconds": 10.0, "compile_seconds": 30.0, "memory_mb": 512.0, "processes": 48.0, "file_mb": 32.0}


@dataclass(frozen=True)
class Run:
    """One program that the sandbox ran."""

    command: str
    limit: float  # seconds on the clock
    seconds: float
    leaked: bool  # whether the secret came out, by whatever way


@dataclass
class Watched:
    """A sandbox that remembers what it ran."""

    sandbox: Sandbox
    secret: bytes
    runs: list[Run] = field(default_factory=list)

    @property
    def isolation(self) -> Isolation:
        return self.sandbox.isolation

    def run(self, task: Task) -> TaskResult:
        start = time.monotonic()
        ran = self.sandbox.run(task)
        seconds = time.monotonic() - start
        outputs = [ran.outcome.stdout.encode(), ran.outcome.stderr.encode(), *ran.outputs.values()]
        leaked = any(self.secret in data for data in outputs)
        self.runs.append(Run(str(task.command), task.limits.wall_seconds, seconds, leaked))
        return ran


@dataclass
class Graded:
    """What became of one attack."""

    attack: Attack
    out: Path
    trace: Path  # what must not come into being
    results: list[Results] = field(default_factory=list)
    refused: str = ""
    taken: set[str] = field(default_factory=set)  # ids of the steps whose sources were taken in
    runs: list[Run] = field(default_factory=list)
    seconds: float = 0.0


@dataclass(frozen=True)
class Range:
    """Where attacks are graded."""

    kit: BuiltKit
    planted: Planted
    listener: Listener
    solved: Mapping[str, str]
    folder: Path

    def _step(self, attack: Attack) -> Step:
        return next(step for step in self.kit.steps if step.id == attack.step)

    def _pictures(self, step: Step) -> str:
        rows = []
        for case in step.images:
            scene = self.kit.project.root / case.scene
            pixels = reference_picture(self.kit, scene, case.args).tobytes()
            letters = pixels.hex().translate(str.maketrans("0123456789abcdef", "abcdefghijklmnop"))
            size = case.args[case.args.index("--size") + 1]
            rows.append(f'{{"{size}", {scene.stat().st_size}, "{letters}"}}')
        return ", ".join(rows)

    def _facts(self, attack: Attack, trace: Path, out: Path) -> Facts:
        step = self._step(attack)
        sources = [path.read_text("utf-8") for path in (self.kit.project.steps / step.id).glob("*_test.cpp")]
        names = re.findall(r'TEST_CASE\("([^"]+)"', "".join(sources))
        return {
            "ABSTRACT": self.listener.abstract,
            "BLANKS": " a" * 30_000,
            "DATABASE": str(self.planted.database),
            "DIGITS": "9" * 6000,
            "HOST": socket.gethostname(),
            "KIT": str(self.kit.project.root),
            "LONG": "x" * 900_000,
            "NAME": attack.submission or "submission",
            "OUT": str(out),
            "PATHS": "/a" * 450_000,
            "PICTURES": lambda: self._pictures(step),
            "PID": str(os.getpid()),
            "PID_NAMESPACE": os.readlink("/proc/self/ns/pid"),  # noqa: PTH115
            "PORT": str(self.listener.port),
            "REFERENCES": str(self.kit.folder),
            "SECRET": str(self.planted.path),
            "SECRET_NAME": self.planted.path.name,
            "SOCKET": str(self.listener.path),
            "TEST_COUNT": str(len(names)),
            "TEST_NAMES": ", ".join(f'"{name}"' for name in names),
            "TRACE": str(trace),
        }

    def grade(self, attack: Attack, sandbox: Sandbox, name: str = "") -> Graded:
        """As often as the attack asks for. Whatever the grader raises but for a usage error is raised here too."""
        folder = self.folder / (name or attack.name)
        folder.mkdir()
        graded = Graded(attack, folder / "out", folder / "trace")
        facts = self._facts(attack, graded.trace, graded.out)
        watched = Watched(sandbox, self.planted.text.encode())
        settings = Settings(only=(attack.step, *attack.honest), limits=_LIMITS | attack.limits)
        path = lay_out(attack, facts, self.solved, folder)
        start = time.monotonic()
        try:
            for _ in range(attack.rounds):
                submission = load_submission(path, self.kit.steps)
                graded.taken = set(submission.sources)
                graded.results.append(grade_submission(self.kit, submission, settings, watched, graded.out))
        except UsageError as error:
            graded.refused = str(error)
        graded.runs, graded.seconds = watched.runs, time.monotonic() - start
        return graded
