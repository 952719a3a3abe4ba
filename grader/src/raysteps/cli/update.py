"""The command `update`."""

import argparse
from pathlib import Path

from rich.console import Console

from raysteps.common.errors import UsageError
from raysteps.common.files import content_hash
from raysteps.common.text import count, join_and, join_some, print_plain
from raysteps.course.project import Project
from raysteps.updater.release_list import PLACE, Release, own_files, read_release
from raysteps.updater.source import Source, open_source
from raysteps.updater.update import Changes, Update

_MAX_NAMED = 5


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where the newer kit is."""
    parser.add_argument(
        "kit", type=Path, nargs="?", metavar="KIT", help="a newer release: a folder or a zip (with --into: this one)"
    )
    parser.add_argument("--into", type=Path, metavar="DIR", help="the repository that takes it in (this one)")
    parser.add_argument("--course-changed", action="store_true", help="take in the kit of a course of another name")


def _tell_own(console: Console, changes: Changes) -> None:
    """What concerns the student's own files, and files of the kit that were changed."""
    for path in changes.kept:
        print_plain(console, f"{path.rpartition('.')[0]} was not as released. It is now; what it was is kept as {path}")
    for path in changes.outdated:
        name = path.rpartition(".")[0]
        print_plain(console, f"The kit has no {name} any more. Yours was not as released, and is kept as {path}")
    for path in changes.left:
        print_plain(console, f"The kit has no {path} any more; yours is still there")
    for path in changes.put_back:
        print_plain(console, f"{path} was not there; the stub is put back")
    for paths, words in ((changes.stubs, "its stub is another one"), (changes.met, "the kit has a stub for it")):
        for path in paths:
            stub = f"grader/stubs/{path.removeprefix('steps/')}"
            print_plain(console, f"{path} is as you left it, but {words} now: compare with {stub}")


def _tell_kept(console: Console, names: list[str]) -> None:
    """The student's own, by name as far as there is room."""
    words = join_some(names, _MAX_NAMED) if names else "there are none yet"
    print_plain(console, f"Your own files are as they were: {words}.")


def _tell(console: Console, changes: Changes, old: Release, new: Release) -> None:
    if changes.any:
        numbers = ((changes.replaced, "replaced"), (changes.added, "added"), (changes.removed, "removed"))
        print_plain(console, f"Files of the kit: {', '.join(f'{len(paths)} {word}' for paths, word in numbers)}.")
    else:
        print_plain(console, "The kit is up to date: nothing had to be changed.")
    added, gone = ([step for step in one.steps if step not in other.steps] for one, other in ((new, old), (old, new)))
    if added:
        print_plain(console, f"New: {join_and(added)}.")
    if gone:
        print_plain(
            console, f"This kit has no {join_and(gone)}. If it is an older one, update once more with the newest."
        )
    _tell_own(console, changes)


def _named(release: Release, listing: bytes) -> str:
    """Two that differ in any file have two names."""
    return f"release {content_hash(listing)[:12]} with {count(len(release.steps), 'step')}"


def _refuse_wrong(root: Path, old: Release, source: Source, *, course_changed: bool) -> None:
    if source.place.resolve() == root.resolve():
        raise UsageError(f"{source.place}: is this repository; expected a newer release beside it")
    new = source.release.course
    if new != old.course and not course_changed:
        raise UsageError(
            f'{source.place}: is a kit of the course "{new}", and this repository is of "{old.course}". '
            "If that is the same course under a new name, say --course-changed"
        )


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """What the student wrote stays byte for byte."""
    root: Path = arguments.into or project.root
    if arguments.kit is None and arguments.into is None:
        raise UsageError("expected a newer release, a folder or a zip, such as in: ./raysteps update ../course-2.zip")
    old = read_release(root)
    if old is None:
        raise UsageError(f"{root / PLACE}: is not there; expected a repository that came from a release of the kit")
    before = _named(old, (root / PLACE).read_bytes())
    with open_source(arguments.kit or project.root) as source:
        _refuse_wrong(root, old, source, course_changed=arguments.course_changed)
        changes = Update(root, old, source).run()
        now = _named(source.release, source.listing)
        _tell(console, changes, old, source.release)
        told = {*changes.kept, *changes.outdated}
        _tell_kept(console, [name for name in own_files(root, source.release) if name not in told])
        print_plain(console, f"{source.release.course}: {now if now == before else f'from {before} to {now}'}.")
    return 0
