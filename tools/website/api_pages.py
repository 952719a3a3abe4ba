"""Pages of the framework's core and of the steps' contracts, made from the headers and their comments."""

import re
from collections.abc import Iterable
from pathlib import Path

from raysteps.course.manifest import read_steps
from raysteps.course.project import Project
from tools.website.documents import CONTRACTS_PAGE, CORE_PAGE

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
        for step in read_steps(project)
        for path in sorted((project.steps / step.id).glob("*.hpp"))
    ]
    return {
        CORE_PAGE: _page(_CORE, (_section(path.name, path) for path in core)),
        CONTRACTS_PAGE: _page(_CONTRACTS, contracts),
    }
