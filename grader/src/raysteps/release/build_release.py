"""Writes a release: to a temporary name first, and under its own when nothing leaks."""

import glob
import shutil
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from raysteps.common.errors import UsageError, reason
from raysteps.common.files import content_hash, write_bytes
from raysteps.common.text import join_and
from raysteps.course.manifest import (
    Step,
    choose,
    course_steps,
    dated_steps,
    read_all_steps,
    read_steps,
    steps_words,
    taken_in,
)
from raysteps.course.project import Project
from raysteps.course.settings import read_course
from raysteps.images.render import write_reference_image
from raysteps.play.play_page import PlayPage, check_published, publish
from raysteps.release.contents import kit_contents, refuse_untracked
from raysteps.release.kit_pages import add_pictures, for_editor, pyproject, readme, unlink_missing, word_for_students
from raysteps.toolchain.build_kit import write_given_tests
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback
from raysteps.updater.release_list import (
    FOLDERS,
    HISTORY,
    PLACE,
    ListedFile,
    Owner,
    Release,
    encoded,
    is_made_anew,
    read_release,
)

# Puts a new release in the place of an older one, and loses nothing that is of neither.

_NOT_OURS = (HISTORY, *FOLDERS)  # may lie in a release that somebody keeps under version control


def _is_as_released(path: Path, listed: ListedFile) -> bool:
    try:
        return listed.is_at(path)
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {reason(error)}") from error


def refuse_foreign_files(out: Path) -> None:
    """Nothing but a release as it was written may be replaced."""
    if not out.exists() or (out.is_dir() and not any(out.iterdir())):
        return
    if not out.is_dir():
        raise UsageError(f"{out}: is a file; expected a new or empty folder, or an earlier release")
    old = read_release(out)
    if old is None:
        raise UsageError(f"{out}: is not empty; expected a new or empty folder, or an earlier release")
    known = old.by_path()
    for path in sorted(out.rglob("*")):
        name = path.relative_to(out).as_posix()
        if name.split("/")[0] in _NOT_OURS or name == PLACE or (path.is_dir() and not path.is_symlink()):
            continue
        if name not in known and is_made_anew(name):
            continue
        if name not in known or not _is_as_released(path, known[name]):
            what = "is not of the release" if name not in known else "is not as it was released"
            raise UsageError(f"{path}: {what} and would be lost; take it away, or name another folder with --out")


def refuse_left_overs(out: Path) -> None:
    """Of a release that was interrupted while it took the place of an older one."""
    found = sorted(out.parent.glob(f".{glob.escape(out.name)}-old-*"))
    if found:
        raise UsageError(
            f"{found[0]}: holds what was in {out} before a release that was interrupted; move what you need (a history "
            "in .git) back, and delete the rest"
        )


def _move_along(old: Path, new: Path) -> None:
    for name in _NOT_OURS:
        if (old / name).exists():
            (old / name).rename(new / name)


def swap(new: Path, out: Path) -> None:
    """What is not of the release, such as its history, moves along."""
    if not out.exists():
        new.rename(out)
        return
    old = Path(tempfile.mkdtemp(prefix=f".{out.name}-old-", dir=out.parent)) / out.name
    out.rename(old)
    try:
        new.rename(out)
    except OSError:
        old.rename(out)
        old.parent.rmdir()
        raise
    _move_along(old, out)
    try:
        refuse_foreign_files(old)
    except UsageError as error:
        raise UsageError(
            f"{out}: was released, but the older one was changed meanwhile and is kept: {error}"
        ) from error
    shutil.rmtree(old.parent)


# What the reference leaves behind for students: its pictures, and the names of its tests.


def write_reference_artifacts(kit: BuiltKit, steps: list[Step], folder: Path, say: ProgressCallback) -> None:
    """Writes folder/reference/."""
    target = Project(folder)
    for step in steps:
        say(f"drawing the reference's pictures of step {step.number}")
        for case in step.images:
            write_reference_image(kit, target, step, case)
    write_given_tests(target, {step.id: kit.tests[step.id] for step in steps})


_EXECUTABLE = {"raysteps"}
_EDITORS = (".vscode/tasks.json", ".vscode/launch.json")

Leaks = Callable[[Path, Path], bool]  # of a folder, and in the history of another


def _list(folder: Path, course: str, kit: BuiltKit, steps: list[Step]) -> Release:
    own = {f"steps/{step.path.as_posix()}" for step in steps}
    files = []
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        name = path.relative_to(folder).as_posix()
        owner: Owner = "student" if name in own else "kit"
        files.append(ListedFile(name, content_hash(path.read_bytes()), owner, name in _EXECUTABLE))
    return Release(course, kit.fingerprint.split()[0], tuple(step.id for step in steps), tuple(files))


