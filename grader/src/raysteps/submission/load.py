"""Takes a submission in: a folder or an archive, of which only the known source files count."""

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from itertools import islice
from pathlib import Path

from raysteps.common.documents import Text
from raysteps.common.errors import UsageError, reason
from raysteps.common.text import did_you_mean, join_and, one_line
from raysteps.course.manifest import Step
from raysteps.submission.archives import DAMAGED, FOREIGN_ENDINGS, archive_entries
from raysteps.submission.encoding import decode
from raysteps.submission.entries import MAX_ABOVE, FileEntry, RejectedFile, is_out_of_sight, shown
from raysteps.submission.folders import FolderReader, PlainFolderReader, what_is

# Where the files of a submission are expected, and which names are close to an expected one.

_BARE = 2
_MAX_NAME = 255  # letters; no system has longer names, but an archive may
_ENDINGS_OF_CODE = (".cpp", ".cc", ".cxx", ".c++", ".cp", ".c")
_ENDINGS = (".txt", ".bak", ".orig", "~", *_ENDINGS_OF_CODE)
_WORDS_OF_COPIES = re.compile(r"\b(?:copy|kopie|copia|copie|of|von|de|final|new|old|v)\b")


@dataclass(frozen=True)
class SourceLocation:
    """An accepted place of a step's file; the lower rank is the more explicit place."""

    step: str
    rank: int
    exact: bool  # not only but for upper and lower case
    home: tuple[str, ...] = ()  # the top folders that it lies below
    form: int = 0  # 0 steps/step/file, 1 step/file, 2 file


def _lower(text: str) -> str:
    """In ASCII only: other alphabets have letters whose lower case is an ASCII letter."""
    return "".join(chr(ord(letter) + 32) if "A" <= letter <= "Z" else letter for letter in text)


def _plain(name: str) -> str:
    """Only what tells one step's file from another's: no ending, numbers, separators, signs of a copy, plural."""
    name = _lower(name)
    while name.endswith(_ENDINGS):
        name = name.removesuffix(next(ending for ending in _ENDINGS if name.endswith(ending)))
    name = _WORDS_OF_COPIES.sub(" ", re.sub(r"[\W\d_]+", " ", name))
    return name.replace(" ", "").rstrip("s")


class SourceLocator:
    """All accepted places of all steps."""

    def __init__(self, steps: list[Step]) -> None:
        self._wanted: dict[tuple[str, ...], tuple[int, str]] = {}
        self._folders = {step.id for step in steps}
        self._plain = {_plain(step.file): step.id for step in steps}
        for step in steps:
            self._wanted["steps", step.id, step.file] = (0, step.id)
            self._wanted[step.id, step.file] = (1, step.id)
            self._wanted[(step.file,)] = (2, step.id)
        self._lower = {tuple(map(_lower, parts)): found for parts, found in self._wanted.items()}

    def find(self, parts: tuple[str, ...]) -> SourceLocation | None:
        """The place that this path is, perhaps below top folders: one for a bare file, which could be anything else
        further down."""
        for above in range(min(len(parts), MAX_ABOVE + 1)):
            tail, forms = parts[above:], _BARE + 1
            for known, worse in ((self._wanted, 0), (self._lower, 1)):
                form, step = known.get(tuple(map(_lower, tail)) if worse else tail, (forms, ""))
                if form < forms and (form < _BARE or above <= 1):
                    return SourceLocation(step, 2 * (form + forms * above) + worse, worse == 0, parts[:above], form)
        return None

    def near(self, parts: tuple[str, ...]) -> str | None:
        """The step whose file this may be meant to be, in the wrong folder or under a wrong name."""
        if len(parts[-1]) > _MAX_NAME or not _lower(parts[-1]).endswith(_ENDINGS):
            return None
        return self._plain.get(_plain(parts[-1]))

    def beside(self, parts: tuple[str, ...]) -> str | None:
        """The step in whose folder this lies, a source under any name but that of the step's tests or their copies."""
        name = _lower(parts[-1])
        is_code = name.endswith(_ENDINGS_OF_CODE) and not name.startswith(".") and "_test" not in name
        return self.is_of_a_step(parts[:-1]) if is_code and len(parts) > 1 else None

    def is_of_a_step(self, parts: tuple[str, ...]) -> str | None:
        """The step whose folder lies at this path."""
        above = len(parts) - 2 if parts[-2:-1] == ("steps",) else len(parts) - 1
        return parts[-1] if above <= MAX_ABOVE and parts[-1] in self._folders else None

    def below(self, folder: tuple[str, ...]) -> list[str]:
        """The steps that have an accepted place somewhere below this folder."""
        lower = tuple(map(_lower, folder))
        heads = [lower[above:] for above in range(MAX_ABOVE + 1)]
        return sorted(
            {step for parts, (_, step) in self._lower.items() if any(_is_head(head, parts) for head in heads)}
        )


