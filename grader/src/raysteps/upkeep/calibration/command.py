"""The command `dev calibrate`."""

import os
from collections.abc import Sequence

from rich.console import Console

from raysteps.common.files import write_if_changed
from raysteps.kit.built_kit import BuiltKit, Say
from raysteps.kit.kit_building import build_kit
from raysteps.kit.manifest import choose
from raysteps.kit.project import Project
from raysteps.upkeep.calibration.manifest import write_limits
from raysteps.upkeep.calibration.marks import marks
from raysteps.upkeep.calibration.measuring import Calibrated, calibrate_step
from raysteps.upkeep.calibration.report import calibration_page, calibration_table, complaints, page_with
from raysteps.upkeep.calibration.settings import Setting, all_settings


def _write(kit: BuiltKit, found: Sequence[Calibrated]) -> None:
    for path in dict.fromkeys(one.limited.path(kit.project) for one in found):
        limits = {
            (one.limited.table, one.limited.name): one.gate.limit
            for one in found
            if one.limited.path(kit.project) == path and not one.gate.is_written
        }
        if limits and write_limits(path, limits):
            print(f"{path.relative_to(kit.project.root).as_posix()} written")


def _measured(kit: BuiltKit, only: Sequence[str], settings: Sequence[Setting], say: Say) -> list[Calibrated]:
    found: list[Calibrated] = []
    for step in choose(kit.steps, list(only)):
        found += calibrate_step(kit, step, settings, os.cpu_count() or 1, say)
    return found


def calibrate(project: Project, only: Sequence[str], console: Console, say: Say, *, check: bool, grades: bool) -> int:
    """Measures the limits of all pictures and writes them; or grades every correct solution (`grades`)."""
    kit = build_kit(project, say)
    settings, left_out = all_settings(kit)
    for text in left_out:
        say(text)
    if grades:
        return marks(kit, choose(kit.steps, list(only)), settings, console, say)
    found = _measured(kit, only, settings, say)
    console.print(calibration_table(found))
    problems = complaints(found, check=check)
    for problem in problems:
        console.print(problem, markup=False, highlight=False)
    if not check:
        _write(kit, found)
        page = project.root / "docs" / "calibration.md"
        text = calibration_page(found, settings, left_out)
        if only and page.is_file():
            text = page_with(page.read_text(encoding="utf-8"), text)
        if write_if_changed(page, text.encode()):
            print(f"{page.relative_to(project.root).as_posix()} written")
    return 1 if problems else 0
