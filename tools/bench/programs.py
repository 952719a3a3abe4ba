"""The programs that are measured, and what is missing."""

import json
import os
import platform
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from raysteps.common.documents import Malformed, convert
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.platform import processor_count
from raysteps.common.process import Outcome, run
from raysteps.common.text import shorten
from raysteps.course.project import Project, generated
from raysteps.toolchain.cmake import BuildTree, release_tree, what_failed
from raysteps.toolchain.link import read_description
from tools.bench.model import Listing, Machine
from tools.selftest.programs import accelerations_of

T = TypeVar("T")

# Holds the programs that are started here on one processor, so that they do not wander while they are measured.


def can_pin_processor() -> bool:
    """Whether this system lets a program choose its processor."""
    return hasattr(os, "sched_setaffinity")


@contextmanager
def pinned() -> Iterator[bool]:
    """Programs started inside inherit one processor, the last that this one may use. Tells whether that worked."""
    if not can_pin_processor():
        yield False
        return
    allowed = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(allowed)})
    try:
        yield True
    finally:
        os.sched_setaffinity(0, allowed)


# What the numbers were measured on.


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def machine(built: Path) -> Machine:
    """This machine, and how the programs in a folder are compiled."""
    description = read_description(built / "kit.json")
    optimization = [flag for flag in description.compile_flags if flag.startswith(("-O", "-m", "/O"))]
    system = f"{platform.system()} {platform.machine()}"
    flags = " ".join(optimization)
    return Machine(_processor(), processor_count(), system, description.compiler_version, flags, can_pin_processor())


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


def _say_how_far(far: str) -> None:
    print(f"raysteps: building the benchmarks: {far}", file=sys.stderr, flush=True)


def _built(tree: BuildTree, name: str) -> Programs:
    with tree.locked():
        _look_again(tree)
        outcome = tree.build(["raysteps-bench", "raytrace-reference"], _say_how_far)
    if outcome.code != 0:
        raise GraderFault("the benchmarks do not build:\n" + what_failed(outcome))
    return Programs(name, tree.program("raysteps-bench"), tree.program("raytrace-reference"), machine(tree.folder))


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


def what_is_missing(listed: Listing) -> list[str]:
    """In words: who else could be measured, and how."""
    lines = []
    if "wide" not in [side.name for side in listed.structures]:
        lines.append("Highway is not installed, so there are no wide trees to measure: apt-get install libhwy-dev")
    if not listed.embree_version:
        lines.append(
            "Embree 3 is not installed, so there is nothing to compare rays with: apt-get install libembree-dev"
        )
    if shutil.which("povray") is None:
        lines.append("POV-Ray is not installed, so there is nothing to compare pictures with: apt-get install povray")
    return lines


# Asks raysteps-bench, which answers with JSON.

_SECONDS = 4 * 3600
_MAX_TEXT = 1 << 30


def _checked(outcome: Outcome) -> str:
    if outcome.timed_out:
        raise GraderFault(f"raysteps-bench took more than {_SECONDS} seconds")
    if outcome.code == 2:
        raise UsageError(outcome.stderr.split("\nUsage:")[0].strip().removeprefix("raysteps-bench: "))
    if outcome.code != 0:
        raise GraderFault(outcome.stderr.strip() or f"raysteps-bench ended with {outcome.signal_name or outcome.code}")
    return outcome.stdout


def ask(kind: type[T], program: Path, *words: str | Path, **more: str) -> T:
    """With all processors. For a row of a table `more` stands in front, in place of the schema."""
    told = json.loads(_checked(run([program, *words], seconds=_SECONDS)))
    if more:
        told = more | {key: value for key, value in told.items() if key != "schema"}
    try:
        return convert(told, kind)
    except Malformed as error:
        raise GraderFault(f"raysteps-bench {words[0]}: {error}") from error


def ask_pinned(kind: type[T], program: Path, *words: str | Path, **more: str) -> T:
    """On one processor, where the system allows that."""
    with pinned():
        return ask(kind, program, *words, **more)


def listed(program: Path) -> Listing:
    """What can be measured."""
    return ask(Listing, program, "list")


def flat_nff(program: Path, scene: Path) -> str:
    """The scene as the kit reads it: nothing but spheres, cones and triangles."""
    return _checked(run([program, "nff", scene], seconds=_SECONDS, cap=_MAX_TEXT))


# The scenes that are measured.

# At about the sizes of the Standard Procedural Databases.
_DEFAULTS = (("sphereflake", 4), ("tetrahedra", 6), ("rings", 11), ("gears", 4), ("mountain", 6))


def default_scenes(project: Project) -> list[Path]:
    """The kit's own, made when they are needed."""
    return [generated(project, kind, size) for kind, size in _DEFAULTS]


def checked(scenes: list[Path]) -> list[Path]:
    """Scenes that somebody named. Two of one name could not be told apart in a table."""
    for scene in scenes:
        if not scene.is_file():
            raise UsageError(f"{scene}: is not there; expected a scene")
    names = [scene.stem for scene in scenes]
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        raise UsageError(f"{twice[0]}: two scenes have this name; expected different names")
    return scenes


# Programs that are started and waited for, and the time of the processor that they took.

if sys.platform != "win32":
    import resource


def children_seconds() -> float:
    if sys.platform == "win32":
        raise UsageError("this measurement needs Linux or macOS: Windows does not tell what ended programs used")
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


_RUN_SECONDS = 3600


def run_pinned(words: list[str | Path], folder: Path) -> tuple[Outcome, float]:
    """A program in that folder, on one processor, with the seconds of the processor that it took. Throws GraderFault
    where it fails."""
    before = children_seconds()
    with pinned():
        outcome = run(words, seconds=_RUN_SECONDS, cwd=folder)
    if outcome.timed_out or outcome.code != 0:
        raise GraderFault(f"{words[0]} failed: {shorten(outcome.stderr, 2000)}")
    return outcome, children_seconds() - before


@contextmanager
def variable(name: str, value: str) -> Iterator[None]:
    """Programs started inside have this variable in their environment."""
    before = os.environ.get(name)
    os.environ[name] = value
    try:
        yield
    finally:
        del os.environ[name]
        if before is not None:
            os.environ[name] = before
