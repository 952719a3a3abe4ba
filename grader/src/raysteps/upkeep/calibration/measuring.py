"""Measures every correct solution and every known mistake on every picture, and finds each picture's limit."""

import tempfile
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from raysteps.kit.built_kit import BuiltKit, Say
from raysteps.kit.manifest import Step
from raysteps.upkeep.calibration.gate import Gate, gate_between
from raysteps.upkeep.calibration.scenes import Limited, limited_pictures
from raysteps.upkeep.calibration.settings import Setting, own_setting
from raysteps.upkeep.calibration.shares import PictureShares, patient
from raysteps.upkeep.entrants import Entrant, mutants, right_ones

SEEDS = range(1, 4)
_EVERY = 25  # measurements between two lines of progress


@dataclass(frozen=True)
class Calibrated:
    """One limit with what it is made from."""

    limited: Limited
    gate: Gate


@dataclass(frozen=True)
class Measured:
    """One candidate in one setting, with a share for each picture."""

    candidate: Entrant
    setting: Setting
    shares: tuple[float, ...]


def counted(say: Say, what: str, total: int) -> Callable[[], None]:
    """To be called after each of them; says how far it is now and then."""
    done = iter(range(1, total + 1))

    def one_more() -> None:
        number = next(done)
        if number % _EVERY == 0 or number == total:
            say(f"{what}: {number} of {total}")

    return one_more


def _measure(measuring: PictureShares, work: Sequence[tuple[Entrant, Setting]], jobs: int, say: Say) -> list[Measured]:
    one_more = counted(say, "measured", len(work))

    def one(item: tuple[Entrant, Setting]) -> Measured:
        measured = Measured(*item, measuring.shares(*item))
        one_more()
        return measured

    with ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(one, work))


def _worst(measured: Sequence[Measured], views: slice) -> dict[str, float]:
    """Of each correct solution in each setting."""
    return {
        f"{one.candidate.name}, {one.setting.name}": max(one.shares[views])
        for one in measured
        if one.candidate.is_right
    }


def calibrate_step(kit: BuiltKit, step: Step, settings: Sequence[Setting], jobs: int, say: Say) -> list[Calibrated]:
    """Correct solutions in every setting, mistakes as students are graded."""
    own = own_setting(kit)
    correct, mistaken = right_ones(kit.project, step), mutants(kit.project, step)
    work = [(one, own) for one in mistaken]
    work += [(one, setting) for one in correct for setting in (own, *settings)]
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        limits = limited_pictures(kit.project, step, SEEDS, Path(folder))
        say(
            f"{step.id}: {len(correct)} correct solutions in {len(settings) + 1} settings and {len(mistaken)} mistakes "
            f"on {sum(len(limited.views) for limited in limits)} pictures"
        )
        measuring = PictureShares(kit, patient(step), [view for limited in limits for view in limited.views])
        measured = _measure(measuring, work, jobs, say)
        say(f"{step.id}: {measuring.binaries} different binaries")
    found, start = [], 0
    for limited in limits:
        views = slice(start, start + len(limited.views))
        mistakes = {one.candidate.name: one.shares[views] for one in measured if not one.candidate.is_right}
        pixels = min(measuring.pixels[views])
        found.append(Calibrated(limited, gate_between(_worst(measured, views), mistakes, pixels, limited.max_wrong)))
        start = views.stop
    return found
