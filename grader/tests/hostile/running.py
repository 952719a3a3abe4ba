"""Grades attacks with the real grader, and keeps what the grader's sandbox saw."""

import os
import re
import secrets
import socket
import sqlite3
import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from hostile.build import Attack, Facts, lay_out
from raysteps.common.errors import UsageError
from raysteps.grading.one import grade_one
from raysteps.grading.rendering import reference_picture
from raysteps.grading.results import Results
from raysteps.grading.settings import Settings
from raysteps.kit.built_kit import BuiltKit
from raysteps.kit.manifest import Step
from raysteps.sandbox.isolation import Isolation
from raysteps.sandbox.task import Ran, Sandbox, Task
from raysteps.submission.intake import take_in

VARIABLE = "RAYSTEPS_PLANTED"
# Enough for honest programs on a busy machine; attacks that take all that they get name less.
_LIMITS = {"seconds": 10.0, "compile_seconds": 30.0, "memory_mb": 512.0, "processes": 48.0, "file_mb": 32.0}


class Listener:
    """Sockets on this machine that nobody should reach."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / "socket"
        self.abstract = f"raysteps-{secrets.token_hex(8)}"
        self.heard: list[str] = []
        self._stop = threading.Event()
        self._tcp = socket.create_server(("127.0.0.1", 0))
        self.port = int(self._tcp.getsockname()[1])
        udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        udp.bind(("127.0.0.1", self.port))
        named, nameless = socket.socket(socket.AF_UNIX), socket.socket(socket.AF_UNIX)
        named.bind(str(self.path))
        nameless.bind(f"\0{self.abstract}\0")
        self.path.chmod(0o666)
        for listening in (named, nameless):
            listening.listen()
        self._sockets = {"tcp": self._tcp, "udp": udp, "named": named, "abstract": nameless}
        self._threads = [
            threading.Thread(target=self._listen, args=item, daemon=True) for item in self._sockets.items()
        ]
        for thread in self._threads:
            thread.start()

    def _listen(self, name: str, listening: socket.socket) -> None:
        listening.settimeout(0.2)
        while not self._stop.is_set():
            try:
                if name == "udp":
                    listening.recvfrom(100)
                else:
                    listening.accept()[0].close()
            except TimeoutError:
                continue
            except OSError:
                return
            self.heard.append(name)

    def close(self) -> None:
        self._stop.set()
        for thread in self._threads:
            thread.join()
        for listening in self._sockets.values():
            listening.close()


@dataclass(frozen=True)
class Planted:
    """A secret that lies about in files that all users can read, and in the grader's environment."""

    text: str
    path: Path
    database: Path


@contextmanager
def planted(kit: BuiltKit, folder: Path) -> Iterator[Planted]:
    """Also beside the references of the kit, which must be a copy."""
    text = f"raysteps-secret-{secrets.token_hex(16)}"
    path = folder / "planted-secret.txt"
    database = folder / "class.sqlite"
    for place in (path, kit.folder / path.name, kit.answers / path.name, kit.folder / "steps" / path.name):
        place.parent.mkdir(exist_ok=True)
        place.write_text(f"{text}\n", encoding="ascii")
        place.chmod(0o644)
    with sqlite3.connect(database) as connection:
        connection.execute("CREATE TABLE grades (student TEXT, points REAL)")
        connection.execute("INSERT INTO grades VALUES (?, 110)", (text,))
    connection.close()
    os.environ[VARIABLE] = text
    try:
        yield Planted(text, path, database)
    finally:
        del os.environ[VARIABLE]


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

    def run(self, task: Task) -> Ran:
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
        source = (self.kit.project.steps / step.path).with_name(f"{step.path.stem}_test.cpp").read_text("utf-8")
        names = re.findall(r'TEST_CASE\("([^"]+)"', source)
        return {
            "ABSTRACT": self.listener.abstract,
            "DATABASE": str(self.planted.database),
            "DIGITS": "9" * 6000,
            "HOST": socket.gethostname(),
            "KIT": str(self.kit.project.root),
            "LONG": "x" * 900_000,
            "NAME": attack.submission or "submission",
            "OUT": str(out),
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
                submission = take_in(path, self.kit.steps)
                graded.results.append(grade_one(self.kit, submission, settings, watched, graded.out))
        except UsageError as error:
            graded.refused = str(error)
        graded.runs, graded.seconds = watched.runs, time.monotonic() - start
        return graded
