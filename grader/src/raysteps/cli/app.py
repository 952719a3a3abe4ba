"""The commands of ./raysteps, and how they end. Each has a module of its own, imported when the command is typed."""

import argparse
import errno
import gc
import os
import sys
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from importlib import import_module
from types import ModuleType
from typing import Any, Literal, TextIO, cast

from rich.console import Console

from raysteps import __version__
from raysteps.cli import STUDENTS_KIT, Parser
from raysteps.common.errors import GraderFault, RaystepsError, UsageError, is_full, reason, reason_and_place
from raysteps.common.text import did_you_mean, harmless_log
from raysteps.course.project import Project, here

EXITS = """exit codes: 0 all passed, 1 checks failed, 2 usage, 3 the student's code does not build, 4 grader fault,
130 interrupted"""
Kit = Literal["any", "whole", "students"]


@dataclass(frozen=True)
class Command:
    """What can be typed. Its module has `add_arguments(parser)` and `run(project, arguments, console)`."""

    name: str
    about: str
    module: str
    kit: Kit = "whole"
    supervised: bool = False  # its module has `seconds_at_most(words)`, too


_IMPL = "{impl}"  # where there is a reference, its programs can be chosen
COMMANDS = (
    Command("watch", "build, test and draw a step again with every save", "raysteps.cli.watch", "any"),
    Command("play", "a page to work in: write C++ in a browser, see the picture", "raysteps.cli.play", "any"),
    Command("list", "the steps, and where you stand", "raysteps.cli.steps", "any"),
    Command("next", "which step to work on, what to open and what to type", "raysteps.cli.steps", "any"),
    Command("hint", "the next hint of a step", "raysteps.cli.steps", "any"),
    Command("reset", "begin a step again: your file is kept in build/reset/", "raysteps.cli.steps", "any"),
    Command(
        "render",
        f"render a scene with your own steps: the arguments of raytrace{_IMPL}",
        "raysteps.cli.render",
        "any",
    ),
    Command("convert", "a model (OBJ, glTF, PLY, STL) as a scene", "raysteps.cli.convert", "any"),
    Command("inspect", "follow one pixel: its rays, tests and light", "raysteps.cli.inspect", "any"),
    Command("view", f"a window on a scene: move the camera, click pixels{_IMPL}", "raysteps.cli.view", "any"),
    Command(
        "finale", f"a large smooth picture, a page and a poster by your own steps{_IMPL}", "raysteps.cli.finale", "any"
    ),
    Command("check", "check your own steps", "raysteps.cli.check", "any"),
    Command("compare", "two pictures, pixel by pixel", "raysteps.cli.compare_pictures", "any"),
    Command("report", "make report.html of results that are there already", "raysteps.cli.report", "any"),
    Command("update", "take in a newer kit; your own files stay", "raysteps.cli.update", "students"),
    Command("replay", "ask a hidden case again, as `check` or `grade` wrote it", "raysteps.cli.replay"),
    Command("grade", "grade a submission: a folder, zip or tar", "raysteps.cli.grade", supervised=True),
    Command("learn", "what the known mistakes answer, so that no submission waits for it", "raysteps.cli.learn"),
    Command("grade-class", "grade a whole class", "raysteps.cli.grade_class"),
    Command("nightly", "grade as work comes in, a few times a day for each student", "raysteps.cli.nightly"),
    Command("desk", "read a graded class: comment, change points, answer", "raysteps.cli.desk"),
    Command("leaderboard", "rank submissions by counted work", "raysteps.cli.leaderboard"),
    Command("similar", "which submissions have more in common than others", "raysteps.cli.similar"),
    Command("release", "make the repository that students get", "raysteps.cli.release"),
    Command("image", "a container image that grades, or one for students", "raysteps.cli.image"),
    Command("export", "for Gradescope, Classroom 50, Canvas and others", "raysteps.cli.export"),
    Command("demo", "one picture per step, and two sample submissions graded", "raysteps.cli.demo"),
    Command("gallery", "a page that walks through the steps in pictures", "raysteps.cli.gallery"),
    Command("bench", "measure the reference", "tools.bench.command"),
    Command("docs", "the documents as a site that needs no network", "tools.website.command"),
    Command("figures", "make the figures of the handouts", "tools.figures.command"),
    Command("test", "test the kit itself", "tools.selftest.run"),
    Command("dev", "for those who maintain the kit", "tools.dev"),
)


# What is typed after those that need some words.
EXAMPLES = {
    "reset": "04",
    "convert": "chair.obj -o chair.pbrt",
    "inspect": "scenes/lessons/three-spheres.nff 160 120",
    "compare": "mine.png reference.png",
    "replay": "cases/02-sphere-intersect.json",
    "grade": "submissions/ann.zip",
    "grade-class": "submissions --out grades",
    "nightly": "submissions --out grades",
    "desk": "grades",
    "leaderboard": "grades",
    "similar": "submissions --out similar.html",
    "release": "--out ../course",
    "image": "--tag grader",
    "export": "gradescope --out autograder.zip",
    "gallery": "--out gallery",
    "bench": "render",
    "dev": "check --only 02",
}


