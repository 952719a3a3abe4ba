"""Makes the stubs from the marked regions of solutions/."""

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise, zip_longest
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_if_changed
from raysteps.common.text import join_and
from raysteps.course.manifest import Step
from raysteps.course.project import Project

# Takes C++ apart into tokens: enough to tell code from comments, strings and white space.

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


def placed_tokens(source: str) -> Iterator[tuple[str, int]]:
    """Names, numbers, strings and single signs in their order, and where each begins; a newline stands where it ends a
    directive."""
    position, fresh_line, directive = 0, True, False
    while position < len(source):
        found = _TOKEN.match(source, position)
        assert found is not None  # some alternative takes any character
        kind = found.lastgroup if found.lastgroup != "delimiter" else "raw"
        assert kind is not None
        start, position = found.start(), found.end()
        if kind in ("block_comment", "raw"):
            position = _end_of_rest(source, kind, found)
        text = source[start:position]
        if kind == "newline":
            if directive:
                yield "\n", start
            fresh_line, directive = True, False
        elif kind == "raw":
            yield text, start
            fresh_line = False
        elif kind in ("string", "number", "name", "other"):
            directive = directive or (fresh_line and text == "#")
            yield text.replace("\\\n", ""), start
            fresh_line = False
    if directive:
        yield "\n", position


def tokens(source: str) -> list[str]:
    """The same without the places."""
    return [text for text, _ in placed_tokens(source.replace("\r\n", "\n"))]


_BEGIN = re.compile(r"^(\s*)// BEGIN SOLUTION(?: (\S.*))?$")
_END = re.compile(r"^\s*// END SOLUTION$")
_MARKER = re.compile(r"^\s*// (BEGIN SOLUTION|END SOLUTION|TODO:|RETURN )")


@dataclass(frozen=True)
class MarkedRegion:
    """What students write themselves: a function, or without a name a helper of the solution."""

    indent: str
    name: str | None
    line: int
    marked: list[str]  # with what the stub is made of

    @property
    def body(self) -> list[str]:
        return [line for line in self.marked if not _MARKER.match(line)]


def _pieces(solution: str, where: str) -> Iterator[str | MarkedRegion]:
    """Its lines in their order, those of a region as one."""
    region: MarkedRegion | None = None
    for number, line in enumerate(solution.splitlines(), start=1):
        begin = _BEGIN.match(line)
        if begin is not None:
            if region is not None:
                raise GraderFault(f"{where}: a region begins inside another")
            region = MarkedRegion(begin.group(1), begin.group(2), number, [])
        elif _END.match(line):
            if region is None:
                raise GraderFault(f"{where}: END SOLUTION without BEGIN SOLUTION")
            yield region
            region = None
        elif region is not None:
            region.marked.append(line)
        else:
            yield line
    if region is not None:
        raise GraderFault(f"{where}: a region has no END SOLUTION")


def solution_regions(solution: str, where: str) -> list[MarkedRegion]:
    """The marked regions."""
    return [piece for piece in _pieces(solution, where) if isinstance(piece, MarkedRegion)]


def _stub_lines(region: MarkedRegion, step: Step, where: str) -> list[str]:
    if region.name is None:
        return []
    todo = [line for line in region.marked if line.strip().startswith("// TODO: ")]
    returns = [line.strip() for line in region.marked if line.strip().startswith("// RETURN")]
    if len(todo) != 1 or len(returns) > 1:
        raise GraderFault(f"{where}: region {region.name} needs one TODO line and at most one RETURN line")
    lines = [todo[0], f'{region.indent}RAYSTEPS_TODO("{step.id}", "{region.name}");']
    if returns and returns[0] != "// RETURN":
        lines.append(f"{region.indent}return {returns[0].removeprefix('// RETURN ')};")
    return lines


def make_stub(solution: str, step: Step, keep: Collection[str] = ()) -> str:
    """The student's starting point: every named region becomes a TODO, unnamed regions vanish. `keep`: functions that
    stay as they are in the solution, with all unnamed regions."""
    where = f"solutions/{step.path.as_posix()}"
    out: list[str] = []
    names: list[str] = []
    drop_blank = False
    for piece in _pieces(solution, where):
        if isinstance(piece, str):
            if not (drop_blank and not piece.strip()):
                out.append(piece)
            drop_blank = False
            continue
        kept = bool(keep) if piece.name is None else piece.name in keep
        out += piece.body if kept else _stub_lines(piece, step, where)
        names += [piece.name] if piece.name else []
        drop_blank = piece.name is None and not kept and (not out or not out[-1].strip())
    if sorted(names) != sorted(step.functions):
        found, listed = join_and(names or ["none"]), join_and(step.functions)
        raise GraderFault(f"{where}: its regions are {found}, but [functions] of step.toml has {listed}")
    return "\n".join(out).rstrip() + "\n"


def without_markers(solution: str) -> str:
    """The solution as a student would hand it in."""
    return "\n".join(line for line in solution.splitlines() if not _MARKER.match(line)).rstrip() + "\n"


