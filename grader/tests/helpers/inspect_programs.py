"""Programs in which one step holds a known mistake, linked from what CMake built."""

from dataclasses import dataclass
from pathlib import Path

from raysteps.common.process import run
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.toolchain.cmake import BuildTree, release_tree, what_failed
from raysteps.toolchain.link import Description, read_description

_TARGETS = ["inspect-reference", "raytrace-reference"]
_SECONDS = 300


@dataclass(frozen=True)
class Workshop:
    """Links inspect and raytrace with any source for one step, and the reference's for all others."""

    tree: BuildTree
    description: Description
    folder: Path

    def compile(self, step: Step, source: str, name: str) -> Path:
        """An object of the step."""
        root = self.tree.project.root
        file, built = self.folder / f"{name}.cpp", self.folder / f"{name}.o"
        file.write_text(source, encoding="utf-8")
        words: list[str | Path] = [self.description.compiler, *self.description.compile_flags, "-O1", "-w"]
        words += ["-I", root, "-I", root / "framework"]
        for include in self.description.more_includes:
            words += ["-isystem", include]
        outcome = run([*words, "-c", file, "-o", built], seconds=_SECONDS)
        assert outcome.code == 0, outcome.stderr
        return built

    def _objects(self, target: str) -> list[Path]:
        objects = self.tree.folder / "framework" / "CMakeFiles" / f"{target}.dir"
        return sorted(path for path in objects.rglob("*") if path.suffix in (".o", ".obj"))

    def link(self, kind: str, step: Step, built: Path, name: str) -> Path:
        """kind: inspect or raytrace."""
        parts = self._objects(f"{kind}-app")
        if kind == "inspect":
            parts += [*self._objects("raysteps-inspect-recorded"), self.tree.folder / "framework/libraysteps-inspect.a"]
        parts += [path for number, path in self.description.steps.items() if number != step.number]
        parts += [self.description.libraries[library] for library in ("render", "io", "core")]
        program = self.folder / f"{kind}-{name}"
        words: list[str | Path] = [self.description.compiler, built, *parts, *self.description.link_flags]
        outcome = run([*words, "-o", program], seconds=_SECONDS)
        assert outcome.code == 0, outcome.stderr
        return program

    def reference(self, kind: str) -> Path:
        return self.tree.program(f"{kind}-reference")


def open_workshop(project: Project, folder: Path) -> Workshop:
    tree = release_tree(project)
    with tree.locked():
        outcome = tree.build(_TARGETS)
    assert outcome.code == 0, what_failed(outcome)
    return Workshop(tree, read_description(tree.folder / "kit.json"), folder)
