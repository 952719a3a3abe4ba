"""Takes C++ apart into tokens: enough to tell code from comments, strings and white space."""

import re

# No alternative may give up after a long run, or a source made for it would take for ever: so an open string goes on to
# the end of its line.
# A backslash at the end of a line joins it with the next, even within a name or a comment mark.
_J = r"(?:\\\n)*"
_PREFIX = rf"(?:u{_J}8|[uUL])?"
_TOKEN = re.compile(
    rf"""
    (?P<newline>\n)
  | (?P<space>[^\S\n]+|\\\n)
  | (?P<line_comment>/{_J}/(?:\\\n|[^\n])*)
  | (?P<block_comment>/{_J}\*)
  | (?P<raw>{_PREFIX}{_J}R{_J}"(?P<delimiter>[^\s()\\"]{{0,16}})\()
  | (?P<string>{_PREFIX}{_J}(?:"(?:\\(?:.|\n)|[^"\\\n])*"?|'(?:\\(?:.|\n)|[^'\\\n])*'?))
  | (?P<number>\.?{_J}[0-9](?:{_J}(?:[eEpP]{_J}[+-]|'{_J}\w|[\w.]))*)
  | (?P<name>[^\W\d](?:{_J}\w)*)
  | (?P<other>.)
    """,
    re.VERBOSE,
)
_BLOCK_END = re.compile(rf"\*{_J}/")


def _end_of_rest(source: str, kind: str, found: re.Match[str]) -> int:
    """Where a block comment or raw string ends: at its mark, or with the file when there is none."""
    if kind == "block_comment":
        closed = _BLOCK_END.search(source, found.end())
        return len(source) if closed is None else closed.end()
    mark = f'){found["delimiter"]}"'
    at = source.find(mark, found.end())
    return len(source) if at < 0 else at + len(mark)


def tokens(source: str) -> list[str]:
    """Names, numbers, strings and single signs in their order; a newline stands where it ends a directive."""
    source = source.replace("\r\n", "\n")
    result: list[str] = []
    position, fresh_line, directive = 0, True, False
    while position < len(source):
        found = _TOKEN.match(source, position)
        assert found is not None  # some alternative takes any character
        kind = found.lastgroup if found.lastgroup != "delimiter" else "raw"
        assert kind is not None
        position = found.end()
        if kind in ("block_comment", "raw"):
            position = _end_of_rest(source, kind, found)
        text = source[found.start() : position]
        if kind == "newline":
            if directive:
                result.append("\n")
            fresh_line, directive = True, False
        elif kind == "raw":
            result.append(text)
            fresh_line = False
        elif kind in ("string", "number", "name", "other"):
            directive = directive or (fresh_line and text == "#")
            result.append(text.replace("\\\n", ""))
            fresh_line = False
    return [*result, "\n"] if directive else result
