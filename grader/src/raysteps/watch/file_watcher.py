"""Notices saves: by events of the file system, by polling where there are none, and by a look of its own every second,
so that a save may come late but is never lost.
"""

import hashlib
import os
import re
import threading
import time
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path

import watchfiles

from raysteps.common.text import count
from raysteps.course.manifest import Step, earlier, read_steps
from raysteps.course.project import Project
from raysteps.toolchain.fingerprint import PROGRAM_FOLDERS, kit_files
from raysteps.watch.events import FileSaved, FileVanished, Owner, Post, WatchNotice

_COUNTS = re.compile(r"\w+\.(hpp|cpp)|step\.toml")  # not what editors leave beside them
_SETTLE_MS = 50  # several writes within this time are one save
_POLL_MS = 300
_LOOK_MS = 1000
_HEARD_SECONDS = 3.0  # what is seen so soon after an event belongs to it
_GONE_SECONDS = 0.5  # a file is away for a moment while an editor saves by renaming

Snapshot = dict[Path, bytes]


def _digests(paths: Iterable[Path]) -> Snapshot:
    """Of what the files hold; those that are not there are left out."""
    found: Snapshot = {}
    for path in paths:
        with suppress(OSError):
            found[path] = hashlib.blake2b(path.read_bytes(), digest_size=16).digest()
    return found


class _KitFiles:
    """All that the kit's programs are built from: many files, of which only those are read that look new."""

    def __init__(self, project: Project) -> None:
        self._project = project
        self._stats: dict[Path, tuple[int, int, int]] = {}
        self.seen: Snapshot = {}

    def look(self) -> Snapshot:
        stats: dict[Path, tuple[int, int, int]] = {}
        with suppress(OSError):  # a folder that goes while it is listed: the next look finds it, or not
            for path in kit_files(self._project, PROGRAM_FOLDERS):
                stat = path.stat()
                stats[path] = (stat.st_mtime_ns, stat.st_size, stat.st_ino)
            new = _digests(path for path, stat in stats.items() if self._stats.get(path) != stat)
            self._stats, self.seen = stats, {path: one for path, one in self.seen.items() if path in stats} | new
        return self.seen


