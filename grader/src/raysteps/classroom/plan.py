"""What a run is to do, worked out before anything is built or graded."""

import os
import uuid
from collections import defaultdict
from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import Any

from raysteps.classroom.entries import Entry, Listing, list_entries, newest_time
from raysteps.classroom.given import Given, read_given, roster_text
from raysteps.classroom.late_policy import parse_late_policy
from raysteps.classroom.matching import Matches, match
from raysteps.classroom.names import name_entries
from raysteps.classroom.order import Order
from raysteps.classroom.places import check_places
from raysteps.classroom.records import Registered, Registration, RunFacts, Scope
from raysteps.classroom.roster import Student
from raysteps.kit.manifest import Step, choose, read_steps
from raysteps.kit.project import Project


@dataclass(frozen=True)
class Plan:
    """`entries` are those of this shard, with their names."""

    order: Order
    steps: list[Step]
    chosen: list[Step]
    listing: Listing
    given: Given
    matches: Matches
    uid: str = field(default_factory=lambda: uuid.uuid4().hex)

    @property
    def students(self) -> list[Student]:
        return self.given.students

    @property
    def late_policy(self) -> str:
        return self.given.late_policy

    @property
    def grading(self) -> dict[str, Any]:
        """Beside the kit and the submission, all that a grade depends on. The database keeps everything that is known;
        what a student is not to see is left out when results.json is made from it."""
        only = [step.id for step in self.chosen] if self.order.only else []
        return {"seed": self.order.seed, "only": only, "feedback": "full", "limits": self.order.limits}

    @property
    def settings(self) -> dict[str, Any]:
        """As the instructor gave them."""
        return {**self.grading, "feedback": self.order.feedback}

    def facts(self, kit: str) -> RunFacts:
        columns = [
            {"id": step.id, "title": step.title, "points": step.points, "bonus": step.bonus} for step in self.chosen
        ]
        folder = str(self.order.folder.resolve()).encode("utf-8", "backslashreplace").decode()
        shard = str(self.order.shard)
        files = [os.path.realpath(path) for path in self.given.files]
        return RunFacts(
            *(self.uid, kit, folder, shard, self.settings, columns, self.late_policy, self.listing.ignored),
            roster=roster_text(self.students),
            files=[file.encode("utf-8", "backslashreplace").decode() for file in files],
        )

    def registered(self, known: dict[str, str]) -> list[Registered]:
        """All entries, also those of other shards, so that merging shards shows what is missing."""
        names = name_entries([entry.label for entry in self.listing.entries], known)
        times = self._times()
        rows = []
        for at, entry in enumerate(self.listing.entries):
            said = times.get(at, [])
            when = said[-1][0] if said else newest_time(entry.path)
            source = "roster" if said else "files" if when else ""
            scope: Scope = "here" if self.order.shard.holds(entry.label) else "elsewhere"
            note = self.matches.entry_notes.get(at, "")
            if len(said) > 1:
                times_said = ", ".join(time for _, time in said)
                note = f"Its students have different times in the roster ({times_said}); the latest counts."
            rows.append(Registered(entry.label, names[entry.label], scope, when, source, note))
        return rows

    def _times(self) -> dict[int, list[tuple[str, str]]]:
        """What the roster says of when an entry was handed in, and that with a zone: of a team perhaps several times,
        the latest last."""
        zone = parse_late_policy(self.late_policy, "").deadline.tzinfo if self.late_policy else UTC

        def moment(text: str) -> datetime:
            when = datetime.fromisoformat(text)
            return when if when.tzinfo is not None else when.replace(tzinfo=zone)

        times: dict[int, dict[datetime, str]] = defaultdict(dict)
        for at, number in self.matches.pairs:
            text = self.students[number].submitted_at
            if text:
                times[at][moment(text)] = text
        return {at: [(said[when], when.isoformat()) for when in sorted(said)] for at, said in times.items()}

    def registrations(self) -> list[Registration]:
        entries: dict[int, list[str]] = defaultdict(list)
        for at, number in self.matches.pairs:
            entries[number].append(self.listing.entries[at].label)
        rows = []
        for number, student in enumerate(self.students):
            note = self.matches.student_notes.get(number, "")
            if len(entries[number]) > 1:
                note = f"Handed in more than once: {', '.join(entries[number])}. Say which one counts in the roster."
            rows.append(Registration(student.id, student.name, student.email, tuple(entries[number]), note))
        return rows

    def mine(self) -> list[Entry]:
        return [entry for entry in self.listing.entries if self.order.shard.holds(entry.label)]


def make_plan(project: Project, order: Order) -> Plan:
    """Everything that can be wrong with the inputs is found here."""
    check_places(order.folder, order.out, resume=order.resume)
    steps = read_steps(project)
    chosen = choose(steps, list(order.only))
    given = read_given(order)
    listing = list_entries(order.folder, given.files)
    matches = match([entry.label for entry in listing.entries], given.students)
    return Plan(order, steps, chosen, listing, given, matches)
