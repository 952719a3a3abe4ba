"""The command `render`: builds what is out of date, then runs raytrace with the same arguments."""

import argparse
import os
import re
import subprocess
import sys
import threading
from collections.abc import Callable, Sequence
from pathlib import Path

from raysteps.cli.convert import as_scene
from raysteps.cli.todo_steps import advice, as_far_as_written, last_value, refuse_missing_tree, wanted_step
from raysteps.common.errors import GraderFault, StudentBuildError, UsageError
from raysteps.common.files import refuse_to_write
from raysteps.common.platform import own_command
from raysteps.common.process import Outcome
from raysteps.common.text import nearest, printable
from raysteps.course.manifest import Step, read_all_steps, read_steps
from raysteps.course.project import Project, here
from raysteps.course.stubs import uses
from raysteps.grading.build_messages import (
    bare_name,
    calls_what_it_may_not,
    compile_message,
    defines,
    errors_in,
    is_of_a_linker,
    link_message,
    missing_here,
    missing_name,
    undefined_here,
    undefined_message,
)
from raysteps.models import ENDINGS
from raysteps.report.terminal import short_path
from raysteps.report.wording import with_folder
from raysteps.results.statuses import NOT_BUILT
from raysteps.sandbox.task import TaskResult
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.cmake import BuildTree, release_tree, what_failed

# What a student is told when a program that is made of the own steps does not build.

_FAILED = re.compile(r"^FAILED: .*$", re.MULTILINE)
_USAGE = UsageError.exit_code


def _failed_step(steps: list[Step], said: str) -> Step | None:
    """The first whose own file has an error, else the one at which the build stopped: its error is in a header. Where
    a file of the kit fails as well, it is the kit's."""
    with_errors = [step for step in steps if errors_in(said, step.file)]
    failed = [line.replace("\\", "/") for line in _FAILED.findall(said)]
    stopped = [next((step for step in steps if step.path.as_posix() in line), None) for line in failed]
    return next(iter(with_errors or ([] if None in stopped else stopped)), None)


def _source(project: Project, step: Step) -> str:
    """As it lies there; nothing where it is no file, as in a students' kit that lacks the step."""
    try:
        return (project.steps / step.path).read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""


def _about(step: Step, message: str) -> str:
    return f"step {step.number} does not build: {with_folder(message.removeprefix(NOT_BUILT), step)}"


def _not_linked(project: Project, steps: list[Step], said: str, ran: TaskResult) -> str:
    """Something that a header asks for, or a helper that was declared and forgotten."""
    missing = missing_name(said)
    if missing is None:
        return f"your steps do not build: {link_message(ran).removeprefix(NOT_BUILT)}"
    name, line = missing
    bare = bare_name(name)
    written = f"::{name.partition('(')[0].strip()}"
    owner = next((step for step in steps if any(written.endswith(f"::{one}") for one in step.functions)), None)
    if owner is not None:
        return _about(owner, missing_here(owner, (name,), _source(project, owner)))
    sources = {step: _source(project, step) for step in steps}
    # Who defines such a name calls its own, unless nobody else calls it.
    using = sorted(
        (step for step in steps if any(uses(sources[step], [bare]))), key=lambda it: defines(sources[it], bare)
    )
    caller = next((step for step in steps if step.file in line), None) or next(iter(using), None)
    if caller is not None:
        return _about(caller, undefined_here(caller, (name,), sources[caller]))
    return f"your steps do not build: {undefined_message((name,)).removeprefix(NOT_BUILT)}"


def why_own_steps_do_not_build(project: Project, outcome: Outcome) -> str:
    """The first error in a file of the student's with the lines around it, as `check` shows it."""
    if outcome.timed_out:
        return f"your steps do not build: it was stopped after {outcome.seconds:.0f} s"
    said = printable(outcome.stdout + outcome.stderr)
    ran = TaskResult(Outcome(outcome.code, outcome.timed_out, "", said, outcome.seconds), {}, outcome.seconds, "")
    steps = read_steps(project)
    step = _failed_step(steps, said)
    if step is not None:
        return _about(step, compile_message(step, _source(project, step), ran))
    if is_of_a_linker(said):
        return _not_linked(project, steps, said, ran)
    return f"your steps do not build:\n{what_failed(outcome)}"


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
    print(f"raysteps: {text}", file=sys.stderr, flush=True)


