"""What there is in a Markdown text: blocks of code, headings, links, formulas."""

import re
from collections.abc import Callable
from dataclasses import dataclass

_FENCE = re.compile(
    r"^(?P<indent> {0,3})(?P<fence>`{3,}|~{3,})(?P<tag>[^`\n]*)\n(?P<body>.*?)^ {0,3}(?P=fence)[ \t]*$",
    re.MULTILINE | re.DOTALL,
)
_HEADING = re.compile(r"^#{1,6}[ \t]+(.+?)[ \t#]*$", re.MULTILINE)
_CODE = re.compile(r"(?<!`)(`+)(?!`)(.+?)(?<!`)\1(?!`)", re.DOTALL)
_LINK = re.compile(r"\[(?P<text>(?:[^\[\]]|\[[^\[\]]*\](?:\([^()]*\))?)*)\]\((?P<target>[^()\s]+)\)")
_FORMULA = re.compile(r"\$\$(.+?)\$\$|(?<![\\$\w])\$(?![\s$])([^$]+?)(?<![\s\\])\$(?![\w$])", re.DOTALL)


@dataclass(frozen=True)
class Block:
    """A fenced block of code; `line` is that of its first line of text, from 1. The body is without what the fence, as
    within a list, is indented by."""

    tag: str
    body: str
    line: int


def _block(text: str, found: re.Match[str]) -> Block:
    body = re.sub(rf"^ {{0,{len(found['indent'])}}}", "", found["body"], flags=re.MULTILINE)
    return Block(found["tag"].strip(), body, text.count("\n", 0, found.start("body")) + 1)


def blocks(text: str) -> list[Block]:
    """All fenced blocks, in order."""
    return [_block(text, found) for found in _FENCE.finditer(text)]


def with_tags(text: str, tag: Callable[[Block], str]) -> str:
    """The text with other words behind the fences."""

    def changed(found: re.Match[str]) -> str:
        start, end = (at - found.start() for at in found.span("tag"))
        return f"{found[0][:start]}{tag(_block(text, found))}{found[0][end:]}"

    return _FENCE.sub(changed, text)


def _blank(found: re.Match[str]) -> str:
    return re.sub(r"[^\n]", " ", found[0])


def prose(text: str) -> str:
    """The text with spaces in place of all code: every line and column stays where it was."""
    return _CODE.sub(_blank, _FENCE.sub(_blank, text))


def code_spans(text: str) -> list[tuple[int, str]]:
    """What stands between backticks in prose, with the line that it begins in."""
    plain = _FENCE.sub(_blank, text)
    return [(plain.count("\n", 0, found.start()) + 1, " ".join(found[2].split())) for found in _CODE.finditer(plain)]


def slug(heading: str) -> str:
    """The anchor of a heading, as a forge makes it."""
    words = _LINK.sub(lambda found: found["text"], heading)
    return re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", words.lower().strip()))


def anchors(text: str) -> set[str]:
    """Every anchor of a document; a heading that comes again gets a number."""
    made: set[str] = set()
    for found in _HEADING.finditer(_FENCE.sub(_blank, text)):
        plain = slug(found[1])
        numbered = (f"{plain}-{number}" if number else plain for number in range(len(made) + 1))
        made.add(next(name for name in numbered if name not in made))
    return made


def targets(text: str) -> list[tuple[int, str]]:
    """Where links and pictures lead, with their lines. A link around a picture is two."""
    plain = prose(text)
    found = re.finditer(r"\]\(([^()\s]+)\)", plain)
    return [(plain.count("\n", 0, one.start()) + 1, one[1]) for one in found]


def with_targets(text: str, new: Callable[[str], str]) -> str:
    """The text with other targets of its links and pictures."""
    spans = [(one.start(1), one.end(1)) for one in re.finditer(r"\]\(([^()\s]+)\)", prose(text))]
    for start, end in reversed(spans):
        text = text[:start] + new(text[start:end]) + text[end:]
    return text


def unlinked(text: str, is_known: Callable[[str], bool]) -> str:
    """The text with only the words of a link, or of a picture, whose target is not known."""
    for found in reversed(list(_LINK.finditer(prose(text)))):
        start, end = found.span()
        words = unlinked(text[slice(*found.span("text"))], is_known)  # a picture may be what is linked
        if is_known(found["target"]):
            text = f"{text[: start + 1]}{words}]({found['target']}){text[end:]}"
        else:
            text = text[: start - (text[:start].endswith("!"))] + words + text[end:]
    return text


def with_formulas(text: str, new: Callable[[str, bool], str]) -> str:
    """The text with something else in place of its formulas; the second word is whether one has lines of its own."""
    for found in reversed(list(_FORMULA.finditer(prose(text)))):
        start, end = found.span()
        text = text[:start] + new(found[1] or found[2], found[1] is not None) + text[end:]
    return text


def formulas(text: str) -> list[str]:
    """What stands between dollars."""
    return [found[1] or found[2] for found in _FORMULA.finditer(prose(text))]


# Formulas become MathML, which a page shows without a script.

_BARE = re.compile(r"\\[dt]?frac(?!\s*\{)")


class BadFormula(ValueError):
    """What cannot be shown, and why."""


def mathml(formula: str, *, block: bool) -> str:
    """One element `math`."""
    from docutils.utils.math import MathError  # for who makes pages of documents; others do without
    from docutils.utils.math.latex2mathml import tex2mathml

    bare = _BARE.search(formula)
    if bare:
        raise BadFormula(f"{formula}: expected braces after {bare[0]}, like \\frac{{1}}{{2}}")
    plain = re.sub(r"\\[{}]", "", formula)
    if plain.count("{") != plain.count("}"):
        raise BadFormula(f"{formula}: expected a closing brace for each opening one")
    try:
        made: str = tex2mathml(formula, as_block=block)
    except (MathError, SyntaxError, KeyError, IndexError) as error:
        raise BadFormula(f"{formula}: {error}") from error
    return re.sub(r">\s+<", "><", made)
