"""Programs that only the makers of the kit need; the full test installs them where it can."""

import os
import shutil
import subprocess


def has_program(program: str, package: str) -> bool:
    """Whether it is there, after an attempt to install it where that is possible."""
    if shutil.which(program) is None and shutil.which("apt-get") is not None:
        admin = [] if os.geteuid() == 0 else ["sudo", "-n"]
        install = [*admin, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "install", "-y", package]
        for words in ([*admin, "apt-get", "update"], install):
            try:
                subprocess.run(words, check=False, capture_output=True, stdin=subprocess.DEVNULL, timeout=900)
            except (OSError, subprocess.TimeoutExpired):
                return False
    return shutil.which(program) is not None
