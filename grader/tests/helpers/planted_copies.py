"""Copies as somebody makes them who does not want to be found: other names, another order, other spelling, and more.

What comes out need not build: it is read by what compares sources, and by nothing else."""

import random
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.stubs import placed_tokens

Change = Callable[[str, random.Random], str]

_NO_NAME = re.compile(
    r"(?:alignas|auto|bool|break|case|catch|char|class|const|constexpr|continue|default|delete|do|double|else|enum|"
    r"explicit|false|final|float|for|if|include|inline|int|long|namespace|new|noexcept|nullptr|operator|override|"
    r"private|public|return|short|signed|sizeof|static|static_cast|std|struct|switch|template|this|throw|true|try|"
    r"typename|unsigned|using|void|while|glm|raysteps|[iud]?vec\d|u?int\d+_t|size_t|ptrdiff_t)"
)
_SYLLABLES = ("ba", "ko", "mi", "tu", "re", "lan", "dor", "sig", "pex", "vul", "nor", "qui")


def _spliced(source: str, pieces: Sequence[tuple[int, int, str]]) -> str:
    out, at = [], 0
    for start, end, text in pieces:
        out += [source[at:start], text]
        at = end
    return "".join([*out, source[at:]])


def renamed(public: frozenset[str]) -> Change:
    """Every name that can be chosen gets another one: variables, parameters, helpers, own types."""

    def change(source: str, draw: random.Random) -> str:
        code = list(placed_tokens(source))
        new: dict[str, str] = {}
        pieces = []
        for at, (text, start) in enumerate(code):
            before = code[at - 1][0] if at else ""
            after = code[at + 1][0] if at + 1 < len(code) else ""
            member = before == "." or source[start - 2 : start] in ("->", "::")
            named = member or after in ("(", "{") or source.startswith("::", start + len(text))
            included = before in ("<", "/", "#", "include") or after in ("/", ">")
            if (named and text in public) or included or _NO_NAME.fullmatch(text) or not re.match(r"[a-z_]", text):
                continue
            if text not in new:
                new[text] = "".join(draw.choices(_SYLLABLES, k=3)) + str(len(new))
            pieces.append((start, start + len(text), new[text]))
        return _spliced(source, pieces)

    return change


def recommented(source: str, draw: random.Random) -> str:
    """No comment of the original is left; others stand elsewhere."""
    lines = [re.sub(r"\s*//.*", "", line) for line in source.splitlines()]
    said = ("// now the next part", "// as in the lecture", "/* important */", "// see the handout")
    out = []
    for line in lines:
        if line.strip().endswith(";") and draw.random() < 0.3:
            out.append(draw.choice(said))
        out.append(line)
    return "\n".join(out) + "\n"


