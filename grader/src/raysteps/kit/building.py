"""Configures and builds with CMake; the compiler is heard only when it fails."""

import fcntl
import os
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.process import Outcome, run
from raysteps.common.text import printable, shorten
from raysteps.kit.project import Project

_ERROR = re.compile(r"^(?P<path>[^\s:][^:\n]*):(?P<line>\d+):(?P<column>\d+): (?:fatal )?error: (?P<text>.+)$", re.M)
_LINK_ERROR = re.compile(
    r"^.*(?:undefined reference to|multiple definition of|undefined symbol|duplicate symbol).*$", re.M
)
_MACHINE = re.compile(
    r"No space left on device|Disk quota exceeded|Read-only file system|signal terminated program|^Killed$",
    re.M,
)
_CONFIGURE_SECONDS = 600
_BUILD_SECONDS = 1800
_COMPILER_MEMORY_MB = 8192


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
        return self.bin / target

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
        generated = home == str(self.project.root) and any(
            (self.folder / name).is_file() for name in ("build.ninja", "Makefile")
        )
        return generated and self.cached("RAYSTEPS_MINE_DIR") == str(self.mine)

    def forget_other_home(self) -> None:
        """CMake refuses a build folder whose sources were elsewhere, as in a clone that was moved or copied."""
        home = self.cached("CMAKE_HOME_DIRECTORY")
        if home and home != str(self.project.root):
            (self.folder / "CMakeCache.txt").unlink(missing_ok=True)
            for folder in (self.folder / "CMakeFiles", *self.folder.glob("_deps/*-subbuild")):
                shutil.rmtree(folder, ignore_errors=True)

    def configure(self) -> None:
        """Configures once; later changes of the CMake files are noticed by the build itself."""
        if self.is_configured():
            return
        self.forget_other_home()
        command: list[str | Path] = ["cmake", "--preset", self.preset, "-S", self.project.root, "-B", self.folder]
        command += [f"-DRAYSTEPS_MINE_DIR={self.mine}", *self.options]
        generator = self.cached("CMAKE_GENERATOR") or ("Ninja" if shutil.which("ninja") else "")
        command += ["-G", generator] if generator else []
        outcome = run(command, seconds=_CONFIGURE_SECONDS, cwd=self.project.root, limited=False)
        if outcome.code != 0:
            raise GraderFault("CMake cannot configure the kit:\n" + shorten(outcome.stdout + outcome.stderr, 6000))

    def build(self, targets: list[str], *, keep_going: bool = False, seconds: float = _BUILD_SECONDS) -> Outcome:
        """Builds the targets (all of them when there are none)."""
        self.configure()
        command: list[str | Path] = ["cmake", "--build", self.folder]
        if "CMAKE_BUILD_PARALLEL_LEVEL" not in os.environ:
            command.append("--parallel")
        if targets:
            command += ["--target", *targets]
        if keep_going:
            command += ["--", *(["-k", "0"] if self.cached("CMAKE_GENERATOR") == "Ninja" else ["-k"])]
        # A program with sanitizers, which a build may run, reserves more addresses than any limit allows.
        memory = None if self.preset == "asan" else _COMPILER_MEMORY_MB
        return run(command, seconds=seconds, cwd=self.project.root, limited=False, memory_mb=memory)

    @contextmanager
    def locked(self) -> Iterator[None]:
        """One grader at a time in this folder."""
        self.folder.mkdir(parents=True, exist_ok=True)
        with (self.folder / ".lock").open("w") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            yield


def release_tree(project: Project) -> BuildTree:
    """What `render`, `check` and `bench` build: the steps in the repository."""
    return BuildTree(project, "release", project.build / "release", project.steps)


def what_failed(outcome: Outcome) -> str:
    """The part of a failed build that a person needs: from its first failure on."""
    text = printable(outcome.stdout + outcome.stderr)
    starts = [at for at in (text.find("FAILED:"), text.find("error:") - 400) if at > 0]
    return shorten(text[min(starts, default=0) :], 6000)


def is_fault_of_machine(outcome: Outcome) -> bool:
    """Whether a build failed for want of disk or memory, whatever the sources say."""
    return _MACHINE.search(outcome.stdout + outcome.stderr) is not None


def is_fault_of_step(outcome: Outcome, source: Path, targets: list[str]) -> bool:
    """Whether a failed build of a step is the work of its source: an error in it or by way of it, a link error of
    its programs, or more time than there was. Everything else is the kit's or the machine's."""
    if outcome.timed_out:
        return True
    output = printable(outcome.stdout + outcome.stderr)
    if _MACHINE.search(output):
        return False
    if _ERROR.search(output):
        return f"{source}:" in output
    return _LINK_ERROR.search(output) is not None and any(target in output for target in targets)


def first_error(output: str, mine: Path) -> str:
    """The first error line, with the student's file named as the student knows it."""
    errors = list(_ERROR.finditer(output))
    own = [error for error in errors if Path(error["path"]).is_relative_to(mine)]
    for error in own or errors:
        name = Path(error["path"]).name
        return printable(f"{name}:{error['line']}:{error['column']}: {error['text']}")
    link = _LINK_ERROR.search(output)
    if link is not None:
        return shorten(printable(link.group().rpartition(": ")[2]), 300)
    return ""
