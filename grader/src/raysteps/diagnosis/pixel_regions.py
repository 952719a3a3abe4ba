"""Where the wrong pixels of a picture lie, in words."""

import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from raysteps.common.documents import read_text
from raysteps.common.text import join_and
from raysteps.course.manifest import Step
from raysteps.diagnosis.evidence import Mask, Picture, differing
from raysteps.images.compare import Pixels
from raysteps.images.render import at_step, reference_picture
from raysteps.results.model import Diagnosis
from raysteps.toolchain.kit_artifacts import BuiltKit

# Which object of the scene a pixel shows, and the scene with its materials changed.

_KINDS = {"s": "sphere", "c": "cone", "p": "polygon", "pp": "polygon"}
_MAX_COLORS = 1 << 24  # as many as there are colours
_PLAIN = "1 0 1 0 1"  # kd, ks, shine, transmittance, index


@dataclass(frozen=True)
class Object:
    """What one line of the scene begins."""

    kind: str
    line: int


@dataclass(frozen=True)
class ObjectMap:
    """For each pixel the number of its object, 0 for the background; object n is objects[n - 1]."""

    numbers: npt.NDArray[np.int32]
    objects: Sequence[Object]


def size_of(args: Sequence[str]) -> tuple[str, ...]:
    """The words of a picture's arguments that say how large it is."""
    at = list(args).index("--size") if "--size" in args else len(args)
    return tuple(args[at : at + 2])


def render_text(kit: BuiltKit, nff: str, args: tuple[str, ...]) -> Pixels:
    """The reference's picture of a scene that is no file; kept by what it says."""
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        path = Path(folder) / "scene.nff"
        path.write_text(nff, encoding="utf-8")
        return reference_picture(kit, path, args)


def _colour(number: int) -> str:
    return " ".join(f"{(number >> shift & 255) / 255:.9g}" for shift in (16, 8, 0))


def numbered(nff: str) -> tuple[str, list[Object]]:
    """The scene with its objects coloured by their numbers."""
    out: list[str] = []
    objects: list[Object] = []
    for at, line in enumerate(nff.splitlines(), start=1):
        words = line.split()
        word = words[0] if words else ""
        if word in _KINDS and len(objects) < _MAX_COLORS - 1:
            objects.append(Object(_KINDS[word], at))
            out.append(f"f {_colour(len(objects))} {_PLAIN}")
        out.append("b 0 0 0" if word == "b" else line)
    return "\n".join(out) + "\n", objects


def without_highlights(nff: str) -> str:
    """The scene with every ks 0."""
    lines = []
    for line in nff.splitlines():
        words = line.split()
        lines.append(" ".join([*words[:5], "0", *words[6:]]) if words[:1] == ["f"] and len(words) == 9 else line)
    return "\n".join(lines) + "\n"


def object_map(kit: BuiltKit, scene: Path, args: Sequence[str]) -> ObjectMap:
    """What the reference sees first in each pixel."""
    nff, objects = numbered(read_text(scene))
    pixels = render_text(kit, nff, ("--step", "2", *size_of(args))).astype(np.int32)
    return ObjectMap(pixels[..., 0] << 16 | pixels[..., 1] << 8 | pixels[..., 2], objects)


_ALL_BUT_FEW = 0.95  # of the wrong pixels count for all
_NEARLY_ALL = 0.9  # of the picture: where it is wrong says nothing
_MAX_NAMED = 3
_EDGES = 0.9
_SMALL = 0.5  # of the picture: a part that is worth its numbers


def edges_of(objects: ObjectMap) -> Mask:
    """The pixels beside another object."""
    numbers = objects.numbers
    mask = np.zeros(numbers.shape, dtype=np.bool_)
    down, across = numbers[1:] != numbers[:-1], numbers[:, 1:] != numbers[:, :-1]
    mask[1:] |= down
    mask[:-1] |= down
    mask[:, 1:] |= across
    mask[:, :-1] |= across
    return mask


def _along_edges(wrong: Mask, objects: ObjectMap) -> str:
    edges = edges_of(objects)
    if edges.mean() < _SMALL and (wrong & edges).sum() >= _EDGES * wrong.sum():
        return "along the edges of things"
    return ""


def _on_objects(wrong: Mask, objects: ObjectMap, scene: str) -> str:
    """Those that hold nearly all of them; nothing where that is most of what one sees."""
    numbers, counts = np.unique(objects.numbers[wrong], return_counts=True)
    order = np.argsort(-counts)
    reached = np.cumsum(counts[order]) >= _ALL_BUT_FEW * counts.sum()
    chosen = sorted(int(number) for number in numbers[order][: int(np.argmax(reached)) + 1])
    seen = np.unique(objects.numbers)
    if len(chosen) > _MAX_NAMED or len(chosen) >= max(2, len(seen) - 1):
        return ""
    words = [_name(number, objects) for number in chosen]
    return f"on {join_and(words)}" + (f" of {scene}" if any(chosen) else "")


def _name(number: int, objects: ObjectMap) -> str:
    if not 0 < number <= len(objects.objects):
        return "the background"
    found = objects.objects[number - 1]
    return f"the {found.kind} of line {found.line}"


def _in_part(wrong: Mask) -> str:
    rows, columns = np.nonzero(wrong)
    height, width = wrong.shape
    top, bottom = (int(value) for value in np.percentile(rows, [1, 99]))
    left, right = (int(value) for value in np.percentile(columns, [1, 99]))
    if (bottom - top + 1) * (right - left + 1) > _SMALL * wrong.size:
        return ""
    row, column = (top + bottom) / 2 / height, (left + right) / 2 / width
    vertical = "upper" if row < 1 / 3 else "lower" if row > 2 / 3 else ""
    horizontal = "left" if column < 1 / 3 else "right" if column > 2 / 3 else ""
    where = f"{vertical} {horizontal}".strip() or "middle"
    return f"in the {where} part, x {left} to {right}, y {top} to {bottom}"