def reformatted(source: str, draw: random.Random) -> str:
    """Brackets in lines of their own, other indentation, lines broken after commas."""
    source = re.sub(r"[ \t]*\{\n", "\n{\n", source)
    source = re.sub(r"^( +)", lambda found: " " * (len(found[1]) // 2), source, flags=re.M)
    return re.sub(r", ", lambda found: ",\n        " if draw.random() < 0.3 else ", ", source)


def respelled(source: str, draw: random.Random) -> str:
    """Literals: 0.5F becomes 5e-1f or .5f."""

    def number(found: re.Match[str]) -> str:
        whole, part = found[1], found[2]
        return draw.choice([f"{whole}.{part}f", f"{whole}.{part}0F", f"{whole}{part}e-{len(part)}f"])

    return re.sub(r"\b(\d)\.(\d+)F\b", number, source)


def retyped(source: str, draw: random.Random) -> str:
    """`const float a = ...` becomes `auto a = ...` or `double a = ...`."""

    def declared(found: re.Match[str]) -> str:
        wide = "double" if found[2] == "float" else "auto"
        return f"{found[1]}{draw.choice(['auto', 'const auto', found[2], wide])} "

    return re.sub(r"^( +)(?:const )?(float|int|double|glm::vec3|std::size_t) (?=\w+ =)", declared, source, flags=re.M)


def unqualified(source: str, draw: random.Random) -> str:
    """Without `glm::` and `std::`."""
    return re.sub(r"\b(?:glm|std)::", "", source).replace("namespace raysteps {", "namespace raysteps {\nusing glm;", 1)


def _closing(source: str, opening: int) -> int:
    depth = 0
    for at in range(opening, len(source)):
        depth += (source[at] == "{") - (source[at] == "}")
        if depth == 0:
            return at
    return len(source) - 1


def loops_turned(source: str, draw: random.Random) -> str:
    """`for` with a counter becomes `while`."""
    found = re.search(r"for \(([^;()]*);([^;]*);([^;()]*)\) \{", source)
    while found is not None:
        end = _closing(source, found.end() - 1)
        body = source[found.end() : end]
        source = (
            f"{source[: found.start()]}{found[1]};\n while ({found[2]}) {{{body} {found[3]};\n }}{source[end + 1 :]}"
        )
        found = re.search(r"for \(([^;()]*);([^;]*);([^;()]*)\) \{", source)
    return source


def _functions(source: str) -> tuple[str, list[str], str]:
    """What comes before the functions, these, and what comes after them."""
    parts = re.split(r"\n\n(?=\S)", source.strip())
    inner = [at for at, part in enumerate(parts) if re.search(r"\) (?:const )?(?:noexcept )?\{", part)]
    if not inner:
        return source, [], ""
    first, last = inner[0], inner[-1]
    return "\n\n".join(parts[:first]), parts[first : last + 1], "\n\n".join(parts[last + 1 :])


def reordered(source: str, draw: random.Random) -> str:
    """The functions of a file in another order."""
    head, functions, tail = _functions(source)
    draw.shuffle(functions)
    return "\n\n".join([head, *functions, tail]) + "\n"


def split_up(source: str, draw: random.Random) -> str:
    """Some lines of every long function in a helper of their own."""
    head, functions, tail = _functions(source)
    out = []
    for function in functions:
        lines = function.splitlines()
        inner = [at for at, line in enumerate(lines) if re.match(r" {4}\S.*;$", line) and "return" not in line]
        runs = [at for at in inner if at + 1 in inner and at + 2 in inner]
        if runs:
            start = draw.choice(runs)
            end = start + draw.choice([2, 3])
            helper = f"static void part{draw.randrange(1000)}(auto& one, auto& other) {{"
            out.append("\n".join([helper, *lines[start:end], "}"]))
            lines[start:end] = [f"    part{draw.randrange(1000)}(one, other);"]
        out.append("\n".join(lines))
    return "\n\n".join([head, *out, tail]) + "\n"


def padded(source: str, draw: random.Random) -> str:
    """Statements that do nothing, after every seventh or so."""
    out = []
    for line in source.splitlines():
        out.append(line)
        if re.match(r" {4,}\S.*;$", line) and "return" not in line and draw.random() < 0.15:
            spare = f"spare{draw.randrange(1000)}"
            out.append(draw.choice([f"    int {spare} = 0; (void){spare};", f"    if (false) {{ {spare}(); }}"]))
    return "\n".join(out) + "\n"


def swapped(source: str, draw: random.Random) -> str:
    """Half of the products and sums of two names the other way round."""

    def turned(found: re.Match[str]) -> str:
        return f"{found[3]} {found[2]} {found[1]}" if draw.random() < 0.5 else found[0]

    return re.sub(r"\b([a-z][\w.]*) ([*+]) ([a-z][\w.]*)\b(?!\()", turned, source)


def lines_swapped(source: str, draw: random.Random) -> str:
    """Some declarations change places with the one below."""
    lines = source.splitlines()
    for at in range(len(lines) - 1):
        both = [re.match(r" +(?:const )?[\w:]+ \w+ = .*;$", lines[at + near]) for near in (0, 1)]
        if all(both) and draw.random() < 0.3:
            lines[at], lines[at + 1] = lines[at + 1], lines[at]
    return "\n".join(lines) + "\n"


def light(public: frozenset[str]) -> list[Change]:
    """What takes five minutes."""
    return [recommented, renamed(public), reformatted]


def medium(public: frozenset[str]) -> list[Change]:
    """What takes half an hour."""
    return [recommented, retyped, respelled, reordered, renamed(public), unqualified, reformatted]


def heavy(public: frozenset[str]) -> list[Change]:
    """What takes an evening."""
    changes = [recommented, lines_swapped, swapped, split_up, loops_turned, retyped, respelled, padded, reordered]
    return [*changes, renamed(public), unqualified, reformatted]


def changed(source: str, changes: Sequence[Change], draw: random.Random) -> str:
    """One change after the other."""
    for change in changes:
        source = change(source, draw)
    return source


# Classes whose copies are known: honest submissions of files that nobody shares, and copies of some of them.

Submission = dict[str, str]


def honest_class(
    project: Project, steps: Sequence[Step], rooms: Sequence[str], draw: random.Random
) -> list[Submission]:
    """As many as most steps have files for; `rooms`: folders of grader/tests with files that were written apart."""
    tests = project.root / "grader" / "tests"
    found: dict[str, list[str]] = {}
    for step in steps:
        paths = [path for room in rooms for path in sorted((tests / room / step.id).glob("*/*.cpp"))]
        draw.shuffle(paths)
        found[step.id] = [path.read_text(encoding="utf-8") for path in paths]
    amount = sorted(map(len, found.values()))[len(found) // 2]
    return [{step: files[at] for step, files in found.items() if at < len(files)} for at in range(amount)]


@dataclass(frozen=True)
class Plant:
    """A copy, and the places of whom it was made from."""

    kind: str
    sources: Submission
    originals: frozenset[int]


def plants(honest: Sequence[Submission], public: frozenset[str], draw: random.Random) -> list[Plant]:
    """Whole submissions, copied with more and more care, and every other step of two."""
    made = []
    for name, changes in (("light", light(public)), ("medium", medium(public)), ("heavy", heavy(public))):
        of = draw.randrange(len(honest))
        copy = {step: changed(text, changes, draw) for step, text in honest[of].items()}
        made.append(Plant(f"whole, {name}", copy, frozenset({of})))
    for name, changes in (("medium", medium(public)), ("heavy", heavy(public))):
        pair = draw.sample(range(len(honest)), 2)
        both = {step: honest[pair[at % 2]].get(step, "") for at, step in enumerate(sorted(honest[pair[0]]))}
        copy = {step: changed(text, changes, draw) for step, text in both.items() if text}
        made.append(Plant(f"of two, {name}", copy, frozenset(pair)))
    return made


def with_step_of(
    honest: Submission, other: Submission, step: str, changes: Sequence[Change], draw: random.Random
) -> Submission:
    """One's own work but for one step."""
    return {**honest, step: changed(other[step], changes, draw)}