def _build(tree: BuildTree, target: str) -> Outcome:
    """Says that it takes a while, once: after an error of the student's, too, the next build is not the first."""
    begun = tree.folder / "begun" / target
    if not (begun.exists() or tree.program(target).exists()):
        _say("building; the first time may take a minute")
    with tree.locked():
        begun.parent.mkdir(parents=True, exist_ok=True)
        begun.touch()
        return tree.build([target], lambda far: _say(f"building: {far}"))


def _refuse_no_source(project: Project) -> None:
    for step in read_all_steps(project):
        path = project.steps / step.path
        if not path.is_file():
            raise StudentBuildError(
                f"steps/{step.path.as_posix()}: is {'a folder' if path.is_dir() else 'not there'}; expected your step "
                f"{step.number}; {own_command()} reset {step.number} puts its stub there"
            )


def _refuse_borrowed(project: Project) -> None:
    """What `check` refuses builds all the same, and would draw the picture of another step's work."""
    steps = read_all_steps(project)
    for step in steps:
        wrong = calls_what_it_may_not(step, steps, _source(project, step))
        if wrong:
            raise StudentBuildError(_about(step, wrong))


def build_mine(tree: BuildTree, target: str = "raytrace-mine") -> Path:
    """Builds a program from the student's steps; what the compiler says is told only when that fails."""
    _refuse_no_source(tree.project)
    outcome = _build(tree, target)
    if outcome.code != 0:
        raise StudentBuildError(why_own_steps_do_not_build(tree.project, outcome))
    _refuse_borrowed(tree.project)
    return tree.program(target)


def build_reference(tree: BuildTree, target: str) -> Path:
    """Builds a program from the reference's steps."""
    outcome = _build(tree, target)
    if outcome.code != 0:
        raise GraderFault(f"{target} does not build:\n{what_failed(outcome)}")
    return tree.program(target)


def build_program(tree: BuildTree, name: str, impl: str) -> Path:
    """NAME-mine or NAME-reference."""
    return (build_mine if impl == "mine" else build_reference)(tree, f"{name}-{impl}")


def implementation_name(program: Path) -> str:
    """A program as people speak of it."""
    return "your program" if program.stem.endswith("-mine") else "the reference's program"


def run_raytrace(program: Path, args: list[str]) -> int:
    """Runs the program on this terminal, so that its progress bar shows, and returns its exit code; 1 after a crash."""
    code = subprocess.run([program, *args], check=False).returncode
    name = Outcome(code, timed_out=False, stdout="", stderr="", seconds=0).signal_words
    if name is not None:
        print(f"raysteps: {implementation_name(program)} crashed ({name}) while it rendered", file=sys.stderr)
        return 1
    return code


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The program itself reads them: see `run_words`."""
    parser.add_argument("args", nargs=argparse.REMAINDER)


_FLAGS = {"--quiet", "--spd", "--strip"}  # without a value behind them
_NOTHING_TO_DRAW = {"-h", "--help", "--list-accel"}


def asks_for_help(project: Project, args: Sequence[str]) -> bool:
    """Of a kit with a reference, whose program gives it while a student's step does not build."""
    return project.has_reference and not {"-h", "--help"}.isdisjoint(args)


def place_of_scene(args: Sequence[str]) -> int | None:
    """Where the first word is that is no option and no value of one."""
    if not _NOTHING_TO_DRAW.isdisjoint(args):
        return None
    pairs = enumerate(zip(("", *args), args, strict=False))
    free = (i for i, (before, _) in pairs if not before.startswith("-") or before in _FLAGS or "=" in before)
    return next((i for i in free if not args[i].startswith("-")), None)


def _is_called_like_a_scene(word: str) -> bool:
    """Behind an option that is none, which the program knows more about."""
    return Path(word).suffix.lower() in (".nff", ".pbrt", *ENDINGS)


def with_scene(project: Project, args: Sequence[str], command: str) -> list[str]:
    """The same words, with a scene that is there. Before anything is built."""
    place = place_of_scene(args)
    if place is None and _NOTHING_TO_DRAW.isdisjoint(args) and not any(map(_is_called_like_a_scene, args)):
        raise UsageError(
            f"{command}: expected a scene, like scenes/lessons/three-spheres.nff; all options: "
            f"{own_command()} {command} --help"
        )
    if place is None:
        return list(args)
    return [*args[:place], resolve_scene(project, args[place]), *args[place + 1 :]]


