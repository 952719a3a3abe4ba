"""What files of a students' kit have in common with something secret, and may: each is named in shared.toml."""

import tomllib
from dataclasses import dataclass
from importlib.resources import files

from raysteps.common.errors import GraderFault

FILE = "grader/src/raysteps/release/leaks/shared.toml"


@dataclass(frozen=True)
class Shared:
    """Words that somebody found to be no secret, the files that have them, and what they are like."""

    files: tuple[str, ...]
    origin: str
    words: str


def read_shared() -> list[Shared]:
    """A list that is not well formed is the kit's fault."""
    try:
        table = tomllib.loads(files(__package__).joinpath("shared.toml").read_text(encoding="utf-8"))
        return [Shared(tuple(one["files"]), str(one["origin"]), str(one["words"])) for one in table["shared"]]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise GraderFault(f"{FILE}: expected [[shared]] with files, origin and words: {error}") from error
