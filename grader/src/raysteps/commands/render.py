"""The command `render`: builds what is out of date, then runs raytrace with the same arguments."""

import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from raysteps.common.errors import GraderFault, StudentBuildError, UsageError
from raysteps.grading.pictures import PictureError, read_ppm, write_png
from raysteps.kit.building import BuildTree, first_error, release_tree, what_failed
from raysteps.kit.project import Project


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
    return impl, rest


def build_program(tree: BuildTree, impl: str) -> Path:
    """Builds raytrace-mine or raytrace-reference; the compiler speaks only when that fails."""
    target = f"raytrace-{impl}"
    if not tree.program(target).exists():
        print("raysteps: building; the first time takes a minute or two", file=sys.stderr, flush=True)
    with tree.locked():
        outcome = tree.build([target])
    if outcome.code != 0:
        output = outcome.stdout + outcome.stderr
        said = what_failed(outcome)
        if impl == "reference":
            raise GraderFault(f"the reference does not build:\n{said}")
        raise StudentBuildError(f"{said}\nYour steps do not build: {first_error(output, tree.mine) or 'see above'}")
    return tree.program(target)


def run_raytrace(program: Path, args: list[str]) -> None:
    """Runs the program on this terminal, so that its progress bar shows."""
    code = subprocess.run([program, *args], check=False).returncode
    if code < 0:
        name = signal.Signals(-code).name if -code in set(signal.Signals) else f"signal {-code}"
        print(f"raysteps: {program.name} crashed ({name}) while it rendered", file=sys.stderr)
        raise SystemExit(1)
    if code != 0:
        raise SystemExit(code)


def render(project: Project, args: list[str]) -> int:
    """Same arguments as raytrace, and a name in .png makes a PNG."""
    impl, args = take_impl(args)
    program = build_program(release_tree(project), impl)
    at = args.index("-o") + 1 if "-o" in args else len(args)
    if at >= len(args) or Path(args[at]).suffix.lower() != ".png":
        run_raytrace(program, args)
        return 0
    target = Path(args[at])
    with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
        picture = Path(folder) / "picture.ppm"
        run_raytrace(program, [*args[:at], str(picture), *args[at + 1 :]])
        if not picture.exists():  # such as --help, which renders nothing
            return 0
        try:
            write_png(read_ppm(picture), target)
        except (PictureError, OSError) as error:
            print(f"raysteps: {target}: {error}", file=sys.stderr)
            return 2
    return 0