def unfinished_functions(source: str, step: Step) -> list[str]:
    """The functions whose RAYSTEPS_TODO line is still in the source (a commented-out one is not)."""
    code = tokens(source)
    called = [code[at : at + 6] for at, word in enumerate(code) if word == "RAYSTEPS_TODO"]
    left = {call[4] for call in called if len(call) == 6 and (call[1], call[3], call[5]) == ("(", ",", ")")}
    return [name for name in step.functions if f'"{name}"' in left]


# No types, though they stand where one may.
_WORDS_OF_CODE = {"return", "else", "do", "case", "default", "goto", "throw", "new", "delete", "sizeof", "using"} | {
    "co_return", "co_yield", "co_await", "and", "or", "not",
}  # fmt: skip
_LINKAGE = ('"C"', '"C++"')
_STATEMENT_ENDS = frozenset(";{}\n")
_OF_TYPES = frozenset(":<>,&*[]")
_GO_ON = (",", "<", ":", "[")  # whatever stands before, a type does not end with one of these
_MAX_BEFORE = 100  # tokens of a declaration before its name


def _is_declared(code: Sequence[str], at: int) -> bool:
    """Whether a type, and nothing but a type, stands between the name there and the statement before."""
    first = at
    while first > 0 and at - first < _MAX_BEFORE and code[first - 1] not in _STATEMENT_ENDS:
        first -= 1
    before = list(code[first:at])
    while before[-2:] == [":", ":"]:  # names that it is qualified by
        del before[-3:]
    if not before or before[-1] in _GO_ON or before[-2:] == ["&", "&"] or before[0].isdigit():
        return False
    words = [word for word in before if word not in _OF_TYPES]
    return all(
        (word.isidentifier() and word not in _WORDS_OF_CODE) or word.isdigit() or word in _LINKAGE for word in words
    )


def _places(source: str, names: Collection[str]) -> Iterator[tuple[str, int, bool]]:
    """Where these names stand, and whether something is declared or defined there."""
    placed = list(placed_tokens(source)) if names else []
    code = [text for text, _ in placed]
    return ((word, placed[at][1], _is_declared(code, at)) for at, word in enumerate(code) if word in names)


def uses(source: str, names: Collection[str]) -> Iterator[tuple[str, int]]:
    """Where the source asks for something by one of these names, not where it declares or defines that."""
    return ((word, at) for word, at, is_declared in _places(source, names) if not is_declared)


def called_functions(source: str, names: Collection[str]) -> set[str]:
    """Those that the source calls by name."""
    return {name for name, _ in uses(source, names)}


def borrowed_functions(source: str, names: Collection[str]) -> set[str]:
    """Those that the source calls by name and has not of its own; none where it depends on conditions what it calls."""
    found = list(_places(source, names))
    borrowed = {name for name, _, _ in found} - {name for name, _, is_declared in found if is_declared}
    if borrowed and any(mark == "#" and word.startswith("if") for mark, word in pairwise(tokens(source))):
        return set()
    return borrowed


def same_code(one: str, other: str) -> bool:
    """Whether two sources differ in comments and white space only."""
    both = ((text for text, _ in placed_tokens(source.replace("\r\n", "\n"))) for source in (one, other))
    return all(mine == theirs for mine, theirs in zip_longest(*both))  # as far as they are the same: one may be huge


def stub_for(project: Project, step: Step) -> str:
    """What the solution generates for this step."""
    return make_stub((project.solutions / step.path).read_text(encoding="utf-8"), step)


_UNTIL_IT_IS_WRITTEN = '"core/unfinished.hpp"'


def included(source: str) -> list[str]:
    """The headers of a file's include lines, with their brackets or quotation marks; none where it depends on
    conditions what is included. What only a stub needs is left out."""
    lines = " ".join(text for text, _ in placed_tokens(source)).split("\n")
    if any(line.strip().startswith("# if") for line in lines):
        return []
    found = (line.strip().removeprefix("# include ") for line in lines if line.strip().startswith("# include "))
    return [name for name in (name.replace(" ", "") for name in found) if name != _UNTIL_IT_IS_WRITTEN]


def pristine_stub(project: Project, step: Step) -> str:
    """The step as the student got it: made from the solution, or where there are none, as the kit keeps it."""
    if project.has_reference:
        return stub_for(project, step)
    path = project.stubs / step.path
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise GraderFault(f"{path}: expected the stub of {step.id}; take it from a fresh copy of the kit") from error


def begun_source(project: Project, step: Step, data: bytes | None) -> str | None:
    """The text of a student's file; None where there is none, or where its code is the stub's."""
    if data is None:
        return None
    text = data.decode("utf-8", "replace")
    return None if same_code(text, pristine_stub(project, step)) else text


def _stub_files(project: Project, steps: list[Step]) -> dict[Path, bytes]:
    """Path and content, where students write."""
    return {project.steps / step.path: stub_for(project, step).encode() for step in steps}


def outdated_stubs(project: Project, steps: list[Step]) -> list[Path]:
    """The files that differ from what the solutions generate."""
    return [
        path for path, data in _stub_files(project, steps).items() if not path.is_file() or path.read_bytes() != data
    ]


def write_stubs(project: Project, steps: list[Step]) -> list[Path]:
    """Writes all stubs; returns the files that changed."""
    return [path for path, data in _stub_files(project, steps).items() if write_if_changed(path, data)]
