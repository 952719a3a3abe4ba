"""The command `view`: a window on a scene."""

import argparse
from pathlib import Path

from raysteps.cli.render import asks_for_help, build_program, refuse_place, run_raytrace, take_impl, with_scene
from raysteps.cli.todo_steps import refuse_missing_tree, wanted_step
from raysteps.common.errors import UsageError
from raysteps.course.project import Project
from raysteps.toolchain.cmake import BuildTree, release_tree

_NO_GLFW = """the window needs GLFW 3.3 or newer and OpenGL, which CMake does not find. Install them and try again:
  Debian, Ubuntu  sudo apt-get install libglfw3-dev
  Fedora          sudo dnf install glfw-devel
  Arch            sudo pacman -S glfw
  Homebrew        brew install glfw
`./raysteps render` makes the same pictures without a window."""


def check_glfw(tree: BuildTree) -> None:
    """Asks CMake, and once more where it said no before: the library may have come since."""
    with tree.locked():
        tree.configure()
        if tree.cached("RAYSTEPS_WINDOW") != "ON":
            tree.configure(again=True)
    if tree.cached("RAYSTEPS_WINDOW") != "ON":
        raise UsageError(_NO_GLFW)


def build_view(tree: BuildTree, impl: str) -> Path:
    """Builds view-mine or view-reference."""
    check_glfw(tree)
    return build_program(tree, "view", impl)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The program itself reads them: see `run_words`."""
    parser.add_argument("args", nargs=argparse.REMAINDER)


def run_words(project: Project, args: list[str]) -> int:
    """The arguments of the program view, and --impl."""
    impl, args = take_impl(args)
    if asks_for_help(project, args):
        impl = "reference"
    wanted_step(project, args)
    args = with_scene(project, args, "view")
    refuse_place(args, "--screenshot")
    if impl == "mine":
        refuse_missing_tree(project, args)
    return run_raytrace(build_view(release_tree(project), impl), args)
