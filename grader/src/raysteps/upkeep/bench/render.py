"""The command `bench render`: nanoseconds a ray, beside Embree and POV-Ray."""

import shutil
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape

from raysteps.kit.project import Project
from raysteps.upkeep.bench.asking import ask, ask_pinned
from raysteps.upkeep.bench.documents import keep
from raysteps.upkeep.bench.povray import Race, race_povray
from raysteps.upkeep.bench.programs import Programs, accelerations, native, portable, what_is_missing
from raysteps.upkeep.bench.render_tables import print_pictures, print_rays
from raysteps.upkeep.bench.scenes import checked, default_scenes


@dataclass(frozen=True)
class RenderWish:
    """What `bench render` was asked for."""

    scenes: list[Path]
    size: int = 512
    depth: int = 5
    rounds: int = 5
    every: int = 64
    structures: str = ""
    native: bool = False
    povray: bool = True


def _rays(programs: Programs, scene: Path, wish: RenderWish) -> Any:
    words = ["--size", wish.size, "--depth", wish.depth, "--rounds", wish.rounds, "--every", wish.every]
    words += ["--structures", wish.structures] if wish.structures else []
    return ask_pinned(programs.bench, "render", scene, *[str(word) for word in words])


def _measure(programs: Programs, scenes: list[Path], wish: RenderWish, console: Console) -> dict[str, Any]:
    rows = []
    for scene in scenes:
        with console.status(f"{programs.build} build: the rays of {escape(scene.name)}"):
            rows.append(_rays(programs, scene, wish))
    print_rays(rows, programs.build, console)
    return {"build": programs.build, "machine": asdict(programs.machine), "scenes": rows}


def _race(programs: Programs, scenes: list[Path], wish: RenderWish, console: Console) -> list[dict[str, Any]]:
    if shutil.which("povray") is None or not wish.povray:
        return []
    rows = []
    trees = [name for name in accelerations(programs) if not wish.structures or name in wish.structures.split(",")]
    if not trees:
        return []
    for scene in scenes:
        with console.status(f"POV-Ray and raytrace in turns: {escape(scene.name)}"):
            rows.append(race_povray(programs, scene, Race(wish.size, wish.depth, wish.rounds, trees)))
    print_pictures(rows, console)
    return rows


def bench_render(project: Project, wish: RenderWish, console: Console) -> int:
    """Measures, prints tables and writes build/bench/render.json."""
    scenes = checked(wish.scenes) or default_scenes(project)
    with console.status("building the benchmarks"):
        programs = portable(project)
    for line in what_is_missing(ask(programs.bench, "list")):
        console.print(line, soft_wrap=True)
    builds = [_measure(programs, scenes, wish, console)]
    if wish.native:
        with console.status("building for this very processor"):
            tuned = native(project)
        builds.append(_measure(tuned, scenes, wish, console))
    pictures = _race(programs, scenes, wish, console)
    keep(project, "render", {"schema": "raysteps/bench-render/v1", "builds": builds, "povray": pictures}, console)
    return 0
