"""Which documents the site has, in which order, and what their links, blocks and formulas are."""

import re
from collections.abc import Iterable
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
