"""The command `render`: builds what is out of date, then runs raytrace with the same arguments."""

import subprocess
import sys
from pathlib import Path

from raysteps.commands.own_build import why_own_steps_do_not_build
from raysteps.commands.unfinished import advice, as_far_as_written, wanted_step
from raysteps.common.errors import GraderFault, StudentBuildError, UsageError
from raysteps.common.process import Outcome
from raysteps.kit.building import BuildTree, release_tree, what_failed
from raysteps.kit.kit_building import build_kit
from raysteps.kit.project import Project, here


def take_impl(args: list[str]) -> tuple[str, list[str]]:
    """Takes `--impl X` out of the arguments."""
    impl = "mine"
    rest = []
    words = iter(args)
    for word in words:
        if word == "--impl":
            impl = next(words, "")
        elif word.startswith("--impl="):
            impl = word.removeprefix("--impl=")
        else:
            rest.append(word)
    if impl not in ("mine", "reference"):
        raise UsageError(f"--impl: expected mine or reference, found '{impl}'")
    if impl == "reference" and not here().has_reference:
        raise UsageError("--impl reference: a students' kit has none; pictures made with it lie in reference/")
    return impl, rest


def _say(text: str) -> None:
    print(f"raysteps: {text}; the first time takes a minute or two", file=sys.stderr, flush=True)


def build_mine(tree: BuildTree, target: str = "raytrace-mine") -> Path:
    """Builds a program from the student's steps; what the compiler says is told only when that fails."""
    if not tree.program(target).exists():
        _say("building")
    with tree.locked():
        outcome = tree.build([target])
    if outcome.code != 0:
        raise StudentBuildError(why_own_steps_do_not_build(tree.project, outcome))
    return tree.program(target)


def build_reference(tree: BuildTree, target: str) -> Path:
    """Builds a program from the reference's steps."""
    if not tree.program(target).exists():
        _say("building")
    with tree.locked():
        outcome = tree.build([target])
    if outcome.code != 0:
        raise GraderFault(f"{target} does not build:\n{what_failed(outcome)}")
    return tree.program(target)


def build_program(tree: BuildTree, name: str, impl: str) -> Path:
    """NAME-mine or NAME-reference."""
    return (build_mine if impl == "mine" else build_reference)(tree, f"{name}-{impl}")


def whose(program: Path) -> str:
    """A program as people speak of it."""
    return "your program" if program.stem.endswith("-mine") else "the reference's program"


def run_raytrace(program: Path, args: list[str]) -> None:
    """Runs the program on this terminal, so that its progress bar shows."""
    code = subprocess.run([program, *args], check=False).returncode
    name = Outcome(code, timed_out=False, stdout="", stderr="", seconds=0).signal_words
    if name is not None:
        print(f"raysteps: {whose(program)} crashed ({name}) while it rendered", file=sys.stderr)
        raise SystemExit(1)
    if code != 0:
        raise SystemExit(code)


def render(project: Project, args: list[str]) -> int:
    """Same arguments as raytrace, and --impl."""
    impl, args = take_impl(args)
    at = args.index("-o") + 1 if "-o" in args else len(args)
    if at < len(args) and Path(args[at]).suffix.lower() not in ("", ".png", ".ppm"):
        raise UsageError(f"{args[at]}: pictures are written as .png or .ppm; expected a name that ends so")
    program = (
        build_kit(project, _say).reference("raytrace") if impl == "reference" else build_mine(release_tree(project))
    )
    if impl == "mine" and at < len(args):
        args = [*args, *as_far_as_written(project, args)]
        said = advice(project, wanted_step(project, args))
        if said:
            print(f"raysteps: {said}", file=sys.stderr)
    run_raytrace(program, args)
    return 0