def _too(picture: Picture) -> str:
    """Whether they are all brighter, or all darker; nothing where the background and directions are not light."""
    wrong = picture.wrong
    step = picture.case.args[picture.case.args.index("--step") + 1] if "--step" in picture.case.args else ""
    if step in ("1", "2"):
        return ""
    gap = picture.mine[wrong].astype(np.int16).sum(axis=1) - picture.reference[wrong].astype(np.int16).sum(axis=1)
    if (gap > 0).mean() >= _ALL_BUT_FEW:
        return "they are too bright"
    return "they are too dark" if (gap < 0).mean() >= _ALL_BUT_FEW else ""


def place_of(picture: Picture, objects: ObjectMap, terms: Sequence[str]) -> str:
    """A sentence. `terms`: what else the wrong pixels have in common, such as `where there is shadow`."""
    wrong = picture.wrong
    scene = picture.case.scene.rpartition("/")[2]
    if wrong.mean() >= _NEARLY_ALL:
        where = ["nearly everywhere"]
    else:
        edges = _along_edges(wrong, objects)
        where = [edges] if edges else [_on_objects(wrong, objects, scene), *terms]
        where.append(_in_part(wrong))
    said = ", ".join(filter(None, where)) or "in many places"
    too = _too(picture)
    return f"In {picture.case.name} the wrong pixels lie {said}" + (f"; {too}." if too else ".")


# What can be said of a wrong picture that no known mistake explains: first which part of the light the wrong pixels
# have in common, by the masks where pictures of neighbouring steps differ.

_WITHIN = 0.9  # of the wrong pixels lie in the mask
_FILLED = 0.25  # of the mask is wrong
_MAX_MASK_SHARE = 0.7  # of the picture, that still says something


@dataclass(frozen=True)
class Term:
    """`where` ends "the wrong pixels lie ..."."""

    where: str
    hint: str


_HIGHLIGHTS = Term("where there are highlights", "Look at the part of the light that mirrors towards the eye.")
_UNLIT = Term("where no light falls on the surface", "What does a surface get from a light that is behind it?")
_SHADOWS = Term("where there is shadow", "Look at what counts as being in the way of the light, and what does not.")
_MIRRORS = Term("where something is mirrored", "Look at the bounced ray: where it starts, where it goes, when it ends.")
_BRIGHT = Term("where the light is too bright for a byte", "What becomes of colours that are above 1?")
_GLASS = Term("where one looks through glass", "Look at the ray that goes through: where it starts and how it bends.")


class Terms:
    """Of one picture."""

    def __init__(self, kit: BuiltKit, step: int, picture: Picture) -> None:
        self._kit = kit
        self._step = step
        self._picture = picture
        self._scene = kit.project.root / picture.case.scene

    def at_step(self, step: int) -> Pixels:
        """The same picture with what an earlier step can do."""
        return reference_picture(self._kit, self._scene, at_step(self._picture.case.args, step))

    def _between(self, step: int) -> Mask:
        return differing(self.at_step(step - 1), self.at_step(step))

    def _highlights(self) -> Mask:
        args = ("--step", "3", *size_of(self._picture.case.args))
        shiny = reference_picture(self._kit, self._scene, args)
        return differing(shiny, render_text(self._kit, without_highlights(read_text(self._scene)), args))

    def _unlit(self) -> Mask:
        mask: Mask = self.at_step(3).max(axis=2) <= 2
        return mask

    def _bright(self) -> Mask:
        mask: Mask = np.asarray(self.at_step(6).max(axis=2) == 255)
        return mask

    def _masks(self) -> Iterator[tuple[int, Term, Callable[[], Mask]]]:
        yield 8, _GLASS, lambda: self._between(8)
        yield 7, _BRIGHT, self._bright
        yield 5, _MIRRORS, lambda: self._between(5)
        yield 4, _SHADOWS, lambda: self._between(4)
        yield 3, _UNLIT, self._unlit
        yield 3, _HIGHLIGHTS, self._highlights

    def found(self) -> list[Term]:
        """What the step itself adds to the light, where that holds nearly all wrong pixels."""
        wrong = self._picture.wrong
        terms = []
        for step, term, make in self._masks():
            if self._step != step:
                continue
            mask = make()
            within = int((wrong & mask).sum())
            if within >= _WITHIN * wrong.sum() and within >= _FILLED * mask.sum() and mask.mean() <= _MAX_MASK_SHARE:
                terms.append(term)
        return terms


_MAX = 2


def findings(kit: BuiltKit, step: Step, pictures: Mapping[str, Picture]) -> Iterator[Diagnosis]:
    """Where the pictures are wrong; those with the fewest wrong pixels say most."""
    telling = sorted(pictures.items(), key=lambda item: float(item[1].wrong.mean()))
    for name, picture in telling[:_MAX]:
        terms = Terms(kit, step.index, picture).found() if picture.wrong.mean() < _NEARLY_ALL else []
        objects = object_map(kit, kit.project.root / picture.case.scene, picture.case.args)
        sentence = place_of(picture, objects, [term.where for term in terms[:2]])
        hint = terms[0].hint if terms else ""
        yield Diagnosis("finding", "where-it-is-wrong", sentence, hint=hint, seen_in=[name])