def unusual_places(places: Mapping[str, SourceLocation]) -> set[str]:
    """The steps that do not lie where the others do: that may be an old copy, or a name that went wrong.

    A whole submission in a folder of its own is usual; a single file in some folder says nothing about it."""
    if not places:
        return set()
    best = min(places.values(), key=lambda place: place.rank)
    usual = (best.home, best.form)
    alike = {step for step, place in places.items() if (place.home, place.form) == usual}
    if best.home and best.form == _BARE and len(alike) == 1:
        return set(places)
    return set(places) - alike


def _is_head(head: tuple[str, ...], parts: tuple[str, ...]) -> bool:
    return len(head) > 0 and parts[: len(head)] == head


# What of a submission counts.

_MAX_COPIES = 3  # that are named
_OPENS_BELOW = os.open in os.supports_dir_fd  # not on Windows

ARCHIVE_ENDINGS = (".tar.gz", ".tgz", ".tar.xz", ".txz", ".tar.bz2", ".tbz2", ".tar", ".zip")


@dataclass(frozen=True)
class Submission:
    """The student's sources by step id, as plain UTF-8 with LF; a step without a file is missing here."""

    name: Text
    sources: dict[str, bytes]
    notes: dict[str, str]  # why a step has no source
    remarks: dict[str, str] = field(default_factory=dict)  # what was unusual about a source that was taken


@dataclass
class _Candidate:
    """What lay at the best place for one step so far."""

    place: SourceLocation
    path: str
    data: bytes = b""
    problem: str = ""


