"""The folder .venv: the Python packages of the kit, away from everybody else's."""

import hashlib
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path


def say(text: str) -> None:
    """Speaks to the person at the keyboard before anything else can."""
    print(f"raysteps: {text}", file=sys.stderr, flush=True)


_TAKES = ("about half a minute", "some minutes, 600 MB")  # without the makers' set, and with it


UNDERSTOOD = 100  # the exit code of the process that reads the words, where there is more to do than to answer them
_EVERY = 20  # seconds


def _run(words: Sequence[str]) -> int:
    """The exit code of a program that may take long and says little."""
    import subprocess  # takes long to load, and is rarely needed
    import time

    start = time.monotonic()
    with subprocess.Popen(words, stdout=2, stdin=subprocess.DEVNULL) as process:
        while True:
            try:
                return process.wait(_EVERY)
            except subprocess.TimeoutExpired:
                say(f"still at it, for {time.monotonic() - start:.0f} s")


class CannotSetUp(Exception):
    """What is missing, and what to type."""


# The student's set of packages, which every kit needs, and on top of it those of the extras of pyproject.toml.
INSTRUCTOR = "instructor"
PLAY = "play"  # also the command that needs it
MAKER = "dev"  # the others, too
_OF_MAKERS = {"docs": (), "test": (), "dev": ("format", "lint")}  # commands, and what of them where it is not all


def set_for(words: Sequence[str]) -> str:
    """What a command needs beside the usual set of its kit: nothing for most."""
    command, *rest = words or [""]
    if command == PLAY:
        return PLAY
    some = _OF_MAKERS.get(command)
    return "" if some is None or (some and rest[:1] not in [[one] for one in some]) else MAKER


class Venv:
    """The one of the repository at `root`."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.folder = root / ".venv"
        self._stamp = self.folder / "raysteps-stamp"

    @property
    def is_whole(self) -> bool:
        """Whether it is the kit of an instructor."""
        return (self.root / "solutions").is_dir()

    def _usual(self) -> set[str]:
        return {INSTRUCTOR} if self.is_whole else set()

    def _installed(self) -> tuple[str, set[str]]:
        """The fingerprint that it was made with, and the sets beside the student's."""
        try:
            first, *sets = self._stamp.read_text(encoding="utf-8").split()
        except (OSError, ValueError):
            return "", set()
        # an older kit installed everything for everybody, and wrote no sets
        return first, set(sets) or ({MAKER} if (self.root / "grader" / "tests").is_dir() else set())

    @property
    def python(self) -> Path:
        return self.folder / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")

    def _fingerprint(self) -> str:
        """Changes with what is to be installed, and with the place of the repository: the installation points there."""
        digest = hashlib.sha256(str(self.root).encode("utf-8", "surrogateescape"))
        digest.update((self.root / "grader" / "pyproject.toml").read_bytes())
        for path in sorted(Path(__file__).parent.glob("*.py")):
            digest.update(path.read_bytes())
        return digest.hexdigest()

    def _is_mine(self) -> bool:
        return Path(sys.prefix).resolve() == self.folder.resolve()

    def is_this(self) -> bool:
        """Whether this process is its Python, started as `run` would start it."""
        return self._is_mine() and bool(sys.flags.utf8_mode) and sys.flags.safe_path

    def is_made(self) -> bool:
        """Whether its Python starts, and its packages are those of this kit."""
        if self._installed()[0] != self._fingerprint():
            return False
        if self._is_mine():
            return True
        import subprocess  # takes long to load, and is rarely needed

        try:
            return subprocess.run([self.python, "-c", ""], capture_output=True, check=False).returncode == 0
        except OSError:
            return False

    def has(self, wanted: str) -> bool:
        """Whether a set is there, or has no use: a kit that was packed without tools tests nothing."""
        if not wanted or (wanted == MAKER and not (self.root / "tools").is_dir()):
            return True
        return bool({wanted, MAKER} & self._installed()[1])

    @contextmanager
    def alone(self) -> Iterator[None]:
        """Only one command at a time changes it; another one waits. Where there are no locks, nobody waits."""
        with (self.root / "grader" / "pyproject.toml").open("rb") as file:
            with suppress(ImportError, OSError):
                import fcntl

                try:
                    fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                except BlockingIOError:
                    say("waiting for another command, which sets up .venv")
                    fcntl.flock(file, fcntl.LOCK_EX)
            yield

    def answer(self, words: Sequence[str]) -> int | None:
        """The exit code where all is said before anything is installed: help, or what is wrong with the words."""
        import subprocess  # takes long to load, and is rarely needed

        python = self.python if self.is_made() else sys.executable
        read = "from sys import argv, path; path.insert(0, argv.pop(1))\n"
        read += "from raysteps.bootstrap.start import read; read()"
        sources = str(Path(__file__).parents[2])
        code = subprocess.run([python, "-X", "utf8", "-P", "-c", read, sources, *words], check=False).returncode
        return None if code == UNDERSTOOD else code

    def make(self, wanted: str = "") -> None:
        """Anew, with the usual set, the one that is wanted and those that were there before."""
        if self.folder.is_symlink():
            self.folder.unlink()  # venv would empty what it leads to, which may be another kit's, and then refuse it
        sets = self._usual() | self._installed()[1] | (set() if self.has(wanted) else {wanted})
        say(f"setting up the Python part in .venv (once, {_TAKES[MAKER in sets]})")
        words = [getattr(sys, "_base_executable", sys.executable), "-m", "venv", "--clear", str(self.folder)]
        if _run(words) != 0:
            raise CannotSetUp(f"{self.folder} cannot be made; the lines above say why")
        self._install(sets)

    def add(self, wanted: str, command: str) -> None:
        """One more set."""
        say(f"installing what only `{command}` and the like need into .venv (once, {_TAKES[wanted == MAKER]})")
        self._install(self._usual() | self._installed()[1] | {wanted})

    def _install(self, sets: set[str]) -> None:
        install = [str(self.python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-e"]
        wanted = f"{self.root / 'grader'}{'[' + ','.join(sorted(sets)) + ']' if sets else ''}"
        if _run([*install, wanted]) != 0:
            raise CannotSetUp("the Python packages could not be installed; is there a network connection?")
        self._stamp.write_text(" ".join([self._fingerprint(), *sorted(sets)]), encoding="utf-8")

    def run(self, words: list[str]) -> int:
        """Hands over to the package. -P: a file in the current folder is no module of ours."""
        command = [str(self.python), "-X", "utf8", "-P", "-m", "raysteps", *words]
        if sys.platform != "win32":
            os.execv(self.python, command)  # noqa: S606  (there is no shell to want)
        import subprocess

        with subprocess.Popen(command) as process:  # where a program cannot become another
            while True:
                try:
                    return process.wait()
                except KeyboardInterrupt:
                    continue  # Ctrl-C reaches the program as well, and it knows what to do
