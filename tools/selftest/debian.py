"""Debian packages that only the tests of the kit need; installed where that needs no question."""

import os
import shutil
import subprocess
from collections.abc import Sequence

_SECONDS = 1200

CACHE = ("ccache",)
CLANG = ("clang",)
MINGW = ("g++-mingw-w64-x86-64-posix", "wine64", "wine")
PAGES = ("chromium",)
WINDOW = ("libglfw3-dev", "libgl1-mesa-dri", "xvfb", "xdotool")


def _installed(package: str) -> bool:
    words = ["dpkg-query", "-W", "-f", "${Status}", package]
    done = subprocess.run(words, check=False, capture_output=True, text=True)
    return done.stdout.endswith("ok installed")


def install(packages: Sequence[str]) -> bool:
    """Whether they are there, after an attempt to install what is missing."""
    if shutil.which("apt-get") is None or shutil.which("dpkg-query") is None:
        return False
    missing = [package for package in packages if not _installed(package)]
    if missing:
        admin = [] if not hasattr(os, "geteuid") or os.geteuid() == 0 else ["sudo", "-n"]
        get = [*admin, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get"]
        try:
            for words in (["update"], ["install", "-y", *missing]):
                subprocess.run(
                    [*get, *words], check=False, capture_output=True, stdin=subprocess.DEVNULL, timeout=_SECONDS
                )
        except (OSError, subprocess.TimeoutExpired):
            return False
    return all(map(_installed, missing))
