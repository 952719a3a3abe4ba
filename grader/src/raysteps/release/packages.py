"""The Python modules that a students' kit needs: all that its commands import, and nothing that knows answers."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from raysteps.common.errors import GraderFault

ENTRIES = ("raysteps.__main__", "raysteps.setting_up.command", "raysteps.students_cli")
# They know answers, or formulas of the steps. A module that goes to students may import these inside of a function, for
# the case that the kit has solutions.
NEVER = (
    "raysteps.classroom",
    "raysteps.cli",
    "raysteps.commands.demo",
    "raysteps.commands.gallery",
    "raysteps.commands.grade",
    "raysteps.commands.inspect.blame",
    "raysteps.commands.inspect.expected",
    "raysteps.commands.inspect.parting",
    "raysteps.commands.inspect.parting_hit",
    "raysteps.commands.inspect.parting_lights",
    "raysteps.commands.inspect.parting_rays",
    "raysteps.commands.inspect.side_by_side",
    "raysteps.commands.inspect.verdict",
    "raysteps.commands.leaderboard",
    "raysteps.commands.release",
    "raysteps.commands.replay",
    "raysteps.diagnosis",
    "raysteps.grading.grader",
    "raysteps.grading.hidden",
    "raysteps.grading.one",
    "raysteps.grading.settings",
    "raysteps.judge",
    "raysteps.mistakes",
    "raysteps.release",
    "raysteps.upkeep",
)
_WITHOUT_DATA = ("exports",)
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
    """The modules, and the schemas, templates and scripts that lie in their packages."""
    modules = needed_modules(source)
    found = set(modules)
    for package in {path.parent for path in modules if path.name == "__init__.py"}:
        if package.name in _WITHOUT_DATA:
            continue
        rooms = [package, *(room for room in package.iterdir() if room.name in ("static", "templates"))]
        for path in (path for room in rooms if room.is_dir() for path in room.iterdir()):
            if path.is_file() and path.suffix in _DATA:
                found.add(path)
    return sorted(found)
