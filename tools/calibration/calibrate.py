"""The command `dev calibrate`."""

import math
import re
import tempfile
import time
import tomllib
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from textwrap import wrap
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_if_changed
from raysteps.common.platform import processor_count
from raysteps.course.manifest import Step, choose
from raysteps.course.project import Project
from raysteps.grading.pipeline import grade_submission
from raysteps.results.model import Settings, StepResult
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.submission.load import Submission
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback
from tools.calibration.measure import (
    LEAST_MARGIN,
    SEEDS,
    CalibratedPicture,
    PictureTable,
    Setting,
    Share,
    all_settings,
    calibrate_step,
    counted,
    own_setting,
    plain,
)
from tools.grade_audit import missed
from tools.test_submissions import Entrant, right_ones

# Every correct solution in every setting: each must get full marks.

_SECONDS = 60.0  # without optimisation, and beside other work, a program takes longer


@dataclass(frozen=True)
class Mark:
    """What a correct solution got."""

    step: Step
    candidate: Entrant
    setting: Setting
    result: StepResult

    @property
    def is_full(self) -> bool:
        return self.result.status == "passed" and self.result.points == self.result.max

    def lost(self) -> str:
        """What cost points, in a line each."""
        head = f"{self.step.id}, {self.candidate.name}, {self.setting.name}: {self.result.status}"
        return "\n  ".join(
            [f"{head}, {self.result.points:g} of {self.result.max:g}", *(missed(self.result) or self.result.messages)]
        )


def mark(kit: BuiltKit, step: Step, candidate: Entrant, setting: Setting, seed: int = 1) -> Mark:
    """As a submission of this one step would be graded."""
    submission = Submission(candidate.name, {step.id: candidate.source.encode()}, {})
    wished = Settings(seed=seed, only=(step.id,), limits={"seconds": _SECONDS})
    with tempfile.TemporaryDirectory(prefix="raysteps-") as out:
        results = grade_submission(setting.applied(kit).in_one_process(), submission, wished, LimitsOnly(), Path(out))
    return Mark(step, candidate, setting, results.steps[0])


def _table(found: Sequence[Mark], seconds: float) -> Table:
    table = Table(title=f"full marks of correct solutions, {seconds:.0f} s", title_justify="left")
    table.add_column("step")
    table.add_column("solution")
    table.add_column("settings", justify="right")
    table.add_column("full marks", justify="right")
    for step, name in dict.fromkeys((one.step.id, one.candidate.name) for one in found):
        mine = [one for one in found if (one.step.id, one.candidate.name) == (step, name)]
        full = sum(one.is_full for one in mine)
        table.add_row(step, escape(name), str(len(mine)), f"[{'green' if full == len(mine) else 'red'}]{full}[/]")
    return table


def marks(
    kit: BuiltKit, steps: Sequence[Step], settings: Sequence[Setting], console: Console, say: ProgressCallback
) -> int:
    """Grades all, prints a table, and says what was lost."""
    start = time.monotonic()
    work = [
        (step, candidate, setting)
        for step in steps
        for candidate in right_ones(kit.project, step)
        for setting in (own_setting(kit), *settings)
    ]
    one_more = counted(say, "graded", len(work))

    def one(item: tuple[Step, Entrant, Setting]) -> Mark:
        found = mark(kit, *item)
        one_more()
        return found

    with ThreadPoolExecutor(processor_count()) as pool:
        found = list(pool.map(one, work))
    console.print(_table(found, time.monotonic() - start))
    short = [one for one in found if not one.is_full]
    for less in short:
        console.print(less.lost(), markup=False, highlight=False)
    print(f"{len(found) - len(short)} of {len(found)} have full marks", flush=True)
    return 1 if short else 0


# What a calibration found: as a table for a terminal, as docs/calibration.md, and in words what to do.

