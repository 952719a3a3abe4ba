"""What a Python file depends on, told from its source, too generously rather than too narrowly.

Modules: what it imports, and what that imports, wherever in the file; modules that it names in a text, as for another
process. A file that names the package itself, or reads its sources, depends on all of it. Documents: those that a
module names, by a file, a folder or a pattern; of a command's module only where a test says that command. All other
files of the repository - steps, solutions, scenes, framework, data - count always.
"""

import ast
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fnmatch import translate
from functools import cache, cached_property
from itertools import pairwise
from pathlib import PurePosixPath

from raysteps.course.project import Project
from raysteps.course.tracked_files import list_files
from raysteps.toolchain.fingerprint import fingerprint
from tools.selftest.stamps import Stamps

_SOURCES, _TOOLS, _TESTS = "grader/src/", "tools/", "grader/tests/"
_COMMON = ("grader/tests/conftest.py",)
_WHOLE = re.compile(r"grader/src(/.*)?|src|tools|(.*/)?\*\.py")
_WHOLE_IN_TESTS = re.compile(r"(\./)?raysteps|grader(/.*)?")
_TEXTS = re.compile(r"[\w./*-]*\.md|/?docs(/[\w./*-]*)?|(.*/)?README(\.md)?|/[\w./*-]*\*\*")
EVERY_TEXT, _TEXTS_OF_PACKAGE, _ENDING, _FOLDER = "*", "grader/*", ".md", "docs"
_PICTURES = "/docs/*.[!m]*"  # which one a document shows is told by the document
_DOTTED = re.compile(r"(raysteps|tools)(\.\w+)+")
_IMPORTED = re.compile(r"from ((?:raysteps|tools)[\w.]*) import ([\w, ]+)")  # in a program that is a text
_COMMANDS = "raysteps.cli.app"  # it has the table of all commands, with their modules
_STARTED = ("-m", "raysteps")
_READS_ALL = list_files.__module__
_Nodes = Sequence[ast.AST]  # of a file: what is around something comes before it
# They read all files too, but nothing that a check tells hangs on it: the name of the built kit's folder, and stamps.
# What is meant to test them counts all files.
_NOT_FOLLOWED = {fingerprint.__module__, Stamps.__module__, __name__}


def is_text(place: str) -> bool:
    """A document, or a picture in one."""
    return place.endswith(".md") or place.startswith("docs/")


def is_code(place: str) -> bool:
    """A Python file that is followed by its imports."""
    return place.endswith(".py") and place.startswith((_SOURCES, _TOOLS, _TESTS))


def _expression(shape: str) -> str:
    return translate(shape[1:]) if shape.startswith("/") else f"(?:.*/)?{translate(shape)}"


@cache
def _pattern(shapes: frozenset[str]) -> re.Pattern[str]:
    return re.compile("|".join(map(_expression, sorted(shapes))) or "(?!)")


@dataclass
class Inputs:
    """Of one Python file, or several."""

    code: set[str] = field(default_factory=set)  # places of Python files
    whole: bool = False  # the package and the tests, all of them
    texts: set[str] = field(default_factory=set)  # shapes of places of documents, or of the ends of such places

    def belongs(self, place: str) -> bool:
        """Whether a file of the repository counts."""
        if is_code(place):
            return place in self.code or (self.whole and place.startswith((_SOURCES, _TOOLS)))
        return not is_text(place) or _pattern(frozenset(self.texts)).fullmatch(place) is not None


@dataclass(frozen=True)
class _Module:
    named: frozenset[str]  # modules, as far as they exist
    whole: bool
    texts: frozenset[str]  # shapes
    said: frozenset[str]  # words that may be commands
    commands: Mapping[str, str]  # with their modules
    plugins: frozenset[str]  # modules
    fixtures: frozenset[str]
    wanted: frozenset[str]  # fixtures, by their names


