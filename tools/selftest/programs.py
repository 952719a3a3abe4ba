"""Checks that build the C++ programs and run them, with the usual compiler, with sanitizers and with clang."""

import os
import shutil
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path

from raysteps.common.process import Outcome, run
from raysteps.course.manifest import read_steps
from raysteps.course.project import Project
from raysteps.toolchain.cmake import BuildTree, what_failed
from tools.selftest.checks import Check, Report
from tools.selftest.debian import CLANG, install
from tools.selftest.stamps import Belongs

# Whether the accelerations give the same picture, byte for byte.

ACCELERATIONS = ("none", "boxes", "octree", "bvh")  # that every raytrace has
_SIZE = "96x96"
_SECONDS = 300


def render_with(
    program: Path, scene: Path, accel: str, picture: Path, *options: str | Path, size: str, seconds: float
) -> Outcome:
    """Renders the scene with one of the accelerations."""
    words: list[str | Path] = [program, scene, "-o", picture, "--accel", accel, "--size", size, "--quiet", *options]
    return run(words, seconds=seconds)


def accelerations_of(program: Path) -> list[str]:
    """All that this program has: those that every raytrace has come first."""
    names = run([program, "--list-accel"], seconds=_SECONDS).stdout.split()
    return [*ACCELERATIONS, *(name for name in names if name not in ACCELERATIONS)]


def _bytes(program: Path, scene: Path, accel: str, folder: Path) -> tuple[bytes, str]:
    picture = folder / f"{accel}.ppm"
    outcome = render_with(program, scene, accel, picture, size=_SIZE, seconds=_SECONDS)
    if outcome.code != 0 or outcome.timed_out:
        return b"", outcome.stderr.strip() or "it did not end"
    return picture.read_bytes(), ""


def scenes_that_differ(project: Project, program: Path) -> list[str]:
    """One line for each scene whose pictures differ or that cannot be rendered."""
    scenes = sorted(project.scenes.rglob("*.nff"))
    if not scenes:
        return ["scenes/ holds no scene"]
    accelerations = accelerations_of(program)
    lines = []
    for scene in scenes:
        name = scene.relative_to(project.root).as_posix()
        with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
            first = b""
            for accel in accelerations:
                picture, problem = _bytes(program, scene, accel, Path(folder))
                first = first or picture
                if problem or picture != first:
                    lines.append(f"{name}: --accel {accel}: {problem or 'another picture than --accel none'}")
    return lines


Inputs = Callable[[str], Belongs]  # what a check that uses a module of the kit depends on

_TEST_SECONDS = 900
_FUZZ_SECONDS = 60
LINES = "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O2 -g1 -DNDEBUG"  # all warnings; lines in what they report, no variables
_QUICK = "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1 -DNDEBUG"  # half the time to build, and lines in what they report


def command(words: list[str | Path], cwd: Path, seconds: float = _TEST_SECONDS) -> Report:
    """Passes when the program exits with 0."""
    outcome = run(words, seconds=seconds, cwd=cwd)
    if outcome.code == 0 and not outcome.timed_out:
        return Report("passed")
    output = (outcome.stdout + outcome.stderr)[-6000:]
    return Report("failed", f"it ran longer than {seconds:.0f} s\n{output}" if outcome.timed_out else output)


def build(tree: BuildTree, targets: list[str]) -> Report:
    with tree.locked():
        outcome = tree.build(targets)
    return Report("passed") if outcome.code == 0 else Report("failed", what_failed(outcome))


def _program(tree: BuildTree, name: str, *args: str | Path) -> Report:
    """Builds the program, so that an old one never passes for a new one, and runs it."""
    built = build(tree, [name])
    return command([tree.program(name), *args], tree.project.root) if built.verdict == "passed" else built


def build_check(name: str, tree: BuildTree, targets: list[str], inputs: Inputs) -> Check:
    return Check(name, lambda: build(tree, targets), inputs(__name__))


