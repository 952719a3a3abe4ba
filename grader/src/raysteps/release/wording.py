"""Words of the pages that one kind of kit has and the other has not, marked by comments in the Markdown."""

import re

from raysteps.common.errors import GraderFault

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


def word_for_students(files: dict[str, bytes]) -> None:
    """All pages among the files."""
    for page in [name for name in files if name.endswith(".md")]:
        files[page] = for_students(page, files[page].decode()).encode()
