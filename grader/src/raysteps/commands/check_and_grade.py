"""The commands `check` and `grade`: a student's own steps, and somebody else's."""

import sys
from collections.abc import Callable
from pathlib import Path

from rich.console import Console
from rich.status import Status

from raysteps.commands.report import print_details, print_files, print_table
from raysteps.common.errors import UsageError
from raysteps.common.files import usable_folder, write_if_changed
from raysteps.grading.grader import Grader, Job
from raysteps.grading.results import Results, write_results
from raysteps.kit.building import BuildTree, release_tree
from raysteps.kit.manifest import Step, choose, read_steps
from raysteps.kit.project import Project
from raysteps.kit.stubs import stub_for
from raysteps.submission.intake import Submission, submission_name, take_in


def exit_code(results: Results) -> int:
    """0 all passed (a bonus need not be started), 3 when building is the only trouble, else 1."""
    open_steps = [
        step for step in results.steps if step.status != "passed" and not (step.bonus and step.status == "not-started")
    ]
    if not open_steps:
        return 0
    return 3 if all(step.status == "does-not-build" for step in open_steps) else 1


def clear(out: Path, steps: list[Step]) -> None:
    """Old results must not be taken for new ones. Only what a grader names so is deleted: the folder may be any."""
    usable_folder(out)
    try:
        (out / "results.json").unlink(missing_ok=True)
        for step in steps:
            folder = out / "pictures" / step.id
            if folder.is_symlink() or folder.parent.is_symlink() or not folder.is_dir():
                continue
            for kind in ("mine", "reference", "difference"):
                for picture in folder.glob(f"*-{kind}.png"):
                    picture.unlink()
            if not any(folder.iterdir()):
                folder.rmdir()
        pictures = out / "pictures"
        if pictures.is_dir() and not pictures.is_symlink() and not any(pictures.iterdir()):
            pictures.rmdir()
    except OSError as error:
        raise UsageError(f"{out}: old results cannot be removed: {error}") from error


def _progress(console: Console, status: Status) -> Callable[[str], None]:
    """Shows what is being done: beside the spinner on a terminal, elsewhere as lines on stderr."""

    def say(text: str) -> None:
        if console.is_terminal:
            status.update(text)
        else:
            print(f"raysteps: {text}", file=sys.stderr, flush=True)

    return say


def check(project: Project, names: list[str], console: Console) -> int:
    """Checks the steps in the repository and explains what is wrong."""
    steps = read_steps(project)
    chosen = choose(steps, names)
    out = project.build / "check"
    tree = release_tree(project)
    with console.status("starting") as status, tree.locked():
        clear(out, steps)
        job = Job("steps", tree, steps, chosen, out, {}, _progress(console, status))
        results = Grader(job).grade()
    path = write_results(results, out)
    print_details(console, results, steps, out)
    console.print()
    print_table(console, results)
    print_files(console, path)
    return exit_code(results)


def _lay_out(project: Project, steps: list[Step], submission: Submission, folder: Path) -> dict[str, str]:
    """Copies the sources to where the build expects them; the stub stands in for what is missing."""
    notes = {}
    for step in steps:
        source = submission.sources.get(step.id)
        if source is None:
            source = stub_for(project, step).encode()
            notes[step.id] = submission.notes.get(step.id, f"{step.file} was not handed in.")
        write_if_changed(folder / step.path, source)
    return notes


def grade_to(project: Project, path: Path, out: Path, console: Console) -> Results:
    """Grades one submission and writes its results."""
    steps = read_steps(project)
    submission = take_in(path, steps)
    usable_folder(out)
    mine = project.build / "grade-submission"
    tree = BuildTree(project, "release", project.build / "grade", mine)
    with console.status("starting") as status, tree.locked():
        clear(out, steps)
        notes = _lay_out(project, steps, submission, mine)
        job = Job(submission.name, tree, steps, steps, out, notes, _progress(console, status))
        results = Grader(job).grade()
    write_results(results, out)
    return results


def grade(project: Project, path: Path, out: Path | None, console: Console, *, details: bool = True) -> Results:
    """Grades one submission and prints what came out."""
    folder = (out or project.build / "grade" / "results" / submission_name(path)).resolve()
    results = grade_to(project, path, folder, console)
    if details:
        print_details(console, results, read_steps(project), folder)
        console.print()
    print_table(console, results)
    print_files(console, folder / "results.json")
    return results