class _Collector:
    """Reads what counts while the entries pass by: a stream does not come back."""

    def __init__(self, steps: list[Step]) -> None:
        self._steps = {step.id: step for step in steps}
        self._places = SourceLocator(steps)
        self._found: dict[str, _Candidate] = {}
        self._problems: dict[str, str] = {}  # why something at an accepted place was not taken
        self._copies: dict[str, list[str]] = {}  # what was left out because the same lay at a more explicit place
        self._near: dict[str, str] = {}  # what looks like a step's file but lies elsewhere or is called otherwise
        self._beside: dict[str, str] = {}  # what lies in a step's folder and looks like no step's file

    def take(self, entries: Iterator[FileEntry]) -> None:
        for entry in entries:
            place = self._places.find(entry.parts)
            if place is not None:
                self._take_at(place, entry)
                continue
            self._expect_folder(entry)
            near = self._places.near(entry.parts)
            if near is not None:
                self._near.setdefault(near, self._not_taken(near, entry))
            elif (beside := self._places.beside(entry.parts)) is not None:
                self._beside.setdefault(beside, self._not_taken(beside, entry))

    def _not_taken(self, step: str, entry: FileEntry) -> str:
        expected = f"steps/{self._steps[step].path.as_posix()}"
        return f"{shown(entry.parts)} was not taken: it must be {expected}."

    def _expect_folder(self, entry: FileEntry) -> None:
        """Where a step's folder belongs, a file is not taken; links and the like are told of otherwise."""
        step = self._places.is_of_a_step(entry.parts)
        with suppress(RejectedFile):
            if step is not None and entry.read() is not None:
                self._problems.setdefault(step, f"{shown(entry.parts)} is a file, not a folder, and was not taken.")

    def _take_at(self, place: SourceLocation, entry: FileEntry) -> None:
        best = self._found.get(place.step)
        path = shown(entry.parts)
        if best is not None and place.rank > best.place.rank:
            self._leave_out(place.step, path)
            return
        if best is not None and place.rank == best.place.rank:
            self._leave_out(place.step, path)  # should there be a better one yet
            best.data, best.problem = b"", "is there more than once, so none of them was taken."
            return
        found = _Candidate(place, path)
        try:
            found.data = entry.read()
        except RejectedFile as problem:  # a file at a lesser place is better than none
            self._problems.setdefault(place.step, f"{path} {problem}")
            return
        if best is not None:
            self._leave_out(place.step, best.path)
        self._found[place.step] = found

    def _leave_out(self, step: str, path: str) -> None:
        copies = self._copies.setdefault(step, [])
        if path not in copies and len(copies) < _MAX_COPIES:
            copies.append(path)

    def cannot_look_into(self, folders: Mapping[tuple[str, ...], str]) -> None:
        for folder, why in folders.items():
            for step in self._places.below(folder):
                self._problems.setdefault(step, f"The folder {shown(folder)} {why}.")

    def submission(self, name: str) -> Submission:
        result = Submission(name, {}, self._beside | self._near | self._problems)
        unusual = unusual_places({step: found.place for step, found in self._found.items()})
        for step, found in self._found.items():
            result.notes.pop(step, None)
            problem = found.problem
            try:
                decoded = decode(found.data)
            except RejectedFile as refused:
                problem = problem or str(refused)
            if problem:
                result.notes[step] = f"{found.path} {problem}"
                continue
            result.sources[step] = decoded.source
            remarks = [self._problems.get(step, ""), decoded.remark(self._steps[step].file)]
            remarks += self._of_place(step, found, unusual)
            if any(remarks):
                result.remarks[step] = " ".join(filter(None, remarks))
        return result

    def _of_place(self, step: str, found: _Candidate, unusual: set[str]) -> list[str]:
        """Where a source lay, and what was left out beside it."""
        remarks = []
        expected = f"steps/{self._steps[step].path.as_posix()}"
        if not found.place.exact:
            remarks.append(f"{found.path} was taken for {expected}.")
        elif step in unusual:
            remarks.append(f"It was found at {found.path}; it belongs at {expected}.")
        copies = sorted(self._copies.get(step, []))
        if copies:
            remarks.append(f"{join_and(copies)} {'was' if len(copies) == 1 else 'were'} left out beside {found.path}.")
        return remarks


def submission_name(path: Path) -> str:
    """The name of the folder, or of the archive without its ending."""
    # A name that is not UTF-8 carries halves of surrogates, which neither JSON nor a terminal takes.
    name = one_line(path.resolve().name.encode("utf-8", "replace").decode("utf-8")).strip()
    for ending in ARCHIVE_ENDINGS:
        if name.lower().endswith(ending) and os.path.isfile(path):  # noqa: PTH113  # Path.is_file may raise
            name = name[: -len(ending)]
            break
    return "submission" if name in ("", ".", "..") else name


def _collect(path: Path, collector: _Collector, *, may_be_link: bool) -> None:
    if path.is_dir():
        reader = _reader(path)
        collector.take(reader.entries())
        collector.cannot_look_into(reader.closed)
    elif not path.exists():
        what, near = ("is a link that leads nowhere", "") if path.is_symlink() else ("is not there", like(path))
        raise UsageError(f"{path}: {what}; expected a submission: a folder, zip or tar{near}")
    elif not path.is_file():
        raise UsageError(f"{path}: is {what_is(path.stat().st_mode)}; expected a submission: a folder, zip or tar")
    else:
        collector.take(archive_entries(path, may_be_link=may_be_link))


