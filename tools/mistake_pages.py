"""The command `dev mistakes`: makes docs/mistakes/, or tells what is out of date there."""

import io
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_bytes, write_if_changed
from raysteps.common.text import join_and
from raysteps.course.manifest import ImageCase, Step
from raysteps.course.mutants import Mutant, read_mutants
from raysteps.course.project import Project
from raysteps.diagnosis.mutant_fingerprints import MutantFingerprint, mutant_fingerprints
from raysteps.images.compare import Pixels, compare
from raysteps.images.noise import visibly_wrong_share
from raysteps.images.render import shown_reference
from raysteps.judge.plan import read_plan
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback

# What there is to show of a known mistake.


@dataclass(frozen=True)
class Exhibit:
    """A mistake, the picture with the most wrong pixels, and all in which it shows."""

    mutant: Mutant
    picture: str | None  # none where all pictures stay right
    pixels: Pixels | None
    pictures: Sequence[str]
    functions: Sequence[str]  # whose answers to the judge it makes wrong


def references(kit: BuiltKit, step: Step) -> dict[str, Pixels]:
    """The right pictures of the step, by name."""
    return {case.name: shown_reference(kit, kit.project.root / case.scene, case) for case in step.images}


def _wrong_share(case: ImageCase, mine: Pixels, right: Pixels) -> float:
    """0 where the picture passes."""
    if case.is_noisy:
        return visibly_wrong_share(mine, right)
    seen = compare(mine, right, case.max_wrong)
    return 0.0 if seen.passed else seen.wrong_share


def _exhibit(step: Step, mutant: Mutant, known: MutantFingerprint, right: Mapping[str, Pixels]) -> Exhibit:
    wrong = {
        case.name: _wrong_share(case, known.pictures[case.name], right[case.name])
        for case in step.images
        if case.name in known.pictures
    }
    shown = {name: share * right[name].size for name, share in wrong.items() if share}
    best = max(shown, key=lambda name: shown[name], default=None)
    functions = [name for name in step.functions if known.answers.get(name)]
    return Exhibit(mutant, best, known.pictures[best] if best else None, list(shown), functions)


def exhibits(kit: BuiltKit, step: Step, say: ProgressCallback) -> list[Exhibit]:
    """One for each mistake, in the order of the catalogue."""
    mutants = read_mutants(kit.project, step)
    if not mutants:
        raise GraderFault(f"{step.id}: there is no catalogue of mistakes")
    known = mutant_fingerprints(kit, step, read_plan(kit.project, step), mutants, say)
    right = references(kit, step)
    return [_exhibit(step, mutant, known[mutant.id], right) for mutant in mutants]


# The pages' pictures: small files, compared with some patience.

_COLORS = 96
_MAX_APART = 2.0  # of 255, on average: another compiler moves a few pixels


def _png(pixels: Pixels) -> bytes:
    data = io.BytesIO()
    Image.fromarray(pixels).quantize(_COLORS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).save(
        data, format="PNG", optimize=True
    )
    return data.getvalue()


def is_current(path: Path, pixels: Pixels) -> bool:
    """Whether the file shows this picture."""
    try:
        with Image.open(path) as image:
            kept = np.asarray(image.convert("RGB"), dtype=np.int16)
    except OSError:
        return False
    with Image.open(io.BytesIO(_png(pixels))) as image:
        wanted = np.asarray(image.convert("RGB"), dtype=np.int16)
    return kept.shape == wanted.shape and float(np.abs(kept - wanted).mean()) <= _MAX_APART


def write_image(path: Path, pixels: Pixels) -> None:
    """With few colours, so that the repository stays small."""
    write_bytes(path, _png(pixels))


# The text of the pages, one for each step, and one that leads to them.

_INTRODUCTION = """# Mistakes that students make

The catalogue from which the grader names mistakes. Each entry is a small change of the reference in
`solutions/NN-name/mutants.toml`: every one of them loses points in its own step, in no other, and is told by name. Here
each stands with the picture that shows it best, what one sees, the usual cause, and the hint that a student reads.

The pages are made by `./raysteps dev mistakes`; edit `mutants.toml`, not them.
"""


def _code(words: Iterable[str]) -> str:
    return join_and([f"`{word}`" for word in words])


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def picture_path(step: Step, name: str) -> str:
    """Of a mistake, or of a right picture; relative to docs/mistakes/."""
    return f"pictures/{step.number}-{name}.png"


def _shows_in(exhibit: Exhibit) -> str:
    parts = []
    if exhibit.pictures:
        parts.append(f"It shows in {join_and(list(exhibit.pictures))}.")
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


def _contents(project: Project, say: ProgressCallback) -> tuple[dict[Path, str], dict[Path, Pixels]]:
    """Texts and pictures by their paths."""
    kit = build_kit(project, say, of_all_parts=True)
    folder = project.root / "docs" / "mistakes"
    every = [(step, exhibits(kit, step, say)) for step in kit.steps]
    texts = {folder / "README.md": index_page(every)}
    pictures: dict[Path, Pixels] = {}
    for step, shown in every:
        texts[folder / f"{step.id}.md"] = step_page(step, shown)
        right = references(kit, step)
        for exhibit in shown:
            if exhibit.picture is not None and exhibit.pixels is not None:
                pictures[folder / picture_path(step, f"right-{exhibit.picture}")] = right[exhibit.picture]
                pictures[folder / picture_path(step, exhibit.mutant.id)] = exhibit.pixels
    return texts, pictures


def out_of_date(project: Project, say: ProgressCallback) -> list[str]:
    """Paths that are missing, old or no longer needed."""
    texts, pictures = _contents(project, say)
    folder = project.root / "docs" / "mistakes"
    old = [path for path, text in texts.items() if not path.is_file() or path.read_text("utf-8") != text]
    old += [path for path, pixels in pictures.items() if not is_current(path, pixels)]
    old += [path for path in folder.rglob("*.*") if path not in texts and path not in pictures]
    return sorted(path.relative_to(project.root).as_posix() for path in old)


def write(project: Project, say: ProgressCallback) -> list[str]:
    """Makes what is out of date anew, removes what is not needed, and returns what changed."""
    texts, pictures = _contents(project, say)
    folder = project.root / "docs" / "mistakes"
    changed = [path for path, text in texts.items() if write_if_changed(path, text.encode())]
    for path, pixels in pictures.items():
        if not is_current(path, pixels):
            write_image(path, pixels)
            changed.append(path)
    for path in list(folder.rglob("*.*")):
        if path not in texts and path not in pictures:
            path.unlink()
            changed.append(path)
    return sorted(path.relative_to(project.root).as_posix() for path in changed)
