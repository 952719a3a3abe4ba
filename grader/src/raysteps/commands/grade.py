"""The command `grade`: somebody else's steps."""

import hashlib
import os
from dataclasses import dataclass, field, replace
from pathlib import Path

from rich.console import Console

from raysteps.commands.check import clear
from raysteps.commands.progress import progress
from raysteps.commands.report import print_details, print_files, print_isolation, print_table, short_path
from raysteps.common.files import one_at_a_time
from raysteps.common.systems import own_command, typed
from raysteps.grading.one import grade_one
from raysteps.grading.settings import Settings
from raysteps.kit.kit_building import build_kit
from raysteps.kit.manifest import read_steps
from raysteps.kit.project import Project
from raysteps.reports.student import try_student_page
from raysteps.results.model import Results
from raysteps.sandbox.choice import find_sandbox
from raysteps.submission.intake import submission_name, take_in


@dataclass(frozen=True)
class Wish:
    """What was asked for on the command line of `grade`."""

    submission: Path
    out: Path | None = None
    settings: Settings = field(default_factory=Settings)
    require_sandbox: bool = False
    details: bool = True
    jobs: int | None = None  # steps at a time; as many as there are processors when not said


def grade(project: Project, wish: Wish, console: Console) -> Results:
    """Grades one submission in the sandbox, writes its results and prints what came out."""

    def again(case: str) -> str:
        words = ["replay", short_path(out / case), "--submission", str(wish.submission)]
        return f"{own_command()} {typed(words)}"

    sandbox = find_sandbox(require=wish.require_sandbox)
    out = (wish.out or project.build / "grade" / submission_name(wish.submission)).resolve()
    lock = hashlib.sha256(str(out).encode()).hexdigest()[:16]
    with console.status("starting") as status, one_at_a_time(project.build / "locks" / lock):
        say = progress(console, status)
        submission = take_in(wish.submission, read_steps(project))
        kit = build_kit(project, say)
        clear(out, kit.steps, kit.steps)
        settings = replace(wish.settings, jobs=wish.jobs or os.cpu_count() or 1)
        results = grade_one(kit, submission, settings, sandbox, out, say)
        page = try_student_page(out, kit.steps, say)  # which may be handed back: no paths of this machine

    if wish.details:
        print_details(console, results, kit.steps, out, again)
        console.print()
    print_table(console, results)
    print_isolation(console, results)
    print_files(console, out / "results.json", page)
    return results