class Sources:
    """The Python files of the repository."""

    def __init__(self, project: Project, files: Iterable[str]) -> None:
        self._root = project.root
        self._places = {_name_of(place): place for place in files if is_code(place)}
        self._read = cache(self._module)

    def tests(self) -> list[str]:
        """Places of the files with tests."""
        found = (place for place in self._places.values() if place.startswith(_TESTS))
        return sorted(place for place in found if PurePosixPath(place).name.startswith("test_"))

    def of_test(self, place: str) -> Inputs:
        """A file with tests, and what pytest loads before it."""
        return self._inputs([_name_of(name) for name in (place, *_COMMON)])

    def of_modules(self, *names: str) -> Inputs:
        """Modules of the package."""
        return self._inputs(list(names))

    def places_of(self, *names: str) -> set[str]:
        """The files of modules, without what they import."""
        return {self._places[name] for name in names}

    def _inputs(self, names: list[str]) -> Inputs:
        tested = {one for first in names if self._places[first].startswith(_TESTS) for one in self._read(first).named}
        closed = _NOT_FOLLOWED - tested
        reached = self._reached(names, closed, self._all_named)
        said = frozenset[str]().union(*(self._read(name).said for name in reached))
        reading = self._reached(names, closed, lambda name: self._named_when(name, said))
        whole = any(self._read(name).whole for name in reached - closed)
        texts = {shape for name in reading - closed for shape in self._read(name).texts}
        if texts:
            texts.add(_PICTURES)
        if whole:
            texts.add(_TEXTS_OF_PACKAGE)
        return Inputs({self._places[name] for name in reached}, whole, texts)

    def _reached(self, names: list[str], closed: set[str], following: Callable[[str], Iterable[str]]) -> set[str]:
        """These modules, and those that follow from them, however far away."""
        found: set[str] = set()
        waiting = list(names)
        while waiting:
            name = waiting.pop()
            if name not in found:
                found.add(name)
                waiting += () if name in closed else (*following(name), *(self._places.keys() & _above(name)))
        return found

    def _all_named(self, name: str) -> set[str]:
        module = self._read(name)
        return {*module.named, *(self._fixtures[one] for one in module.wanted & self._fixtures.keys())}

    def _named_when(self, name: str, said: frozenset[str]) -> set[str]:
        """Without the modules of commands that nobody says."""
        commands = self._read(name).commands
        return self._all_named(name) - {commands[word] for word in commands.keys() - said}

    @cached_property
    def _fixtures(self) -> dict[str, str]:
        """Of the tests' plugins, which conftest.py names: fixtures, with their modules."""
        plugins = {name for place in _COMMON for name in self._read(_name_of(place)).plugins}
        return {one: name for name in plugins for one in self._read(name).fixtures}

    def _module(self, name: str) -> _Module:
        place = self._places[name]
        tree = tuple(ast.walk(ast.parse((self._root / place).read_text(encoding="utf-8"))))
        words = {text for _, text in _constants(tree)}
        in_tests, has_commands = place.startswith(_TESTS), name == _COMMANDS
        named, whole = self._imported(tree, name)
        for word in words:
            named |= {found[0] for found in _DOTTED.finditer(word)}
            named |= {f"{found[1]}.{one}" for found in _IMPORTED.finditer(word) for one in found[2].split(", ")}
            if re.fullmatch(r"\w+\.py", word):
                named.add(f"{self._package(name)}.{word.removesuffix('.py')}".lstrip("."))  # beside it, as keeper.py
            if word.startswith("raysteps.") and word.endswith("."):  # the rest of the name is made when it runs
                named |= {one for one in self._places if one.startswith(word)}
            whole |= bool(_WHOLE.fullmatch(word)) or (in_tests and bool(_WHOLE_IN_TESTS.fullmatch(word)))
        if whole:
            named.add(_COMMANDS)  # it may start the program
        return _Module(
            named=frozenset(one for one in named if one in self._places),
            whole=whole or name == _READS_ALL,
            texts=frozenset(() if has_commands else _texts(tree, lists_all=_READS_ALL in named)),
            said=frozenset(_typed(tree) if in_tests else _started(tree)),
            commands=dict(_commands(tree)) if has_commands else {},
            plugins=frozenset(words & self._places.keys()) if place in _COMMON else frozenset(),
            fixtures=frozenset(_fixtures(tree)) if in_tests else frozenset(),
            wanted=frozenset(_wanted(tree)) if in_tests else frozenset(),
        )

    def _package(self, name: str) -> str:
        return name if self._places[name].endswith("/__init__.py") else name.rpartition(".")[0]

    def _imported(self, tree: _Nodes, name: str) -> tuple[set[str], bool]:
        """By its statements and calls; and whether that may be the whole package."""
        named: set[str] = set()
        whole = False
        for node in tree:
            match node:
                case ast.Import():
                    named |= {alias.name for alias in node.names}
                    whole |= not named.isdisjoint({"raysteps", "tools"})
                case ast.ImportFrom(module=module, level=0) if module:
                    named |= {module, *(f"{module}.{alias.name}" for alias in node.names)}
                case ast.List() | ast.Tuple() | ast.Set() | ast.Call():
                    values = _values(node)
                    if isinstance(node, ast.Call) and ast.unparse(node.func).endswith("import_module"):
                        named |= {f"{self._package(name)}.{value}".lstrip(".") for value in values}
                    whole |= "grader" in values or _STARTED in pairwise(values)
        return named, whole


def _constants(tree: _Nodes) -> Iterator[tuple[ast.Constant, str]]:
    """All texts in it that are no docstrings."""
    documented = {id(node.value) for node in tree if isinstance(node, ast.Expr)}
    for node in tree:
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in documented:
            yield node, node.value


def _values(node: ast.AST) -> list[str]:
    """The constants among what it lists, or is called with."""
    parts = node.args if isinstance(node, ast.Call) else getattr(node, "elts", ())
    return [str(part.value) for part in parts if isinstance(part, ast.Constant)]


# The documents that a module names.