def _program_check(name: str, tree: BuildTree, inputs: Inputs, program: str, *args: str | Path) -> Check:
    return Check(name, partial(_program, tree, program, *args), inputs(__name__), beside=True)


def program_checks(tree: BuildTree, inputs: Inputs, suffix: str = "") -> list[Check]:
    """The tests of the framework and of all steps."""
    names = ["test-framework", *(f"test-reference-{step.number}" for step in read_steps(tree.project))]
    checks = [_program_check(name + suffix, tree, inputs, name) for name in names]
    replay = "fuzz-readers-replay"
    return [*checks, _program_check(replay + suffix, tree, inputs, replay, _corpus(tree.project))]


def _corpus(project: Project) -> Path:
    return project.root / "framework" / "io" / "fuzz" / "corpus"


def _same_pictures(project: Project, tree: BuildTree) -> Report:
    built = build(tree, ["raytrace-reference"])
    if built.verdict != "passed":
        return built
    different = scenes_that_differ(project, tree.program("raytrace-reference"))
    return Report("failed", "\n".join(different)) if different else Report("passed")


def same_pictures_check(project: Project, tree: BuildTree, inputs: Inputs) -> Check:
    name = "all structures give the same picture"
    return Check(name, lambda: _same_pictures(project, tree), inputs(__name__), beside=True)


def _has_clang() -> bool:
    return shutil.which("clang++") is not None or install(CLANG)


def asan_checks(project: Project, inputs: Inputs) -> list[Check]:
    """By clang where it can be had: it needs a third of the time that g++ takes for code with sanitizers."""
    compiler = ("-DCMAKE_CXX_COMPILER=clang++",) if _has_clang() else ()
    tree = BuildTree(project, "asan", project.build / "asan", project.steps, (*compiler, _QUICK))
    tests = [f"test-reference-{step.number}" for step in read_steps(project)]
    targets = ["test-framework", *tests, "fuzz-readers-replay"]
    name = "build with address and undefined behaviour sanitizers"
    return [build_check(name, tree, targets, inputs), *program_checks(tree, inputs, ", sanitized")]


def _fuzz(project: Project, tree: BuildTree) -> Report:
    corpus = project.build / "fuzz" / "corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    words: list[str | Path] = [corpus, _corpus(project)]
    words += [f"-max_total_time={_FUZZ_SECONDS}", "-timeout=10", "-rss_limit_mb=2048", "-print_final_stats=1"]
    return _program(tree, "fuzz-readers", *words, f"-artifact_prefix={corpus.parent}/")


def clang_checks(project: Project, inputs: Inputs) -> list[Check]:
    if not _has_clang():
        missing = Report("skipped", "install: clang")
        return [Check(name, lambda: missing) for name in ("build everything with clang", "fuzz-readers for 60 s")]
    compiler = ("-DCMAKE_CXX_COMPILER=clang++", _QUICK)
    tree = BuildTree(project, "dev", project.build / "clang", project.steps, compiler)
    watched = (*compiler, "-DRAYSTEPS_FUZZ=ON", "-DRAYSTEPS_SANITIZE=address,undefined,fuzzer-no-link")
    fuzzer = BuildTree(project, "asan", project.build / "fuzz", project.steps, watched)
    return [
        build_check("build everything with clang", tree, [], inputs),
        build_check("build the fuzz target", fuzzer, ["fuzz-readers"], inputs),
        Check(f"fuzz-readers for {_FUZZ_SECONDS} s", lambda: _fuzz(project, fuzzer), inputs(__name__), beside=True),
        _program_check("test-framework, clang", tree, inputs, "test-framework"),
    ]


# What was compiled for one copy of the kit is taken for the next: tests build many, and a fresh clone is one, too.


def use_compiler_cache() -> None:
    """From here on, in this process and in those that it starts; in the user's own cache. Without ccache nothing is
    different but the time. Another launcher that somebody chose stays."""
    if shutil.which("ccache"):
        os.environ.setdefault("CMAKE_CXX_COMPILER_LAUNCHER", "ccache")
        os.environ["CCACHE_NOHASHDIR"] = "1"
