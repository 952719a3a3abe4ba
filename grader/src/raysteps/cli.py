"""The commands of ./raysteps."""

import argparse
import re
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console

from raysteps.classroom import command as classroom
from raysteps.commands import for_students, release
from raysteps.commands.check import exit_code
from raysteps.commands.demo import demo
from raysteps.commands.gallery import command as gallery
from raysteps.commands.grade import Wish, grade
from raysteps.commands.leaderboard import command as leaderboard
from raysteps.commands.replay import replay
from raysteps.exports import command as exports
from raysteps.grading.settings import Settings
from raysteps.kit.course import read_course
from raysteps.kit.manifest import choose, read_steps
from raysteps.kit.project import Project
from raysteps.programs.limits import parse_limits
from raysteps.upkeep import dev
from raysteps.upkeep.bench import command as bench
from raysteps.upkeep.figures import command as figures
from raysteps.upkeep.selftest import selftest
from raysteps.upkeep.site import command as site


def _above_0(word: str) -> int:
    if not re.fullmatch(r"[0-9]{1,4}", word) or int(word) == 0:
        raise argparse.ArgumentTypeError(f"{word}: expected a whole number above 0")
    return int(word)


def _parser() -> argparse.ArgumentParser:
    parser = for_students.new_parser("A ray tracer in graded steps.")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for_students.add_arguments(commands.add_parser)

    add = commands.add_parser("replay", help="ask a hidden case again, as `check` or `grade` wrote it")
    add.add_argument("case", type=Path, help="such as cases/02-sphere-intersect.json")
    add.add_argument("--submission", type=Path, metavar="PATH", help="whose steps: a folder, zip or tar (your own)")

    add = commands.add_parser("grade", help="grade a submission: a folder, zip or tar")
    add.add_argument("submission", type=Path)
    add.add_argument("--out", type=Path, help="where results.json and the pictures go")
    add.add_argument("--seed", type=int, metavar="N", help="of the hidden cases (that of course.toml, else 1)")
    add.add_argument("--only", nargs="+", default=[], metavar="STEP", help="grade these steps only")
    add.add_argument(
        "--feedback", choices=["full", "diagnosis", "score"], default="full", help="what results.json tells"
    )
    add.add_argument("--limit", action="append", default=[], metavar="NAME=VALUE", help="such as seconds=40")
    add.add_argument("--require-sandbox", action="store_true", help="refuse to run without strong isolation")
    add.add_argument("--jobs", type=_above_0, metavar="N", help="steps at a time (as many as there are processors)")

    classroom.add_arguments(commands.add_parser("grade-class", help="grade a whole class"))
    leaderboard.add_arguments(commands.add_parser("leaderboard", help="rank submissions by counted work"))
    release.add_arguments(commands.add_parser("release", help="make the repository that students get"))
    exports.add_arguments(commands.add_parser("export", help="for Gradescope, Classroom 50, Canvas and others"))

    add = commands.add_parser("demo", help="one picture per step, and two sample submissions graded")
    add.add_argument("--out", type=Path, help="where the pictures go (build/demo)")

    gallery.add_arguments(commands.add_parser("gallery", help="a page that walks through the steps in pictures"))

    bench.add_arguments(commands.add_parser("bench", help="measure the reference"))
    site.add_arguments(commands.add_parser("docs", help="the documents as a site that needs no network"))
    figures.add_arguments(commands.add_parser("figures", help="make the figures of the handouts"))

    add = commands.add_parser("test", help="test the kit itself")
    add.add_argument("--full", action="store_true", help="also what needs more: sanitizers, clang, fuzzing")

    dev.add_arguments(commands.add_parser("dev", help="for those who maintain the kit"))
    return parser


def _wish(project: Project, arguments: argparse.Namespace) -> Wish:
    only = [step.id for step in choose(read_steps(project), arguments.only)] if arguments.only else []
    seed = read_course(project).seed_or(arguments.seed)
    settings = Settings(seed, tuple(only), arguments.feedback, parse_limits(arguments.limit))
    return Wish(arguments.submission, arguments.out, settings, arguments.require_sandbox, jobs=arguments.jobs)


def _run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    match arguments.command:
        case "replay":
            return replay(project, arguments.case, arguments.submission, console)
        case "grade":
            return exit_code(grade(project, _wish(project, arguments), console))
        case "grade-class":
            return classroom.run(project, arguments, console)
        case "leaderboard":
            return leaderboard.run(project, arguments, console)
        case "release":
            return release.run(project, arguments, console)
        case "export":
            return exports.run(project, arguments, console)
        case "demo":
            return demo(project, arguments.out, console)
        case "gallery":
            return gallery.run(project, arguments, console)
        case "bench":
            return bench.run(project, arguments, console)
        case "docs":
            return site.run(project, arguments, console, _parser())
        case "figures":
            return figures.run(project, arguments, console)
        case "test":
            return selftest(project, console, full=arguments.full)
        case _:
            return dev.run(project, arguments, console)


def main(argv: Sequence[str] | None = None) -> int:
    """Runs one command and returns its exit code."""
    return for_students.run_line(_parser(), _run, argv)