def _texts(tree: _Nodes, *, lists_all: bool) -> Iterator[str]:
    """Shapes. What a name must end with selects among what is named elsewhere, and a key of a table is a command."""
    known = {id(node.value) for node in tree if isinstance(node, ast.Expr)}
    for node in tree:
        match node:
            case ast.Call(func=ast.Attribute(attr="endswith"), args=[ending]):
                known |= {id(part) for part in ast.walk(ending)}
            case ast.Dict(keys=keys):
                known |= {id(key) for key in keys if isinstance(key, ast.Constant) and key.value == _FOLDER}
        place = None if id(node) in known else re.sub(r"^(\.\.?/)+", "", _joined(node) or "")
        if place == _ENDING:
            yield EVERY_TEXT
        elif place and _TEXTS.fullmatch(place):
            known |= {id(part) for part in _parts(node)}
            yield place if re.search(r"\.\w+$", place) else f"{place.rstrip('/*')}*"
    if lists_all:
        yield from _listed(tree)


def _parts(node: ast.AST) -> Iterator[ast.AST]:
    """Of what `_joined` joins."""
    yield node
    match node:
        case ast.BinOp(left=left, right=right):
            yield from (*_parts(left), *_parts(right))
        case ast.JoinedStr(values=values):
            yield from values
        case ast.Call(func=ast.Attribute(value=folder), args=[pattern]):
            yield from (*_parts(folder), pattern)


def _joined(node: ast.AST) -> str | None:
    """What stands there as one text, with * for what is not known: "docs" / f"{name}.md", folder.glob("*.md"). What
    begins with / begins at the root of the kit."""
    match node:
        case ast.Constant(value=str(text)):
            return re.sub(r"\{[^{}]*\}", "*", text)
        case ast.JoinedStr(values=values):
            return "".join(_joined(value) or "*" for value in values)
        case ast.BinOp(left=left, op=ast.Div(), right=right):
            return _in_folder(left, _joined(right) or "*")
        case ast.Call(func=ast.Attribute(value=folder, attr="glob" | "rglob"), args=[ast.Constant(value=str(text))]):
            return _in_folder(folder, "**" if text == "*" else text)
    return None


def _in_folder(folder: ast.AST, name: str) -> str:
    match folder:
        case ast.Attribute(attr="root"):  # of a project
            return f"/{name}"
        case ast.Attribute(attr="steps" | "scenes" | "solutions" as place):
            return f"/{place}/{name}"
    return f"{_joined(folder)}/{name}" if _joined(folder) else name


def _listed(tree: _Nodes) -> Iterator[str]:
    """Shapes of what a module that lists all files reads of them: those in the folders that it names."""
    for node in tree:
        match node:
            case ast.Call(func=ast.Name(id="places"), args=[_, ast.Name(id=folders)]):
                for given in tree:
                    if isinstance(given, ast.Assign) and ast.unparse(given.targets[0]) == folders:
                        yield from (f"{folder}/*" for folder in _values(given.value))
            case ast.Call(func=ast.Name(id="places")):
                yield EVERY_TEXT


# The commands that may be typed, and the fixtures that a test may have.


def _commands(tree: _Nodes) -> Iterator[tuple[str, str]]:
    for node in tree:
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "Command":
            values = _values(node)
            yield values[0], next(value for value in values if _DOTTED.fullmatch(value))


def _typed(tree: _Nodes) -> Iterator[str]:
    """The first words of texts that are no parts of paths, and what follows ./raysteps in them."""
    parts = {
        id(side)
        for node in tree
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div)
        for side in (node.left, node.right)
    }
    for node, text in _constants(tree):
        yield from () if id(node) in parts else text.split()[:1]
        yield from re.findall(r"raysteps\s+([a-z-]+)", text)


def _started(tree: _Nodes) -> Iterator[str]:
    """What is listed after `-m raysteps`."""
    for node in tree:
        values = _values(node)
        if _STARTED in pairwise(values):
            yield from values


def _functions(tree: _Nodes) -> Iterator[tuple[ast.FunctionDef, bool]]:
    """With whether it is a fixture."""
    for node in tree:
        if isinstance(node, ast.FunctionDef):
            yield node, any(ast.unparse(one).startswith("pytest.fixture") for one in node.decorator_list)


def _fixtures(tree: _Nodes) -> Iterator[str]:
    return (function.name for function, is_fixture in _functions(tree) if is_fixture)


def _wanted(tree: _Nodes) -> Iterator[str]:
    for function, is_fixture in _functions(tree):
        if is_fixture or function.name.startswith("test"):
            yield from (argument.arg for argument in function.args.args)
    for node in tree:
        if isinstance(node, ast.Call) and ast.unparse(node.func).endswith(("usefixtures", "getfixturevalue")):
            yield from _values(node)


def _name_of(place: str) -> str:
    """raysteps.course.stubs, tools.lint; a test is known by its own name alone, wherever it lies, but in a package."""
    name = place.removeprefix(_SOURCES).removeprefix(_TESTS).removesuffix(".py").removesuffix("/__init__")
    if place.startswith(_TESTS) and not name.startswith("hostile/"):
        name = name.rpartition("/")[2]
    return name.replace("/", ".")


def _above(name: str) -> set[str]:
    parts = name.split(".")
    return {".".join(parts[:count]) for count in range(1, len(parts))}
