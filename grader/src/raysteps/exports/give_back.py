"""Gives the reports of a graded class back: who gets what, and the archives that Moodle and Canvas take."""

import re
from collections import Counter, defaultdict
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from raysteps.classroom.class_document import read_class_document, steps_of
from raysteps.classroom.database import CLASS_JSON, SUBMISSIONS
from raysteps.classroom.entries import canvas_numbers, folded, moodle_identity, stem
from raysteps.common.errors import UsageError, reason
from raysteps.common.platform import kit_command
from raysteps.common.text import clean, did_you_mean, join_and
from raysteps.course.manifest import Step
from raysteps.exports.autograders import Member, TarMode, as_tar, as_zip
from raysteps.exports.class_results import GradedStudent, Person, match, number_at_end, read_class, results_of
from raysteps.results.class_model import ClassResults
from raysteps.results.model import Results
from raysteps.results.store import REPORT

# Who gets what. Every way of giving back asks here, and nowhere else.


@dataclass(frozen=True)
class Delivery:
    """What one student gets: of a team each member gets the same."""

    student: GradedStudent
    results: Results  # as much of them as the class was graded to tell students
    folder: Path  # of results.json, the report and its pictures

    @property
    def report(self) -> Path:
        return self.folder / REPORT

    def report_bytes(self) -> bytes:
        try:
            return self.report.read_bytes()
        except OSError as error:
            raise UsageError(f"{self.report}: cannot be read: {reason(error)}") from error


@dataclass(frozen=True)
class Undelivered:
    """Whom nothing is given back to, and why."""

    label: str
    why: str


@dataclass
class Deliveries:
    """A class that is given back."""

    given: list[Delivery] = field(default_factory=list)
    others: list[Undelivered] = field(default_factory=list)
    course: str = ""
    steps: list[Step] = field(default_factory=list)  # as the run graded them

    def leave_out(self, delivery: Delivery, why: str) -> None:
        self.others.append(Undelivered(delivery.student.label, why))


_WITHOUT_REPORT = {
    "fault": "the grader failed with it: look at fault.txt, then run grade-class with --resume",
    "not-graded": "not graded yet: go on with grade-class --resume",
}


def _identity(student: GradedStudent) -> tuple[str, str, str]:
    return student.id, student.name, student.email


def _chosen(graded: Sequence[GradedStudent], only: Sequence[str]) -> list[GradedStudent]:
    """Those whose submission, id, name or email address was named; all when none was."""
    if not only:
        return list(graded)
    names = [{folded(word) for word in (one.submission, *_identity(one)) if word} for one in graded]
    for word in only:
        if not any(folded(word) in known for known in names):
            hint = did_you_mean(folded(word), sorted(set().union(*names)))
            raise UsageError(f"--only {word}: is no submission, id, name or email address in results.csv{hint}")
    wanted = set(map(folded, only))
    return [one for one, known in zip(graded, names, strict=True) if wanted & known]


def _why_not(one: GradedStudent, outdated: Collection[str], handed_in: Mapping[tuple[str, str, str], int]) -> str:
    if not one.submission:
        return "handed nothing in"
    if one.status in _WITHOUT_REPORT:
        return _WITHOUT_REPORT[one.status]
    if one.submission in outdated:
        return "has an earlier result, because what is there now is not graded yet: go on with grade-class --resume"
    if one.known and handed_in[_identity(one)] > 1:
        return "handed in more than once: say in the column `submission` of the roster which one counts, and --resume"
    return ""


def read_deliveries(folder: Path, only: Sequence[str] = ()) -> Deliveries:
    """Of the output of grade-class. What lies on disk holds no more than `--feedback` let students be told."""
    graded = read_class(folder)
    document: ClassResults = read_class_document(folder / CLASS_JSON)
    outdated = set(document.outdated)
    handed_in = Counter(_identity(one) for one in graded if one.submission)
    found = Deliveries(course=document.course, steps=steps_of(document.steps))
    for one in _chosen(graded, only):
        why = _why_not(one, outdated, handed_in)
        results = results_of(folder, one) if not why else None
        home = folder / SUBMISSIONS / one.submission
        if not why and results is None:
            why = f"no results.json in {home}: run grade-class with --resume, which writes it anew"
        elif not why and not (home / REPORT).is_file():
            why = f"no {REPORT} in {home}: `{kit_command('report', home)}` makes it"
        if results is None or why:
            found.others.append(Undelivered(one.label, why))
        else:
            found.given.append(Delivery(one, results, home))
    return found


def _rivals(deliveries: Deliveries, places: Mapping[int, str]) -> dict[int, str]:
    """By delivery, why it is left out: where a platform would put the reports of two submissions in one place, nobody
    knows which one counts. `places` by delivery."""
    at_place: dict[str, dict[str, None]] = defaultdict(dict)
    for at, place in places.items():
        at_place[place][deliveries.given[at].student.submission] = None
    return {
        at: f"{join_and(list(at_place[place]))} would go to one place, {place}: take what does not count out of the "
        "folder of the submissions, and run grade-class with --resume"
        for at, place in places.items()
        if len(at_place[place]) > 1
    }


