"""Checks that build the C++ programs and run them, with the usual compiler, with sanitizers and with clang."""

import shutil
from functools import partial
from pathlib import Path

from raysteps.common.process import run
from raysteps.kit.building import BuildTree, what_failed
from raysteps.kit.manifest import read_steps
from raysteps.kit.project import Project
from raysteps.upkeep.checks import Check, Report
from raysteps.upkeep.packages import CLANG, install
from raysteps.upkeep.same_picture import scenes_that_differ

_TEST_SECONDS = 900
_FUZZ_SECONDS = 60
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


def program_checks(tree: BuildTree, suffix: str = "") -> list[Check]:
    names = ["test-framework", *(f"test-reference-{step.number}" for step in read_steps(tree.project))]
    checks = [Check(name + suffix, partial(_program, tree, name)) for name in names]
    replay = "fuzz-readers-replay"
    return [*checks, Check(replay + suffix, partial(_program, tree, replay, _corpus(tree.project)))]


def _corpus(project: Project) -> Path:
    return project.root / "framework" / "io" / "fuzz" / "corpus"


def same_pictures(project: Project, tree: BuildTree) -> Report:
    built = build(tree, ["raytrace-reference"])
    if built.verdict != "passed":
        return built
    different = scenes_that_differ(project, tree.program("raytrace-reference"))
    return Report("failed", "\n".join(different)) if different else Report("passed")


def asan_checks(project: Project) -> list[Check]:
    tree = BuildTree(project, "asan", project.build / "asan", project.steps, (_QUICK,))
    tests = [f"test-reference-{step.number}" for step in read_steps(project)]
    targets = ["test-framework", *tests, "fuzz-readers-replay"]
    name = "build with address and undefined behaviour sanitizers"
    return [Check(name, lambda: build(tree, targets)), *program_checks(tree, ", sanitized")]


def _has_clang() -> bool:
    return shutil.which("clang++") is not None or install(CLANG)


def _fuzz(project: Project, tree: BuildTree) -> Report:
    corpus = project.build / "fuzz" / "corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    words: list[str | Path] = [corpus, _corpus(project)]
    words += [f"-max_total_time={_FUZZ_SECONDS}", "-timeout=10", "-rss_limit_mb=2048", "-print_final_stats=1"]
    return _program(tree, "fuzz-readers", *words, f"-artifact_prefix={corpus.parent}/")


def clang_checks(project: Project) -> list[Check]:
    if not _has_clang():
        missing = Report("skipped", "install: clang")
        return [Check(name, lambda: missing) for name in ("build everything with clang", "fuzz-readers for 60 s")]
    compiler = ("-DCMAKE_CXX_COMPILER=clang++", _QUICK)
    tree = BuildTree(project, "dev", project.build / "clang", project.steps, compiler)
    watched = (*compiler, "-DRAYSTEPS_FUZZ=ON", "-DRAYSTEPS_SANITIZE=address,undefined,fuzzer-no-link")
    fuzzer = BuildTree(project, "asan", project.build / "fuzz", project.steps, watched)
    return [
        Check("build everything with clang", lambda: build(tree, [])),
        Check("test-framework, clang", partial(_program, tree, "test-framework")),
        Check("build the fuzz target", lambda: build(fuzzer, ["fuzz-readers"])),
        Check(f"fuzz-readers for {_FUZZ_SECONDS} s", lambda: _fuzz(project, fuzzer)),
    ]
