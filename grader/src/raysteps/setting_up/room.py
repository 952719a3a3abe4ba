"""The folder .venv: the Python packages of the kit, away from everybody else's."""

import hashlib
import os
import subprocess
import sys
from pathlib import Path

from raysteps.setting_up.telling import CannotSetUp, say


class Room:
    """The one of the repository at `root`."""

    def __init__(self, root: Path) -> None:
        self._root = root
        self.folder = root / ".venv"
        self._stamp = self.folder / "raysteps-stamp"

    @property
    def python(self) -> Path:
        return self.folder / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")

    def _fingerprint(self) -> str:
        """Changes with what is to be installed, and with the place of the repository: the installation points there."""
        digest = hashlib.sha256(str(self._root).encode("utf-8", "surrogateescape"))
        digest.update((self._root / "grader" / "pyproject.toml").read_bytes())
        for path in sorted(Path(__file__).parent.glob("*.py")):
            digest.update(path.read_bytes())
        return digest.hexdigest()

    def is_ready(self) -> bool:
        try:
            if self._stamp.read_text(encoding="utf-8") != self._fingerprint():
                return False
            if Path(sys.prefix).resolve() == self.folder.resolve():  # this is the Python of the room
                return True
            return subprocess.run([self.python, "-c", ""], capture_output=True, check=False).returncode == 0
        except OSError:
            return False

    def make(self) -> None:
        say("setting up the Python part in .venv (once, about a minute)")
        words = [getattr(sys, "_base_executable", sys.executable), "-m", "venv", "--clear", str(self.folder)]
        if subprocess.run(words, check=False, stdout=2, stdin=subprocess.DEVNULL).returncode != 0:
            raise CannotSetUp(f"{self.folder} cannot be made; the lines above say why")
        install = [str(self.python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-e"]
        wanted = f"{self._root / 'grader'}[dev]"
        if subprocess.run([*install, wanted], check=False, stdout=2, stdin=subprocess.DEVNULL).returncode != 0:
            raise CannotSetUp("the Python packages could not be installed; is there a network connection?")
        self._stamp.write_text(self._fingerprint(), encoding="utf-8")

    def run(self, words: list[str]) -> int:
        """Hands over to the package. -P: a file in the current folder is no module of ours."""
        command = [str(self.python), "-X", "utf8", "-P", "-m", "raysteps", *words]
        if sys.platform != "win32":
            os.execv(self.python, command)  # noqa: S606  (there is no shell to want)
        with subprocess.Popen(command) as process:  # where a program cannot become another
            while True:
                try:
                    return process.wait()
                except KeyboardInterrupt:
                    continue  # Ctrl-C reaches the program as well, and it knows what to do
