"""Pages that nobody wrote: of all commands, of the core, and of the contracts of the steps."""

import argparse
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from raysteps.course.manifest import kit_steps
from raysteps.course.project import Project
from tools.website.documents import CONTRACTS_PAGE, CORE_PAGE

# What the C++ programs accept: the text that they print for --help.

_SOURCES = {"raytrace": "options.cpp", "inspect": "inspect_options.cpp", "view": "view_options.cpp"}


def usage(project: Project, program: str) -> str:
    """The text."""
    source = (project.root / "framework" / "apps" / _SOURCES[program]).read_text(encoding="utf-8")
    found = re.search(r'_usage = R"\((.*?)\)"', source, re.DOTALL)
    if found is None:
        raise ValueError(f"framework/apps/{_SOURCES[program]}: expected a constant k_..._usage")
    return found[1]


# The page of all commands, made from the command line itself.

_WIDTH = 88
_OF_PROGRAMS = {"render": "raytrace", "view": "view"}
_BEGIN = """# Commands

Everything that `./raysteps` can do. `./raysteps COMMAND --help` prints the same.

Exit codes: 0 all passed, 1 checks failed, 2 usage, 3 the student's code does not build, 4 a fault of the grader, 130
interrupted.
"""
_OWN_STEPS = """All words after the command go to `{program}`, a C++ program. Without `--impl`, or with `--impl mine`,
it has your own steps; with `--impl reference` those of the kit.
"""


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|").replace("<", "&lt;").replace("*", "\\*").replace("_", "\\_")


def _help(parser: argparse.ArgumentParser, action: argparse.Action) -> str:
    return _cell((action.help or "") % {"default": action.default, "prog": parser.prog})


def _value(action: argparse.Action) -> str:
    if action.nargs == 0:
        return ""
    word = action.metavar or ("{" + ",".join(map(str, action.choices)) + "}" if action.choices else None)
    shown = " ".join(word) if isinstance(word, tuple) else word or action.dest.upper()
    return f"{shown} ..." if action.nargs in ("*", "+") else shown


def _name(action: argparse.Action) -> str:
    if not action.option_strings:
        return _value(action)
    value = _value(action)
    return ", ".join(action.option_strings) + (f" {value}" if value else "")


def _commands(parser: argparse.ArgumentParser) -> Iterator[tuple[str, argparse.ArgumentParser, str]]:
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            helps = {choice.dest: choice.help or "" for choice in action._choices_actions}
            for name, child in action.choices.items():
                yield name, child, helps.get(name, "")


def _usage(parser: argparse.ArgumentParser) -> str:
    parser.formatter_class = lambda prog: argparse.HelpFormatter(prog, width=_WIDTH)
    return parser.format_usage().removeprefix("usage: ").replace("raysteps", "./raysteps", 1)


def _part(project: Project, words: str, parser: argparse.ArgumentParser, about: str, level: int) -> Iterator[str]:
    yield f"{'#' * level} {words}"
    sentence = about[:1].upper() + about[1:]
    yield f"{_cell(sentence)}{'' if sentence.endswith('.') else '.'}" if sentence else ""
    program = _OF_PROGRAMS.get(words)
    if program:
        yield _OWN_STEPS.format(program=program)
        yield f"```text\n{usage(project, program).strip()}\n```"
        return
    children = list(_commands(parser))
    if not children:
        yield f"```text\n{_usage(parser).strip()}\n```"
    shown = [
        action
        for action in parser._actions
        if not isinstance(action, argparse._SubParsersAction | argparse._HelpAction)
        and action.help != argparse.SUPPRESS
    ]
    if shown:
        rows = [f"| `{_name(action).replace('|', chr(92) + '|')}` | {_help(parser, action)} |" for action in shown]
        yield "\n".join(["| argument | meaning |", "|---|---|", *rows])
    for name, child, said in children:
        yield from _part(project, f"{words} {name}", child, said, level + 1)


def command_page(project: Project, parser: argparse.ArgumentParser) -> str:
    """The text, in Markdown."""
    parts = [part for name, child, about in _commands(parser) for part in _part(project, name, child, about, 2)]
    return "\n\n".join([_BEGIN.strip(), *(part for part in parts if part)]) + "\n"


# Pages of the core and of the contracts, made from the headers and their comments.

_CORE = """# The framework's core

The value types that all steps share, and the scene: the headers of `framework/core/`. No student edits them, every step
uses them. Private members are left out. [The glossary](glossary.md) says what others call these things.
"""
_CONTRACTS = """# The contracts of the steps

What the functions of each step promise: the headers of `steps/`. The handouts explain them, the tests and the judge
hold to them.
"""
_NO_PART = re.compile(r"#pragma once|#include .*|(?:inline )?namespace raysteps \{|\}  // namespace raysteps")
_PRIVATE = re.compile(r"^private:\n.*?(?=^\};)", re.MULTILINE | re.DOTALL)


def _parts(header: str) -> tuple[str, str]:
    """The comment that a header begins with, up to its first empty line, and what it declares."""
    lines = [line for line in header.splitlines() if not _NO_PART.fullmatch(line)]
    about = []
    while lines and lines[0].startswith("// "):
        about.append(lines.pop(0).removeprefix("// "))
    if lines and lines[0] == "//":
        lines.pop(0)
    code = _PRIVATE.sub("", "\n".join(lines))
    return " ".join(about), re.sub(r"\n{3,}", "\n\n", code).strip()


def _section(title: str, path: Path, more: str = "") -> str:
    about, code = _parts(path.read_text(encoding="utf-8"))
    return "\n\n".join(part for part in (f"## {title}", about, more, f"```cpp\n{code}\n```") if part)


def _page(begin: str, sections: Iterable[str]) -> str:
    return "\n\n".join([begin.strip(), *sections]) + "\n"


def api_pages(project: Project) -> dict[Path, str]:
    """The text of each page, in Markdown."""
    core = sorted((project.root / "framework" / "core").glob("*.hpp"))
    contracts = [
        _section(f"{step.number} {step.title}", path, f"[Its handout](../steps/{step.id}/README.md); `{path.name}`.")
        for step in kit_steps(project)
        for path in sorted((project.steps / step.id).glob("*.hpp"))
    ]
    return {
        CORE_PAGE: _page(_CORE, (_section(path.name, path) for path in core)),
        CONTRACTS_PAGE: _page(_CONTRACTS, contracts),
    }
