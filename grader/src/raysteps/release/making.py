"""Writes a release: to a temporary name first, and under its own when nothing leaks."""

import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.common.files import write_bytes
from raysteps.kit.built_kit import BuiltKit, Say
from raysteps.kit.manifest import Step, read_all_steps
from raysteps.release.contents import kit_contents
from raysteps.release.given import write_all_given
from raysteps.release.links import add_pictures, unlink_missing
from raysteps.release.pages_of_kit import for_editor, pyproject, readme
from raysteps.release.wording import word_for_students
from raysteps.students.listing import PLACE, Listed, Owner, Release, encoded, mark, read_release

_EXECUTABLE = {"raysteps"}
_EDITORS = (".vscode/tasks.json", ".vscode/launch.json")
_NOT_OURS = (".git", ".venv", "build")  # may lie in a release that somebody keeps under version control

Leaks = Callable[[Path], bool]


def usable(out: Path) -> None:
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
        if name not in known or mark(path.read_bytes()) != known[name].mark:
            what = "is not of the release" if name not in known else "is not as it was released"
            raise UsageError(f"{path}: {what} and would be lost; take it away, or name another folder with --out")


def _list(folder: Path, course: str, kit: BuiltKit, steps: list[Step]) -> Release:
    own = {f"steps/{step.path.as_posix()}" for step in steps}
    files = []
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        name = path.relative_to(folder).as_posix()
        owner: Owner = "student" if name in own else "kit"
        files.append(Listed(name, mark(path.read_bytes()), owner, name in _EXECUTABLE))
    return Release(course, kit.fingerprint.split()[0], tuple(step.id for step in steps), tuple(files))


def write_release(kit: BuiltKit, steps: list[Step], course: str, folder: Path) -> None:
    """All files into an empty folder."""
    absent = [step for step in read_all_steps(kit.project) if step not in steps]
    files = kit_contents(kit.project, steps, absent)
    files["grader/pyproject.toml"] = pyproject((kit.project.root / "grader" / "pyproject.toml").read_text("utf-8"))
    files["README.md"] = readme(course, steps)
    files |= {name: for_editor(files[name], steps) for name in _EDITORS if name in files}
    word_for_students(files)
    add_pictures(files, kit.project.root)
    unlink_missing(files)
    for name, data in files.items():
        write_bytes(folder / name, data)
    for name in _EXECUTABLE:
        (folder / name).chmod(0o755)
    write_all_given(kit, steps, folder)
    write_bytes(folder / PLACE, encoded(_list(folder, course, kit, steps)))


def _swap(new: Path, out: Path) -> None:
    """What is not of the release, such as its history, moves along."""
    if not out.exists():
        new.rename(out)
        return
    old = Path(tempfile.mkdtemp(prefix=f".{out.name}-old-", dir=out.parent)) / out.name
    out.rename(old)
    new.rename(out)
    for name in _NOT_OURS:
        if (old / name).exists():
            (old / name).rename(out / name)
    shutil.rmtree(old.parent)


def release(kit: BuiltKit, steps: list[Step], course: str, out: Path, leaks: Leaks, say: Say) -> bool:
    """Whether it was written; not where `leaks` finds something in it."""
    usable(out)
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=f".{out.name}-new-", dir=out.parent) as name:
            new = Path(name) / out.name
            new.mkdir(mode=0o755)
            say("writing the files")
            write_release(kit, steps, course, new)
            say("looking for leaks")
            if leaks(new):
                return False
            _swap(new, out)
    except OSError as error:
        raise UsageError(f"{out}: cannot be written: {error.strerror or error}") from error
    return True


def first_steps(text: str | None, steps: list[Step]) -> list[Step]:
    """`1-4` or `4` for the first four, nothing for all of them."""
    if text is None:
        return steps
    first, dash, last = text.partition("-")
    numbers = [word for word in ((first, last) if dash else ("1", first)) if word.isdecimal()]
    known = {step.index for step in steps}
    if len(numbers) != 2 or int(numbers[0]) != steps[0].index or int(numbers[1]) not in known:
        raise UsageError(
            f"--steps {text}: expected the first and the last, such as {steps[0].index}-{min(4, steps[-1].index)}; "
            "each step builds on those before it, so none can be left out among them"
        )
    return [step for step in steps if step.index <= int(numbers[1])]
