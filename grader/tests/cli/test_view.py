"""The window, on a screen that nobody sees."""

import os
import re
import shutil
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from raysteps.cli.view import check_glfw
from raysteps.common.errors import UsageError
from raysteps.course.project import Project
from raysteps.images.compare import is_flat, read_ppm
from raysteps.toolchain.cmake import BuildTree, release_tree, what_failed
from tools.figures.renders import NoScreen, hidden_screen

_SECONDS = 60  # until something has surely gone wrong
_PROGRAMS = ["view-reference", "inspect-reference", "raytrace-reference"]
_SCENE = "scenes/lessons/glass.nff"


@pytest.fixture(scope="module")
def tree(project: Project) -> BuildTree:
    """With the window and what it is compared with."""
    built = release_tree(project)
    try:
        check_glfw(built)
    except UsageError:
        pytest.skip("GLFW is missing: install libglfw3-dev")
    with built.locked():
        outcome = built.build(_PROGRAMS)
    assert outcome.code == 0, what_failed(outcome)
    return built


@pytest.fixture(scope="module")
def screen() -> Iterator[dict[str, str]]:
    """The environment of a program on a screen of its own."""
    try:
        with hidden_screen() as environment:
            yield environment
    except NoScreen as error:
        pytest.skip(str(error))


def _run(command: list[str | Path], cwd: Path, env: dict[str, str] | None = None) -> str:
    done = subprocess.run(command, cwd=cwd, env=env, capture_output=True, text=True, timeout=_SECONDS, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize(("step", "size"), [("2", "61x47"), ("6", "160x120"), ("8", "401x33")])
def test_the_window_shows_the_picture_and_a_click_inspects(
    project: Project, tree: BuildTree, screen: dict[str, str], tmp_path: Path, step: str, size: str
) -> None:
    same: list[str | Path] = ["--step", step, "--size", size]
    shown, traced = tmp_path / "shown.ppm", tmp_path / "traced.ppm"
    view: list[str | Path] = [tree.program("view-reference"), _SCENE, *same, "--screenshot", shown, "--click", "40,30"]
    text = _run(view, project.root, screen)
    _run([tree.program("raytrace-reference"), _SCENE, *same, "-o", traced, "--quiet"], project.root)
    assert not is_flat(read_ppm(shown))
    assert (read_ppm(shown) == read_ppm(traced)).all()
    assert text == _run([tree.program("inspect-reference"), _SCENE, "40", "30", *same], project.root)


def _until(what: Callable[[], str]) -> str:
    """Asks until there is an answer."""
    end = time.monotonic() + _SECONDS
    while time.monotonic() < end:
        if answer := what():
            return answer
        time.sleep(0.05)
    raise AssertionError("nothing happened")


def _parts(pattern: str, text: str) -> tuple[str, ...]:
    """The groups of a pattern that the text begins with."""
    found = re.match(pattern, text)
    assert found is not None, text
    return found.groups()


def test_a_camera_that_was_dragged_can_be_put_into_a_scene(
    project: Project, tree: BuildTree, screen: dict[str, str], tmp_path: Path
) -> None:
    if shutil.which("xdotool") is None:
        pytest.skip("xdotool is missing: install xdotool")

    def hand(*words: str) -> str:
        done = subprocess.run(["xdotool", *words], env=screen, capture_output=True, text=True, check=False)
        return done.stdout.strip()

    scene = (project.root / _SCENE).read_text(encoding="utf-8")
    (tmp_path / "scene.nff").write_text(scene, encoding="utf-8")
    said = tmp_path / "said.txt"
    command = [str(tree.program("view-reference")), "scene.nff", "--size", "320x240"]
    with said.open("w") as out, subprocess.Popen(command, cwd=tmp_path, env=screen, stdout=out) as window:
        try:
            _until(lambda: hand("search", "--name", "scene.nff.*100%"))
            hand("mousemove", "300", "200", "mousedown", "1", "mousemove", "340", "190", "mousemove", "380", "180")
            hand("mouseup", "1", "mousemove", "200", "220", "click", "1")
            _until(lambda: "the pixel" if "the pixel" in said.read_text() else "")
            hand("key", "q")
            assert window.wait(_SECONDS) == 0
        finally:
            window.kill()
    camera, text = _parts(r"(?s)# .*?\n(v\n.*?resolution 320 240\n)(.*)$", said.read_text())
    moved, times = re.subn(r"(?m)^v\n(?:(?:from|at|up|angle|hither|resolution) .*\n)+", camera, scene)
    assert times == 1
    assert moved != scene
    (tmp_path / "scene.nff").write_text(moved, encoding="utf-8")
    x, y = _parts(r"pixel \((\d+), (\d+)\)", text)
    assert text == _run([tree.program("inspect-reference"), "scene.nff", x, y], tmp_path)


def test_without_a_screen_there_is_a_message(project: Project, tree: BuildTree) -> None:
    env = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    command = [str(tree.program("view-reference")), _SCENE]
    done = subprocess.run(command, cwd=project.root, env=env, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "no window can be opened" in done.stderr
    assert "./raysteps render" in done.stderr


def test_without_glfw_the_command_names_the_package(project: Project, tmp_path: Path) -> None:
    lacking = ("-DCMAKE_DISABLE_FIND_PACKAGE_glfw3=ON",)
    with pytest.raises(UsageError, match="libglfw3-dev"):
        check_glfw(BuildTree(project, "release", tmp_path / "build", project.steps, lacking))
