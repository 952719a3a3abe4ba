"""Which part of the light the wrong pixels have in common: the masks where pictures of neighbouring steps differ."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from raysteps.diagnosis.evidence import Mask, Picture, differing
from raysteps.diagnosis.objects import read_scene, render_text, size_of, without_highlights
from raysteps.kit.built_kit import BuiltKit
from raysteps.programs.pictures import Pixels
from raysteps.programs.rendering import reference_picture

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
        self._rest = self._without_step(picture.case.args)

    @staticmethod
    def _without_step(args: tuple[str, ...]) -> tuple[str, ...]:
        at = args.index("--step") if "--step" in args else len(args)
        return (*args[:at], *args[at + 2 :])

    def at_step(self, step: int) -> Pixels:
        """The same picture with what an earlier step can do."""
        return reference_picture(self._kit, self._scene, ("--step", str(step), *self._rest))

    def _between(self, step: int) -> Mask:
        return differing(self.at_step(step - 1), self.at_step(step))

    def _highlights(self) -> Mask:
        args = ("--step", "3", *size_of(self._picture.case.args))
        shiny = reference_picture(self._kit, self._scene, args)
        return differing(shiny, render_text(self._kit, without_highlights(read_scene(self._scene)), args))

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
        """Those that hold nearly all wrong pixels; what the step itself adds comes first."""
        wrong = self._picture.wrong
        terms = []
        for least, term, make in self._masks():
            if self._step < least:
                continue
            mask = make()
            within = int((wrong & mask).sum())
            if within >= _WITHIN * wrong.sum() and within >= _FILLED * mask.sum() and mask.mean() <= _LARGEST:
                terms.append(term)
        return terms