def _refuse_gaps(steps: list[Step], absent: list[Step]) -> None:
    """A later picture needs the step in between: the reference has it, and the students' stand-in draws nothing. A part
    needs those before it, and none after it."""
    part = max(step.part for step in steps)
    earlier = [step for step in absent if step.part not in {one.part for one in steps} and step.part < part]
    if earlier:
        raise UsageError(
            f"part {part} goes on from part {earlier[0].part}, and a students' kit has no reference to stand in; "
            f"{taken_in(steps, earlier[0].part)}"
        )
    gaps = [step.id for step in absent if step.index < steps[-1].index and step.part <= part]
    if gaps:
        until = [step.index for step in steps if step.id < gaps[0]]
        it = "it" if len(gaps) == 1 else "them"
        sooner = f"end before {it} with `--steps {steps[0].index}-{until[-1]}`, or " if until else ""
        raise UsageError(
            f"{join_and(gaps)}: left out of the course, but the pictures of later steps need {it}, and a students' kit "
            f"has no reference to stand in; {sooner}let {it} in, as a bonus or for few points"
        )


def written_files(project: Project, steps: list[Step], course: str) -> dict[str, bytes]:
    """All but what the reference draws, so that nothing has to be built for it. What may not go out is refused."""
    absent = [step for step in read_all_steps(project) if step not in steps]
    _refuse_gaps(steps, absent)
    files = kit_contents(project, steps, absent)
    files["grader/pyproject.toml"] = pyproject((project.root / "grader" / "pyproject.toml").read_text("utf-8"))
    later = [(step, day) for step, day in dated_steps(project) if step not in steps]
    files["README.md"] = readme(course, steps, read_course(project).term, later)
    files |= {name: for_editor(files[name], steps) for name in _EDITORS if name in files}
    word_for_students(files, steps)
    add_pictures(files, project.root)
    refuse_untracked(project.root, files)
    unlink_missing(files)
    return files


def write_release(
    kit: BuiltKit, steps: list[Step], course: str, folder: Path, say: ProgressCallback = lambda text: None
) -> None:
    """All files into an empty folder."""
    for name, data in written_files(kit.project, steps, course).items():
        write_bytes(folder / name, data)
    for name in _EXECUTABLE:
        (folder / name).chmod(0o755)
    write_reference_artifacts(kit, steps, folder, say)
    write_bytes(folder / PLACE, encoded(_list(folder, course, kit, steps)))


@dataclass(frozen=True)
class PageOptions:
    """Where the page to work in goes, and where npm packages come from."""

    out: Path
    registry: str


def _students_page(kit: BuiltKit, folder: Path, registry: str, say: ProgressCallback) -> Path:
    """Made of the release, in the cache of the whole kit; nothing of it stays in the release."""
    made = PlayPage(Project(folder), registry, say, kit.project.build / "play").make()
    shutil.rmtree(folder / "build")
    return made


def release(
    kit: BuiltKit,
    steps: list[Step],
    course: str,
    out: Path,
    leaks: Leaks,
    say: ProgressCallback,
    page: PageOptions | None = None,
) -> bool:
    """Whether it was written; not where `leaks` finds something in it, or in the page to work in."""
    refuse_left_overs(out)
    refuse_foreign_files(out)
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=f".{out.name}-new-", dir=out.parent) as name:
            new = Path(name) / out.name
            new.mkdir(mode=0o755)
            say("writing the files")
            write_release(kit, steps, course, new, say)
            made = _students_page(kit, new, page.registry, say) if page else None
            say("looking for leaks")
            if any([leaks(new, out), made is not None and leaks(made, made)]):
                return False
            refuse_foreign_files(out)
            if page:
                check_published(page.out)
            swap(new, out)
            if page and made:
                publish(made, page.out)
    except OSError as error:
        raise UsageError(f"{out}: cannot be written: {reason(error)}") from error
    return True


def _up_to_the_last(steps: list[Step], chosen: list[Step]) -> list[Step]:
    """Of each part up to its last chosen step; of parts before these, all."""
    last = {step.part: step.index for step in chosen}
    whole = [step.part for step in steps if step.part not in last and step.part < max(last)]
    return [step for step in steps if step.part in whole or step.index <= last.get(step.part, 0)]


def first_steps(names: Sequence[str], steps: list[Step], said_by: str = "", others: Sequence[Step] = ()) -> list[Step]:
    """The steps with these names, all when there are none. One alone stands for all up to it; `said_by` tells where the
    names are from. `others`: see `choose`."""
    where = said_by or f"--steps {' '.join(names)}"
    try:
        chosen = choose(steps, names, others)
    except UsageError as error:
        raise UsageError(f"{where}: {error}") from error
    until = _up_to_the_last(steps, chosen)
    if chosen != until and (len(chosen) > 1 or said_by):
        raise UsageError(
            f"{where}: expected the first and the last, such as {steps_words(steps[:4])[0]}; "
            "each step builds on those before it, so none can be left out among them"
        )
    return until


def due_steps(project: Project, day: date) -> list[Step]:
    """Those of the course that may go out on that day, by course.toml."""
    course, steps = read_course(project), course_steps(project)
    later = {step.id: when for step, when in dated_steps(project) if when > day}
    due = [step for step in steps if step.id not in later]
    if not due:
        raise UsageError(
            f"{course.place('steps')}: the first steps are given out on {min(later.values())}; --steps gives out "
            f"others sooner, such as --steps {steps_words(steps)[0]}"
        )
    return first_steps([step.id for step in due], read_steps(project), course.place("steps"))
