"""The command `test`: everything that shows the kit works."""

import os
import shutil
import subprocess
import sys
from functools import partial
from pathlib import Path

from rich.console import Console

from raysteps.common.process import run
from raysteps.kit.building import BuildTree, what_failed
from raysteps.kit.manifest import read_steps
from raysteps.kit.project import Project
from raysteps.kit.stubs import outdated_stubs
from raysteps.upkeep.checks import Check, Report, run_checks
from raysteps.upkeep.handbook.command import out_of_date
from raysteps.upkeep.same_picture import scenes_that_differ
from raysteps.upkeep.samples import outdated_samples
from raysteps.upkeep.truth.command import check_truth

_TEST_SECONDS = 900
_PYTEST_SECONDS = 2400
_FUZZ_SECONDS = 60
_PAIRS = 40
_SLOW = "pytest, hostile submissions and packages for other systems"


def _command(words: list[str | Path], cwd: Path, seconds: float = _TEST_SECONDS) -> Report:
    """Passes when the program exits with 0."""
    outcome = run(words, seconds=seconds, cwd=cwd)
    if outcome.code == 0 and not outcome.timed_out:
        return Report("passed")
    output = (outcome.stdout + outcome.stderr)[-6000:]
    return Report("failed", f"it ran longer than {seconds:.0f} s\n{output}" if outcome.timed_out else output)


def _build(tree: BuildTree, targets: list[str]) -> Report:
    with tree.locked():
        outcome = tree.build(targets)
    return Report("passed") if outcome.code == 0 else Report("failed", what_failed(outcome))


def _program(tree: BuildTree, name: str, *args: str | Path) -> Report:
    """Builds the program, so that an old one never passes for a new one, and runs it."""
    built = _build(tree, [name])
    return _command([tree.program(name), *args], tree.project.root) if built.verdict == "passed" else built


def _program_checks(tree: BuildTree, suffix: str = "") -> list[Check]:
    names = ["test-framework", *(f"test-reference-{step.number}" for step in read_steps(tree.project))]
    checks = [Check(name + suffix, partial(_program, tree, name)) for name in names]
    replay = "fuzz-readers-replay"
    return [*checks, Check(replay + suffix, partial(_program, tree, replay, _corpus(tree.project)))]


def _corpus(project: Project) -> Path:
    return project.root / "framework" / "io" / "fuzz" / "corpus"


def _stubs(project: Project) -> Report:
    names = [step.path.as_posix() for step in outdated_stubs(project, read_steps(project))]
    text = "these stubs differ from what the solutions generate (./raysteps dev stubs makes them anew): "
    return Report("failed", text + ", ".join(names)) if names else Report("passed")


def _samples(project: Project) -> Report:
    names = [path.relative_to(project.root).as_posix() for path in outdated_samples(project, read_steps(project))]
    text = "these samples differ from what the solutions make (./raysteps dev samples makes them anew): "
    return Report("failed", text + ", ".join(names)) if names else Report("passed")


def _truth(project: Project, console: Console, *, pairs: int) -> Report:
    code = check_truth(project, console, lambda text: None, pairs=pairs)
    return Report("failed", "its table and lines stand above") if code else Report("passed")


def _mistakes(project: Project) -> Report:
    old = out_of_date(project, lambda text: None)
    text = "these differ from what the catalogue makes (./raysteps dev mistakes makes them anew): "
    return Report("failed", text + ", ".join(old)) if old else Report("passed")


def _same_pictures(project: Project, tree: BuildTree) -> Report:
    built = _build(tree, ["raytrace-reference"])
    if built.verdict != "passed":
        return built
    different = scenes_that_differ(project, tree.program("raytrace-reference"))
    return Report("failed", "\n".join(different)) if different else Report("passed")


def _python_checks(project: Project) -> list[Check]:
    grader = project.root / "grader"
    python = Path(sys.executable)
    generator = project.scenes / "generate.py"
    return [
        Check("stubs match the solutions", lambda: _stubs(project)),
        Check("samples match the solutions", lambda: _samples(project)),
        Check("generated scenes match the generator", lambda: _command([python, generator, "--check"], project.root)),
        Check("ruff check", lambda: _command([python, "-m", "ruff", "check", "."], grader)),
        Check("ruff format", lambda: _command([python, "-m", "ruff", "format", "--check", "."], grader)),
        Check("mypy --strict", lambda: _command([python, "-m", "mypy"], grader)),
        Check("pytest, with grading from end to end", lambda: _pytest(project, "not slow")),
    ]


