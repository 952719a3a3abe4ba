"""Fetches what students have pushed: one entry for each repository that the roster names.

A repository is a stranger's. Nothing of it is checked out: its files are read from git's own store, so that no hook, no
filter, no link and no submodule of it counts for anything."""

import re
import shutil
import tempfile
from collections import defaultdict
from collections.abc import Callable, Collection, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

from raysteps.classroom.entries import name_entries
from raysteps.classroom.roster import Student
from raysteps.common.errors import UsageError
from raysteps.common.files import write_bytes
from raysteps.common.process import Outcome, run
from raysteps.common.text import clean, shorten
from raysteps.submission.entries import MAX_DEPTH, MAX_ENTRIES, MAX_SOURCE, split

# What may be fetched.

_WORD, _PATH = r"[A-Za-z0-9][A-Za-z0-9_.-]*", r"[A-Za-z0-9._~%+/-]+"  # nothing that git or ssh takes for an option
_ADDRESS = re.compile(rf"(https://|ssh://({_WORD}@)?){_WORD}(:[0-9]{{1,5}})?/{_PATH}|{_WORD}@{_WORD}:(?!-){_PATH}")
_EXPECTED = (
    "expected https://HOST/PATH, ssh://USER@HOST/PATH or USER@HOST:PATH without a password, or with --local DIR the "
    "name of a repository in that folder"
)


def checked_address(text: str, local: Path | None) -> str:
    """The address as git gets it. A path is one only below `local`: who fills in a form may name any repository of
    this machine, the kit's with its solutions among them."""
    if _ADDRESS.fullmatch(text):
        return text
    if local is not None and re.fullmatch(rf"{_WORD}(/{_PATH})?", text):
        place = (local / text).resolve()
        if place != local.resolve() and place.is_relative_to(local.resolve()) and place.is_dir():
            return str(place)
    raise UsageError(f"{shorten(clean(text), 100)!r} is no address of a repository here; {_EXPECTED}")


# Git, with nobody to ask. What an instructor has set up to prove who asks still counts: keys, credential helpers.

_SECONDS = 60.0
_MAX_PACK = 32 << 20
_MAX_MEMORY = 2 << 30
_MAX_LISTING = 8 << 20
_UNSET = ("GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE", "GIT_ASKPASS", "SSH_ASKPASS", "DISPLAY")
_SET = (
    *("GIT_TERMINAL_PROMPT=0", "GCM_INTERACTIVE=never", "GIT_LFS_SKIP_SMUDGE=1", "GIT_NO_LAZY_FETCH=1"),
    *("GIT_OPTIONAL_LOCKS=0", "LC_ALL=C"),
)
_CONFIG = (
    *("core.hooksPath=/dev/null", "core.fsmonitor=false", "fetch.recurseSubmodules=false", "gc.auto=0"),
    *("fetch.unpackLimit=1", "maintenance.auto=false", "http.followRedirects=initial", "protocol.version=2"),
)


class CannotFetch(Exception):
    """Why not, for the instructor."""


def _git(
    words: Sequence[str | Path],
    address: str = "",
    cap: int = 1 << 20,
    heard: Callable[[bytes], None] = lambda data: None,
) -> Outcome:
    """Without a terminal, so that nothing can be asked; within limits on time, memory and what is written."""
    allowed = "file" if address.startswith("/") else "https:ssh"
    command: list[str | Path] = ["env", *(word for name in _UNSET for word in ("-u", name)), *_SET]
    command += [f"GIT_ALLOW_PROTOCOL={allowed}"]
    if prlimit := shutil.which("prlimit"):
        command += [prlimit, f"--fsize={_MAX_PACK}", f"--as={_MAX_MEMORY}", "--core=0"]
    command += ["git", *(word for setting in _CONFIG for word in ("-c", setting)), *words]
    outcome = run(command, seconds=_SECONDS, cap=cap, heard=heard)
    if outcome.timed_out:
        raise CannotFetch(f"git took longer than {_SECONDS:.0f} s")
    if outcome.code != 0:
        said = [line for line in clean(outcome.stderr).splitlines() if line.strip()] or [f"exit code {outcome.code}"]
        raise CannotFetch(shorten(next((line for line in said if line.startswith("fatal:")), said[-1]), 200))
    return outcome


def newest_commit(address: str, branch: str) -> str:
    """Of the branch, or of the one that the repository begins with."""
    wanted = f"refs/heads/{branch}" if branch else "HEAD"
    for line in _git(["ls-remote", "--", address, wanted], address).stdout.splitlines():
        commit, _, name = line.partition("\t")
        if name == wanted and re.fullmatch("[0-9a-f]{40,64}", commit):
            return commit
    raise CannotFetch(f"there is no {f'branch {branch}' if branch else 'commit'} in it yet")


