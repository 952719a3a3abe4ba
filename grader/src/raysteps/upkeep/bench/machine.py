"""What the numbers were measured on, without the name of the machine."""

import os
import platform
from dataclasses import dataclass
from pathlib import Path

from raysteps.kit.building import BuildTree
from raysteps.kit.description import read_description
from raysteps.upkeep.bench.pinning import can_pin


@dataclass(frozen=True)
class Machine:
    """Processor, compiler and system."""

    processor: str
    cores: int
    system: str
    compiler: str
    flags: str
    pinned: bool


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def machine(tree: BuildTree) -> Machine:
    """This machine, and how the tree's programs are compiled."""
    description = read_description(tree.folder / "kit.json")
    optimization = [flag for flag in description.compile_flags if flag.startswith(("-O", "-m", "/O"))]
    system = f"{platform.system()} {platform.machine()}"
    flags = " ".join(optimization)
    return Machine(_processor(), os.cpu_count() or 1, system, description.compiler_version, flags, can_pin())