def _pytest(project: Project, marked: str) -> Report:
    words: list[str | Path] = [sys.executable, "-m", "pytest", "-q", "-m", marked]
    return _command(words, project.root / "grader", _PYTEST_SECONDS)


def _grade_checks(project: Project, console: Console, *, full: bool) -> list[Check]:
    pairs = _PAIRS if full else 0
    name = "grades are true: stubs, references, known mistakes, other ways" + (", pairs of mistakes" if full else "")
    return [
        Check(name, lambda: _truth(project, console, pairs=pairs)),
        Check("pages of mistakes match the catalogue", lambda: _mistakes(project)),
    ]


def _asan_checks(project: Project) -> list[Check]:
    tree = BuildTree(project, "asan", project.build / "asan", project.steps)
    tests = [f"test-reference-{step.number}" for step in read_steps(project)]
    targets = ["test-framework", *tests, "fuzz-readers-replay"]
    build = Check("build with address and undefined behaviour sanitizers", lambda: _build(tree, targets))
    return [build, *_program_checks(tree, ", sanitized")]


def _install_clang() -> bool:
    """Whether clang++ is there, after an attempt to install it where that is possible."""
    if shutil.which("clang++") is None and shutil.which("apt-get") is not None:
        admin = [] if os.geteuid() == 0 else ["sudo", "-n"]
        install = [*admin, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "install", "-y", "clang"]
        for words in ([*admin, "apt-get", "update"], install):
            try:
                subprocess.run(words, check=False, capture_output=True, stdin=subprocess.DEVNULL, timeout=900)
            except (OSError, subprocess.TimeoutExpired):
                return False
    return shutil.which("clang++") is not None


def _fuzz(project: Project, tree: BuildTree) -> Report:
    corpus = project.build / "fuzz" / "corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    words: list[str | Path] = [corpus, _corpus(project)]
    words += [f"-max_total_time={_FUZZ_SECONDS}", "-timeout=10", "-rss_limit_mb=2048", "-print_final_stats=1"]
    return _program(tree, "fuzz-readers", *words, f"-artifact_prefix={corpus.parent}/")


def _clang_checks(project: Project) -> list[Check]:
    if not _install_clang():
        missing = Report("skipped", "install: clang")
        return [Check(name, lambda: missing) for name in ("build everything with clang", "fuzz-readers for 60 s")]
    compiler = ("-DCMAKE_CXX_COMPILER=clang++",)
    tree = BuildTree(project, "dev", project.build / "clang", project.steps, compiler)
    watched = (*compiler, "-DRAYSTEPS_FUZZ=ON", "-DRAYSTEPS_SANITIZE=address,undefined,fuzzer-no-link")
    fuzzer = BuildTree(project, "asan", project.build / "fuzz", project.steps, watched)
    return [
        Check("build everything with clang", lambda: _build(tree, [])),
        Check("test-framework, clang", partial(_program, tree, "test-framework")),
        Check("build the fuzz target", lambda: _build(fuzzer, ["fuzz-readers"])),
        Check(f"fuzz-readers for {_FUZZ_SECONDS} s", lambda: _fuzz(project, fuzzer)),
    ]


def selftest(project: Project, console: Console, *, full: bool) -> int:
    """All checks, or all that need no more than the basic tools."""
    tree = BuildTree(project, "dev", project.build / "dev", project.steps)
    checks = [Check("build everything, warnings are errors", lambda: _build(tree, [])), *_program_checks(tree)]
    checks.append(Check("none, boxes and octree give the same picture", lambda: _same_pictures(project, tree)))
    checks += _grade_checks(project, console, full=full)
    checks += _python_checks(project)
    if full:
        checks.append(Check(_SLOW, lambda: _pytest(project, "slow")))
        checks += _asan_checks(project) + _clang_checks(project)
    else:
        more = Report("skipped", "run: ./raysteps test --full")
        names = (_SLOW, "sanitizers", "build everything with clang", "fuzz-readers for 60 s")
        checks += [Check(name, lambda: more) for name in names]
    return run_checks(checks, console)
