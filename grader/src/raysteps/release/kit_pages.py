"""Text files that a students' kit has of its own: README.md, the package's pyproject.toml, what an editor offers."""

import json
import posixpath
import re
import tomllib
from collections.abc import Sequence
from datetime import date
from importlib.resources import files
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.files import readable_json
from raysteps.common.markdown import targets, unlinked
from raysteps.common.text import join_and, number
from raysteps.course.manifest import Step, steps_words
from raysteps.grading.scoring import max_points

_DATA = ["play/static/*", "py.typed", "report/static/*", "report/templates/*"]


def _picture(steps: list[Step]) -> str:
    """What draws the first picture of the course; a first step may have none."""
    index, scene = next(
        ((step.index, case.scene) for step in steps for case in step.images),
        (steps[0].index, "scenes/lessons/three-spheres.nff"),
    )
    return f"./raysteps render {scene} -o first.png --step {index}"


def _follow(later: Sequence[tuple[Step, date]]) -> str:
    """`Step 3 follows on 2026-11-02, and steps 4-5 on 2026-11-23.`"""
    later = sorted(later, key=lambda one: (one[1], one[0].index))
    days = {day: [step for step, other in later if other == day] for _, day in later}
    said: list[str] = []
    for day, steps in days.items():
        verb = "" if said else " follows" if len(steps) == 1 else " follow"
        said.append(f"step{'s' * (len(steps) > 1)} {join_and(steps_words(steps))}{verb} on {day}")
    return f"\n\n{', and '.join(said).capitalize()}." if said else ""


def readme(course: str, steps: list[Step], term: str = "", later: Sequence[tuple[Step, date]] = ()) -> bytes:
    """Short: the steps, and what to type first; `later` follow on their days."""
    rows = [
        f"| [{step.number} {step.title}](steps/{step.id}/README.md){' (bonus)' if step.bonus else ''} "
        f"| `steps/{step.path.as_posix()}` | {number(step.points)} |"
        for step in steps
    ]
    template = files("raysteps.release").joinpath("templates/README.md").read_text(encoding="utf-8")
    words = {
        "COURSE": course + (f"\n\n{term}." if term else ""),
        "STEPS": "\n".join(rows) + _follow(later),
        "FIRST": steps[0].number,
        "FIRST_FILE": steps[0].path.as_posix(),
        "FIRST_ID": steps[0].id,
        "PICTURE": _picture(steps),
    }
    for name, text in words.items():
        template = template.replace(f"@{name}@", text)
    return template.encode()


def for_editor(text: bytes, steps: list[Step]) -> bytes:
    """Tasks and programs to debug, for these steps only, and without the task that tests the whole kit."""
    table = json.loads(text)
    if "tasks" in table:
        table["tasks"] = [task for task in table["tasks"] if task.get("args") != ["test"]]
    for asked in (one for one in table.get("inputs", []) if one["id"] == "step"):
        asked["options"], asked["default"] = [step.number for step in steps], steps[0].number
    return readable_json(table).encode()


def pyproject(text: str) -> bytes:
    """What the package needs to run, without what it takes to work on it."""
    table = tomllib.loads(text)
    project = table["project"]
    lines = [
        "[build-system]",
        f"requires = {json.dumps(table['build-system']['requires'])}",
        f"build-backend = {json.dumps(table['build-system']['build-backend'])}",
        "",
        "[project]",
        *(f"{key} = {json.dumps(project[key])}" for key in ("name", "dynamic", "requires-python", "license")),
        'description = "Checks the steps of a ray tracing course"',
        "dependencies = [",
        *(f"    {json.dumps(name)}," for name in project["dependencies"]),
        "]",
        "",
        "[project.optional-dependencies]",
        f"play = {json.dumps(project['optional-dependencies']['play'])}",
        "",
        "[tool.setuptools.dynamic]",
        'version = {attr = "raysteps.__version__"}',
        "",
        "[tool.setuptools.packages.find]",
        'where = ["src"]',
        "",
        "[tool.setuptools.package-data]",
        f"raysteps = {json.dumps(_DATA)}",
    ]
    return ("\n".join(lines) + "\n").encode()


