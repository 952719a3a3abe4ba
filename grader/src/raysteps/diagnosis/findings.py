"""What can be said of a wrong picture that no known mistake explains."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from raysteps.common.documents import read_text
from raysteps.course.manifest import Step
from raysteps.diagnosis.evidence import Mask, Picture, differing
from raysteps.diagnosis.pixel_regions import object_map, place_of, render_text, size_of, without_highlights
from raysteps.diagnosis.transforms import BEFORE, Transformed, in_words, transformation_of
from raysteps.images.compare import Pixels
from raysteps.images.render import at_step, reference_picture
from raysteps.results.model import Diagnosis
from raysteps.toolchain.kit_artifacts import BuiltKit

# Which part of the light the wrong pixels have in common: the masks where pictures of neighbouring steps differ.

_WITHIN = 0.9  # of the wrong pixels lie in the mask
_FILLED = 0.25  # of the mask is wrong
_LARGEST = 0.7  # of the picture: a mask that says something


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
            if within >= _WITHIN * wrong.sum() and within >= _FILLED * mask.sum() and mask.mean() <= _LARGEST:
                terms.append(term)
        return terms


_MAX = 2
_NEARLY_ALL = 0.9  # of the picture: where it is wrong says nothing


def _before(kit: BuiltKit, step: Step, picture: Picture) -> Mapping[str, Pixels]:
    """The picture of an earlier step, by what it means when it comes out of this one."""
    if step.index not in BEFORE:
        return {}
    name, earlier = BEFORE[step.index]
    return {name: Terms(kit, step.index, picture).at_step(earlier)}


_OF_VECTORS = {
    "negative": "normals-reversed",
    "red-and-blue-swapped": "axes-exchanged",
    "channels-permuted": "axes-exchanged",
}


def _name(changed: Transformed, step: Step, picture: Picture) -> str:
    """Where colours are directions, another order of the channels is another order of the axes."""
    shows_vectors = step.index == 1 or "normals" in picture.case.args
    return _OF_VECTORS.get(changed.id, changed.id) if shows_vectors else changed.id


def transformations(kit: BuiltKit, step: Step, pictures: Mapping[str, Picture]) -> Iterator[Diagnosis]:
    """Each once, with all pictures that it explains."""
    found: dict[tuple[str, str], list[str]] = {}
    for name, picture in pictures.items():
        changed = transformation_of(picture, _before(kit, step, picture))
        if changed is not None:
            found.setdefault((_name(changed, step, picture), changed.detail), []).append(name)
    for (name, detail), seen_in in sorted(found.items(), key=lambda item: -len(item[1]))[:_MAX]:
        yield in_words(name, detail, seen_in)


def findings(kit: BuiltKit, step: Step, pictures: Mapping[str, Picture]) -> Iterator[Diagnosis]:
    """Where the pictures are wrong; those with the fewest wrong pixels say most."""
    telling = sorted(pictures.items(), key=lambda item: float(item[1].wrong.mean()))
    for name, picture in telling[:_MAX]:
        terms = Terms(kit, step.index, picture).found() if picture.wrong.mean() < _NEARLY_ALL else []
        objects = object_map(kit, kit.project.root / picture.case.scene, picture.case.args)
        sentence = place_of(picture, objects, [term.where for term in terms[:2]])
        hint = terms[0].hint if terms else ""
        yield Diagnosis("finding", "where-it-is-wrong", sentence, hint=hint, seen_in=[name])