def _reader(folder: Path) -> FolderReader | PlainFolderReader:
    return FolderReader(folder) if _OPENS_BELOW else PlainFolderReader(folder)


def like(path: Path) -> str:
    """Words that name what there is instead."""
    try:
        names = [child.name for child in path.parent.iterdir() if child.name != path.name]
    except FileNotFoundError:
        return f"; there is no folder {path.parent} either"
    except OSError:  # what may not be listed, or is no folder
        return ""
    return did_you_mean(path.name, names)


def without_place(error: UsageError, path: Path) -> str:
    """What is wrong with a submission, for its student, who need not know where it lies."""
    return str(error).removeprefix(f"{path}: ").replace(f"{path}{os.sep}", "")


def submissions_inside(path: Path, steps: list[Step]) -> list[str]:
    """What lies in a folder that holds no step itself, where it is a class: folders that each hold a file of the same
    step, or archives that each hold a step."""
    highest = _homes_in(path, steps)
    folders = {home for found in highest for home in found}
    several = {home for found in highest if len(found) > 1 for home in found}
    if path.is_dir() and not folders:
        packed = [one.name for one in _packed_in(path)]
        several = set(packed) if len([*islice(_packed_steps(path, steps), 2)]) > 1 else set()
    return sorted(several)


def archives_beside(path: Path, steps: list[Step]) -> list[str]:
    """Those that hold a step, beside the only folder that does and is taken: other submissions, or old ones."""
    folders = {home for found in _homes_in(path, steps) for home in found}
    if len(folders) != 1 or "" in folders:
        return []
    return [one for one in _packed_steps(path, steps) if submission_name(path / one) not in folders]


def _homes_in(path: Path, steps: list[Step]) -> list[set[str]]:
    """Of each step the folders that hold its file; what lies further down is somebody's old copy."""
    if not path.is_dir():
        return []
    places, homes = SourceLocator(steps), dict[str, set[tuple[str, ...]]]()
    for place in filter(None, (places.find(entry.parts) for entry in _reader(path).entries())):
        homes.setdefault(place.step, set()).add(place.home)
    if any(() in found for found in homes.values()):
        return [{""}]
    return [{"/".join(home) for home in _highest(found)} for found in homes.values()]


_MAX_LOOKED_INTO = 16  # archives: who hands in a thousand would have them all decoded


def _packed_steps(path: Path, steps: list[Step]) -> Iterator[str]:
    """The archives in a folder that each hold a step, among the first ones."""
    return (one.name for one in _packed_in(path)[:_MAX_LOOKED_INTO] if _holds_a_step(one, steps))


def _holds_a_step(archive: Path, steps: list[Step]) -> bool:
    try:
        found = _load(archive, steps, may_be_link=False)
    except UsageError:
        return False
    return bool(found.sources or found.notes)


def is_submission(path: Path, steps: list[Step]) -> bool:
    """Whether a folder holds a step itself, in a folder of the step's name."""
    return any((path / above / step.path).is_file() for step in steps for above in ("steps", ""))


def refuse_results_in(handed_in: Path, out: Path, rooms: Sequence[str]) -> None:
    """What was handed in must stay as it is: results in it would be handed in the next time, and earlier ones are
    cleared. `rooms` are the folders in `out` that a grading writes to. Where a submission is a whole kit, its `build`
    and other folders of tools are no part of it."""
    real, place = handed_in.resolve(), out.resolve()
    below = place.relative_to(real).parts if place.is_relative_to(real) else None
    is_in = below is not None and not (below and is_out_of_sight(below))
    if is_in or any(real.is_relative_to(place / room) for room in rooms):
        raise UsageError(
            f"--out {out}: the results would lie among what was handed in, {handed_in}; name a folder outside of it, "
            "or one in its build folder, such as build/grades"
        )
    link = _link_on_the_way(handed_in, out, rooms)
    if link is not None:
        raise UsageError(f"--out {out}: {link} is a link that was handed in, and results would go where it leads")


