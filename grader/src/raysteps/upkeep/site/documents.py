"""Which documents the site has, and in which order."""

from dataclasses import dataclass
from pathlib import Path

from raysteps.kit.manifest import read_steps
from raysteps.kit.project import Project

COMMANDS_PAGE = Path("docs/commands.md")  # made from the command line itself, so not in the repository
_SECTIONS = (
    ("For students", ("students",)),
    ("For instructors", ("instructors", "class", "exports", "release", "windows")),
    ("Tools", ("watch", "inspect", "view", "maps", "gallery", "pages", "handouts", "figures")),
    ("Reference", ("commands", "formats", "spd", "benchmarks")),
    ("How it works", ("architecture", "truth", "diagnosis", "judge", "sandbox", "hostile", "calibration")),
)


@dataclass(frozen=True)
class Section:
    """Some pages below a word in the site's menu; paths begin at the repository."""

    title: str
    pages: tuple[Path, ...]


def front_page() -> Path:
    """The one that becomes index.html."""
    return Path("README.md")


def _mistakes(project: Project) -> tuple[Path, ...]:
    folder = Path("docs/mistakes")
    names = sorted(path.name for path in (project.root / folder).glob("*.md") if path.name != "README.md")
    return (folder / "README.md", *(folder / name for name in names))


def sections(project: Project) -> list[Section]:
    """The menu. A document that no section names stands under the last one, so that none is ever missing."""
    handouts = tuple(Path("steps") / step.id / "README.md" for step in read_steps(project))
    named = {name for _, names in _SECTIONS for name in names}
    others = sorted(path.stem for path in (project.root / "docs").glob("*.md") if path.stem not in named)
    made = []
    for title, names in _SECTIONS:
        wanted = [*names, *others] if title == _SECTIONS[-1][0] else list(names)
        pages = [Path("docs") / f"{name}.md" for name in wanted]
        made.append(Section(title, tuple(p for p in pages if p == COMMANDS_PAGE or (project.root / p).is_file())))
    reference = next(section for section in made if section.title == "Reference")
    made[made.index(reference)] = Section(reference.title, (*reference.pages, Path("scenes/README.md")))
    made.insert(1, Section("The steps", handouts))
    made.insert(2, Section("Mistakes that students make", _mistakes(project)))
    return [section for section in made if section.pages]


def documents(project: Project) -> list[Path]:
    """All that are written by hand, from the repository on."""
    pages = [page for section in sections(project) for page in section.pages if page != COMMANDS_PAGE]
    return [front_page(), *pages]
