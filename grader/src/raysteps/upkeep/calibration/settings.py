"""Compilers and settings under which every correct solution must give the same picture."""

import platform
import shutil
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from raysteps.common.process import run
from raysteps.kit.built_kit import BuiltKit

KIT = "the kit's own setting"
_COMPILERS = ("g++", "clang++")
_LEVELS = (("-O0",), ("-O2",), ("-O3", "-march=native"))
_CHOSEN_HERE = ("-O", "-march", "-mfma", "-ffp-contract", "-W")
_EVERY_COMPILER = ("-D", "-std=", "-fPIC", "-fno-lto", "-isysroot", "-arch")
_ONLY_GCC = ("-fno-gnu-unique",)  # its absence would give a step's helpers names that are shared by all libraries


@dataclass(frozen=True)
class Setting:
    """How the one file is compiled that is tried out; all else stays as the kit has it."""

    name: str
    compiler: str
    flags: tuple[str, ...]

    def applied(self, kit: BuiltKit) -> BuiltKit:
        """The kit, with another compiler for a student's file."""
        description = replace(kit.description, compiler=self.compiler, compile_flags=list(self.flags))
        return replace(kit, description=description)


def own_setting(kit: BuiltKit) -> Setting:
    """As students are graded."""
    return Setting(KIT, kit.description.compiler, tuple(kit.description.compile_flags))


def _is_clang(compiler: str) -> bool:
    said = run([compiler, "--version"], seconds=20)
    return "clang" in said.stdout.lower()


def _basic_flags(kit: BuiltKit, *, clang: bool) -> list[str]:
    """The kit's flags without those that vary, and without those that only another compiler knows."""
    given = kit.description.compile_flags
    if clang == ("clang" in kit.description.compiler_version.lower()):
        return [*(flag for flag in given if not flag.startswith(_CHOSEN_HERE)), "-w"]
    kept = [flag for flag in given if flag.startswith(_EVERY_COMPILER)]
    return [*kept, *(() if clang else _ONLY_GCC), "-w"]


def fused_flags(machine: str, cpu: str) -> tuple[str, ...] | None:
    """Those that let a compiler fuse a product and a sum; none where the processor cannot."""
    if machine.lower() in ("x86_64", "amd64"):
        return ("-mfma", "-ffp-contract=fast") if "fma" in cpu.split() else None
    return ("-ffp-contract=fast",) if machine.lower() in ("aarch64", "arm64") else None


def _cpu() -> str:
    try:
        return Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return ""


def all_settings(kit: BuiltKit, compilers: Sequence[str] = _COMPILERS) -> tuple[list[Setting], list[str]]:
    """Every compiler at every level, with and without FMA; and what was left out, and why."""
    fused = fused_flags(platform.machine(), _cpu())
    left_out = [] if fused else ["this processor has no FMA, or does not say so: settings with it were left out"]
    found = []
    for name in compilers:
        path = shutil.which(name)
        if path is None:
            left_out.append(f"{name} is not installed: its settings were left out")
            continue
        basic = _basic_flags(kit, clang=_is_clang(path))
        for level in _LEVELS:
            words = " ".join((name, *level))
            found.append(Setting(words, path, (*basic, *level, "-ffp-contract=off")))
            if fused:
                found.append(Setting(f"{words}, FMA", path, (*basic, *level, *fused)))
    return found, left_out
