"""Writes a release: to a temporary name first, and under its own when nothing leaks."""

import tempfile
from collections.abc import Callable
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.common.files import write_bytes
from raysteps.common.text import listed
from raysteps.kit.built_kit import BuiltKit, Say
from raysteps.kit.manifest import Step, read_all_steps
from raysteps.kit.project import Project
from raysteps.release.contents import kit_contents, refuse_untracked
from raysteps.release.given import write_all_given
from raysteps.release.links import add_pictures, unlink_missing
from raysteps.release.pages_of_kit import for_editor, pyproject, readme
from raysteps.release.replacing import refuse_left_overs, swap, usable
from raysteps.release.wording import word_for_students
from raysteps.students.listing import PLACE, Listed, Owner, Release, encoded, mark

_EXECUTABLE = {"raysteps"}
_EDITORS = (".vscode/tasks.json", ".vscode/launch.json")

Leaks = Callable[[Path, Path], bool]  # of a folder, and in the history of another


def _list(folder: Path, course: str, kit: BuiltKit, steps: list[Step]) -> Release:
    own = {f"steps/{step.path.as_posix()}" for step in steps}
    files = []
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        name = path.relative_to(folder).as_posix()
        owner: Owner = "student" if name in own else "kit"
        files.append(Listed(name, mark(path.read_bytes()), owner, name in _EXECUTABLE))
    return Release(course, kit.fingerprint.split()[0], tuple(step.id for step in steps), tuple(files))


def _refuse_gaps(steps: list[Step], absent: list[Step]) -> None:
    """A later picture needs the step in between: the reference has it, and the students' stand-in draws nothing."""
    gaps = [step.id for step in absent if step.index < steps[-1].index]
    if gaps:
        until = [step.index for step in steps if step.id < gaps[0]]
        sooner = f"end before it with `--steps {steps[0].index}-{until[-1]}`, or " if until else ""
        raise UsageError(
            f"{listed(gaps)}: left out of the course, but the pictures of later steps need it, and a students' kit has "
            f"no reference to stand in; {sooner}let it in, as a bonus or for few points"
        )


def written_files(project: Project, steps: list[Step], course: str) -> dict[str, bytes]:
    """All but what the reference draws, so that nothing has to be built for it. What may not go out is refused."""
    absent = [step for step in read_all_steps(project) if step not in steps]
    _refuse_gaps(steps, absent)
    files = kit_contents(project, steps, absent)
    files["grader/pyproject.toml"] = pyproject((project.root / "grader" / "pyproject.toml").read_text("utf-8"))
    files["README.md"] = readme(course, steps)
    files |= {name: for_editor(files[name], steps) for name in _EDITORS if name in files}
    word_for_students(files, steps)
    add_pictures(files, project.root)
    refuse_untracked(project.root, files)
    unlink_missing(files)
    return files


def write_release(kit: BuiltKit, steps: list[Step], course: str, folder: Path) -> None:
    """All files into an empty folder."""
    for name, data in written_files(kit.project, steps, course).items():
        write_bytes(folder / name, data)
    for name in _EXECUTABLE:
        (folder / name).chmod(0o755)
    write_all_given(kit, steps, folder)
    write_bytes(folder / PLACE, encoded(_list(folder, course, kit, steps)))


def release(kit: BuiltKit, steps: list[Step], course: str, out: Path, leaks: Leaks, say: Say) -> bool:
    """Whether it was written; not where `leaks` finds something in it."""
    refuse_left_overs(out)
    usable(out)
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=f".{out.name}-new-", dir=out.parent) as name:
            new = Path(name) / out.name
            new.mkdir(mode=0o755)
            say("writing the files")
            write_release(kit, steps, course, new)
            say("looking for leaks")
            if leaks(new, out):
                return False
            usable(out)
            swap(new, out)
    except OSError as error:
        raise UsageError(f"{out}: cannot be written: {error.strerror or error}") from error
    return True


def first_steps(text: str | None, steps: list[Step]) -> list[Step]:
    """`1-4` or `4` for the first four, nothing for all of them."""
    if text is None:
        return steps
    start = str(steps[0].index)
    first, dash, last = text.partition("-")
    if not dash:
        first, last = start, first
    if not (first.isdecimal() and last.isdecimal()) or int(first) != steps[0].index:
        such = f"{start}-{steps[min(3, len(steps) - 1)].index}"
        raise UsageError(
            f"--steps {text}: expected the first and the last, such as {such}; "
            "each step builds on those before it, so none can be left out among them"
        )
    if int(last) not in {step.index for step in steps}:
        raise UsageError(f"--steps {text}: there is no step {last}; the steps are {', '.join(it.id for it in steps)}")
    return [step for step in steps if step.index <= int(last)]
