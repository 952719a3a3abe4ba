"""The text of the pages, one for each step, and one that leads to them."""

from collections.abc import Iterable, Sequence

from raysteps.common.text import listed
from raysteps.kit.manifest import Step
from raysteps.upkeep.handbook.exhibits import Exhibit

_INTRODUCTION = """# Mistakes that students make

The catalogue from which the grader names mistakes. Each entry is a small change of the reference in
`solutions/NN-name/mutants.toml`: every one of them loses points in its own step, in no other, and is told by name. Here
each stands with the picture that shows it best, what one sees, the usual cause, and the hint that a student reads.

The pages are made by `./raysteps dev mistakes`; edit `mutants.toml`, not them.
"""


def _code(words: Iterable[str]) -> str:
    return listed([f"`{word}`" for word in words])


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def picture_path(step: Step, name: str) -> str:
    """Of a mistake, or of a right picture; relative to docs/mistakes/."""
    return f"pictures/{step.number}-{name}.png"


def _shows_in(exhibit: Exhibit) -> str:
    parts = []
    if exhibit.pictures:
        parts.append(f"It shows in {listed(list(exhibit.pictures))}.")
    else:
        parts.append("No picture of the step shows it.")
    if exhibit.functions:
        parts.append(f"The judge sees it in {_code(exhibit.functions)}.")
    return " ".join(parts)


def _row(step: Step, exhibit: Exhibit) -> str:
    mutant = exhibit.mutant
    right = mine = ""
    if exhibit.picture:
        right = f"![{exhibit.picture}]({picture_path(step, f'right-{exhibit.picture}')})"
        mine = f"![{mutant.id}]({picture_path(step, mutant.id)})"
    words = (
        f"**{mutant.name[0].upper()}{mutant.name[1:]}** (`{mutant.id}` in `{mutant.function}`)",
        mutant.sees,
        f"*Cause:* {mutant.cause}",
        f"*Hint:* {mutant.hint}",
        _shows_in(exhibit),
    )
    return f"| {right} | {mine} | {'<br>'.join(_cell(word) for word in words)} |"


def step_page(step: Step, shown: Sequence[Exhibit]) -> str:
    """A row for each mistake: the right picture, the wrong one, and what there is to say."""
    lines = [
        f"# {step.number} {step.title}: known mistakes",
        "",
        "| right | wrong | mistake |",
        "|---|---|---|",
        *(_row(step, exhibit) for exhibit in shown),
    ]
    return "\n".join(lines) + "\n"


def index_page(every: Sequence[tuple[Step, Sequence[Exhibit]]]) -> str:
    """How many there are, and where."""
    lines = [_INTRODUCTION, "| step | mistakes | shown by a picture |", "|---|---|---|"]
    for step, shown in every:
        visible = sum(exhibit.picture is not None for exhibit in shown)
        lines.append(f"| [{step.number} {step.title}]({step.id}.md) | {len(shown)} | {visible} |")
    return "\n".join(lines) + "\n"
