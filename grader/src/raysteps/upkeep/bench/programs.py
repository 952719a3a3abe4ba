"""The programs that are measured, and what is missing."""

import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault
from raysteps.common.process import run
from raysteps.kit.building import BuildTree, release_tree, what_failed
from raysteps.kit.project import Project
from raysteps.upkeep.bench.machine import Machine, machine
from raysteps.upkeep.same_picture import accelerations_of

_NATIVE = "-march=native"
_CONFIGURE_SECONDS = 600


@dataclass(frozen=True)
class Programs:
    """The benchmark program and the reference renderer of one build."""

    build: str
    bench: Path
    raytrace: Path
    machine: Machine


def _look_again(tree: BuildTree) -> None:
    """CMake would not notice by itself that Embree or Highway has been installed since."""
    if any(tree.cached(name).endswith("NOTFOUND") for name in ("embree_DIR", "hwy_DIR")):
        run(["cmake", tree.folder], seconds=_CONFIGURE_SECONDS)


def _built(tree: BuildTree, name: str) -> Programs:
    with tree.locked():
        _look_again(tree)
        outcome = tree.build(["raysteps-bench", "raytrace-reference"])
    if outcome.code != 0:
        raise GraderFault("the benchmarks do not build:\n" + what_failed(outcome))
    return Programs(name, tree.program("raysteps-bench"), tree.program("raytrace-reference"), machine(tree))


def portable(project: Project) -> Programs:
    """As the kit is built everywhere: for any processor of this kind."""
    return _built(release_tree(project), "portable")


def native(project: Project) -> Programs:
    """Compiled for this very processor."""
    options = (f"-DCMAKE_CXX_FLAGS={_NATIVE}",)
    tree = BuildTree(project, "release", project.build / "native", project.steps, options)
    return _built(tree, f"native ({_NATIVE})")


def accelerations(programs: Programs) -> list[str]:
    """The trees that raytrace can use; not those that test most surfaces."""
    return [name for name in accelerations_of(programs.raytrace) if name not in ("none", "boxes")]


def what_is_missing(listed: dict[str, Any]) -> list[str]:
    """In words: who else could be measured, and how; `listed` is what `raysteps-bench list` says."""
    lines = []
    if "wide" not in [side["name"] for side in listed["structures"]]:
        lines.append("Highway is not installed, so there are no wide trees to measure: apt-get install libhwy-dev")
    if not listed["embree_version"]:
        lines.append(
            "Embree 3 is not installed, so there is nothing to compare rays with: apt-get install libembree-dev"
        )
    if shutil.which("povray") is None:
        lines.append("POV-Ray is not installed, so there is nothing to compare pictures with: apt-get install povray")
    return lines
