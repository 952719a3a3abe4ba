"""Where things are in the repository."""

import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from raysteps.common.errors import GraderFault
from raysteps.common.process import run


@dataclass(frozen=True)
class Project:
    """The repository that a command works in."""

    root: Path

    @property
    def steps(self) -> Path:
        return self.root / "steps"

    @property
    def solutions(self) -> Path:
        return self.root / "solutions"

    @property
    def scenes(self) -> Path:
        return self.root / "scenes"

    @property
    def samples(self) -> Path:
        return self.root / "grader" / "samples"

    @property
    def stubs(self) -> Path:
        """In a students' kit: the stubs once more, because those in steps/ are written over."""
        return self.root / "grader" / "stubs"

    @property
    def given(self) -> Path:
        """In a students' kit: the reference's pictures, and the names of its tests."""
        return self.root / "reference"

    @property
    def has_reference(self) -> bool:
        """A students' kit has no solutions."""
        return self.solutions.is_dir()

    @property
    def build(self) -> Path:
        return self.root / "build"


def here() -> Project:
    """The repository that this package is installed from (the install is editable)."""
    return Project(Path(__file__).resolve().parents[4])


# Which files of the kit git knows; without git, all that lie there.

_SECONDS = 60
_MAX_OUTPUT = 16 << 20


def _listed(root: Path, *which: str) -> list[PurePosixPath] | None:
    if not (root / ".git").exists():
        return None
    command: list[str | Path] = ["git", "-C", root, "ls-files", "-z", "--exclude-standard", *which]
    try:
        outcome = run(command, seconds=_SECONDS, cap=_MAX_OUTPUT)
    except OSError:
        return None
    if outcome.code != 0:
        return None
    return [PurePosixPath(name) for name in outcome.stdout.split("\0") if name]


def places(root: Path, folders: Iterable[str] = (".",)) -> list[PurePosixPath]:
    """What git tracks, and new files that it does not ignore; without git, files and folders in these folders."""
    listed = _listed(root, "--cached", "--others")
    if listed is not None:
        return listed
    found = [path for folder in folders for path in (root / folder).rglob("*")]
    return [PurePosixPath(path.relative_to(root).as_posix()) for path in found]


def untracked(root: Path) -> set[str]:
    """New files that git does not ignore; none where there is no git."""
    return {place.as_posix() for place in _listed(root, "--others") or ()}


# Scenes that the generator makes when they are needed.


def generated(project: Project, kind: str, size: int) -> Path:
    """The generated scene of that kind and size, made once."""
    path = project.build / "scenes" / f"{kind}-{size}.nff"
    if not path.is_file():
        path.parent.mkdir(parents=True, exist_ok=True)
        script = project.scenes / "generate.py"
        outcome = run([sys.executable, script, kind, "--size", str(size), "-o", path], seconds=300)
        if outcome.code != 0:
            raise GraderFault(f"the scene {kind} cannot be made: {outcome.stderr.strip()}")
    return path
