"""What a calibration found: as a table for a terminal, as docs/calibration.md, and in words what to do."""

import math
import re
from collections.abc import Sequence
from textwrap import wrap

from rich.markup import escape
from rich.table import Table

from raysteps.upkeep.calibration.gate import LEAST_MARGIN, Share, plain
from raysteps.upkeep.calibration.measuring import SEEDS, Calibrated
from raysteps.upkeep.calibration.settings import Setting

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


def _margin(one: Calibrated) -> str:
    return "" if math.isinf(one.gate.margin) else f"{float(f'{one.gate.margin:.3g}'):g}"


def _row(one: Calibrated) -> tuple[str, ...]:
    return (
        one.limited.step,
        one.limited.title,
        _share(one.gate.worst),
        _share(one.gate.mildest),
        _margin(one),
        plain(one.gate.stands),
    )


def calibration_table(found: Sequence[Calibrated]) -> Table:
    """One row for each limit."""
    table = Table(title="limits on wrong pixels", title_justify="left")
    for heading in _HEADINGS:
        table.add_column(heading, justify="right" if heading in ("margin", "limit") else "left")
    for one in found:
        color = "green" if one.gate.is_clear else "red"
        cells = [escape(cell) for cell in _row(one)]
        table.add_row(*cells[:4], f"[{color}]{cells[4]}[/]", cells[5])
    return table


def _unseen_everywhere(found: Sequence[Calibrated]) -> list[str]:
    """Mistakes of each step that none of its pictures shows."""
    lines = []
    for step in dict.fromkeys(one.limited.step for one in found):
        hidden_from = [set(one.gate.unseen) for one in found if one.limited.step == step]
        names = sorted(set.intersection(*hidden_from)) if hidden_from else []
        text = f"- {step}: {', '.join(names) if names else 'none'}"
        lines += wrap(text, _WIDEST, subsequent_indent="  ", break_on_hyphens=False)
    return lines


def calibration_page(found: Sequence[Calibrated], settings: Sequence[Setting], left_out: Sequence[str]) -> str:
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


def complaints(found: Sequence[Calibrated], *, check: bool) -> list[str]:
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
