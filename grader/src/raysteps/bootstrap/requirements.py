"""What a machine lacks to build the kit, what to type to get it, and getting it where that needs no question."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

from raysteps.bootstrap.venv import CannotSetUp, say

_OLDEST_CMAKE = (3, 22)
_COMPILERS = ("g++", "clang++", "cl")
_ASK_SECONDS = 60


@dataclass(frozen=True)
class Requirement:
    """Something that is missing, and the package that has it, by the program that installs packages."""

    what: str
    packages: dict[str, str]


COMPILER = Requirement(
    "a C++20 compiler", {"apt-get": "g++", "brew": "gcc", "dnf": "gcc-c++", "pacman": "gcc", "winget": ""}
)
CMAKE = Requirement(
    "CMake 3.22 or newer",
    {"apt-get": "cmake", "brew": "cmake", "dnf": "cmake", "pacman": "cmake", "winget": "Kitware.CMake"},
)
NINJA = Requirement(
    "Ninja",
    {
        "apt-get": "ninja-build",
        "brew": "ninja",
        "dnf": "ninja-build",
        "pacman": "ninja",
        "winget": "Ninja-build.Ninja",
    },
)
VENV = Requirement("Python's venv", {"apt-get": "python3-venv"})
# Asked for only where apt-get can bring them; elsewhere CMake fetches them itself.
LIBRARIES = (
    Requirement("GLM", {"apt-get": "libglm-dev"}),
    Requirement("Catch2", {"apt-get": "catch2"}),
    Requirement("stb_image_write", {"apt-get": "libstb-dev"}),
)
# Grading other people's work needs a sandbox; one's own work does not, so nobody is stopped for want of it.
SANDBOX = Requirement("bubblewrap", {"apt-get": "bubblewrap"})
# For --accel wide; everything else works without it.
HIGHWAY = Requirement("Highway", {"apt-get": "libhwy-dev"})


def output_of(words: Sequence[str]) -> str:
    """What a program prints; nothing when it cannot be started or fails."""
    try:
        done = subprocess.run(
            words, capture_output=True, check=False, text=True, errors="replace", timeout=_ASK_SECONDS,
            stdin=subprocess.DEVNULL,
        )  # fmt: skip
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return done.stdout if done.returncode == 0 else ""


def has_compiler() -> bool:
    return any(map(shutil.which, _COMPILERS)) or bool(os.environ.get("CXX"))


def cmake_is_new_enough(said: str) -> bool:
    """`said` is what `cmake --version` prints."""
    found = re.match(r"cmake version (\d+)\.(\d+)", said)
    return found is not None and (int(found[1]), int(found[2])) >= _OLDEST_CMAKE


def is_installed(need: Requirement) -> bool:
    """Whether a Debian package is there."""
    package = need.packages["apt-get"]
    return output_of(["dpkg-query", "-W", "-f", "${Status}", package]).endswith("ok installed")


def has_venv() -> bool:
    return bool(output_of([sys.executable, "-c", "import venv, ensurepip; print('yes')"]))


def missing() -> list[Requirement]:
    """All that must be there."""
    needs = [] if has_compiler() else [COMPILER]
    if not cmake_is_new_enough(output_of(["cmake", "--version"])):
        needs.append(CMAKE)
    if shutil.which("ninja") is None:
        needs.append(NINJA)
    if not has_venv():
        needs.append(VENV)
    if shutil.which("apt-get"):
        needs += [library for library in LIBRARIES if not is_installed(library)]
    return needs


# What to type to get what is missing.

_LINES = {
    "apt-get": "sudo apt-get update && sudo apt-get install -y {}",
    "brew": "brew install {}",
    "dnf": "sudo dnf install {}",
    "pacman": "sudo pacman -S {}",
}
_BUILD_TOOLS = "--passive --wait --add Microsoft.VisualStudio.Workload.VCTools --includeRecommended"
_WINDOWS_COMPILER = f"""a compiler, one of these two:
  winget install BrechtSanders.WinLibs.POSIX.UCRT
  winget install Microsoft.VisualStudio.2022.BuildTools --override "{_BUILD_TOOLS}"
