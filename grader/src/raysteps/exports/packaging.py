"""Writes what is uploaded to another system."""

import argparse
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.exports.archives import into_folder
from raysteps.exports.arguments import out_file, script_words
from raysteps.exports.autograders import (
    autolab_tar,
    classroom50_autograder,
    github_workflow,
    gradescope_zip,
    prairielearn_folder,
)
from raysteps.exports.formats import write_out
from raysteps.kit.manifest import choose, read_steps
from raysteps.kit.project import Project
from raysteps.programs.limits import parse_limits


def package(project: Project, arguments: argparse.Namespace) -> list[Path]:
    """The files or folders that were written."""
    choose(read_steps(project), arguments.steps)
    parse_limits(arguments.limit)
    words = script_words(arguments)
    match arguments.system:
        case "gradescope":
            path = out_file(arguments, "autograder.zip")
            write_out(path, gradescope_zip(project, words))
        case "autolab":
            path = out_file(arguments, "raysteps-autolab.tar")
            write_out(path, autolab_tar(project, words))
        case "prairielearn":
            path = out_file(arguments, "serverFilesCourse/raysteps")
            into_folder(prairielearn_folder(project, words), path)
        case _:
            return _package_github(arguments, words)
    return [path]


def _package_github(arguments: argparse.Namespace, words: list[str]) -> list[Path]:
    if arguments.workflow is not None:
        write_out(arguments.workflow, github_workflow(arguments.kit, words, legacy=arguments.legacy))
    if arguments.autograder is not None:
        write_out(arguments.autograder, classroom50_autograder(words))
    written = [path for path in (arguments.workflow, arguments.autograder) if path is not None]
    if not written:
        raise UsageError("expected --results FILE, --workflow FILE or --autograder FILE")
    return written
