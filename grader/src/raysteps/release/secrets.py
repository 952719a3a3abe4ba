"""What must not be in a release: solutions, other correct ways, known mistakes, hidden cases and their judge."""

import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path

from raysteps.common.errors import GraderFault, reason
from raysteps.course.manifest import read_all_steps
from raysteps.course.project import Project
from raysteps.course.settings import USUAL_SEED, read_course
from raysteps.course.stubs import pristine_stub, solution_regions, tokens
from raysteps.release.page_parts import mangled

# What the kit keeps to itself, text by text, and from where each is.

Texts = Iterator[tuple[str, str]]

_IMPORT = re.compile(r"^(?:from|import) (?:[^(\n]*\([^)]*\)|.*)$", re.M)


def _files(project: Project, folder: Path, pattern: str) -> Texts:
    for path in sorted(folder.glob(pattern)):
        yield path.relative_to(project.root).as_posix(), path.read_text(encoding="utf-8")


def solution_code(project: Project) -> Texts:
    """Regions by where they stand, and whole files that are alternatives or tell how the judge asks."""
    for step in read_all_steps(project):
        name = f"solutions/{step.path.as_posix()}"
        for region in solution_regions((project.root / name).read_text(encoding="utf-8"), name):
            yield f"{name}:{region.line} ({region.name or 'a helper'})", "\n".join(region.body)
    yield from _files(project, project.solutions, "*/alternatives/*.cpp")
    yield from _files(project, project.solutions, "*/worker.cpp")


def _strings(value: object) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for part in value.values():
            yield from _strings(part)
    elif isinstance(value, list):
        for part in value:
            yield from _strings(part)


def mistakes(project: Project) -> Texts:
    """The texts of the known mistakes, and the code before and after."""
    for origin, text in _files(project, project.solutions, "*/mutants.toml"):
        tables = tomllib.loads(text)["mutants"]  # an id is the name of a picture, too, and says nothing
        yield from (
            (origin, part) for one in tables for key, value in one.items() if key != "id" for part in _strings(value)
        )


def hidden_cases(project: Project) -> Texts:
    """The kinds of cases and how many there are, line by line."""
    for origin, text in _files(project, project.solutions, "*/cases.toml"):
        yield from ((origin, line) for line in text.splitlines() if line.startswith('"'))


def own_judges(project: Project) -> Texts:
    """Those of steps that an instructor added."""
    yield from _files(project, project.solutions, "*/judge.py")


def judge_modules(project: Project) -> Texts:
    """What draws the hidden cases and knows the answers, without its imports: they are like those of any module."""
    package = project.root / "grader" / "src" / "raysteps"
    for pattern in ("judge/**/*.py", "inspector/blame.py"):
        for origin, text in _files(project, package, pattern):
            yield origin, _IMPORT.sub("", text)


def public_names(project: Project) -> set[str]:
    """Names in what students include: nobody who uses them has seen a solution."""
    texts = [pristine_stub(project, step) for step in read_all_steps(project)]
    rooms = (project.steps.glob("*/*.hpp"), (project.root / "framework").rglob("*.?pp"))
    texts += [path.read_text(encoding="utf-8", errors="replace") for room in rooms for path in room]
    return {word for text in texts for word in re.findall(r"\w+", text)}


# Takes text apart into words and signs, whatever it is written in, and finds sequences of them again.

SHORTEST = 5  # words of a sequence that can be looked for
_WORD = re.compile(r"[^\W\d]\w*|\d[\w.]*|::|->|&&|\|\||[-+*/<>=!]=|\+\+|--|\n|\S")
_COMMENT_MARK = re.compile(r"//+!?|/\*+|\*/|^[ \t]*(?:\*|#|>)(?=[ \t])", re.M)
_ESCAPED = re.compile(r"\\+[nrt]|\\+(?=[\"'])")

Words = tuple[str, ...]


@dataclass(frozen=True)
class Word:
    """And the line that it stands in."""

    text: str
    line: int


def words_in(text: str) -> list[Word]:
    """All words: code in a comment, in a JSON string or quoted in a page is code, too."""
    plain = _COMMENT_MARK.sub(" ", _ESCAPED.sub(" ", text))
    found, line = [], 1
    for match in _WORD.finditer(plain):
        if match[0] == "\n":
            line += 1
        else:
            found.append(Word(match[0], line))
    return found


def code_words(source: str) -> Words:
    """Of C++, without its comments and what it includes."""
    plain = re.sub(r"^\s*#.*", "", source, flags=re.M)
    return tuple(word.text for word in words_in(" ".join(tokens(plain))))


def plain_words(text: str) -> Words:
    return tuple(word.text for word in words_in(text))


