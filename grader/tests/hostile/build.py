"""Reads the corpus and lays one attack out as a submission."""

import re
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from hostile.folders import FOLDERS
from hostile.parts import BOTH_FUNCTIONS, PARTS
from hostile.tars import TARS
from hostile.zips import ZIPS

CORPUS = Path(__file__).parent
_PLACE = re.compile(r"@([A-Z_]+)@")
_RIGHT_IF = re.compile(r"^@RIGHT_IF\((.*)\)@$", re.M)


@dataclass(frozen=True)
class Attack:
    """One folder of the corpus, as its entry.toml describes it."""

    name: str
    numbers: list[int]  # of the kinds that docs/hostile.md lists
    title: str
    tries: str
    step: str = "07-tone-mapping"  # under attack
    most: float = 0.0  # points that the step may earn
    least: float = 0.0
    status: list[str] = field(default_factory=list)  # that the step may have; any when there are none
    honest: list[str] = field(default_factory=list)  # steps beside it, complete, which keep all their points
    beside: list[str] = field(default_factory=list)  # complete steps that are taken in, but not graded
    secret: bool = False  # it tries to read the planted secret
    note: str = ""  # words that must be among the step's messages
    refused: str = ""  # words of the UsageError with which the submission is not taken in
    submission: str = ""  # the name that the results must have
    outside: bool = False  # it does no harm without a sandbox either, and earns points there
    rounds: int = 1  # how often it is graded, one after the other
    made_by: str = ""  # a function of folders.py, zips.py or tars.py
    limits: dict[str, float] = field(default_factory=dict)
    files: dict[str, str] = field(default_factory=dict)  # more files beside the sources

    @property
    def folder(self) -> Path:
        return CORPUS / self.name


def read_attack(folder: Path) -> Attack:
    return Attack(folder.name, **tomllib.loads((folder / "entry.toml").read_text(encoding="utf-8")))


def read_corpus() -> list[Attack]:
    return [read_attack(path.parent) for path in sorted(CORPUS.glob("[0-9][0-9]-*/entry.toml"))]


Facts = Mapping[str, str | Callable[[], str]]


def fill_in(text: str, facts: Facts) -> str:
    """Replaces @NAME@ by a part that several attacks share, or by what this machine and this run are like."""

    def fact(found: re.Match[str]) -> str:
        value = PARTS.get(found[1]) or facts.get(found[1])
        return found[0] if value is None else value if isinstance(value, str) else value()

    def both(found: re.Match[str]) -> str:
        return BOTH_FUNCTIONS.replace("CONDITION", found[1])

    return _PLACE.sub(fact, _RIGHT_IF.sub(both, text))


def sources_of(attack: Attack, facts: Facts) -> dict[str, str]:
    """Its files by path within the submission, with all facts filled in."""
    files = {
        path.relative_to(attack.folder).as_posix(): path.read_text(encoding="utf-8")
        for path in sorted(attack.folder.glob("steps/*/*.cpp"))
    }
    return {path: fill_in(text, facts) for path, text in (files | attack.files).items()}


def lay_out(attack: Attack, facts: Facts, solved: Mapping[str, str], into: Path) -> Path:
    """Makes the submission, a folder or an archive, in a new folder."""
    files = sources_of(attack, facts)
    for step in (*attack.honest, *attack.beside):
        files[f"steps/{step}/{step[3:].replace('-', '_')}.cpp"] = solved[step]
    folder = into / (attack.submission or "submission")
    for path, text in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text, encoding="utf-8")
    if not attack.made_by:
        return folder
    make = (FOLDERS | ZIPS | TARS)[attack.made_by]
    return make(folder, {name: value for name, value in facts.items() if isinstance(value, str)})
