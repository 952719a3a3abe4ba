"""Checks that build the C++ programs and run them: as usual, with sanitizers, by clang, and for Windows."""

import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path

from raysteps.common.process import Outcome, run
from raysteps.course.manifest import kit_steps
from raysteps.course.project import Project
from raysteps.images.compare import PictureError, compare, read_ppm
from raysteps.play.packages import CACHE_VARIABLE
from raysteps.toolchain.cmake import BuildTree, what_failed
from tools.selftest.checks import Check, Report
from tools.selftest.stamps import FileFilter

# Debian packages that only the tests of the kit need; installed where that needs no question.

_INSTALL_SECONDS = 1200

CACHE = ("ccache",)
CLANG = ("clang",)
MINGW = ("g++-mingw-w64-x86-64-posix", "wine64", "wine")
PAGES = ("chromium-headless-shell", "chromium")  # one of them: the first does the same in less time
WINDOW = ("libglfw3-dev", "libgl1-mesa-dri", "xvfb", "xdotool")


def _installed(package: str) -> bool:
    words = ["dpkg-query", "-W", "-f", "${Status}", package]
    done = subprocess.run(words, check=False, capture_output=True, text=True)
    return done.stdout.endswith("ok installed")


def install(packages: Sequence[str]) -> bool:
    """Whether they are there, after an attempt to install what is missing."""
    if shutil.which("apt-get") is None or shutil.which("dpkg-query") is None:
        return False
    missing = [package for package in packages if not _installed(package)]
    if missing:
        admin = [] if not hasattr(os, "geteuid") or os.geteuid() == 0 else ["sudo", "-n"]
        get = [*admin, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get"]
        try:
            for words in (["update"], ["install", "-y", *missing]):
                subprocess.run(
                    [*get, *words], check=False, capture_output=True, stdin=subprocess.DEVNULL, timeout=_INSTALL_SECONDS
                )
        except (OSError, subprocess.TimeoutExpired):
            return False
    return all(map(_installed, missing))


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


Inputs = Callable[[str], FileFilter]  # what a check that uses a module of the kit depends on

_TEST_SECONDS = 900
_FUZZ_RUNS = 400_000  # about a minute
LINES = "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O2 -g1 -DNDEBUG"  # all warnings; lines in what they report, no variables
_QUICK = "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1 -DNDEBUG"  # half the time to build, and lines in what they report


def command(words: list[str | Path], cwd: Path, seconds: float = _TEST_SECONDS, progress: str = "(?!)") -> Report:
    """Passes when the program exits with 0. Lines of its output that begin like `progress`, a pattern, are no news."""
    outcome = run(words, seconds=seconds, cwd=cwd)
    if outcome.code == 0 and not outcome.timed_out:
        return Report("passed")
    lines = (outcome.stdout + outcome.stderr).splitlines()
    output = "\n".join(line for line in lines if not re.match(progress, line))[-6000:]
    return Report("failed", f"it ran longer than {seconds:.0f} s\n{output}" if outcome.timed_out else output)


def build(tree: BuildTree, targets: list[str]) -> Report:
    with tree.locked():
        outcome = tree.build(targets)
    return Report("passed") if outcome.code == 0 else Report("failed", what_failed(outcome))


def _program(tree: BuildTree, name: str, *args: str | Path, by: Sequence[str] = ()) -> Report:
    """Builds the program, so that an old one never passes for a new one, and runs it, or has it run `by` another."""
    built = build(tree, [name])
    return command([*by, tree.program(name), *args], tree.project.root) if built.verdict == "passed" else built


def build_check(name: str, tree: BuildTree, targets: list[str], inputs: Inputs) -> Check:
    return Check(name, lambda: build(tree, targets), inputs(__name__))


def _program_check(name: str, tree: BuildTree, inputs: Inputs, program: str, *args: str | Path) -> Check:
    return Check(name, partial(_program, tree, program, *args), inputs(__name__), beside=True)


def program_checks(tree: BuildTree, inputs: Inputs, suffix: str = "") -> list[Check]:
    """The tests of the framework and of all steps."""
    names = ["test-framework", *(f"test-reference-{step.number}" for step in kit_steps(tree.project))]
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
    """By clang where it can be had: it needs a third of the time that g++ takes for code with sanitizers, and warns of
    other things, so it builds everything. Sealed programs, which sanitizers do not allow, are g++'s only."""
    compiler = ("-DCMAKE_CXX_COMPILER=clang++",) if _has_clang() else ()
    tree = BuildTree(project, "asan", project.build / "asan", project.steps, (*compiler, _QUICK))
    tests = [f"test-reference-{step.number}" for step in kit_steps(project)]
    targets = [] if compiler else ["test-framework", *tests, "fuzz-readers-replay"]
    name = f"build {'everything with clang, ' if compiler else ''}with address and undefined behaviour sanitizers"
    checks = [build_check(name, tree, targets, inputs), *program_checks(tree, inputs, ", sanitized")]
    if not compiler:
        checks.append(Check("build everything with clang", lambda: Report("skipped", "install: clang")))
    return checks


def _fuzz(project: Project, tree: BuildTree) -> Report:
    """From the corpus of the repository, and from what earlier runs found. In a fresh clone it goes the same way each
    time, so what it finds can be found again; a further run goes on from there. The fuzzer looks at addresses, too:
    where the system allows it, they are the same each time."""
    found = project.build / "fuzz" / "corpus"
    found.mkdir(parents=True, exist_ok=True)
    seeds = ",".join(str(path) for path in sorted(_corpus(project).iterdir()))
    words = [f"-runs={_FUZZ_RUNS}", "-seed=1", "-reload=0", "-detect_leaks=0"]  # leaks are looked for at the end
    words += ["-timeout=10", "-rss_limit_mb=2048", "-print_final_stats=1"]
    words += [f"-seed_inputs={seeds}", f"-artifact_prefix={found.parent}/"]
    fixed = ["setarch", "-R"]
    same_addresses = shutil.which("setarch") and run([*fixed, "true"], seconds=_TEST_SECONDS).code == 0
    return _program(tree, "fuzz-readers", found, *words, by=fixed if same_addresses else ())


def fuzz_checks(project: Project, inputs: Inputs) -> list[Check]:
    name = "fuzz-readers"
    if not _has_clang():
        return [Check(name, lambda: Report("skipped", "install: clang"))]
    sanitizers = "-DRAYSTEPS_SANITIZE=address,undefined,fuzzer-no-link"
    options = ("-DCMAKE_CXX_COMPILER=clang++", _QUICK, "-DRAYSTEPS_FUZZ=ON", sanitizers)
    tree = BuildTree(project, "asan", project.build / "fuzz", project.steps, options)
    return [
        build_check("build the fuzz target", tree, ["fuzz-readers"], inputs),
        Check(name, lambda: _fuzz(project, tree), inputs(__name__), beside=True),
    ]


# What was compiled once is not compiled again: tests build many copies of the kit, a fresh clone is one, too, and they
# start Python thousands of times.


def use_caches() -> None:
    """From here on, in this process and in those that it starts, also where these have another home; ccache, and what
    the page to work in is made of, in the user's own cache. Nothing is different but the time. Another launcher that
    somebody chose stays."""
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    if ccache := shutil.which("ccache"):
        os.environ.setdefault("CMAKE_CXX_COMPILER_LAUNCHER", "ccache")
        os.environ["CCACHE_NOHASHDIR"] = "1"
        asked = subprocess.run([ccache, "--get-config", "cache_dir"], capture_output=True, check=False, text=True)
        if folder := asked.stdout.strip():
            os.environ.setdefault("CCACHE_DIR", folder)
    with suppress(OSError, RuntimeError):  # no home, or none to write in
        page = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "raysteps" / "play"
        page.mkdir(parents=True, exist_ok=True)
        os.environ.setdefault(CACHE_VARIABLE, str(page))


# Programs for Windows: compiled here by MinGW-w64, run by Wine.

_COMPILERS = ("x86_64-w64-mingw32-g++-posix", "x86_64-w64-mingw32-g++")
_WINE_SECONDS = 600
_SCENE = "scenes/lessons/three-spheres.nff"
_BUILD = "build for Windows (MinGW-w64)"
_RUN = "test-framework, the tests of all steps and the same pictures, Windows (Wine)"


def windows_checks(project: Project, native: BuildTree, inputs: Inputs) -> list[Check]:
    """`native` holds the programs of this system, to compare with."""
    if not ((any(map(shutil.which, _COMPILERS)) and shutil.which("wine")) or install(MINGW)):
        missing = Report("skipped", f"install: {' '.join(MINGW)}")
        return [Check(name, lambda: missing) for name in (_BUILD, _RUN)]
    tree = BuildTree(project, "mingw", project.build / "mingw", project.steps)
    tests = ["test-framework", "test-reference"]  # which holds the tests of all steps
    belongs = inputs(__name__)
    return [
        Check(_BUILD, lambda: build(tree, [*tests, "raytrace-reference"]), belongs),
        Check(_RUN, lambda: _right_in_wine(native, tree, tests), belongs, beside=True),
    ]


def _right_in_wine(native: BuildTree, tree: BuildTree, tests: list[str]) -> Report:
    with _wine_running(tree):
        failed = [*_failed_in_wine(tree, tests), *_different_in_wine(native, tree)]
    return Report("failed", "\n".join(failed)) if failed else Report("passed")


@contextmanager
def _wine_running(tree: BuildTree) -> Iterator[None]:
    """With a Windows of its own in the build folder, whose server stays until the end of it. By itself the server ends
    with its last program, and cuts off the next one if that comes at this moment."""
    (tree.folder / "wine").mkdir(parents=True, exist_ok=True)
    _with_wine(tree, ["wineserver", "--persistent"])
    try:
        _with_wine(tree, ["wine", "wineboot", "--init"])
        yield
    finally:
        _with_wine(tree, ["wineserver", "--kill"])


def _with_wine(tree: BuildTree, words: list[str | Path]) -> Outcome:
    """Without a window and with nothing that asks."""
    settings = {"WINEPREFIX": str(tree.folder / "wine"), "WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree,mshtml="}
    options = [f"{name}={value}" for name, value in settings.items()]
    display = ["-u", "DISPLAY"] if "DISPLAY" in os.environ else []
    return run(["env", *display, *options, *words], seconds=_WINE_SECONDS, cwd=tree.project.root)


def _program_in_wine(tree: BuildTree, name: str, options: list[str | Path]) -> Outcome:
    return _with_wine(tree, ["wine", tree.bin / f"{name}.exe", *options])


def _failed_in_wine(tree: BuildTree, tests: list[str]) -> Iterator[str]:
    for name in tests:
        outcome = _program_in_wine(tree, name, [])
        if outcome.code != 0 or outcome.timed_out or "All tests passed" not in outcome.stdout:
            yield f"{name}:\n{(outcome.stdout + outcome.stderr)[-2000:]}"


def _different_in_wine(native: BuildTree, tree: BuildTree) -> Iterator[str]:
    """Pictures after each step, by the gate of grades without one wrong pixel: powers come from another library of
    maths on Windows, so a byte may be off by one."""
    built = build(native, ["raytrace-reference"])
    if built.verdict != "passed":
        yield built.detail
        return
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        for step in kit_steps(tree.project):
            options: list[str | Path] = [tree.project.root / _SCENE, "--size", _SIZE, "--step", str(step.index)]
            options += ["--quiet", "-o"]
            # a name that no code page has, to see that paths are not spoiled on the way
            here, there = Path(folder) / "here.ppm", Path(folder) / f"dört-光-{step.number}.ppm"
            run([native.program("raytrace-reference"), *options, here], seconds=_WINE_SECONDS)
            said = _program_in_wine(tree, "raytrace-reference", [*options, there])
            try:
                verdict = compare(read_ppm(there), read_ppm(here), 0.0)
            except PictureError as error:
                yield f"step {step.number}: {error} {said.stderr[-500:]}"
            else:
                if not verdict.passed:
                    yield f"step {step.number}: {verdict.message}"
