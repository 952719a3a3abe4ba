"""Where things are in the repository."""

import sys
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import GraderFault


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


# Scenes that the generator makes when they are needed.


def is_of_part_two(scene: Path) -> bool:
    """Whether it is in pbrt's format: NFF knows what part one draws."""
    return scene.suffix.lower() == ".pbrt"


def generated(project: Project, kind: str, size: int) -> Path:
    """The generated scene of that kind and size, made once."""
    path = project.build / "scenes" / f"{kind}-{size}.nff"
    if not path.is_file():
        from raysteps.common.process import run  # rarely, and it takes long to load

        path.parent.mkdir(parents=True, exist_ok=True)
        script = project.scenes / "generate.py"
        outcome = run([sys.executable, script, kind, "--size", str(size), "-o", path], seconds=300)
        if outcome.code != 0:
            raise GraderFault(f"the scene {kind} cannot be made: {outcome.stderr.strip()}")
    return path
