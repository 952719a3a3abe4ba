"""What of a class is compared, and `export similarity`: the same as JPlag reads it."""

import argparse
import sys
from collections.abc import Collection, Mapping
from itertools import zip_longest
from pathlib import Path
from typing import Any

from raysteps.classroom.database import refuse_results
from raysteps.classroom.entries import ANOTHERS, list_entries, name_entries
from raysteps.common.errors import UsageError
from raysteps.common.files import write_out
from raysteps.common.text import clean, count, name_order
from raysteps.course.manifest import Step, chosen_steps, read_steps
from raysteps.course.mutants import read_alternatives, reference_source
from raysteps.course.project import Project
from raysteps.course.stubs import pristine_stub, same_code
from raysteps.exports.autograders import Member, as_zip, into_folder
from raysteps.exports.similar_pairs import ComparedSubmission, Origin
from raysteps.submission.load import Submission, load_submission

BASE, ROOM = "base-code", "submissions"
_REFERENCE = "_kit-reference"  # no submission's name begins with `_` and a letter

BegunSources = dict[str, dict[Step, bytes]]  # by the names of submissions


def add_similarity_arguments(systems: "argparse._SubParsersAction[Any]") -> None:
    """A class, and where it goes."""
    add = systems.add_parser("similarity", help="the sources of a class, to be compared by JPlag")
    add.add_argument("folder", type=Path, metavar="CLASS", help="one folder, zip or tar per submission")
    add.add_argument("--out", type=Path, required=True, metavar="FILE.zip|DIR", help="where they go")
    add.add_argument("--steps", nargs="+", default=[], metavar="STEP", help="only these; all when none is given")
    add.add_argument(
        "--solutions", action="store_true", help="the kit's own solutions, too, as if somebody had handed them in"
    )


def _started(submission: Submission, stubs: dict[Step, str]) -> dict[Step, bytes]:
    """What is more than the stub: who has not begun a step is like everybody who has not."""
    found = {}
    for step, stub in stubs.items():
        data = submission.sources.get(step.id)
        if data is not None and not same_code(data.decode("utf-8", "replace"), stub):
            found[step] = data
    return found


def started_of_class(folder: Path, every: list[Step], stubs: dict[Step, str], left_out: list[Path]) -> BegunSources:
    """What each has begun, by name; who has begun nothing is named on stderr."""
    refuse_results(folder)
    entries = list_entries(folder, left_out).entries
    names = name_entries([entry.label for entry in entries], {})
    entries.sort(key=lambda entry: name_order(entry.label))
    found: BegunSources = {}
    for entry in entries:
        try:
            started = {} if entry.leads_to else _started(load_submission(entry.path, every), stubs)
            note = ANOTHERS if entry.leads_to else "" if started else "holds no step that was begun"
        except UsageError as error:
            started, note = {}, str(error).removeprefix(f"{entry.path}: ")
        if note:
            print(f"raysteps: {clean(entry.label)} is left out: it {clean(note)}", file=sys.stderr)
        else:
            found[names[entry.label]] = started
    return found


def known_solutions(project: Project, steps: Collection[Step], origin: Origin) -> list[ComparedSubmission]:
    """The reference, and the other correct ways, one for each step: they tell what is usual where a class is small."""
    ways = [[reference_source(project, one), *(way.source for way in read_alternatives(project, one))] for one in steps]
    rows = [
        {step.id: source for step, source in zip(steps, row, strict=True) if source is not None}
        for row in zip_longest(*ways)
    ]
    names = ["the kit's reference", *(f"the kit's other way {number}" for number in range(1, len(rows)))]
    return [ComparedSubmission(name, row, origin) for name, row in zip(names, rows, strict=True)]


def base_code(project: Project, stubs: Mapping[Step, str]) -> list[str]:
    """Stubs, contracts and the framework."""
    paths = [*project.steps.glob("*/*.hpp"), *(project.root / "framework").rglob("*.?pp")]
    return [*stubs.values(), *(path.read_text(encoding="utf-8", errors="replace") for path in sorted(paths))]


def _of_kit(project: Project, chosen: list[Step]) -> list[Member]:
    room = f"{ROOM}/{_REFERENCE}"
    return [Member(f"{room}/{step.path.as_posix()}", reference_source(project, step).encode()) for step in chosen]


def export_similarity(project: Project, arguments: argparse.Namespace) -> int:
    """Writes the sources, and says how JPlag is called with them."""
    every = read_steps(project)
    stubs = {step: pristine_stub(project, step) for step in chosen_steps(project, arguments.steps)}
    out: Path = arguments.out
    handed_in = started_of_class(arguments.folder, every, stubs, [out])
    members = [
        Member(f"{ROOM}/{name}/{step.path.as_posix()}", data)
        for name, started in handed_in.items()
        for step, data in started.items()
    ]
    if len(handed_in) + (1 if arguments.solutions else 0) < 2:
        raise UsageError(f"{arguments.folder}: holds {count(len(handed_in), 'submission')} with work; expected two")
    members += _of_kit(project, list(stubs)) if arguments.solutions else []
    members += [Member(f"{BASE}/{step.path.as_posix()}", stub.encode()) for step, stub in stubs.items()]
    members.sort(key=lambda member: member.name)
    if out.suffix.lower() == ".zip":
        write_out(out, as_zip(members))
        where = "in the folder that it is unpacked to"
    else:
        into_folder(members, out)
        where = f"in {out}"
    print(f"raysteps: wrote {count(len(handed_in), 'submission')} to {out}. Then, {where}:", file=sys.stderr)
    print(f"java -jar jplag.jar -l cpp -bc {BASE} --result-file similarity {ROOM}", flush=True)
    return 0
