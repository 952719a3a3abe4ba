"""What can be said of a wrong picture that no known mistake explains."""

from collections.abc import Iterator, Mapping

from raysteps.diagnosis.evidence import Picture
from raysteps.diagnosis.objects import object_map
from raysteps.diagnosis.places import place_of
from raysteps.diagnosis.terms import Terms
from raysteps.diagnosis.transformation_words import BEFORE, in_words
from raysteps.diagnosis.transformations import Changed, transformation_of
from raysteps.kit.built_kit import BuiltKit
from raysteps.kit.manifest import Step
from raysteps.programs.pictures import Pixels
from raysteps.results.model import Diagnosis

_MOST = 2
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


def _name(changed: Changed, step: Step, picture: Picture) -> str:
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
    for (name, detail), seen_in in sorted(found.items(), key=lambda item: -len(item[1]))[:_MOST]:
        yield in_words(name, detail, seen_in)


def findings(kit: BuiltKit, step: Step, pictures: Mapping[str, Picture]) -> Iterator[Diagnosis]:
    """Where the pictures are wrong; those with the fewest wrong pixels say most."""
    telling = sorted(pictures.items(), key=lambda item: float(item[1].wrong.mean()))
    for name, picture in telling[:_MOST]:
        terms = Terms(kit, step.index, picture).found() if picture.wrong.mean() < _NEARLY_ALL else []
        objects = object_map(kit, kit.project.root / picture.case.scene, picture.case.args)
        sentence = place_of(picture, objects, [term.where for term in terms[:2]])
        hint = terms[0].hint if terms else ""
        yield Diagnosis("finding", "where-it-is-wrong", sentence, hint=hint, seen_in=[name])