def _link_on_the_way(handed_in: Path, out: Path, rooms: Sequence[str]) -> Path | None:
    """One of the submission's that results would be written through."""
    place = Path(os.path.abspath(out))  # noqa: PTH100  # Path.absolute leaves `..` in it
    for home in (Path(os.path.abspath(handed_in)), handed_in.resolve()):  # noqa: PTH100
        if place.is_relative_to(home):
            inner = [place / room for room in rooms]
            ways = [place, *place.parents, *inner, *(child for room in inner for child in room.glob("*"))]
            return next((way for way in ways if way != home and way.is_relative_to(home) and way.is_symlink()), None)
    return None


def _highest(homes: set[tuple[str, ...]]) -> list[tuple[str, ...]]:
    least = min(map(len, homes))
    return [home for home in homes if len(home) == least]


def _packed_in(folder: Path) -> list[Path]:
    """The archives that lie in a folder, as where a platform makes one for each student's upload."""
    with os.scandir(folder) as children:
        return sorted(
            Path(child)
            for child in children
            if child.name.lower().endswith((*ARCHIVE_ENDINGS, *FOREIGN_ENDINGS))
            and not child.name.startswith(".")  # such as what macOS writes beside each file
            and child.is_file(follow_symlinks=False)
        )


def load_submission(path: Path, steps: list[Step]) -> Submission:
    """Reads a submission into memory; nothing is ever unpacked to disk. Of a folder that holds no step, but one
    archive, this is read."""
    submission = _load(path, steps, may_be_link=True)  # which was named by whoever grades
    if submission.sources or submission.notes:
        return submission
    packed = _packed_in(path) if path.is_dir() else []
    if len(packed) == 1:
        inner = _load(packed[0], steps, may_be_link=False)
        if inner.sources or inner.notes:
            return replace(inner, name=submission.name)
        more = f", nor does {one_line(packed[0].name)} in it"
    else:
        more = f", but {len(packed)} archives, of which none is taken" if packed else ""
    raise UsageError(f"{path}: holds no step{more}; expected files like steps/{steps[0].path.as_posix()}")


def load_each(folder: Path, steps: Sequence[Step]) -> dict[str, Submission]:
    """What a folder holds of each step, by id, as if it were the only one: the folder is gone through once for all."""
    collectors = {step.id: _Collector([step]) for step in steps}
    reader = _reader(folder)
    for entry in reader.entries():
        for collector in collectors.values():
            collector.take(iter((entry,)))
    for collector in collectors.values():
        collector.cannot_look_into(reader.closed)
    return {step: collector.submission(submission_name(folder)) for step, collector in collectors.items()}


def _load(path: Path, steps: list[Step], *, may_be_link: bool) -> Submission:
    """Nothing but a name where there is no step."""
    collector = _Collector(steps)
    try:
        _collect(path, collector, may_be_link=may_be_link)
    except DAMAGED as error:
        if path.is_file() and not path.name.lower().endswith(ARCHIVE_ENDINGS):
            example = f"steps/{steps[0].path.as_posix()}"
            raise UsageError(
                f"{path}: is one file; expected a folder with files like {example}, or a zip or tar of it"
            ) from error
        if isinstance(error, OSError) and error.errno is not None:
            raise UsageError(f"{path}: cannot be read: {reason(error)}") from error
        why = "an archive may be damaged or cut off"
        raise UsageError(f"{path}: cannot be read as a folder, zip or tar; {why} ({reason(error)})") from error
    return collector.submission(submission_name(path))