# Links of the kit's pages: pictures that they show come along, and what is not there is not linked.

_PICTURES = (".png", ".svg", ".jpg", ".gif")


def _place(page: str, link: str) -> str | None:
    """The path from the root that a link leads to; none for other sites and places in the same page."""
    path = link.partition("#")[0]
    if not path or re.match(r"[a-z]+:", path):
        return None
    return posixpath.normpath(posixpath.join(posixpath.dirname(page), path))


def add_pictures(files: dict[str, bytes], root: Path) -> None:
    """Those that a page shows, wherever the whole kit keeps them."""
    for page in [name for name in files if name.endswith(".md")]:
        for _, link in targets(files[page].decode()):
            place = _place(page, link)
            if place is None or place in files or not place.endswith(_PICTURES) or place.startswith(".."):
                continue
            if (root / place).is_file():
                files[place] = (root / place).read_bytes()


def unlink_missing(files: dict[str, bytes]) -> None:
    """`[words](docs/elsewhere.md)` becomes `words` where students do not get that page."""
    folders = {parent for name in files for parent in _parents(name)}
    for page in [name for name in files if name.endswith(".md")]:

        def is_known(link: str, page: str = page) -> bool:
            place = _place(page, link)
            return place is None or place in files or place.rstrip("/") in folders

        files[page] = unlinked(files[page].decode(), is_known).encode()


def _parents(name: str) -> list[str]:
    parts = name.split("/")
    return ["/".join(parts[:at]) for at in range(1, len(parts))]


# Words of the pages that one kind of kit has and the other has not, marked by comments in the Markdown.

# A mark on a line of its own goes with the line; marks within a line leave the rest of it as it is.
_WHOLE = re.compile(
    r"^<!-- whole kit -->\n.*?^<!-- end -->\n|<!-- whole kit -->.*?<!-- end -->", re.MULTILINE | re.DOTALL
)
_STUDENTS = re.compile(r"<!-- students'\s+kit:\s*(.*?)\s*-->", re.DOTALL)
_MARK = re.compile(r"<!-- *(?:whole\s+kit|end|students'\s+kit)\b")
_MADE = re.compile(r"^<!-- (?:begin|end) [\w-]+ -->\n", re.MULTILINE)  # around what a command writes into a page
_FENCED = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
_GAP = re.compile(r"\n{3,}")


def _without_gaps(text: str) -> str:
    """What was taken out leaves one empty line between paragraphs, and code as it was."""
    parts, end = [], 0
    for fenced in _FENCED.finditer(text):
        parts += [_GAP.sub("\n\n", text[end : fenced.start()]), fenced[0]]
        end = fenced.end()
    return "".join([*parts, _GAP.sub("\n\n", text[end:])])


def for_students(page: str, text: str) -> str:
    """The page as a students' kit has it."""
    text = _MADE.sub("", text)
    if not _MARK.search(text):
        return text
    chosen = _STUDENTS.sub(lambda found: found[1], _WHOLE.sub("", text))
    left = _MARK.search(chosen)
    if left is not None:
        raise GraderFault(
            f"{page}: the mark `{left[0]}` stands alone; expected `<!-- whole kit -->` before `<!-- end -->`, "
            "and `<!-- students' kit: words -->`"
        )
    return _without_gaps(chosen)


def as_printed(text: str, step: Step) -> str:
    """What `check` prints of a right step there: the points of the visible part, and nothing hidden."""
    seen = number(max_points(step, judged=False))
    text = re.sub(rf"^({step.id} .*: passed, )([0-9.]+) of \2", rf"\g<1>{seen} of {seen}", text, flags=re.MULTILINE)
    return re.sub(r"^  hidden   all [0-9]+ passed\n", "", text, flags=re.MULTILINE)


def word_for_students(files: dict[str, bytes], steps: list[Step]) -> None:
    """All pages among the files."""
    for page in [name for name in files if name.endswith(".md")]:
        files[page] = for_students(page, files[page].decode()).encode()
    for step in steps:
        page = f"steps/{step.id}/README.md"
        if page in files:
            files[page] = as_printed(files[page].decode(), step).encode()
