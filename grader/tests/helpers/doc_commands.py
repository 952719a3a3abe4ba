"""The commands of the documents, read by the programs that they are for."""

import argparse
import contextlib
import importlib.util
import io
import itertools
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import ModuleType

from typed_commands import Typed, commands, mentioned, typed

from raysteps.cli.app import new_parser
from raysteps.cli.render import take_impl
from raysteps.common.errors import RaystepsError
from raysteps.common.markdown import blocks
from raysteps.course.project import Project, here
from tools.website.documents import documents, is_shell, usage

OTHER_PROGRAMS = {
    "apt-get", "brew", "cd", "cmake", "code", "cp", "ctest", "dnf", "docker", "git", "jplag", "java", "mkdir",
    "python3", "sbatch", "sqlite3", "ssh", "sudo", "tar", "winget", "wsl", "xcode-select", "zip",
}  # fmt: skip


def blocks_of(project: Project) -> list[list[Typed]]:
    """Block by block, of all documents that the site shows."""
    return [
        block
        for document in documents(project)
        for block in typed(document, (project.root / document).read_text(encoding="utf-8"))
    ]


def all_commands(project: Project) -> list[Typed]:
    """Of blocks and of prose."""
    spans = [
        one
        for document in documents(project)
        for one in mentioned(document, (project.root / document).read_text(encoding="utf-8"))
    ]
    return [*(one for block in blocks_of(project) for one in block), *spans]


@cache
def scene_generator(project: Project) -> ModuleType:
    """scenes/generate.py, which is no part of the package."""
    path = project.scenes / "generate.py"
    spec = importlib.util.spec_from_file_location("scene_generator", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.path.insert(0, str(project.scenes))
    try:
        sys.modules[spec.name] = module
        spec.loader.exec_module(module)
    finally:
        sys.path.remove(str(project.scenes))
    return module


@cache
def _command_line(command: str) -> argparse.ArgumentParser:
    """The whole kit's, or a students' kit's for what only that has."""
    return new_parser(Project(Path("a students' kit")) if command == "update" else here())


# What the C++ programs accept, read from the text that they print for --help.

_OPTION = re.compile(r"^  (?:-\w, )?(--?[\w-]+)(?: (\S+))?(?=\s|$)", re.MULTILINE)


def _usage_parser(project: Project, program: str) -> argparse.ArgumentParser:
    """Reads a scene and the program's options as the program does, but for the ranges of numbers."""
    parser = argparse.ArgumentParser(prog=program, allow_abbrev=False, add_help=False)
    parser.add_argument("scene", nargs="?")
    for option, value in _OPTION.findall(usage(project, program)):
        words = value.split("|")
        if not value:
            parser.add_argument(option, action="store_true")
        elif len(words) > 1:
            parser.add_argument(option, choices=words)
        elif value == "N":
            parser.add_argument(option, type=int)
        elif value == "WxH":
            parser.add_argument(option, type=_size)
        else:
            parser.add_argument(option)
    return parser


def _size(word: str) -> str:
    if not re.fullmatch(r"[1-9]\d*x[1-9]\d*", word):
        raise argparse.ArgumentTypeError(f"{word}: expected WxH")
    return word


@cache
def _program(project: Project, name: str) -> argparse.ArgumentParser:
    return _usage_parser(project, name)


def _read(parser: argparse.ArgumentParser, words: list[str]) -> str:
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
            parser.parse_args(words)
    except SystemExit as ended:
        return said.getvalue().strip().splitlines()[-1] if ended.code else ""
    return ""


def _parsers(parser: argparse.ArgumentParser, words: list[str]) -> Iterator[argparse.ArgumentParser]:
    """The parser, and those of the commands that the first words name."""
    yield parser
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction) and words and words[0] in action.choices:
            yield from _parsers(action.choices[words[0]], words[1:])


