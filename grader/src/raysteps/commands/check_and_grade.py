"""The commands `check` and `grade`: a student's own steps, and somebody else's."""

import hashlib
import os
from dataclasses import dataclass, field, replace
from pathlib import Path

from rich.console import Console

from raysteps.commands.course.remembered import remember
from raysteps.commands.progress import progress
from raysteps.commands.report import print_details, print_files, print_isolation, print_table, short_path
from raysteps.common.errors import UsageError
from raysteps.common.files import one_at_a_time, usable_folder
from raysteps.common.systems import own_command, typed
from raysteps.grading.one import grade_one
from raysteps.grading.settings import Settings
from raysteps.judge.case_files import FOLDER as CASES
from raysteps.judge.case_files import place_of
from raysteps.kit.built_kit import BuiltKit, Say
from raysteps.kit.kit_building import build_kit
from raysteps.kit.manifest import Step, choose, read_steps
from raysteps.kit.project import Project
from raysteps.reports.commands import replay_command
from raysteps.reports.student import REPORT, try_student_page
from raysteps.results.model import Results
from raysteps.sandbox.choice import find_sandbox
from raysteps.sandbox.open_air import OpenAir
from raysteps.submission.intake import submission_name, take_in


def exit_code(results: Results) -> int:
    """0 all passed (a bonus need not be started), 3 when building is the only trouble, else 1."""
    open_steps = [
        step for step in results.steps if step.status != "passed" and not (step.bonus and step.status == "not-started")
    ]
    if not open_steps:
        return 0
    return 3 if all(step.status == "does-not-build" for step in open_steps) else 1


def clear(out: Path, steps: list[Step], asked_again: list[Step]) -> None:
    """Old results must not be taken for new ones. Only what a grader names so is deleted: the folder may be any. Cases
    stay for `replay` until their step is graded again."""
    usable_folder(out)
    try:
        for name in ("results.json", REPORT):
            (out / name).unlink(missing_ok=True)
        for step in steps:
            folder = out / "pictures" / step.id
            if folder.is_symlink() or folder.parent.is_symlink() or not folder.is_dir():
                continue
            for kind in ("mine", "reference", "difference"):
                for picture in folder.glob(f"*-{kind}.png"):
                    picture.unlink()
            if not any(folder.iterdir()):
                folder.rmdir()
        if not (out / CASES).is_symlink():
            for name in (place_of(step.number, function) for step in asked_again for function in step.functions):
                (out / name).unlink(missing_ok=True)
        for room in (out / "pictures", out / CASES):
            if room.is_dir() and not room.is_symlink() and not any(room.iterdir()):
                room.rmdir()
    except OSError as error:
        raise UsageError(f"{out}: old results cannot be removed: {error}") from error


@dataclass(frozen=True)
class Checked:
    """What came of checking one's own steps; there is no page where it could not be made."""

    kit: BuiltKit
    results: Results
    page: Path | None


def check_steps(project: Project, chosen: list[Step], say: Say) -> Checked:
    """The steps in the repository; the results go to build/check. Your own code needs no sandbox."""
    out = project.build / "check"
    with one_at_a_time(project.build / "check.lock"):
        kit = build_kit(project, say)
        clear(out, kit.steps, chosen)
        submission = take_in(project.steps, kit.steps)
        settings = Settings(only=tuple(step.id for step in chosen), jobs=os.cpu_count() or 1)
        results = grade_one(kit, submission, settings, OpenAir(), out, say)
        remember(project, results, submission.sources)
        return Checked(kit, results, try_student_page(out, kit.steps, say))


def check(project: Project, names: list[str], console: Console) -> int:
    """Checks the steps in the repository and explains what is wrong."""
    chosen = choose(read_steps(project), names)
    out = project.build / "check"
    with console.status("starting") as status:
        checked = check_steps(project, chosen, progress(console, status))
    print_details(console, checked.results, checked.kit.steps, out, replay_command)
    console.print()
    print_table(console, checked.results)
    print_files(console, out / "results.json", checked.page)
    return exit_code(checked.results)


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

    def again(case: str) -> str:
        words = ["replay", short_path(out / case), "--submission", str(wish.submission)]
        return f"{own_command()} {typed(words)}"

    if wish.details:
        print_details(console, results, kit.steps, out, again)
        console.print()
    print_table(console, results)
    print_isolation(console, results)
    print_files(console, out / "results.json", page)
    return results
