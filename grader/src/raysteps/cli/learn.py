"""The command `learn`: what the known mistakes answer and draw, before a submission has to wait for it."""

import argparse

from rich.console import Console

from raysteps.course.mutants import read_mutants
from raysteps.course.project import Project
from raysteps.diagnosis.mutant_fingerprints import mutant_fingerprints
from raysteps.judge.plan import read_plan
from raysteps.report.terminal import progress
from raysteps.toolchain.build_kit import build_kit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """None: all steps are learned."""


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Keeps it in the built kit."""
    with console.status("starting") as status:
        say = progress(console, status)
        kit = build_kit(project, say)
        for step in kit.steps:
            mutant_fingerprints(kit, step, read_plan(project, step), read_mutants(project, step), say)
    return 0