_HEADINGS = ("step", "picture", "worst correct solution", "mildest mistake", "margin", "limit")
_WIDEST = 120  # columns of a document
_INTRODUCTION = f"""# Calibration of the pictures

*Made by `./raysteps dev calibrate`; not written by hand.*

A picture passes when the share of its pixels that differ from the reference's by more than 2/255 is at most
`max_wrong`. That limit is no matter of taste. Every correct solution that is kept (the reference and
`solutions/*/alternatives`) is rendered in every setting below, every known mistake (`solutions/*/mutants.toml`) in the
kit's own. The limit lies midway, in ratio, between the worst correct solution and the mildest mistake.

- A correct solution counts as two pixels wrong at least, even where all give the reference's picture exactly: somebody
  will write it in a way that nobody has thought of.
- A mistake that changes ten pixels of a picture or fewer, or no more than a correct solution does, is not what that
  picture shows. It is told from a correct solution by other pictures or by the judge's questions to the functions.
- Hidden scenes are measured with the seeds {SEEDS.start} to {SEEDS.stop - 1}: of correct solutions the worst of them
  counts, of mistakes the mildest.
- The margin says how many times more pixels the mildest mistake changes than the worst correct solution. Where it is
  below {LEAST_MARGIN:.0f} the picture cannot tell the two apart, the calibration fails, and the scene has to be
  changed: more of what the mistake changes, fewer edges, another size or depth. Moving the limit would not help.

`./raysteps dev calibrate --check` measures again and compares with the manifests. `./raysteps dev calibrate --marks`
grades every correct solution in every setting and expects full marks.
"""


def _share(share: Share | None) -> str:
    if share is None:
        return "none"
    whose = f" ({share.whose})" if share.whose else " (two pixels)"
    return f"{share.value * 100:.3g} %{whose}"


def _margin(one: CalibratedPicture) -> str:
    return "" if math.isinf(one.gate.margin) else f"{float(f'{one.gate.margin:.3g}'):g}"


def _row(one: CalibratedPicture) -> tuple[str, ...]:
    return (
        one.limited.step,
        one.limited.title,
        _share(one.gate.worst),
        _share(one.gate.mildest),
        _margin(one),
        plain(one.gate.stands),
    )


def calibration_table(found: Sequence[CalibratedPicture]) -> Table:
    """One row for each limit."""
    table = Table(title="limits on wrong pixels", title_justify="left")
    for heading in _HEADINGS:
        table.add_column(heading, justify="right" if heading in ("margin", "limit") else "left")
    for one in found:
        color = "green" if one.gate.is_clear else "red"
        cells = [escape(cell) for cell in _row(one)]
        table.add_row(*cells[:4], f"[{color}]{cells[4]}[/]", cells[5])
    return table


def _unseen_everywhere(found: Sequence[CalibratedPicture]) -> list[str]:
    """Mistakes of each step that none of its pictures shows."""
    lines = []
    for step in dict.fromkeys(one.limited.step for one in found):
        hidden_from = [set(one.gate.unseen) for one in found if one.limited.step == step]
        names = sorted(set.intersection(*hidden_from)) if hidden_from else []
        text = f"- {step}: {', '.join(names) if names else 'none'}"
        lines += wrap(text, _WIDEST, subsequent_indent="  ", break_on_hyphens=False)
    return lines


def calibration_page(found: Sequence[CalibratedPicture], settings: Sequence[Setting], left_out: Sequence[str]) -> str:
    """docs/calibration.md."""
    lines = [_INTRODUCTION, "## Settings", ""]
    lines += [f"- {setting.name}" for setting in settings] + [f"- {text}" for text in left_out]
    lines += ["", "FMA: `-ffp-contract=fast` on a processor that can fuse a product and a sum; elsewhere it is off."]
    lines += ["", "## Limits", "", "| " + " | ".join(_HEADINGS) + " | mistakes it does not show |"]
    lines.append("|" + "---|" * (len(_HEADINGS) + 1))
    lines += [f"| {' | '.join(_row(one))} | {', '.join(one.gate.unseen)} |" for one in found]
    lines += ["", "## Mistakes that no picture of their step shows", ""]
    lines += ["The visible tests and the judge's questions have to find these.", ""]
    lines += _unseen_everywhere(found)
    return "\n".join(lines) + "\n"


def _entries(page: str) -> list[str]:
    """Its lines, each with the indented ones that go on with it."""
    return re.split(r"\n(?!  )", page)


def _renewed(entries: list[str], head: str, step: str, new: list[str]) -> list[str]:
    """Entries of a step begin with `head` and its name; those of a new step come after the last one's."""
    own = [number for number, entry in enumerate(entries) if entry.startswith(f"{head}{step}")]
    of_steps = [number for number, entry in enumerate(entries) if re.match(rf"{re.escape(head)}\d\d-", entry)]
    at = own[0] if own else [len(entries), *(number + 1 for number in of_steps)][-1]
    return entries[:at] + new + [entry for number, entry in enumerate(entries[at:], at) if number not in own]