# What Moodle takes under "Upload multiple feedback files in a zip": a folder for each participant, whose name holds the
# number that Moodle counts this one by in the assignment.

_NOT_IN_MOODLE = re.compile(r'[_/\\:*?"<>|\x00-\x1f]+')
_MOODLE_PLUGIN = "assignsubmission_file_"  # with the last `_`: versions before 4.1 take no other


def moodle_folder(name: str, participant: str) -> str:
    """What stands before the first `_` is for people; a `_` in it would put another word in the number's place."""
    shown = " ".join(_NOT_IN_MOODLE.sub(" ", clean(name)).split())[:80].strip(" .~")
    return f"{shown or 'Participant'}_{participant}_{_MOODLE_PLUGIN}"


def _of_whom(student: GradedStudent, name: str) -> bool:
    """Whether the name at the beginning of a download is this student's; a team's comes before it, with a dash."""
    said, own = folded(name), folded(student.name)
    return bool(own) and (said == own or said.endswith(f"-{own}"))


def _participants(deliveries: Deliveries) -> dict[int, str]:
    """By the names of the downloads: of a team only who handed in is named there."""
    teams: dict[str, list[int]] = defaultdict(list)
    for at, one in enumerate(deliveries.given):
        teams[one.student.submission].append(at)
    found: dict[int, str] = {}
    for members in teams.values():
        name, participant = moodle_identity(stem(deliveries.given[members[0]].student.entry))
        of_name = [at for at in members if _of_whom(deliveries.given[at].student, name)]
        mine = members if len(members) == 1 else of_name if len(of_name) == 1 else []
        found |= {at: participant for at in mine if participant}
    return found


def moodle_zip(deliveries: Deliveries, people: Sequence[Person] | None) -> bytes:
    """`people` are the rows of a grading worksheet, whose numbers count where there is one. Whom no number is known of,
    or one that is another's as well, goes over to the others."""
    if people is not None:
        rows = match([one.student for one in deliveries.given], people)
        found = {at: number_at_end(min(people[row].numbers, key=len)) for at, row in rows.found.items()}
        why = "no row of the worksheet is this student's"
    else:
        found = _participants(deliveries)
        why = "no participant number in the name of what was handed in: name the grading worksheet with --template"
    rivals = _rivals(deliveries, {at: f"participant {number} of Moodle" for at, number in found.items() if number})
    members: dict[str, Member] = {}
    given = []
    for at, one in enumerate(deliveries.given):
        participant = found.get(at, "")
        if not participant or at in rivals:
            deliveries.leave_out(one, rivals.get(at, why))
            continue
        folder = moodle_folder(one.student.name or one.student.submission, participant)
        members[participant] = Member(f"{folder}/{REPORT}", one.report_bytes())
        given.append(one)
    deliveries.given = given
    return as_zip(sorted(members.values(), key=lambda member: member.name))


# What Canvas takes under "Re-Upload Submissions" of an assignment: files that are called as in the download. It shows
# each under the name that the student gave it, and so the reports come in an archive of the same kind.

_TAR_MODES: dict[str, TarMode] = {
    ".tar": "w", ".tar.gz": "w:gz", ".tgz": "w:gz", ".tar.xz": "w:xz", ".txz": "w:xz", ".tar.bz2": "w:bz2",
    ".tbz2": "w:bz2",
}  # fmt: skip


def packed(entry: str, members: Sequence[Member]) -> bytes:
    """In the form that the ending says; what was unpacked already was a zip most likely."""
    lower = entry.lower()
    mode = next((mode for ending, mode in _TAR_MODES.items() if lower.endswith(ending)), None)
    return as_zip(members) if mode is None else as_tar(members, mode)


_NOT_OF_CANVAS = "what was handed in is not named as in a download of Canvas, such as leeann_4711_815_steps.zip"


def canvas_zip(deliveries: Deliveries) -> bytes:
    """One file for each submission: of a team Canvas itself tells the others. What Canvas did not name, or named
    once for two, goes over to the others."""
    uploads = {at: found for at, one in enumerate(deliveries.given) if (found := canvas_numbers(one.student.entry))}
    rivals = _rivals(deliveries, {at: f"upload {file} of student {number}" for at, (number, file) in uploads.items()})
    members: dict[str, Member] = {}
    given = []
    for at, one in enumerate(deliveries.given):
        entry = one.student.entry
        if at not in uploads or at in rivals:
            deliveries.leave_out(one, rivals.get(at, _NOT_OF_CANVAS))
            continue
        name = entry if stem(entry) != entry else f"{entry}.zip"
        members[entry] = Member(name, packed(name, [Member(REPORT, one.report_bytes())]))
        given.append(one)
    deliveries.given = given
    return as_zip(sorted(members.values(), key=lambda member: member.name))


def refuse_nobody(deliveries: Deliveries, folder: Path) -> None:
    """Where nothing can be given back, the reasons say what to do."""
    if not deliveries.given:
        reasons = list(dict.fromkeys(other.why for other in deliveries.others))[:3]
        raise UsageError(f"{folder}: nothing can be given back: {'; '.join(reasons)}")
