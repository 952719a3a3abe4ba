"""What must not be in a release: solutions, other correct ways, known mistakes and hidden cases."""

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from raysteps.kit.cpp_tokens import tokens
from raysteps.kit.manifest import read_all_steps, read_steps
from raysteps.kit.project import Project
from raysteps.kit.stubs import pristine_stub, solution_regions
from raysteps.release.contents import kit_contents
from raysteps.release.leaks.words import Sequences, code_words, plain_words

# Words in a row. The framework of the kit itself has a phrase or two in common with solutions, as how a record of a hit
# is filled in; nobody else writes so many words alike by chance, and not even the framework may share a whole passage.
_PHRASE, _LEAST_OF_A_PHRASE = 16, 10
_PASSAGE, _LEAST_OF_A_PASSAGE = 32, 16
_FRAGMENT, _LEAST_OF_A_FRAGMENT = 12, 9
_LEAST_OF_A_CASE = 5
_NAME = re.compile(r"[A-Za-z_]\w{5,}")


@dataclass(frozen=True)
class Secrets:
    """Sequences of words, and names of helpers that only solutions have."""

    sequences: Sequences
    names: dict[str, str]  # and where they come from


def _texts(project: Project, pattern: str) -> Iterator[tuple[str, str]]:
    for path in sorted(project.solutions.glob(pattern)):
        yield path.relative_to(project.root).as_posix(), path.read_text(encoding="utf-8")


def _solution_code(project: Project) -> Iterator[tuple[str, str]]:
    """Regions by where they stand, and whole files that are alternatives or tell how the judge asks."""
    for step in read_all_steps(project):
        name = f"solutions/{step.path.as_posix()}"
        for region in solution_regions((project.root / name).read_text(encoding="utf-8")):
            yield f"{name}:{region.line} ({region.name or 'a helper'})", "\n".join(region.body)
    yield from _texts(project, "*/alternatives/*.cpp")
    yield from _texts(project, "*/worker.cpp")


def _strings(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for part in value.values():
            yield from _strings(part)
    elif isinstance(value, list):
        for part in value:
            yield from _strings(part)


def _public(project: Project) -> Iterator[str]:
    """What every student may read: stubs, contracts, handouts, manifests with their hints, and visible tests."""
    for step in read_steps(project):
        yield from (
            path.read_text(encoding="utf-8", errors="replace")
            for path in sorted((project.steps / step.id).iterdir())
            if path.suffix in (".hpp", ".md", ".toml") or path.name.endswith("_test.cpp")
        )
        yield pristine_stub(project, step)


def _shipped(project: Project) -> Iterator[str]:
    """What the kit itself gives out; scenes are numbers only."""
    for name, data in kit_contents(project, read_steps(project), []).items():
        if b"\0" not in data and not name.endswith((".nff", ".svg")):
            yield data.decode("utf-8", "replace")


def _helpers(project: Project, public: set[str]) -> dict[str, str]:
    """Functions and types that only solutions have; not those of a library."""
    found: dict[str, str] = {}
    for origin, source in _solution_code(project):
        code = tokens(source)
        for before, name, following in zip(["", *code], code, [*code[1:], ""], strict=False):
            if following in ("(", "{") and before not in (":", ".") and _NAME.fullmatch(name) and name not in public:
                found.setdefault(name, origin)
    return found


def gather(project: Project) -> Secrets:
    """From solutions/, less what is public."""
    phrases, passages = Sequences(), Sequences()
    for origin, source in _solution_code(project):
        words = code_words(source)
        phrases.add(words, origin, _PHRASE, _LEAST_OF_A_PHRASE)
        passages.add(words, origin, _PASSAGE, _LEAST_OF_A_PASSAGE)
    for origin, text in _texts(project, "*/mutants.toml"):
        for fragment in _strings(tomllib.loads(text)):
            phrases.add(plain_words(fragment), origin, _FRAGMENT, _LEAST_OF_A_FRAGMENT)
    for origin, text in _texts(project, "*/cases.toml"):
        for line in text.splitlines():
            if line.startswith('"'):
                phrases.add(plain_words(line), origin, _FRAGMENT, _LEAST_OF_A_CASE)
    for origin, text in _texts(project, "*/judge.py"):
        phrases.add(plain_words(text), origin, _FRAGMENT, _LEAST_OF_A_FRAGMENT)
    for text in _public(project):
        phrases.allow(text)
        passages.allow(text)
    shipped = list(_shipped(project))
    for text in shipped:
        phrases.allow(text)
    phrases.join(passages)
    return Secrets(phrases, _helpers(project, {word for text in shipped for word in re.findall(r"\w+", text)}))