# What is meant by those that take no step, where one is named.
_FOR_STEPS = {"test": "check", "list": "check", "next": "hint", "play": "watch"}


# What a students' kit has in their place; else what there is.
_INSTEAD = {"grade": "check", "grade-class": "check", "nightly": "check", "learn": "check", "replay": "check",
            "test": "check", "leaderboard": "report", "desk": "report", "demo": "finale",
            "gallery": "finale"}  # fmt: skip


# Words of other programs, and what comes nearest here.
_MEANT = {"build": "check", "compile": "check", "make": "check", "run": "render", "draw": "render", "open": "report",
          "start": "watch", "status": "list", "steps": "list", "ls": "list", "tip": "hint", "diff": "compare",
          "submit": "check", "show": "view", "plagiarism": "similar", "undo": "reset"}  # fmt: skip


def _no_such_command(project: Project, word: str) -> str:
    there = {one.name: one.about.replace(_IMPL, "") for one in _commands(project)}
    known = {one.name: one for one in COMMANDS}
    if word not in known:
        meant = f"; did you mean {_MEANT[word]}?" if _MEANT.get(word) in there else did_you_mean(word, there)
        return f"there is no such command{meant or '.'} See ./raysteps --help"
    if known[word].kit == "students":
        return "only a students' kit has this command; `./raysteps release` makes one. See ./raysteps --help"
    if project.has_reference:
        return "this copy of the kit was packed without it; the whole kit has it. See ./raysteps --help"
    instead = _INSTEAD.get(word)
    ours = f" Here `./raysteps {instead}` comes nearest: {there[instead]}." if instead else ""
    return (
        "only the instructor's kit has this command; yours is a students' kit, made from that one with "
        f"`./raysteps release`.{ours} See ./raysteps --help"
    )


def _commands(project: Project) -> list[Command]:
    left_out = "students" if project.has_reference else "whole"
    tools = (project.root / "tools").is_dir()  # an autograder is packed without them
    return [one for one in COMMANDS if one.kit != left_out and (tools or not one.module.startswith("tools."))]


def _module(project: Project, command: Command) -> ModuleType:
    root = os.fspath(project.root)
    if command.module.startswith("tools.") and root not in sys.path:
        sys.path.append(root)
    return import_module(command.module)