def resolve_scene(project: Project, scene: str) -> str:
    """The scene, or of a model the scene around it. Before anything is built."""
    path = Path(scene)
    if not scene or (path.exists() and not path.is_dir()):
        return as_scene(project, scene)
    if path.suffix.lower() in ENDINGS:
        raise UsageError(f"{scene}: is {'a folder' if path.is_dir() else 'not there'}; expected a model")
    own = Path(f"{scene}.nff")
    known = {one.stem: one for one in (*sorted(project.scenes.rglob("*.nff")), *([own] if own.is_file() else []))}
    name = nearest(path.stem, known)
    meant = (
        "a scene, such as scenes/lessons/three-spheres.nff; others of the kit lie beside it and in scenes/generated"
        if name is None
        else f"the path of a scene; did you mean {short_path(known[name])}?"
    )
    raise UsageError(f"{scene}: is {'a folder' if path.is_dir() else 'not there'}; expected {meant}")


def refuse_place(args: Sequence[str], option: str) -> None:
    """Of a file that a program writes."""
    word = last_value(args, option)
    if word:
        refuse_to_write(Path(word))


def _is_where_we_print(path: Path) -> bool:
    """Such as /dev/stdout, into a pipe or a file."""
    try:
        return os.path.samestat(path.stat(), os.fstat(sys.stdout.fileno()))
    except (OSError, ValueError):
        return False


def _says_its_kind(path: Path) -> bool:
    """By its ending; what is no file, such as a pipe or where we print, needs none."""
    if path.suffix.lower() in (".png", ".ppm"):
        return True
    return not path.suffix and path.exists() and (not path.is_file() or _is_where_we_print(path))


_LONG = 20.0  # seconds; the kit's own scenes take one or two


def _run_mine(program: Path, args: list[str]) -> int:
    """After a while it says what a function that never ends looks like."""
    words = (
        "your program is still drawing. If nothing moves, one of your functions may never end: Ctrl-C stops it, and "
        f"{own_command()} check with the number of its step may name the line"
    )
    if "--quiet" in args:
        return run_raytrace(program, args)
    telling = threading.Timer(_LONG, _say, [words])
    telling.daemon = True
    telling.start()
    try:
        return run_raytrace(program, args)
    finally:
        telling.cancel()


def _draw(run: Callable[[Path, list[str]], int], program: Path, args: list[str], picture: str | None) -> int:
    """Says where the picture is, except in the picture itself."""
    code = run(program, args)
    if code == 0 and picture is not None and "--quiet" not in args and not _is_where_we_print(Path(picture)):
        print(f"Picture: {picture}", flush=True)
    return code


def run_words(project: Project, args: list[str]) -> int:
    """Same arguments as raytrace, and --impl."""
    impl, args = take_impl(args)
    if asks_for_help(project, args):
        return run_raytrace(build_program(release_tree(project), "raytrace", "reference"), args)
    picture = last_value(args, "-o")
    if picture is not None and not _says_its_kind(Path(picture)):
        raise UsageError(f"{picture}: pictures are written as .png or .ppm; expected a name such as mine.png")
    wanted_step(project, args)  # complains before anything is built
    args = with_scene(project, args, "render")
    if place_of_scene(args) is not None and not any(word == "--spd" or word.startswith("-o") for word in args):
        raise UsageError(f"render: expected -o FILE for the picture; all options: {own_command()} render --help")
    for option in ("-o", "--stats"):
        refuse_place(args, option)
    if impl == "reference":
        kit = build_kit(project, _say)
        return _draw(run_raytrace, kit.reference("raytrace"), args, picture)
    refuse_missing_tree(project, args)
    program = build_mine(release_tree(project))
    if picture is None:
        return _run_mine(program, args)
    more, said = as_far_as_written(project, args)
    code = _draw(_run_mine, program, [*args, *more], picture)
    if code != _USAGE:  # then it says what is wrong with the words, and nothing was drawn
        notes = [note for note in (said, advice(project, wanted_step(project, [*args, *more]))) if note]
        print("".join(f"raysteps: {note}\n" for note in notes), end="", file=sys.stderr)
    return code
