"""The kit as it grades: framework, references and tests, built once and only read from then on."""

import json
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from raysteps.common.platform import executable
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.toolchain.box import BoxLinker
from raysteps.toolchain.link import Description, library_name

Kind = Literal["raytrace", "worker", "test"]
ProgressCallback = Callable[[str], None]
Tags = Mapping[str, Mapping[str, frozenset[str]]]


@dataclass(frozen=True)
class BuiltKit:
    """Lives in build/kit/FINGERPRINT. `tests` holds each step's visible test cases with their tags."""

    project: Project
    folder: Path
    fingerprint: str
    steps: list[Step]
    description: Description
    tests: Tags
    interpreter: str | None  # the dynamic loader of this system; none where steps are no libraries

    @property
    def include(self) -> Path:
        """The headers that a student's file may include: core/ and the steps' contracts."""
        return self.folder / "include"

    @property
    def pictures(self) -> Path:
        """Pictures of the reference, kept from run to run."""
        return self.folder / "pictures"

    @property
    def has_reference(self) -> bool:
        """In a students' kit stubs stand where the reference's steps would."""
        return self.project.has_reference

    @property
    def answers(self) -> Path:
        """Answers of the reference to the judge, kept from run to run."""
        return self.folder / "answers"

    def reference(self, kind: Kind, step: Step | None = None) -> Path:
        """A program in which every step is the reference's."""
        return executable(self.folder / "bin" / (f"test-{step.number}" if step is not None else kind))

    def functions(self, step: Step) -> dict[str, str]:
        """Linker names of the step's functions, and how C++ writes them; empty where steps are no libraries."""
        path = self.folder / "steps" / f"{step.number}.names.json"
        names: dict[str, str] = json.loads(path.read_text("utf-8")) if path.is_file() else {}
        return names

    def exports(self, step: Step) -> Path:
        """The linker's version script with the names of the functions."""
        return self.folder / "steps" / f"{step.number}.map"

    def known(self) -> frozenset[str]:
        """All names of the kit."""
        return frozenset(json.loads((self.folder / "steps" / "known.json").read_text(encoding="utf-8")))

    def allowed(self, step: Step) -> frozenset[str]:
        """The kit's names that the step may ask for: core's, and the functions of steps up to it."""
        names = json.loads((self.folder / "steps" / f"{step.number}.allowed.json").read_text(encoding="utf-8"))
        return frozenset(names)

    def boxes(self, steps: Collection[Step]) -> BoxLinker | None:
        """What asks these steps in another process; none where programs load them."""
        boxes = BoxLinker(self.folder, self.description) if self.description.remote is not None else None
        return boxes if boxes is not None and all(boxes.can_be_asked(step.number) for step in steps) else None

    def program(self, kind: Kind, step: Step, *, together: bool = False) -> Path:
        """A program that lacks the student's library of this step (`together`: of all up to it)."""
        return self.folder / "bin" / f"{kind}-{'cumulative' if together else 'isolated'}-{step.number}"

    def reference_step(self, step: Step) -> Path:
        """The reference's step as a submission's is built: a library, or elsewhere an object."""
        library = self.folder / "steps" / library_name(step.number)
        return library if library.is_file() else self.folder / "steps" / f"{step.number}.o"

    def rest(self, kind: Kind, step: Step, *, together: bool = False) -> list[Path]:
        """Where steps are no libraries: all that a program is linked from beside the student's objects."""
        name = self.program(kind, step, together=together).name
        return [self.folder / line for line in (self.folder / "rest" / f"{name}.txt").read_text("utf-8").splitlines()]
