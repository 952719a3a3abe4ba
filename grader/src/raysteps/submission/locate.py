"""Where the files of a submission are expected, and which names are close to an expected one."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

from raysteps.course.manifest import Step

_BARE = 2
_MAX_NAME = 255  # letters; no system has longer names, but an archive may
_ENDINGS = (".txt", ".bak", ".orig", "~", ".cpp", ".cc", ".cxx", ".c++", ".cp", ".c")
_WORDS_OF_COPIES = re.compile(r"\b(?:copy|kopie|copia|copie|of|von|de|final|new|old|v)\b")


@dataclass(frozen=True)
class Place:
    """An accepted place of a step's file; the lower rank is the more explicit place."""

    step: str
    rank: int
    exact: bool  # not only but for upper and lower case
    home: str = ""  # the top folder that it lies below
    form: int = 0  # 0 steps/step/file, 1 step/file, 2 file


def _lower(text: str) -> str:
    """In ASCII only: other alphabets have letters whose lower case is an ASCII letter."""
    return "".join(chr(ord(letter) + 32) if "A" <= letter <= "Z" else letter for letter in text)


def _plain(name: str) -> str:
    """Only what tells one step's file from another's: no ending, numbers, separators, signs of a copy, plural."""
    name = _lower(name)
    while name.endswith(_ENDINGS):
        name = name.removesuffix(next(ending for ending in _ENDINGS if name.endswith(ending)))
    name = _WORDS_OF_COPIES.sub(" ", re.sub(r"[\W\d_]+", " ", name))
    return name.replace(" ", "").rstrip("s")


class Places:
    """All accepted places of all steps."""

    def __init__(self, steps: list[Step]) -> None:
        self._wanted: dict[tuple[str, ...], tuple[int, str]] = {}
        self._plain = {_plain(step.file): step.id for step in steps}
        for step in steps:
            self._wanted["steps", step.id, step.file] = (0, step.id)
            self._wanted[step.id, step.file] = (1, step.id)
            self._wanted[(step.file,)] = (2, step.id)
        self._lower = {tuple(map(_lower, parts)): found for parts, found in self._wanted.items()}

    def find(self, parts: tuple[str, ...]) -> Place | None:
        """The place that this path is, perhaps below one single top folder."""
        for tail, below, home in ((parts, 0, ""), (parts[1:], 3, parts[0])):
            for known, worse in ((self._wanted, 0), (self._lower, 1)):
                found = known.get(tuple(map(_lower, tail)) if worse else tail)
                if found is not None:
                    return Place(found[1], 2 * (found[0] + below) + worse, worse == 0, home, found[0])
        return None

    def near(self, parts: tuple[str, ...]) -> str | None:
        """The step whose file this may be meant to be, in the wrong folder or under a wrong name."""
        if len(parts[-1]) > _MAX_NAME or not _lower(parts[-1]).endswith(_ENDINGS):
            return None
        return self._plain.get(_plain(parts[-1]))

    def below(self, folder: tuple[str, ...]) -> list[str]:
        """The steps that have an accepted place somewhere below this folder."""
        lower = tuple(map(_lower, folder))
        found = [
            step for parts, (_, step) in self._lower.items() for head in (lower, lower[1:]) if _is_head(head, parts)
        ]
        return sorted(set(found))


def unusual_places(places: Mapping[str, Place]) -> set[str]:
    """The steps that do not lie where the others do: that may be an old copy, or a name that went wrong.

    A whole submission in a folder of its own is usual; a single file in some folder says nothing about it."""
    if not places:
        return set()
    best = min(places.values(), key=lambda place: place.rank)
    usual = (best.home, best.form)
    alike = {step for step, place in places.items() if (place.home, place.form) == usual}
    if best.home and best.form == _BARE and len(alike) == 1:
        return set(places)
    return set(places) - alike


def _is_head(head: tuple[str, ...], parts: tuple[str, ...]) -> bool:
    return len(head) > 0 and parts[: len(head)] == head
