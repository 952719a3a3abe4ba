"""Which files of the kit students get."""

import ast
import re
from collections.abc import Collection, Iterator
from pathlib import Path, PurePosixPath

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.text import join_and
from raysteps.course.manifest import Step, course_manifests
from raysteps.course.project import Project
from raysteps.course.stubs import pristine_stub
from raysteps.course.tracked_files import list_files, untracked_files
from raysteps.updater.release_list import is_made_anew

# The Python modules that a students' kit needs: all that its commands import, and nothing that knows answers.

ENTRIES = ("raysteps.__main__", "raysteps.bootstrap.start", "raysteps.cli.app")
# They know answers, formulas of the steps or the seed. A module that goes to students may import these inside of a
# function, for the case that the kit has solutions.
NEVER = (
    "raysteps.classroom",
    "raysteps.cli.demo",
    "raysteps.cli.desk",
    "raysteps.cli.export",
    "raysteps.cli.gallery",
    "raysteps.cli.grade",
    "raysteps.cli.grade_class",
    "raysteps.cli.image",
    "raysteps.cli.leaderboard",
    "raysteps.cli.learn",
    "raysteps.cli.nightly",
    "raysteps.cli.release",
    "raysteps.cli.replay",
    "raysteps.cli.similar",
    "raysteps.cli.supervise",
    "raysteps.course.mutants",
    "raysteps.course.settings",
    "raysteps.desk",
    "raysteps.diagnosis",
    "raysteps.gallery",
    "raysteps.grading.withhold",
    "raysteps.grading.pipeline",
    "raysteps.inspector.blame",
    "raysteps.inspector.divergence",
    "raysteps.inspector.lamp_differences",
    "raysteps.inspector.side_by_side",
    "raysteps.judge",
    "raysteps.release",
)
_DATA = (".json", ".css", ".js", ".j2", ".typed")


def _is_never(module: str) -> bool:
    return any(module == name or module.startswith(f"{name}.") for name in NEVER)


def _path(source: Path, module: str) -> Path | None:
    place = source.joinpath(*module.split("."))
    found = [path for path in (place.with_suffix(".py"), place / "__init__.py") if path.is_file()]
    return found[0] if found else None


def _named(node: ast.AST) -> Iterator[str]:
    """Modules, or what may be one: of `from a import b` both a and a.b; a string is one where a process is started."""
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
    elif isinstance(node, ast.ImportFrom) and node.module is not None:
        yield node.module
        yield from (f"{node.module}.{alias.name}" for alias in node.names)
    elif isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value.startswith("raysteps."):
        yield node.value


def _started(node: ast.AST, package: str) -> Iterator[str]:
    """A script beside the module that starts it, by its file name, and what that imports from beside itself."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str) and re.fullmatch(r"\w+\.py", node.value):
        yield f"{package}.{node.value.removesuffix('.py')}"
    if isinstance(node, ast.Call) and ast.unparse(node.func).endswith("import_module"):
        words = [word.value for word in node.args if isinstance(word, ast.Constant)]
        yield from (f"{package}.{word}" for word in words if isinstance(word, str))


def _imports(path: Path, package: str) -> Iterator[tuple[str, bool]]:
    """What a module names, and whether that is needed as soon as it is imported."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    inside = {
        id(node)
        for function in ast.walk(tree)
        if isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef | ast.If)
        for node in ast.walk(function)
    }
    for node in ast.walk(tree):
        at_once = isinstance(node, ast.Import | ast.ImportFrom) and id(node) not in inside
        names = [*_named(node), *_started(node, package)]
        yield from ((name, at_once) for name in names if name.startswith("raysteps"))


def needed_modules(source: Path) -> list[Path]:
    """Files below `source`, the folder that holds the package."""
    waiting, found = list(ENTRIES), dict[str, Path]()
    while waiting:
        module = waiting.pop()
        path = _path(source, module)
        if path is None or module in found:
            continue
        found[module] = path
        parent = module.rpartition(".")[0]
        waiting += [parent] if parent else []
        for name, at_once in _imports(path, module.rpartition(".")[0]):
            if not _is_never(name):
                waiting.append(name)
            elif at_once and _path(source, name) is not None:
                raise GraderFault(
                    f"{path}: imports {name}, which students do not get; expected it inside of a function"
                )
    return sorted(found.values())


def package_files(source: Path) -> list[Path]:
    """The modules, and the templates and scripts that lie in their packages."""
    modules = needed_modules(source)
    found = set(modules)
    for package in {path.parent for path in modules if path.name == "__init__.py"}:
        rooms = [package, *(room for room in package.iterdir() if room.name in ("static", "templates"))]
        for path in (path for room in rooms if room.is_dir() for path in room.iterdir()):
            if path.is_file() and path.suffix in _DATA:
                found.add(path)
    return sorted(found)


# Stand-ins for steps that a kit does not have: the framework calls their functions.

FOLDER = "framework/absent/steps"


