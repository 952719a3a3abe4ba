"""Checks of the Windows programs: compiled here by MinGW-w64, run by Wine."""

import os
import shutil
import tempfile
from pathlib import Path

from raysteps.common.process import Outcome, run
from raysteps.course.manifest import read_steps
from raysteps.course.project import Project
from raysteps.images.compare import PictureError, compare, read_ppm
from raysteps.toolchain.cmake import BuildTree, what_failed
from tools.selftest.checks import Check, Report
from tools.selftest.debian import MINGW, install
from tools.selftest.programs import Inputs

_COMPILERS = ("x86_64-w64-mingw32-g++-posix", "x86_64-w64-mingw32-g++")
_SECONDS = 600
_SIZE = "96x96"
_SCENE = "scenes/lessons/three-spheres.nff"
_BUILD = "build for Windows (MinGW-w64)"
_RUN = "test-framework and the tests of all steps, Windows (Wine)"
_PICTURES = "the same pictures on Windows (Wine)"


def windows_checks(project: Project, native: BuildTree, inputs: Inputs) -> list[Check]:
    """`native` holds the programs of this system, to compare with."""
    if not ((any(map(shutil.which, _COMPILERS)) and shutil.which("wine")) or install(MINGW)):
        missing = Report("skipped", f"install: {' '.join(MINGW)}")
        return [Check(name, lambda: missing) for name in (_BUILD, _RUN, _PICTURES)]
    tree = BuildTree(project, "mingw", project.build / "mingw", project.steps)
    tests = ["test-framework", "test-reference"]  # which holds the tests of all steps
    belongs = inputs(__name__)
    return [
        Check(_BUILD, lambda: _built(tree, [*tests, "raytrace-reference"]), belongs),
        Check(_RUN, lambda: _all_pass(tree, tests), belongs, beside=True),
        Check(_PICTURES, lambda: _same_pictures(native, tree), belongs, beside=True),
    ]


def _built(tree: BuildTree, targets: list[str]) -> Report:
    with tree.locked():
        outcome = tree.build(targets)
    if outcome.code == 0:
        _in_wine(tree, ["wineboot", "--init"])  # its Windows is made here, and not by two programs at a time
    return Report("passed") if outcome.code == 0 else Report("failed", what_failed(outcome))


def _program(tree: BuildTree, name: str) -> Path:
    return tree.bin / f"{name}.exe"


def _in_wine(tree: BuildTree, words: list[str | Path]) -> Outcome:
    """With a Windows of its own in the build folder, without a window and with nothing that asks."""
    settings = {"WINEPREFIX": str(tree.folder / "wine"), "WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree,mshtml="}
    options = [f"{name}={value}" for name, value in settings.items()]
    display = ["-u", "DISPLAY"] if "DISPLAY" in os.environ else []
    return run(["env", *display, *options, "wine", *words], seconds=_SECONDS, cwd=tree.project.root)


def _all_pass(tree: BuildTree, tests: list[str]) -> Report:
    failed = []
    for name in tests:
        outcome = _in_wine(tree, [_program(tree, name)])
        if outcome.code != 0 or outcome.timed_out or "All tests passed" not in outcome.stdout:
            failed.append(f"{name}:\n{(outcome.stdout + outcome.stderr)[-2000:]}")
    return Report("failed", "\n".join(failed)) if failed else Report("passed")


def _same_pictures(native: BuildTree, tree: BuildTree) -> Report:
    """After each step, by the gate of grades without one wrong pixel: powers come from another library of maths on
    Windows, so a byte may be off by one."""
    with native.locked():
        outcome = native.build(["raytrace-reference"])
    if outcome.code != 0:
        return Report("failed", what_failed(outcome))
    different = []
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        for step in read_steps(tree.project):
            options: list[str | Path] = [tree.project.root / _SCENE, "--size", _SIZE, "--step", str(step.index)]
            options += ["--quiet", "-o"]
            # a name that no code page has, to see that paths are not spoiled on the way
            here, there = Path(folder) / "here.ppm", Path(folder) / f"dört-光-{step.number}.ppm"
            run([native.program("raytrace-reference"), *options, here], seconds=_SECONDS)
            said = _in_wine(tree, [_program(tree, "raytrace-reference"), *options, there])
            try:
                verdict = compare(read_ppm(there), read_ppm(here), 0.0)
            except PictureError as error:
                different.append(f"step {step.number}: {error} {said.stderr[-500:]}")
            else:
                different += [] if verdict.passed else [f"step {step.number}: {verdict.message}"]
    return Report("failed", "\n".join(different)) if different else Report("passed")
