"""The same picture by POV-Ray and by raytrace, in turns."""

import json
import re
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.process import Outcome, run
from raysteps.common.text import shorten
from raysteps.upkeep.bench.asking import flat_nff
from raysteps.upkeep.bench.brightness import brightness_difference, linear_picture
from raysteps.upkeep.bench.flat_scene import read_flat
from raysteps.upkeep.bench.pinning import pinned
from raysteps.upkeep.bench.pov_scene import pov_text
from raysteps.upkeep.bench.processor import children_seconds
from raysteps.upkeep.bench.programs import Programs
from raysteps.upkeep.bench.spread import spread_of

_SECONDS = 3600
_MOST_DIFFERENCE = 0.01
_MOST_WITH_GLASS = 0.05  # light passes POV-Ray's glass, while the kit's throws a full shadow
_TRACE_TIME = re.compile(r"Trace Time:.*\(([0-9.]+) seconds\)")
_BACKGROUND = re.compile(r"^b .*$", re.MULTILINE)
_OPTIONS = ("-D", "-A", "+WT1", "+FP", "File_Gamma=1.0", "+Q9", "-V", "-P")


@dataclass(frozen=True)
class Race:
    """How whole pictures are measured."""

    size: int
    depth: int
    rounds: int
    trees: list[str]


@dataclass(frozen=True)
class Taken:
    """Seconds of one run: of tracing by its own account, of the whole process, and of the processor in it."""

    trace: float
    process: float
    processor: float


Runner = Callable[[int], Taken]  # of a picture with that many pixels on each side


def _run(words: list[str | Path], folder: Path) -> tuple[Outcome, float]:
    before = children_seconds()
    with pinned():
        outcome = run(words, seconds=_SECONDS, cwd=folder)
    if outcome.timed_out or outcome.code != 0:
        raise GraderFault(f"{words[0]} failed: {shorten(outcome.stderr, 2000)}")
    return outcome, children_seconds() - before


def trace_seconds(report: str) -> float:
    """What POV-Ray says about itself, to the millisecond."""
    found = _TRACE_TIME.search(report)
    if not found:
        raise GraderFault("POV-Ray did not tell its trace time; expected a line 'Trace Time: ... (1.234 seconds)'")
    return float(found.group(1))


def _povray(folder: Path, size: int) -> Taken:
    files: list[str | Path] = ["+Iscene.pov", "+Opovray.ppm", f"+W{size}", f"+H{size}"]
    outcome, processor = _run(["povray", *files, *_OPTIONS], folder)
    return Taken(trace_seconds(outcome.stderr + outcome.stdout), outcome.seconds, processor)


def _raytrace(program: Path, folder: Path, tree: str, depth: int, size: int) -> Taken:
    options = ["--size", f"{size}x{size}", "--depth", str(depth), "--threads", "1", "--quiet"]
    words: list[str | Path] = [program, "scene.nff", "-o", f"{tree}.ppm", "--accel", tree, "--stats", f"{tree}.json"]
    outcome, processor = _run([*words, *options], folder)
    stats = json.loads((folder / f"{tree}.json").read_text(encoding="utf-8"))
    return Taken(float(stats["render_seconds"]), outcome.seconds, processor)


def _difference(folder: Path, tree: str) -> float:
    theirs = linear_picture(folder / "povray.ppm", tone_mapped=False)
    return brightness_difference(theirs, linear_picture(folder / f"{tree}.ppm", tone_mapped=True))


def _skipped(scene: str, why: str) -> dict[str, Any]:
    return {"scene": scene, "skipped": why, "brightness_difference": None, "programs": []}


def _measured(folder: Path, scene: str, runners: dict[str, Runner], race: Race, bound: float) -> dict[str, Any]:
    """A picture of one pixel takes reading and building, but no rays to speak of: the rest is tracing."""
    size = race.size
    times: dict[str, list[tuple[Taken, float]]] = {name: [] for name in runners}
    for runner in runners.values():
        runner(size)  # warms up, and leaves the pictures
    difference = _difference(folder, list(runners)[1].removeprefix("raytrace "))
    if difference > bound:
        return _skipped(scene, f"not the same scene: brightness differs by {difference:.3f}, expected at most {bound}")
    for _ in range(race.rounds):
        for name, runner in runners.items():
            whole, without_rays = runner(size), runner(1)
            times[name].append((whole, max(0.0, whole.processor - without_rays.processor)))
    programs = [
        {
            "program": name,
            "trace_seconds": spread_of([one.trace for one, _ in taken]),
            "trace_processor_seconds": spread_of([tracing for _, tracing in taken]),
            "process_seconds": spread_of([one.process for one, _ in taken]),
            "processor_seconds": spread_of([one.processor for one, _ in taken]),
        }
        for name, taken in times.items()
    ]
    return {"scene": scene, "skipped": "", "brightness_difference": difference, "programs": programs}


def race_povray(programs: Programs, scene: Path, race: Race) -> dict[str, Any]:
    """Both get the same flat scene with a black background."""
    text = flat_nff(programs.bench, scene)
    flat = read_flat(text)
    bound = _MOST_WITH_GLASS if any(shape.fill[6] > 0.0 for shape in flat.shapes) else _MOST_DIFFERENCE
    try:
        pov = pov_text(flat, race.depth)
    except UsageError as error:
        return _skipped(scene.stem, str(error))
    with tempfile.TemporaryDirectory(prefix="raysteps-pov-") as name:
        folder = Path(name)
        (folder / "scene.pov").write_text(pov, encoding="utf-8")
        (folder / "scene.nff").write_text(_BACKGROUND.sub("b 0 0 0", text), encoding="utf-8")
        runners: dict[str, Runner] = {"povray": partial(_povray, folder)}
        for tree in race.trees:
            runners[f"raytrace {tree}"] = partial(_raytrace, programs.raytrace, folder, tree, race.depth)
        return _measured(folder, scene.stem, runners, race, bound)