The first is MinGW (g++), a small download. The second is Microsoft's (cl): type all commands of the kit in the
"x64 Native Tools Command Prompt for VS 2022" then."""


def _for_windows(needs: Sequence[Requirement]) -> str:
    lines = [f"  winget install {need.packages['winget']}" for need in needs if need.packages.get("winget")]
    if COMPILER in needs:
        lines.append(_WINDOWS_COMPILER)
    return "\n".join(["install it with:", *lines, "Then open a new terminal, so that it is found, and try again."])


def advice(needs: Sequence[Requirement]) -> str:
    """The lines for this system."""
    if sys.platform == "win32":
        return _for_windows(needs)
    for manager, line in _LINES.items():
        packages = [need.packages[manager] for need in needs if need.packages.get(manager)]
        if shutil.which(manager) and packages:
            return "install it with:  " + line.format(" ".join(packages))
    return "needed are a C++20 compiler, CMake 3.22 or newer, Ninja and Python 3.11 or newer with venv"


# Installs packages where that needs no question: with apt-get, as root or by sudo without a password.

_TAIL = 20  # lines of what apt-get said, when it failed


def _as_root() -> list[str] | None:
    """The words before a command that only root may give; none where there is no way to become root."""
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        return []
    sudo = shutil.which("sudo")
    if sudo is None:
        return None
    asked = subprocess.run([sudo, "-n", "true"], capture_output=True, check=False, stdin=subprocess.DEVNULL)
    return ["sudo", "-n"] if asked.returncode == 0 else None


def install(needs: Sequence[Requirement]) -> bool:
    """Whether apt-get brought them."""
    before = None if shutil.which("apt-get") is None else _as_root()
    if before is None:
        return False
    packages = [need.packages["apt-get"] for need in needs]
    say(f"installing system packages: {' '.join(packages)}")
    get = [*before, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get"]
    for words in (["update"], ["install", "-y", *packages]):
        done = subprocess.run(
            [*get, *words],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            check=False,
            text=True,
            errors="replace",
            stdin=subprocess.DEVNULL,
        )
        if done.returncode != 0:
            say("\n".join(done.stdout.splitlines()[-_TAIL:]))
            return False
    return True


def install_required() -> None:
    """Raises CannotSetUp with the lines to type where it cannot be had without asking."""
    needs = missing()
    if needs and install(needs):
        needs = missing()
    if needs:
        raise CannotSetUp(f"this is missing: {', '.join(need.what for need in needs)}\n{advice(needs)}")


def install_optional() -> None:
    """Says what the kit does without where it cannot be had."""
    if not (sys.platform == "linux" and shutil.which("apt-get")):
        return
    if shutil.which("bwrap") is None and not install([SANDBOX]):
        line = "sudo apt-get install -y bubblewrap"
        say(f"without bubblewrap, other people's work is graded in a weaker sandbox: {line}")
    if not is_installed(HIGHWAY) and not install([HIGHWAY]):
        say("without Highway there is no --accel wide: sudo apt-get install -y libhwy-dev")


# Words are read before the packages are there, whose names the commands import.


class _Absent(type):
    """Of a class that stands in for whatever a package has: others can be made of it, called and indexed."""

    def __getattr__(cls, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return cls

    def __call__(cls, *words: Any, **named: Any) -> Any:
        return cls

    def __or__(cls, other: Any) -> Any:
        return cls

    __ror__ = __getitem__ = __or__

    def __new__(mcs, name: str, bases: Any, members: Any, **_: Any) -> Any:
        return super().__new__(mcs, name, bases, members)


class AbsentPackages(MetaPathFinder, Loader):
    """Comes last: packages that are not installed are there for who imports them, and do nothing."""

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> ModuleSpec | None:
        is_absent = name.partition(".")[0] not in {"raysteps", "tools", *sys.stdlib_module_names}
        return ModuleSpec(name, self, is_package=True) if is_absent else None

    def exec_module(self, module: ModuleType) -> None:
        module.__dict__["__getattr__"] = _Absent(module.__name__, (), {}).__getattr__
