"""What must not be in a release: solutions, other correct ways, known mistakes, hidden cases and their judge."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from raysteps.kit.course import USUAL_SEED, read_course
from raysteps.kit.cpp_tokens import tokens
from raysteps.kit.manifest import read_all_steps
from raysteps.kit.project import Project
from raysteps.kit.stubs import pristine_stub
from raysteps.release.leaks.shared import Shared, read_shared
from raysteps.release.leaks.sources import (
    hidden_cases,
    judge_modules,
    mistakes,
    own_judges,
    public_names,
    solution_code,
)
from raysteps.release.leaks.words import Sequences, Word, code_words, plain_words

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

    sequences: Sequences
    names: dict[str, str]  # and where they come from
    seed: str | None

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


def gather(project: Project, shared: Sequence[Shared] | None = None) -> Secrets:
    """Less what the stubs themselves have, and the few things that shared.toml names. Nothing else is public: no file
    is forgiven because it is meant to go out."""
    secret = Sequences()
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
    for one in read_shared() if shared is None else shared:
        secret.allow(one.words)
    seed = read_course(project).seed
    return Secrets(secret, _helpers(project), None if seed in (None, USUAL_SEED) else str(seed))
