"""The command `export`: results, autograders and gradebooks for other systems."""

import argparse
import sys

from rich.console import Console

from raysteps.exports import running
from raysteps.exports.arguments import add_arguments, grading_words, out_file, refuse_grading_words
from raysteps.exports.autolab import as_lines, to_autolab
from raysteps.exports.formats import validate, write, write_out
from raysteps.exports.gradebook_command import fill_gradebook
from raysteps.exports.gradescope import submitters, to_gradescope
from raysteps.exports.hosted import Options, by_id
from raysteps.exports.packaging import package
from raysteps.exports.prairielearn import to_prairielearn
from raysteps.exports.reading import read_results
from raysteps.exports.similarity import export_similarity
from raysteps.judge.feedback import withhold
from raysteps.kit.course import read_course
from raysteps.kit.manifest import read_steps
from raysteps.kit.project import Project

__all__ = ["add_arguments", "run"]


def _options(arguments: argparse.Namespace) -> Options:
    words = tuple(grading_words(arguments))
    return Options(arguments.minutes * 60, tuple(arguments.steps), words, echo=arguments.system == "gradescope")


def _run_there(project: Project, arguments: argparse.Namespace) -> int:
    place, options = arguments.run.resolve(), _options(arguments)
    match arguments.system:
        case "gradescope":
            return running.gradescope(project, place, options, arguments.hidden)
        case "prairielearn":
            return running.prairielearn(project, place, options)
        case "autolab":
            return running.autolab(project, place, options)
        case _:
            return running.github(project, place, options, arguments.out, legacy=arguments.legacy)


def _convert(project: Project, arguments: argparse.Namespace) -> int:
    refuse_grading_words(arguments)
    document, steps = read_results(arguments.results), by_id(read_steps(project))
    document = withhold(document, arguments.feedback or "full")
    match arguments.system:
        case "gradescope":
            names = submitters(arguments.metadata) if arguments.metadata is not None else []
            results = to_gradescope(document, steps, hidden=arguments.hidden, names=names)
            write(results, "gradescope", out_file(arguments, "results.json"))
        case "prairielearn":
            results = to_prairielearn(document, steps, arguments.results.parent)
            write(results, "prairielearn", out_file(arguments, "results.json"))
        case "autolab":
            lines = to_autolab(document, steps)
            validate(lines, "autolab")
            if arguments.out is None:
                print(as_lines(lines), end="", flush=True)
            else:
                write_out(arguments.out, as_lines(lines).encode())
        case _:
            running.deliver_github(document, steps, arguments.out, arguments.repository, legacy=arguments.legacy)
    return 0


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Runs `export` and returns its exit code."""
    if arguments.system in ("canvas", "moodle"):
        return fill_gradebook(project, arguments, console)
    if arguments.system == "similarity":
        return export_similarity(project, arguments)
    if arguments.run is not None:
        return _run_there(project, arguments)
    if arguments.results is not None:
        return _convert(project, arguments)
    course = read_course(project)
    if arguments.seed is None and course.seed is not None:
        arguments.seed = str(course.seed)  # what is uploaded does not take course.toml along
    for path in package(project, arguments):
        print(f"raysteps: wrote {path}", file=sys.stderr)
    return 0
