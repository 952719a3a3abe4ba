"""Where things are in the repository, and in which state it is."""

import hashlib
import re
import sys
from collections.abc import Collection, Iterator
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


# One state of the kit and another: folders, and which of their files count. What an editor leaves beside them does not,
# nor do a student's own steps, nor the packages that change no grade.
_NO_GRADE = "bootstrap|cli|exports|gallery|inspector|progress|release|report|updater|watch"
_SOURCES = {
    "framework": r".*\.(hpp|cpp|cmake|txt)",
    "cmake": r".*\.cmake",
    "scenes": r".*\.(nff|pbrt|py)",
    "solutions": r"[0-9]{2}-[a-z0-9-]+/[a-z_]+\.(cpp|toml|py)",
    "steps": r"[0-9]{2}-[a-z0-9-]+/(step\.toml|\w+\.hpp|\w+_test\.cpp)",
    "grader/stubs": r".*\.cpp",
    "reference": r".*\.(png|json)",
    "grader/src": rf"raysteps/(?!({_NO_GRADE})/).*\.(py|json)",
}
PROGRAM_FOLDERS = ("framework", "cmake", "scenes", "solutions", "steps")  # what programs are built from


def kit_files(project: Project, folders: Collection[str] = tuple(_SOURCES)) -> Iterator[Path]:
    """Those in these folders that count."""
    for name in folders:
        folder, pattern = project.root / name, _SOURCES[name]
        for path in sorted(folder.rglob("*")):
            counts = re.fullmatch(pattern, path.relative_to(folder).as_posix()) and not path.name.startswith(".")
            if counts and path.is_file():
                yield path


def fingerprint(project: Project) -> str:
    """Changes with everything that a grade depends on in the repository; not with a student's own steps."""
    digest = hashlib.sha256()
    for path in (project.root / "CMakeLists.txt", project.root / "CMakePresets.json", *kit_files(project)):
        data = path.read_bytes()
        digest.update(f"{path.relative_to(project.root).as_posix()}\0{len(data)}\0".encode())
        digest.update(data)
    return digest.hexdigest()[:16]