def missing_step_stub(stub: str) -> str:
    """A stub that says what it is no part of, and not what is to do."""
    lines = [line for line in stub.splitlines() if not line.strip().startswith("// TODO:")]
    return "\n".join(lines).replace("RAYSTEPS_TODO(", "RAYSTEPS_ABSENT(") + "\n"


def missing_step_stubs(project: Project, absent: list[Step]) -> dict[str, bytes]:
    """Contract and stand-in of each, by path."""
    files: dict[str, bytes] = {}
    for step in absent:
        for header in sorted((project.steps / step.id).glob("*.hpp")):
            files[f"{FOLDER}/{step.id}/{header.name}"] = header.read_bytes()
        files[f"{FOLDER}/{step.path.as_posix()}"] = missing_step_stub(pristine_stub(project, step)).encode()
    return files


_ROOT = {
    ".clang-format",
    ".editorconfig",
    ".gitattributes",
    ".gitignore",
    "CMakeLists.txt",
    "CMakePresets.json",
    "LICENSE",
    "LICENSE-CC-BY-4.0.md",
    "raysteps",
    "raysteps.cmd",
    "raysteps.py",
}
_FOLDERS = {".devcontainer", ".vscode", "cmake", "framework", "scenes"}
_DOCS = {  # what a student looks up
    "finale.md",
    "formats.md",
    "inspect.md",
    "maps.md",
    "pages.md",
    "paper.md",
    "play.md",
    "students.md",
    "view.md",
    "watch.md",
    "where-rays-go.md",
    "where-students-work.md",
}
# The framework's own tests need a reference; the judge's worker, the boxes, the wide trees and the rays of the SPD
# answer what steps ask.
_NOT_FOR_STUDENTS = re.compile(
    r"framework/(wide/.*|io/fuzz/.*|worker/.*|remote/.*|apps/spd_report\..*|render/(any_hit(_here)?\.cpp|spd\..*)|.*_test\.cpp|absent/.*)"
)
_OF_A_STEP = re.compile(r"steps/[^/]+/(README\.md|step\.toml|[^/]+(\.hpp|_test\.cpp|\.png|\.svg))")
_OVERLAY, _WORKFLOW = "grader/src/raysteps/release/overlay", "course/github-workflow.yml"
_MAX_NAMED = 5
_SKIPPED = {"build", ".venv", ".git"}


def refuse_untracked(root: Path, files: Collection[str]) -> None:
    """Git would have none of them: notes, copies, a solution that somebody kept."""
    new = untracked_files(root)
    found = sorted(name for name in new if name in files or name == _WORKFLOW or name.startswith(f"{_OVERLAY}/"))
    if found:
        it = "it" if len(found) == 1 else "them"
        raise UsageError(
            f"{join_and(found[:_MAX_NAMED])}: would go out, but git does not know {it}; `git add` what belongs to the "
            "kit, and take away the rest"
        )


def _is_made(place: PurePosixPath) -> bool:
    """By setting up and trying a kit, wherever it lies."""
    return is_made_anew(place.as_posix()) or not _SKIPPED.isdisjoint(place.parts)


def _belongs(place: PurePosixPath, steps: Collection[str]) -> bool:
    name, first = place.as_posix(), place.parts[0]
    if len(place.parts) == 1:
        return name in _ROOT
    if _NOT_FOR_STUDENTS.fullmatch(name):
        return False
    if first == "steps":
        return place.parts[1] in steps and _OF_A_STEP.fullmatch(name) is not None
    return first in _FOLDERS or (first == "docs" and len(place.parts) == 2 and place.name in _DOCS)


def _readable(path: Path) -> bytes:
    if path.is_symlink():
        raise GraderFault(f"{path}: is a link; expected a file of the kit itself")
    return path.read_bytes()


def _overlay(folder: Path) -> dict[str, bytes]:
    """Files that only a students' kit has, such as its workflow."""
    files = [path for path in sorted(folder.rglob("*")) if path.is_file()]
    named = {path.relative_to(folder): path for path in files}
    return {place.as_posix(): _readable(path) for place, path in named.items() if not _is_made(PurePosixPath(place))}


def kit_contents(project: Project, steps: list[Step], absent: list[Step]) -> dict[str, bytes]:
    """Files by path, without those that are made: pictures, README and the list of all files."""
    chosen = {step.id for step in steps}
    known = [place for place in list_files(project.root) if not _is_made(place)]
    files = {
        place.as_posix(): _readable(project.root / place)
        for place in known
        if _belongs(place, chosen) and (project.root / place).is_file()
    }
    source = project.root / "grader" / "src"
    files |= {f"grader/src/{path.relative_to(source).as_posix()}": _readable(path) for path in package_files(source)}
    for step in steps:
        stub = pristine_stub(project, step).encode()
        files[f"steps/{step.path.as_posix()}"] = files[f"grader/stubs/{step.path.as_posix()}"] = stub
    files |= {name: data for name, data in course_manifests(project).items() if name in files}
    files |= missing_step_stubs(project, absent)
    workflow = project.root / _WORKFLOW
    if workflow.is_file():
        files[".github/workflows/check.yml"] = _readable(workflow)
    return files | _overlay(project.root / _OVERLAY)