@dataclass
class NgramIndex:
    """Sequences of words, each with where it comes from."""

    by_start: dict[Words, dict[Words, str]] = field(default_factory=dict)

    def add(self, words: Words, origin: str, length: int, shortest: int) -> None:
        """All parts of that length; of something shorter the whole, unless it is too short to say anything."""
        if len(words) < max(shortest, SHORTEST):
            return
        for at in range(max(1, len(words) - length + 1)):
            part = words[at : at + length]
            self.by_start.setdefault(part[:SHORTEST], {}).setdefault(part, origin)

    def matches(self, words: Sequence[Word]) -> Iterator[tuple[Word, Words, str]]:
        """Where sequences begin, which ones, and where they come from."""
        texts = tuple(word.text for word in words)
        for at in range(len(texts) - SHORTEST + 1):
            candidates = self.by_start.get(texts[at : at + SHORTEST])
            if candidates is None:
                continue
            for sequence, origin in candidates.items():
                if texts[at : at + len(sequence)] == sequence:
                    yield words[at], sequence, origin

    def join(self, other: "NgramIndex") -> None:
        """Those of both."""
        for start, sequences in other.by_start.items():
            self.by_start.setdefault(start, {}).update(sequences)

    def allow(self, text: str) -> None:
        """What stands in a text that everybody may read is no secret."""
        for _, sequence, _ in list(self.matches(words_in(text))):
            self.by_start[sequence[:SHORTEST]].pop(sequence, None)


# What files of a students' kit have in common with something secret, and may: each is named in shared.toml.

FILE = "grader/src/raysteps/release/shared.toml"


@dataclass(frozen=True)
class AllowedWords:
    """Words that somebody found to be no secret, the files that have them, and what they are like."""

    files: tuple[str, ...]
    origin: str
    words: str


def read_allowlist() -> list[AllowedWords]:
    """A list that is not well formed is the kit's fault."""
    try:
        table = tomllib.loads(files(__package__).joinpath("shared.toml").read_text(encoding="utf-8"))
        return [AllowedWords(tuple(one["files"]), str(one["origin"]), str(one["words"])) for one in table["shared"]]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise GraderFault(f"{FILE}: expected [[shared]] with files, origin and words: {reason(error)}") from error


# Words in a row, and how many a text must have to say anything by itself. Nobody writes so many alike by chance.
_CODE, _LEAST_OF_CODE = 16, 10
_TEXT, _LEAST_OF_TEXT = 16, 9
_JUDGE, _LEAST_OF_A_CASE = 12, 5
_MODULE, _LEAST_OF_A_MODULE = 24, 16
_NAME = re.compile(r"[A-Za-z_]\w{5,}")
_NEAR = 3  # words between `seed` and its number


@dataclass(frozen=True)
class Secrets:
    """Sequences of words, names of helpers that only solutions have, and what hidden cases are drawn from."""

    sequences: NgramIndex
    names: dict[str, str]  # and where they come from
    seed: str | None
    functions: Mapping[str, str] = field(default_factory=dict)  # of the steps, by their names in objects

    def tells_seed(self, words: Sequence[Word]) -> Word | None:
        """The word that is the seed, where it is called so."""
        for at, word in enumerate(words):
            if word.text == self.seed and any("seed" in one.text.lower() for one in words[max(0, at - 1 - _NEAR) : at]):
                return word
        return None


def _helpers(project: Project) -> dict[str, str]:
    """Functions and types that only solutions have; not those of a library."""
    public, found = public_names(project), dict[str, str]()
    for origin, source in solution_code(project):
        code = tokens(source)
        for before, name, following in zip(["", *code], code, [*code[1:], ""], strict=False):
            if following in ("(", "{") and before not in (":", ".") and _NAME.fullmatch(name) and name not in public:
                found.setdefault(name, origin)
    return found


def gather(project: Project, shared: Sequence[AllowedWords] | None = None) -> Secrets:
    """Less what the stubs themselves have, and the few things that shared.toml names. Nothing else is public: no file
    is forgiven because it is meant to go out."""
    secret = NgramIndex()
    for origin, source in solution_code(project):
        secret.add(code_words(source), origin, _CODE, _LEAST_OF_CODE)
    for origin, text in mistakes(project):
        secret.add(plain_words(text), origin, _TEXT, _LEAST_OF_TEXT)
    for origin, text in (*hidden_cases(project), *own_judges(project)):
        secret.add(plain_words(text), origin, _JUDGE, _LEAST_OF_A_CASE)
    for origin, source in judge_modules(project):
        secret.add(plain_words(source), origin, _MODULE, _LEAST_OF_A_MODULE)
    for step in read_all_steps(project):
        secret.allow(pristine_stub(project, step))
    for one in read_allowlist() if shared is None else shared:
        secret.allow(one.words)
    seed = read_course(project).seed
    functions = {mangled(name): name for step in read_all_steps(project) for name in step.functions}
    return Secrets(secret, _helpers(project), None if seed in (None, USUAL_SEED) else str(seed), functions)