def _synopsis(project: Project, parser: argparse.ArgumentParser, words: list[str]) -> str:
    """A synopsis has holes, but its options must be there."""
    found = list(_parsers(parser, words))
    known = {option for parser in found for option in parser._option_string_actions}
    if words[0] in ("render", "view"):
        program = "raytrace" if words[0] == "render" else "view"
        known |= {"--impl", *re.findall(r"--?[\w-]+", usage(project, program))}
    if len(found) == 1 and words[0] not in ("...", "…") and not words[0].isupper() and not words[0].startswith("-"):
        return f"no command is called {words[0]}"
    unknown = [option for word in words for option in re.findall(r"^\[?(--?[a-z][\w-]*)", word) if option not in known]
    return f"unknown: {', '.join(unknown)}" if unknown else ""


def _raysteps(project: Project, parser: argparse.ArgumentParser, one: Typed, words: list[str]) -> str:
    if one.is_synopsis:
        return _synopsis(project, parser, words)
    if words[0] in ("render", "view"):
        try:
            _, rest = take_impl(words[1:])
        except RaystepsError as error:
            return str(error)
        return _read(_program(project, "raytrace" if words[0] == "render" else "view"), rest)
    return _read(parser, words)


def complaint(project: Project, one: Typed, parser: argparse.ArgumentParser | None = None) -> str:
    """What is wrong with the command; empty when nothing is. `parser` is that of another kit than the whole."""
    named = [word for word in one.words if re.match(r"(?:scenes|steps|grader)/\w", word)]
    for word in named:
        if not (project.root / word).exists():
            return f"{word}: nothing of that name in the kit"
    first, words = one.words[0], list(one.words[1:])
    if first == "./raysteps" or (first == "python" and words[:1] == ["raysteps"]):
        words = words if first == "./raysteps" else words[1:]
        return _raysteps(project, parser or _command_line(words[0]), one, words) if words else ""
    if re.fullmatch(r"(?:build/\w+/bin/)?raytrace(?:-mine|-reference)?", first):
        return _read(_program(project, "raytrace"), words)
    if first == "python" and words[:1] == ["scenes/generate.py"]:
        return _read(scene_generator(project).parser(), words[1:])
    if first.startswith(("../.venv/bin/", ".venv/bin/")) or first in OTHER_PROGRAMS:
        return ""
    return f"{first}: no program of the kit, and not among those that are known to be somebody else's"


@dataclass(frozen=True)
class Shown:
    """What a document says that a command prints."""

    command: Typed
    lines: tuple[str, ...]


def shown_in(document: Path, text: str) -> Iterator[Shown]:
    """Output stands in a block of its own, right below that of its command, or below words that begin or end with
    "prints". No document shows what `render` prints: where the picture is, and what is not written yet."""
    lines = text.splitlines()
    for above, below in itertools.pairwise(blocks(text)):
        speaking = [one for one in commands(document, above) if one.words[1:2] != ("render",)]
        end = above.line + above.body.count("\n")  # the line of the fence below it
        words = re.findall(r"\w+", " ".join(lines[end : below.line - 2]))
        follows = not words or "prints" in (words[0], words[-1])
        if follows and speaking and below.tag in ("", "text") and not is_shell(below):
            yield Shown(speaking[-1], tuple(below.body.splitlines()))


def outputs_of(project: Project) -> list[Shown]:
    """Of all documents."""
    return [
        shown
        for document in documents(project)
        for shown in shown_in(document, (project.root / document).read_text(encoding="utf-8"))
    ]


def missing(shown: tuple[str, ...], printed: str) -> str:
    """The first line that the program did not print, or not in its place. A line of dots stands for some lines, dots at
    an end for a rest."""
    lines = iter(line.rstrip() for line in printed.splitlines())
    for line in (one.rstrip() for one in shown):
        head = line.removesuffix("...")
        if head.strip() and not any(there == line or (head != line and there.startswith(head)) for there in lines):
            return line
    return ""
