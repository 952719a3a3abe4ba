"""Configures and builds with CMake; the compiler is heard only when it fails."""

import os
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.files import file_lock
from raysteps.common.platform import executable, processor_count
from raysteps.common.process import Outcome, run
from raysteps.common.text import printable, shorten
from raysteps.course.project import Project
from raysteps.toolchain.kit_artifacts import ProgressCallback, rate_limited

_CONFIGURE_SECONDS = 600
_BUILD_SECONDS = 1800
_LAUNCHER = "CMAKE_CXX_COMPILER_LAUNCHER"


class _BuildProgress:
    """What Ninja and Make say of it: `[37/140]`, or `[ 26%]`."""

    _DONE = re.compile(rb"\[ *([0-9]+)(?:/([0-9]+)|(%))\]")

    def __init__(self, say: ProgressCallback) -> None:
        self._say = rate_limited(say)

    def heard(self, data: bytes) -> None:
        found = self._DONE.findall(data)
        if found:
            done, of, percent = (word.decode() for word in found[-1])
            self._say(f"{done} %" if percent else f"{done} of {of}")


@dataclass(frozen=True)
class BuildTree:
    """One build folder: a preset, and a folder that holds the student's steps."""

    project: Project
    preset: str
    folder: Path
    mine: Path
    options: tuple[str, ...] = ()

    @property
    def bin(self) -> Path:
        return self.folder / "bin"

    def program(self, target: str) -> Path:
        return executable(self.bin / target)

    def cached(self, name: str) -> str:
        """A value from CMake's cache, or nothing."""
        try:
            text = (self.folder / "CMakeCache.txt").read_text(encoding="utf-8", errors="replace")
        except OSError:
            return ""
        found = re.search(rf"^{re.escape(name)}:[A-Z]+=(.*)$", text, re.M)
        return found.group(1) if found else ""

    def is_configured(self) -> bool:
        home = self.cached("CMAKE_HOME_DIRECTORY")
        generated = home == self.project.root.as_posix() and any(
            (self.folder / name).is_file() for name in ("build.ninja", "Makefile")
        )
        is_same = generated and self.cached("RAYSTEPS_MINE_DIR") == self.mine.as_posix()
        return is_same and not self._launcher_is_gone()

    def _launcher_is_gone(self) -> bool:
        """CMake remembers what starts the compiler, such as ccache. It may not be installed any more."""
        launcher = self.cached(_LAUNCHER).partition(";")[0]
        return launcher != "" and shutil.which(launcher) is None

    def forget_other_home(self) -> None:
        """CMake refuses a build folder whose sources were elsewhere, as in a clone that was moved or copied."""
        home = self.cached("CMAKE_HOME_DIRECTORY")
        if home and home != self.project.root.as_posix():
            (self.folder / "CMakeCache.txt").unlink(missing_ok=True)
            for folder in (self.folder / "CMakeFiles", *self.folder.glob("_deps/*-subbuild")):
                shutil.rmtree(folder, ignore_errors=True)

    def configure(self, *, again: bool = False) -> None:
        """Configures once; later changes of the CMake files are noticed by the build itself, new libraries are not."""
        if self.is_configured() and not again:
            return
        self.forget_other_home()
        command: list[str | Path] = ["cmake", "--preset", self.preset, "-S", self.project.root, "-B", self.folder]
        command += [f"-DRAYSTEPS_MINE_DIR={self.mine.as_posix()}", *self.options]
        if self._launcher_is_gone():
            command.append(f"-U{_LAUNCHER}")
        generator = self.cached("CMAKE_GENERATOR") or ("Ninja" if shutil.which("ninja") else "")
        command += ["-G", generator] if generator else []
        outcome = run(command, seconds=_CONFIGURE_SECONDS, cwd=self.project.root)
        if outcome.code != 0:
            raise GraderFault("CMake cannot configure the kit:\n" + shorten(outcome.stdout + outcome.stderr, 6000))

    def build(self, targets: list[str], say: ProgressCallback = lambda text: None) -> Outcome:
        """Builds the targets (all of them when there are none). `say` gets how far it is, every few seconds."""
        if not self.is_configured():
            say("looking for the compiler and the libraries")
        self.configure()
        cached = f"CCACHE_BASEDIR={self.project.root.as_posix()}"  # for whoever uses ccache: copies of the kit share it
        command: list[str | Path] = ["cmake", "-E", "env", cached, "cmake", "--build", self.folder]
        if "CMAKE_BUILD_PARALLEL_LEVEL" not in os.environ:
            command += ["--parallel", str(processor_count())]  # make would start all at once without a number
        if targets:
            command += ["--target", *targets]
        return run(command, seconds=_BUILD_SECONDS, cwd=self.project.root, heard=_BuildProgress(say).heard)

    @contextmanager
    def locked(self, say: ProgressCallback = lambda text: None) -> Iterator[None]:
        """One command at a time in this folder."""
        with file_lock(self.folder / ".lock", lambda: say("waiting for another command, which builds here")):
            yield


def release_tree(project: Project) -> BuildTree:
    """What `render`, `check` and `bench` build: the steps in the repository."""
    return BuildTree(project, "release", project.build / "release", project.steps)


def what_failed(outcome: Outcome) -> str:
    """The part of a failed build that a person needs: from its first failure on."""
    text = printable(outcome.stdout + outcome.stderr)
    failed = text.find("FAILED:")
    errors = [text.find(word) for word in ("error:", "error C") if word in text]
    starts = [max(0, at - 400) for at in errors if at > 400 or not 0 <= failed < at]  # with what stands before it
    start = min([*starts, *([failed] if failed >= 0 else [])], default=0)
    return shorten(text[text.rfind("\n", 0, start) + 1 :], 6000)
