"""Installs packages where that needs no question: with apt-get, as root or by sudo without a password."""

import os
import shutil
import subprocess
from collections.abc import Sequence

from raysteps.setting_up.needs import Need
from raysteps.setting_up.telling import say

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


def install(needs: Sequence[Need]) -> bool:
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