class FileWatcher:
    """Watches in a thread what the program of one step is built from: the student's files up to it, and the kit."""

    def __init__(self, project: Project, step: Step, post: Post, *, poll: bool) -> None:
        self._project = project
        self._post = post
        self._poll = poll
        self._kit = _KitFiles(project)
        self._lock = threading.Lock()
        self._end = threading.Event()
        self._thread = threading.Thread(target=self._watch, daemon=True)
        self.look_at(step)

    def look_at(self, step: Step) -> None:
        """From now on this step; what its files hold now is no news."""
        with self._lock:
            self._step = step
            before = earlier(step, read_steps(self._project))
            self._earlier = [self._project.steps / other.path for other in before]
            self._kit.look()
            self._seen = self._snapshot()
            self._away_since: float | None = None

    def _snapshot(self) -> Snapshot:
        """Files of the step and the student's own before it, as they are; the kit's, as they were seen last."""
        folder = self._project.steps / self._step.id
        near = [path for path in self._kit.seen if path.parent == folder]
        with suppress(OSError):
            near = [path for path in folder.iterdir() if _COUNTS.fullmatch(path.name)]
        far = {path: one for path, one in self._kit.seen.items() if path.parent != folder}
        return far | _digests([*near, *self._earlier])

    def start(self) -> None:
        self._thread.start()

    def close(self) -> None:
        self._end.set()
        if self._thread.is_alive():
            self._thread.join(2)

    def _folders(self) -> list[Path]:
        """Those of a students' kit are fewer. Without the steps there is nothing to watch."""
        folders = (self._project.root / name for name in PROGRAM_FOLDERS)
        return [self._project.steps, *(one for one in folders if one != self._project.steps and one.is_dir())]

    def _changes(self) -> Iterator[bool]:
        """Whenever there may be news: true when the system said so, false when it is time to look anyway."""
        with suppress(FileNotFoundError):
            for changes in watchfiles.watch(
                *self._folders(),
                watch_filter=None,
                step=_SETTLE_MS,
                stop_event=self._end,
                rust_timeout=_LOOK_MS,
                yield_on_timeout=True,
                raise_interrupt=False,
                force_polling=self._poll,
                poll_delay_ms=_POLL_MS,
                ignore_permission_denied=True,
            ):
                yield bool(changes)

    def _watch(self) -> None:
        while not self._end.is_set():
            try:
                self._follow()
            except (OSError, RuntimeError) as error:  # such as too many watches of this user
                if not self._poll:
                    self._begin_to_poll(f"File events do not work here ({error})")
            self._end.wait(_POLL_MS / 1000)
            self.look()

    def _follow(self) -> None:
        """Until it is closed, or a save has raised no event within a second of being seen."""
        heard, missed = -_HEARD_SECONDS, False
        for told in self._changes():
            now = time.monotonic()
            if told:
                heard, missed = now, False
            elif missed and not self._poll:
                self._begin_to_poll("A save was seen that no event told of")
                return
            news = self.look(told=told)
            missed = missed or (news and not told and now > heard + _HEARD_SECONDS)

    def _begin_to_poll(self, why: str) -> None:
        self._poll = True
        self._post(WatchNotice(f"{why}: from now on files are polled."))

    def look(self, *, told: bool = True) -> bool:
        """Whether there was news; posts it. The kit's files are looked at when the system told of a change, or tells
        of none."""
        with self._lock:
            if told or self._poll:
                self._kit.look()
            now, before, own = self._snapshot(), self._seen, self._project.steps / self._step.path
            if own not in now and own in before:
                self._away_since = self._away_since or time.monotonic()
                if time.monotonic() < self._away_since + _GONE_SECONDS:
                    return False
                self._seen = now
                self._post(FileVanished(own.name))
                return True
            self._away_since = None
            changed = sorted(path for path in now.keys() | before.keys() if now.get(path) != before.get(path))
            self._seen = now
            if changed:
                self._post(self._saved(changed))
            return bool(changed)

    def _saved(self, changed: list[Path]) -> FileSaved:
        """The kit's first: it takes longest. Otherwise the student's own file of this step."""
        own = self._project.steps / self._step.path
        kit = [path for path in changed if path != own and path not in self._earlier]
        owner: Owner = "kit" if kit else "step" if own in changed else "earlier"
        first, more = (kit or changed)[0], len(changed) - 1
        if owner == "step":
            return FileSaved(own.name)
        name = first.relative_to(self._project.root).as_posix()
        return FileSaved(f"{name} and {count(more, 'more file')}" if more else name, owner)


# Where file events cannot be trusted: on mounts that somebody else may write to.

_MOUNTS = Path("/proc/self/mountinfo")
# Network file systems, shares of virtual machines, and Windows' own disks as Linux sees them.
_SHARED = re.compile(
    r"nfs\d?|cifs|smb\d?|smbfs|9p|drvfs|afs|ncpfs|vboxsf|vmhgfs|prl_fs|virtiofs|fakeowner|fuse\.(?!fuseblk|ext|ntfs).*"
)
_OFF = {"", "0", "false", "no", "off"}


def _unescaped(text: str) -> str:
    return re.sub(r"\\([0-7]{3})", lambda found: chr(int(found[1], 8)), text)


def kind_of(path: Path, mounts: Path = _MOUNTS) -> str:
    """The type of the file system that holds the path, or nothing where that cannot be told."""
    best, kind = -1, ""
    place = path.resolve()
    try:
        lines = mounts.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return ""
    for line in lines:
        fields, _, rest = line.partition(" - ")
        words, types = fields.split(), rest.split()
        if len(words) < 5 or not types:
            continue
        mount = Path(_unescaped(words[4]))
        if place.is_relative_to(mount) and len(mount.parts) >= best:  # a later mount hides an earlier one
            best, kind = len(mount.parts), types[0]
    return kind


def why_poll(path: Path, environment: Mapping[str, str] = os.environ, mounts: Path = _MOUNTS) -> str:
    """Why files there are polled, or nothing where events can be trusted."""
    for name in ("RAYSTEPS_POLL", "WATCHFILES_FORCE_POLLING"):
        if name in environment:
            return f"{name} is set" if environment[name].strip().lower() not in _OFF else ""
    kind = kind_of(path, mounts)
    return f"the files are on {kind}, where saves may raise no event" if _SHARED.fullmatch(kind) else ""
