"""Which documents the site has, in which order, and what their links, blocks and formulas are; and the pages that
nobody wrote: of all commands, of the core, and of the contracts of the steps."""

import argparse
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote

from raysteps.common.markdown import BadFormula, Block, anchors, formulas, mathml, targets
from raysteps.course.manifest import kit_steps
from raysteps.course.project import Project

# Made from the command line and from the headers, so not in the repository.
COMMANDS_PAGE = Path("docs/commands.md")
CORE_PAGE = Path("docs/core.md")
CONTRACTS_PAGE = Path("docs/contracts.md")
_MADE = (COMMANDS_PAGE, CORE_PAGE, CONTRACTS_PAGE)
MISTAKES = Path("docs/mistakes/README.md")
_SECTIONS = (
    ("For students", ("students", "where-students-work", "paper", "where-rays-go")),
    ("For instructors", ("instructors", "class", "exports", "release")),
    ("Tools", ("watch", "inspect", "view", "maps", "finale", "gallery", "pages")),
    ("Reference", ("glossary", "commands", "contracts", "core", "formats", "mistakes/README", "spd", "benchmarks")),
    (
        "How it works",
        (
            *("architecture", "decisions", "dependencies", "handouts", "site", "truth"),
            *("diagnosis", "judge", "sandbox", "hostile", "calibration"),
        ),
    ),
)
_PROJECT = ("CONTRIBUTING", "CHANGELOG", "SECURITY", "THIRD_PARTY", "LICENSE-CC-BY-4.0")  # at the top of the repository


@dataclass(frozen=True)
class Section:
    """Some pages below a word in the site's menu; paths begin at the repository."""

    title: str
    pages: tuple[Path, ...]


def front_page() -> Path:
    """The one that becomes index.html."""
    return Path("README.md")


def below(project: Project, page: Path) -> tuple[Path, ...]:
    """The pages that unfold below one of the menu: those of each step's mistakes."""
    if page != MISTAKES:
        return ()
    return tuple(sorted(page.parent / path.name for path in (project.root / page.parent).glob("[0-9]*.md")))


def sections(project: Project) -> list[Section]:
    """The menu. A document that no section names stands under the last one, so that none is ever missing."""
    handouts = tuple(Path("steps") / step.id / "README.md" for step in kit_steps(project))
    named = {name for _, names in _SECTIONS for name in names}
    others = sorted(path.stem for path in (project.root / "docs").glob("*.md") if path.stem not in named)
    made = []
    for title, names in _SECTIONS:
        wanted = [*names, *others] if title == _SECTIONS[-1][0] else list(names)
        pages = [Path("docs") / f"{name}.md" for name in wanted]
        made.append(Section(title, tuple(p for p in pages if p in _MADE or (project.root / p).is_file())))
    reference = next(section for section in made if section.title == "Reference")
    made[made.index(reference)] = Section(reference.title, (*reference.pages, Path("scenes/README.md")))
    made.insert(1, Section("The steps", handouts))
    project_pages = tuple(Path(f"{name}.md") for name in _PROJECT if (project.root / f"{name}.md").is_file())
    made.append(Section("The project", project_pages))
    return [section for section in made if section.pages]


def documents(project: Project) -> list[Path]:
    """All that are written by hand, from the repository on."""
    pages = [page for section in sections(project) for page in section.pages if page not in _MADE]
    return [front_page(), *pages, *(child for page in pages for child in below(project, page))]


# Dead links: to files that are not there, and to headings that nobody wrote.


def is_elsewhere(target: str) -> bool:
    """Whether a link leaves the repository."""
    return "://" in target or target.startswith("mailto:")


def split(document: Path, target: str) -> tuple[Path, str]:
    """The file that a link leads to, and the anchor in it."""
    path, _, anchor = target.partition("#")
    return (document.parent / unquote(path)).resolve() if path else document.resolve(), anchor


def dead_links(root: Path, documents: Iterable[Path]) -> list[str]:
    """One line for each, with its place."""
    found = []
    known: dict[Path, set[str]] = {}
    for name in documents:
        document = root / name
        for line, target in targets(document.read_text(encoding="utf-8")):
            if is_elsewhere(target):
                continue
            path, anchor = split(document, target)
            if not path.exists():
                found.append(f"{name}:{line}: {target}: expected a file of the repository, found nothing of that name")
            elif not path.is_relative_to(root.resolve()):
                found.append(f"{name}:{line}: {target}: leaves the repository")
            elif anchor and path.suffix == ".md":
                if path not in known:
                    known[path] = anchors(path.read_text(encoding="utf-8"))
                if anchor not in known[path]:
                    near = ", ".join(sorted(known[path]))
                    found.append(f"{name}:{line}: {target}: no heading makes that anchor; there are: {near}")
    return found


# Blocks of commands.

_TAGS = ("sh", "bash", "shell", "console", "powershell", "bat")
_PROGRAMS = re.compile(
    r"(?:\$ )?(?:[A-Z_]+=\S+ )*"
    r"(?:\./raysteps|python3?|raytrace|cd|cmake|ctest|git|tar|zip|docker|sbatch|sqlite3|xvfb-run|sudo|wsl|winget|brew"
    r"|xcode-select|exec|ssh|jplag|java|\.venv/bin/\w+)(?: |$)"
)


def is_shell(block: Block) -> bool:
    """Whether people are to type it."""
    return block.tag in _TAGS or (not block.tag and _PROGRAMS.match(block.body) is not None)


def bad_formulas(root: Path, documents: Iterable[Path]) -> list[str]:
    """One line for each that cannot be shown."""
    found = []
    for document in documents:
        for formula in formulas((root / document).read_text(encoding="utf-8")):
            try:
                mathml(formula, block=False)
            except BadFormula as error:
                found.append(f"{document}: the formula {error}")
    return found


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
