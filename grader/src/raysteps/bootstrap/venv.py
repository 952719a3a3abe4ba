"""The folder .venv: the Python packages of the kit, away from everybody else's."""

import hashlib
import os
import sys
from pathlib import Path


def say(text: str) -> None:
    """Speaks to the person at the keyboard before anything else can."""
    print(f"raysteps: {text}", file=sys.stderr, flush=True)


class CannotSetUp(Exception):
    """What is missing, and what to type."""


class Venv:
    """The one of the repository at `root`."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.folder = root / ".venv"
        self._stamp = self.folder / "raysteps-stamp"

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

    def is_ready(self) -> bool:
        try:
            if self._stamp.read_text(encoding="utf-8") != self._fingerprint():
                return False
            if self._is_mine():
                return True
            import subprocess  # takes long to load, and is rarely needed

            return subprocess.run([self.python, "-c", ""], capture_output=True, check=False).returncode == 0
        except OSError:
            return False

    def make(self) -> None:
        """Anew, with all packages."""
        import subprocess

        say("setting up the Python part in .venv (once, about a minute)")
        words = [getattr(sys, "_base_executable", sys.executable), "-m", "venv", "--clear", str(self.folder)]
        if subprocess.run(words, check=False, stdout=2, stdin=subprocess.DEVNULL).returncode != 0:
            raise CannotSetUp(f"{self.folder} cannot be made; the lines above say why")
        install = [str(self.python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-e"]
        tests = (self.root / "grader" / "tests").is_dir()  # a students' kit has none
        wanted = f"{self.root / 'grader'}{'[dev]' if tests else ''}"
        if subprocess.run([*install, wanted], check=False, stdout=2, stdin=subprocess.DEVNULL).returncode != 0:
            raise CannotSetUp("the Python packages could not be installed; is there a network connection?")
        self._stamp.write_text(self._fingerprint(), encoding="utf-8")

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