def page_with(page: str, measured: str) -> str:
    """The page with the steps that another page, of some steps only, has measured anew."""
    entries, others = _entries(page), _entries(measured)
    for head, end in (("| ", " |"), ("- ", ":")):
        of_steps = [entry for entry in others if re.match(rf"{re.escape(head)}\d\d-", entry)]
        for step in dict.fromkeys(entry.removeprefix(head).partition(end)[0] for entry in of_steps):
            new = [entry for entry in of_steps if entry.startswith(f"{head}{step}{end}")]
            entries = _renewed(entries, head, f"{step}{end}", new)
    return "\n".join(entries)


def complaints(found: Sequence[CalibratedPicture], *, check: bool) -> list[str]:
    """What is not as it should be, one line for each limit."""
    lines = []
    for one in found:
        gate, where = one.gate, f"{one.limited.step}, {one.limited.title}"
        if not gate.is_clear:
            lines.append(
                f"{where}: the mistake {_share(gate.mildest)} is too near to the correct solution "
                f"{_share(gate.worst)}; change the scene so that the margin of {gate.margin:.2g} becomes "
                f"{LEAST_MARGIN:.0f} or more"
            )
        elif check and not gate.is_written:
            lines.append(
                f"{where}: max_wrong is {plain(gate.written)}, measured {plain(gate.limit)}; "
                "./raysteps dev calibrate writes it"
            )
    return lines


# Writes limits into manifests, and leaves all else as it stands: comments, order and layout.

_NAMES = {"images": "name", "twins": "of", "random_scenes": "name"}
_LIMIT = re.compile(r"^(max_wrong[ \t]*=[ \t]*)[^ \t\r\n#]+", re.M)


def _name_of(block: str) -> tuple[str, str] | None:
    """Which table a part of a manifest is, from one line with a bracket to the next."""
    header = re.match(r"\[\[(\w+)\]\]", block)
    if header is None or header[1] not in _NAMES:
        return None
    table: dict[str, Any] = tomllib.loads(block)[header[1]][0]
    return header[1], str(table[_NAMES[header[1]]])


def with_limits(text: str, limits: Mapping[tuple[PictureTable, str], float]) -> str:
    """The manifest with these limits in the tables of these names."""
    blocks = re.split(r"^(?=\[)", text, flags=re.M)
    left = {(str(table), name): value for (table, name), value in limits.items()}
    for place, block in enumerate(blocks):
        value = left.pop(name, None) if (name := _name_of(block)) is not None else None
        if value is None:
            continue
        blocks[place], times = _LIMIT.subn(rf"\g<1>{plain(value)}", block)
        if times != 1:
            raise GraderFault(f"{name}: expected one line max_wrong = ..., found {times}")
    if left:
        raise GraderFault(f"no table for {', '.join(' '.join(name) for name in left)}")
    return "".join(blocks)


def write_limits(path: Path, limits: Mapping[tuple[PictureTable, str], float]) -> bool:
    """Whether the file changed."""
    return write_if_changed(path, with_limits(path.read_text(encoding="utf-8"), limits).encode())


def _write(kit: BuiltKit, found: Sequence[CalibratedPicture]) -> None:
    for path in dict.fromkeys(one.limited.path(kit.project) for one in found):
        limits = {
            (one.limited.table, one.limited.name): one.gate.limit
            for one in found
            if one.limited.path(kit.project) == path and not one.gate.is_written
        }
        if limits and write_limits(path, limits):
            print(f"{path.relative_to(kit.project.root).as_posix()} written")


def _measured(
    kit: BuiltKit, only: Sequence[str], settings: Sequence[Setting], say: ProgressCallback
) -> list[CalibratedPicture]:
    found: list[CalibratedPicture] = []
    for step in choose(kit.steps, list(only)):
        found += calibrate_step(kit, step, settings, processor_count(), say)
    return found


def calibrate(
    project: Project, only: Sequence[str], console: Console, say: ProgressCallback, *, check: bool, grades: bool
) -> int:
    """Measures the limits of all pictures and writes them; or grades every correct solution (`grades`)."""
    kit = build_kit(project, say, of_all_parts=True)
    settings, left_out = all_settings(kit)
    for text in left_out:
        say(text)
    if grades:
        return marks(kit, choose(kit.steps, list(only)), settings, console, say)
    found = _measured(kit, only, settings, say)
    console.print(calibration_table(found))
    problems = complaints(found, check=check)
    for problem in problems:
        console.print(problem, markup=False, highlight=False)
    if not check:
        _write(kit, found)
        page = project.root / "docs" / "calibration.md"
        text = calibration_page(found, settings, left_out)
        if only and page.is_file():
            text = page_with(page.read_text(encoding="utf-8"), text)
        if write_if_changed(page, text.encode()):
            print(f"{page.relative_to(project.root).as_posix()} written")
    return 1 if problems else 0
