"""What to type to get what is missing."""

import shutil
import sys
from collections.abc import Sequence

from raysteps.setting_up.needs import COMPILER, Need

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


def _for_windows(needs: Sequence[Need]) -> str:
    lines = [f"  winget install {need.packages['winget']}" for need in needs if need.packages.get("winget")]
    if COMPILER in needs:
        lines.append(_WINDOWS_COMPILER)
    return "\n".join(["install it with:", *lines, "Then open a new terminal, so that it is found, and try again."])


def advice(needs: Sequence[Need]) -> str:
    """The lines for this system."""
    if sys.platform == "win32":
        return _for_windows(needs)
    for manager, line in _LINES.items():
        packages = [need.packages[manager] for need in needs if need.packages.get(manager)]
        if shutil.which(manager) and packages:
            return "install it with:  " + line.format(" ".join(packages))
    return "needed are a C++20 compiler, CMake 3.22 or newer, Ninja and Python 3.11 or newer with venv"