def _fetch(address: str, branch: str, store: Path) -> str:
    """The commit, without what came before it."""
    _git(["init", "--quiet", "--bare", "--template=", store])
    wanted = f"refs/heads/{branch}" if branch else "HEAD"
    words = ["fetch", "--quiet", "--depth=1", "--no-tags", "--no-recurse-submodules", "--no-auto-maintenance"]
    _git(["-C", store, *words, "--", address, f"+{wanted}:refs/raysteps/fetched"], address)
    return _git(["-C", store, "rev-parse", "--verify", "refs/raysteps/fetched^{commit}"]).stdout.strip()


_MAX_SOURCES = 200


def _copy(store: Path, commit: str, names: Collection[str], folder: Path) -> None:
    """The regular files with such names. One that is too large is written as the reader of submissions refuses it."""
    listing = _git(["-C", store, "ls-tree", "-r", "-l", "-z", "--full-tree", commit], cap=_MAX_LISTING).stdout
    if listing.count("\0") > MAX_ENTRIES or (listing and not listing.endswith("\0")):
        raise CannotFetch(f"it holds more than {MAX_ENTRIES} files")
    taken = 0
    for line in filter(None, listing.split("\0")):
        facts, _, name = line.partition("\t")
        mode, _, found, size = facts.split()
        parts = split(name)
        if mode not in ("100644", "100755") or parts is None or parts[-1] not in names or len(parts) > MAX_DEPTH:
            continue
        taken += 1
        if taken > _MAX_SOURCES:
            raise CannotFetch(f"it holds more than {_MAX_SOURCES} files that are called like steps")
        data = _blob(store, found, int(size)) if int(size) <= MAX_SOURCE else b" " * (MAX_SOURCE + 1)
        write_bytes(folder.joinpath(*parts), data)


def _blob(store: Path, found: str, size: int) -> bytes:
    pieces: list[bytes] = []
    _git(["-C", store, "cat-file", "blob", found], cap=0, heard=pieces.append)
    data = b"".join(pieces)
    if len(data) != size:
        raise CannotFetch(f"{len(data)} bytes of a file came, and {size} were expected")
    return data


# One entry for each repository.

_AT_A_TIME = 4


@dataclass(frozen=True)
class Remotes:
    """Where what was fetched lies, and what of a repository counts."""

    folder: Path
    branch: str = ""
    local: Path | None = None

    @property
    def entries(self) -> Path:
        """As grade-class takes them."""
        return self.folder / "entries"

    def bring(self, name: str, text: str, names: Collection[str]) -> None:
        """The newest state, if it is another than the last one. It is there as a whole or not at all."""
        address = checked_address(text, self.local)
        mark, entry = self.folder / "commits" / name, self.entries / name
        newest = f"{address} {newest_commit(address, self.branch)}\n"
        if entry.is_dir() and mark.is_file() and mark.read_text(encoding="utf-8") == newest:
            return
        with tempfile.TemporaryDirectory(prefix=_UNFINISHED, dir=self.folder) as place:
            store, new = Path(place) / "store", Path(place) / "entry"
            new.mkdir()
            commit = _fetch(address, self.branch, store)
            _copy(store, commit, names, new)
            mark.unlink(missing_ok=True)  # so that it is fetched again when this is broken off
            shutil.rmtree(entry, ignore_errors=True)
            new.rename(entry)
            write_bytes(mark, f"{address} {commit}\n".encode())


_UNFINISHED = ".new-"


def fetch_all(
    remotes: Remotes, students: Sequence[Student], names: Collection[str], say: Callable[[str], None]
) -> list[Student]:
    """The students, each with the entry that was fetched. Of a repository that cannot be had the last state stays, and
    nobody else waits for it longer than its time."""
    owners: dict[str, list[Student]] = defaultdict(list)
    for student in students:
        if student.repository:
            owners[student.repository].append(student)
    if not owners:
        raise UsageError("the roster names no repository; expected a column `repository`, or a folder of submissions")
    labels = {address: "+".join(student.shown for student in of) for address, of in owners.items()}
    safe = name_entries(list(labels.values()), {})
    called = {address: safe[label] for address, label in labels.items()}
    for folder in (remotes.entries, remotes.folder / "commits"):
        folder.mkdir(parents=True, exist_ok=True)
    for left in remotes.folder.glob(f"{_UNFINISHED}*"):
        shutil.rmtree(left, ignore_errors=True)
    for entry in remotes.entries.iterdir():
        if entry.name not in called.values():
            shutil.rmtree(entry, ignore_errors=True)

    def bring(address: str) -> str:
        try:
            remotes.bring(called[address], address, names)
        except (CannotFetch, UsageError, OSError) as error:
            return f"{called[address]}: nothing was fetched: {error}"
        return ""

    with ThreadPoolExecutor(_AT_A_TIME) as pool:
        for trouble in filter(None, pool.map(bring, owners)):
            say(trouble)
    return [replace(one, submission=called.get(one.repository, one.submission)) for one in students]
