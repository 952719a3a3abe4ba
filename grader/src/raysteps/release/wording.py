"""Words of the pages that one kind of kit has and the other has not, marked by comments in the Markdown."""

import re

from raysteps.common.errors import GraderFault
from raysteps.common.text import number
from raysteps.grading.scoring import most_points
from raysteps.kit.manifest import Step

# A mark on a line of its own goes with the line; marks within a line leave the rest of it as it is.
_WHOLE = re.compile(
    r"^<!-- whole kit -->\n.*?^<!-- end -->\n|<!-- whole kit -->.*?<!-- end -->", re.MULTILINE | re.DOTALL
)
_STUDENTS = re.compile(r"<!-- students' kit:\s*(.*?)\s*-->", re.DOTALL)
_MARK = re.compile(r"<!-- *(?:whole kit|end|students' kit)\b")
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
    whole, seen = number(most_points(step, judged=True)), number(most_points(step, judged=False))
    text = text.replace(f": passed, {whole} of {whole}", f": passed, {seen} of {seen}")
    return re.sub(r"^  hidden   all [0-9]+ passed\n", "", text, flags=re.MULTILINE)


def word_for_students(files: dict[str, bytes], steps: list[Step]) -> None:
    """All pages among the files."""
    for page in [name for name in files if name.endswith(".md")]:
        files[page] = for_students(page, files[page].decode()).encode()
    for step in steps:
        page = f"steps/{step.id}/README.md"
        if page in files:
            files[page] = as_printed(files[page].decode(), step).encode()
