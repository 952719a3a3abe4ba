"""What a machine lacks to build the kit."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass

_OLDEST_CMAKE = (3, 22)
_COMPILERS = ("g++", "clang++", "cl")
_ASK_SECONDS = 60


@dataclass(frozen=True)
class Need:
    """Something that is missing, and the package that has it, by the program that installs packages."""

    what: str
    packages: dict[str, str]


COMPILER = Need("a C++20 compiler", {"apt-get": "g++", "brew": "gcc", "dnf": "gcc-c++", "pacman": "gcc", "winget": ""})
CMAKE = Need(
    "CMake 3.22 or newer",
    {"apt-get": "cmake", "brew": "cmake", "dnf": "cmake", "pacman": "cmake", "winget": "Kitware.CMake"},
)
NINJA = Need(
    "Ninja",
    {
        "apt-get": "ninja-build",
        "brew": "ninja",
        "dnf": "ninja-build",
        "pacman": "ninja",
        "winget": "Ninja-build.Ninja",
    },
)
VENV = Need("Python's venv", {"apt-get": "python3-venv"})
# Asked for only where apt-get can bring them; elsewhere CMake fetches them itself.
LIBRARIES = (Need("GLM", {"apt-get": "libglm-dev"}), Need("Catch2", {"apt-get": "catch2"}))
# Grading other people's work needs a sandbox; one's own work does not, so nobody is stopped for want of it.
SANDBOX = Need("bubblewrap", {"apt-get": "bubblewrap"})
# For --accel wide; everything else works without it.
HIGHWAY = Need("Highway", {"apt-get": "libhwy-dev"})


def said_by(words: Sequence[str]) -> str:
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


def is_installed(need: Need) -> bool:
    """Whether a Debian package is there."""
    package = need.packages["apt-get"]
    return said_by(["dpkg-query", "-W", "-f", "${Status}", package]).endswith("ok installed")


def has_venv() -> bool:
    return bool(said_by([sys.executable, "-c", "import venv, ensurepip; print('yes')"]))


def missing() -> list[Need]:
    """All that must be there."""
    needs = [] if has_compiler() else [COMPILER]
    if not cmake_is_new_enough(said_by(["cmake", "--version"])):
        needs.append(CMAKE)
    if shutil.which("ninja") is None:
        needs.append(NINJA)
    if not has_venv():
        needs.append(VENV)
    if shutil.which("apt-get"):
        needs += [library for library in LIBRARIES if not is_installed(library)]
    return needs