def new_parser(project: Project, only: str | None = None) -> argparse.ArgumentParser:
    """Of all commands; with `only`, the arguments of no other command are known, which saves importing it."""
    parser = Parser(
        prog="raysteps",
        description="A ray tracer in graded steps.",
        epilog=EXITS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"raysteps {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    impl = "; --impl mine|reference" if project.has_reference else ""
    for command in _commands(project):
        child = commands.add_parser(command.name, help=command.about.replace(_IMPL, impl))
        child.example = EXAMPLES.get(command.name, "")
        child.for_steps = _FOR_STEPS.get(command.name, "")
        if not project.has_reference:
            child.set_defaults(**{STUDENTS_KIT: project})
        if only in (None, command.name):
            _module(project, command).add_arguments(child)
    return parser


# How a command ends: with what exit code, and with what words when something went wrong.

_NO_TERMINAL = 10_000  # columns
_SIGPIPE = 128 + 13  # as a shell has it of programs that a closed pipe ends


# What is expected of a place that a person may have named, or where the kit lies.
_EXPECTED: dict[type[OSError], str] = {
    IsADirectoryError: "expected a file there",
    NotADirectoryError: "expected a folder there",
    FileExistsError: "expected a folder there, or nothing yet",
    PermissionError: "what it needs there must be open to you",
}
_TO_WRITE = "it needs a place where it can write, such as a copy of the kit"


class _ReaderIsGone(BrokenPipeError):
    """Nobody reads what is printed."""


class _ActionsLog:
    """A stream of which GitHub Actions takes no line for a command: what was handed in is printed, too.

    Nobody can tell whether it goes to the log: what a job writes into a file or a pipe is changed as well. A program
    that prints by itself is not."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        self._stream.write(harmless_log(text))
        return len(text)

    def writelines(self, lines: Iterable[str]) -> None:
        self.write("".join(lines))

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


class _Console(Console):
    def on_broken_pipe(self) -> None:
        raise _ReaderIsGone  # not an exit code of 1: see `exit_code_of`


def console_here() -> Console:
    """As wide as the terminal; where there is none, lines are not broken."""
    return _Console(emoji=False) if sys.stdout.isatty() else _Console(emoji=False, width=_NO_TERMINAL)


def _trouble_of_printing() -> OSError | None:
    """What keeps from printing: who reads it has read enough, as `head` does, or where it goes is full. Then nothing
    more is printed."""
    try:
        sys.stdout.flush()
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return error
    return None


def _tell(text: str) -> None:
    with suppress(OSError):  # there may be no room for that either
        print(f"raysteps: {text}", file=sys.stderr)


def exit_code_of(error: BaseException) -> int:
    """Says what went wrong; SystemExit and the like are none of its business, and with RAYSTEPS_DEBUG no fault is."""
    trouble = _trouble_of_printing()
    if isinstance(error, _ReaderIsGone) or isinstance(trouble, BrokenPipeError):
        return _SIGPIPE
    if isinstance(error, RaystepsError):
        _tell(str(error))
        return error.exit_code
    if isinstance(error, KeyboardInterrupt):
        _tell("interrupted")
        return 130
    if trouble is not None:
        _tell(f"what it says cannot be written to where it goes: {reason(trouble)}")
        return GraderFault.exit_code
    if isinstance(error, OSError) and is_full(error):
        where = reason_and_place(error)
        _tell(f"something cannot be written: {where}; make room and type it again")
        return GraderFault.exit_code
    if isinstance(error, OSError) and error.filename is not None:  # else it is no file that could be opened
        expected = next((words for kind, words in _EXPECTED.items() if isinstance(error, kind)), "")
        if expected or error.errno == errno.EROFS:
            _tell(f"{reason_and_place(error)}; {expected or _TO_WRITE}")
            return UsageError.exit_code
    if not isinstance(error, Exception) or os.environ.get("RAYSTEPS_DEBUG"):
        raise error
    Console(stderr=True).print_exception(max_frames=4)
    _tell("this is a fault of the grader, not of your code")
    return GraderFault.exit_code


def as_options(words: Sequence[str]) -> list[str]:
    """`help` and `version` as the options that they mean: `help check` is `check --help`."""
    match list(words):
        case ["help", *rest]:
            return [*rest, "--help"]
        case ["version"]:
            return ["--version"]
    return list(words)


def _command(project: Project, words: Sequence[str]) -> Command | None:
    """The one that is named. Where none is, says so, or prints the help, and may end the process."""
    command = next((one for one in _commands(project) if words[:1] == [one.name]), None)
    if command is None:
        parser = new_parser(project, "")
        if words and not words[0].startswith("-"):
            parser.error(f"{words[0]}: {_no_such_command(project, words[0])}")
        if words:
            parser.parse_args(words)  # which says what is wrong with them, or prints the help
        parser.print_help(sys.stderr)
    return command


def read_words() -> None:
    """Says what is wrong with those of this process, or prints the help, and ends it; nothing where they are right."""
    project, words = here(), as_options(sys.argv[1:])
    command = _command(project, words)
    if command is None:
        sys.exit(UsageError.exit_code)
    if not hasattr(_module(project, command), "run_words"):
        new_parser(project, command.name).parse_args(words)


def main(argv: Sequence[str] | None = None) -> int:
    """Runs one command and returns its exit code; without words it prints the help."""
    project = here()
    words = as_options(sys.argv[1:] if argv is None else argv)
    try:
        command = _command(project, words)
        if command is None:
            return UsageError.exit_code
        module = _module(project, command)
        if hasattr(module, "run_words"):  # what follows is for a program, and not read here
            code: int = module.run_words(project, words[1:])
        else:
            code = module.run(project, new_parser(project, command.name).parse_args(words), console_here())
        sys.stdout.flush()
        return code
    except BaseException as error:
        code = exit_code_of(error)
        if code == GraderFault.exit_code and not isinstance(error, OSError):  # which is want of room
            _tell_changed(project)
        return code


def _tell_changed(project: Project) -> None:
    """A fault may come of files of the kit that a student has changed."""
    from raysteps.updater.release_list import about_changed

    changed = about_changed(project.root)
    if changed:
        _tell(changed)


_RARELY = 50_000  # new objects, until Python looks for circles that nobody needs: most live as long as the command


def run_process(argv: Sequence[str] | None = None) -> int:
    """The same for a process that does nothing else: a command that says how long it may take is ended after that."""
    if os.environ.get("GITHUB_ACTIONS"):
        sys.stdout, sys.stderr = (cast(TextIO, _ActionsLog(stream)) for stream in (sys.stdout, sys.stderr))
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # numpy starts others for longer than it computes here
    gc.set_threshold(_RARELY)
    words = as_options(sys.argv[1:] if argv is None else argv)
    project = here()
    command = next((one for one in _commands(project) if words[:1] == [one.name] and one.supervised), None)
    if command is None:
        return main(words)
    from raysteps.cli.supervise import run_with_timeout  # rarely

    try:
        return run_with_timeout(lambda: main(words), _module(project, command).seconds_at_most(words))
    except BaseException as error:
        return exit_code_of(error)
