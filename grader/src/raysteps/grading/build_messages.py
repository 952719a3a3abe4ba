"""What a failed build says to a student: the first real error in the student's own file, and the lines around it."""

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from raysteps.common.text import join_and, nearest, printable, shorten
from raysteps.course.manifest import Step, read_all_steps
from raysteps.course.stubs import borrowed_functions, included, same_code, uses
from raysteps.results.statuses import NOT_BUILT
from raysteps.sandbox.task import TaskResult
from raysteps.toolchain.compile import Compiled, clean_log, unqualified_name
from raysteps.toolchain.kit_artifacts import BuiltKit, function_name

_MAX_READ = 1 << 20  # characters of what a compiler or linker said that are looked through
_MAX_MORE = 3  # errors that are told in a line each, besides the first
# GCC counts no columns in a line that is too long.
_PLACE = r"^(?P<path>(?:[A-Za-z]:)?[^\s:][^:\n]*):(?P<line>\d{1,7})(?::(?P<column>\d{1,7}))?:"
_ERROR = re.compile(_PLACE + r" (?:fatal )?error: (?P<text>.+)$", re.M)
_CAUSE = re.compile(_PLACE + r"(?:   required from here| note: in instantiation of )", re.M)  # of an error in a header
_MICROSOFT_ERROR = re.compile(
    r"^(?P<path>[^\n(]+)\((?P<line>\d{1,7})(?:,(?P<column>\d{1,7}))?\): (?:fatal )?error (?P<text>C\d+: .+)$", re.M
)
# What follows the first words of a message is read once, however often these words come again: a source can shape them.
_MISSING = re.compile(  # what is a warning only is nowhere to be found yet, such as what a box will have
    r"(?<!warning: )undefined reference to [`'](?P<name>[^`'\n]+)'"
    r"|(?<!warning: )(?:undefined|unresolved external) symbol:? \"?(?P<other>[^\s\"][^\"\n]*)"
)
_TWICE = re.compile(
    r"(?:multiple definition of|duplicate symbol:?) [`'\"]?(?P<name>[^`'\"\n]+)"
    r"|LNK2005: \"?(?P<theirs>[^\s\"][^\"\n]*)"
)

_LAST_WORDS = re.compile(r"ld returned \d+ exit status|linker command failed|^compilation terminated")  # why is above


@dataclass(frozen=True)
class _Error:
    file: str
    line: int
    column: int  # 0: not told
    text: str


def _errors(output: str) -> list[_Error]:
    """As GCC and Clang write them, or else as Microsoft's compiler does, which knows no columns."""
    found = list(_ERROR.finditer(output)) or list(_MICROSOFT_ERROR.finditer(output))
    return [_error_at(one, one["text"]) for one in found]


def _error_at(place: re.Match[str], text: str) -> _Error:
    file = shorten(re.split(r"[/\\]", place["path"])[-1], 200)  # a source can say that its lines come from any
    return _Error(file, int(place["line"]), int(place["column"] or 0), text)


def _caused_by(output: str, file: str, error: _Error) -> list[_Error]:
    """An error in a header, such as in std::max, at the line of the file that asked for it; none where none did."""
    causes = (_error_at(one, error.text) for one in _CAUSE.finditer(output))
    return [cause for cause in causes if cause.file == file][:1]


def errors_in(output: str, file: str) -> bool:
    """Whether the compiler complains about the file of this name."""
    return any(error.file == file for error in _errors(output))


def _context(source: str, line: int, column: int) -> str:
    """The line with one before and one after, and a mark under the column."""
    lines = source.removesuffix("\n").split("\n")  # as a compiler counts them, which knows no other end of a line
    shown = []
    for number in range(max(1, line - 1), min(len(lines), line + 1) + 1):
        text = printable(lines[number - 1]).removesuffix("\n").replace("\n", " ")  # a lone \r is no end
        shown.append(f"{number:5} | {shorten(text, 160)}")
        if number == line and 0 < column <= 160:
            shown.append(f"      | {' ' * (column - 1)}^")
    return "\n".join(shown)


def _more(errors: list[_Error]) -> str:
    """Those that follow, of which the first may be the cause."""
    _, *others = dict.fromkeys((error.line, error.text) for error in errors)
    told = "".join(f"\n{line:5} | {shorten(text, 160)}" for line, text in others[:_MAX_MORE])
    further = f"\n      | and {len(others) - _MAX_MORE} more" if len(others) > _MAX_MORE else ""
    return f"\nMore errors, which may all come from that one:{told}{further}" if others else ""


# What errors mean that many meet first who are new to C++ and glm, as GCC, Clang and Microsoft's compiler write them.
# JavaScript reads these patterns, too.
_STRAY_BRACE = r"expected declaration before '}'|extraneous closing brace"
IN_OTHER_WORDS = (
    (
        _STRAY_BRACE,
        "There is one } too many, here or above: it ends namespace raysteps early, and names of the kit mean nothing "
        "behind it.",
    ),
    (
        r"\u27e8U\+|character <U\+"
        "(?:00AD|034F|061C|115F|1160|17B[45]|180[B-F]|20(?:0[B-F]|2[89A-E]|6)|3164|F(?:E(?:0|FF)|FA0|FF[0-9AB]))",
        "There is a sign in it that nobody sees, as copied text may have: delete what stands there, and type it anew.",
    ),
    (
        r"(?:'operator[-+*/]=?'(?: in '.*')? \(operand types are|invalid operands|C267[6-9]: binary '[-+*/])"
        r"(?=.*'(?:const )?(?:glm::)?vec\W?\d)(?=.*'(?:const )?(?:unsigned |long )*(?:int|double|long)\b)",
        "A vector of glm takes floats only: write 2.0F, not 2 or 2.0, or float(x).",
    ),
    (
        r"(?:no matching function for call to|C2672:) '(?:std::|glm::)?(?:max|min|clamp|mix)\b",
        "All its arguments must be of one type: beside a float 0.0F, not 0 or 0.0.",
    ),
    (
        r"'__comp' cannot be used as a function|called object type '\w+' is not a function|C2064:",
        "std::max and std::min take two numbers; for three write std::max({a, b, c}).",
    ),
    (
        r"'(?:const )?(?:class |struct )?std::optional<.*has no member"
        r"|(?:no member named .* in|is not a member of) '(?:const )?std::optional<",
        "A std::optional may hold nothing: ask has_value() first, then write -> in place of the dot.",
    ),
    (
        r"(?:convert(?: '.*'| argument \d+)? from|conversion from(?: returned value of type)?|cannot convert"
        r"|from expression of type) '(?:const )?(?:class )?std::optional<(?!.* to .*'(?:const )?std::optional<)"
        r"|(?:no match for 'operator(?!=' \(operand types are 'std::optional)|invalid operands|C267[6-9]:)"
        r".*'(?:const )?std::optional<",
        "A std::optional may hold nothing: ask has_value() first, then write * before it for what it holds.",
    ),
    (
        r"no declaration matches|out-of-line definition of .* does not match|C2511:",
        "It must stand here as the header declares it: the same arguments, with const and & where it has them.",
    ),
    (
        r"(?:(?:is not a member of|no (?:member|type|template) named .* in namespace) '(?:std|glm)'"
        r"|in namespace '(?:std|glm)' does not name a (?:template )?type)(?!.*did you mean)",
        "Is it spelled right, and is the header that declares it included, such as <cmath> for std::sqrt?",
    ),
    (
        r"base operand of '->' has non-pointer|member reference type .* is not a pointer|C2819:",
        "What is no pointer has its members behind a dot: write . in place of ->.",
    ),
    (
        r"could not convert .* to |cannot convert '|conversion from '.*' to |invalid initialization of reference"
        r"|no match for 'operator='|no viable (?:conversion from|overloaded '=')"
        r"|cannot initialize (?:a|return) |assigning to .* from incompatible type|C2440:|C2664:",
        "It is of one type, and another is asked for here: compare both with what the header says.",
    ),
    (
        r"No such file or directory$|file not found$|C1083:",
        "The lines with #include that the stub has are enough: paths begin below the kit's framework or at steps/.",
    ),
    (
        r"does not name a (?:template )?type|was not declared in this scope|has not been declared|unknown type name"
        r"|use of undeclared identifier|C2065:|C2061:|C3861:",
        "The compiler has not met this name above: is it spelled as where it is declared, and is that file included?",
    ),
    (
        r"function.definition is not allowed here|expected '}'(?: at end of input)?$|C1075:|C2601:",
        "A closing brace is missing somewhere above: each { needs one.",
    ),
    (
        r"expected (?:(?:',' or )?';'|initializer before)|C2143: .*';'|C2146: .*';'",
        "A semicolon is missing, here or at the end of the line before.",
    ),
    (
        r"binary 'operator[%^]'|C229[67]: '[%^]'"
        r"|invalid operands to binary expression \('(?:const )?(?:float|double|int)' "
        r".*and '(?:const )?(?:float|double|int)'",
        "Operators of whole numbers, such as ^ and %, take no floats: a power is std::pow(a, b) or a * a, a remainder "
        "std::fmod(a, b).",
    ),
    (
        r"extended character|stray '\\\d|unexpected character <U\+|non-ASCII|C3872:|C2018:",
        'This sign looks like one of C++, but is another: type it anew, such as " for a curved quote, - for a dash.',
    ),
    (
        r"redefinition of (?!default)|C2084:",
        "It is defined twice, in this file or in a header that it includes: keep one of them, or give yours another "
        "name.",
    ),
    (
        r"discards qualifiers|read-only|cannot assign to .* const|C2166:|C3490:",
        "What is const stays as it is: change a copy, or mark a function that changes nothing as const.",
    ),
)


def _plain(error: _Error) -> str:
    return re.sub("[\u2018\u2019]", "'", shorten(error.text))


def _other_words(errors: list[_Error]) -> str:
    """The first error as a line of its own, for what many meet first; else nothing. A brace too many has all of its
    errors behind it, and may be told after them."""
    texts = list(map(_plain, errors))
    text = next((one for one in texts if re.search(_STRAY_BRACE, one)), texts[0])
    found = next((words for pattern, words in IN_OTHER_WORDS if re.search(pattern, text)), None)
    return "" if found is None else f"\n{found}"


def compile_message(step: Step, source: str, ran: TaskResult) -> str:
    """One sentence, the place, the lines, and what else."""
    if ran.hung:
        seconds = f"{ran.outcome.seconds:.0f} s"
        return f"{NOT_BUILT}the compiler was stopped after {seconds}; such a file takes about a second."
    if ran.stopped == "memory":
        return f"{NOT_BUILT}the compiler needed more memory than it may have."
    output = printable((ran.outcome.stderr or ran.outcome.stdout)[:_MAX_READ])
    errors = _errors(output)
    own = [error for error in errors if error.file == step.file]
    own = own or [error for first in errors[:1] for error in _caused_by(output, step.file, first)]
    for error in own or errors:
        place = f"{error.file}:{error.line}" + (f":{error.column}" if error.column else "")
        said = shorten(error.text, 300)
        text = f"{NOT_BUILT}{place}: {said}"
        if own:
            text += f"\n{_context(source, error.line, error.column)}{_other_words(own)}{_more(own)}"
        return text
    if "File size limit exceeded" in output:
        return f"{NOT_BUILT}what the compiler makes of it is larger than a file may be. Is there a huge array?"
    if "relocation truncated to fit" in output:
        return f"{NOT_BUILT}its variables take more than 2 GB. Is there a huge array?"
    if is_of_a_linker(output):
        return link_message(ran)
    lines = [line for line in output.splitlines() if line.strip() and not _LAST_WORDS.search(line)]
    telling = [line for line in lines if re.search("error:|terminated|Error", line)]
    said = shorten(clean_log("".join(telling[-1:] or lines[:1])), 300)
    return f"{NOT_BUILT}{said}" if said else f"{NOT_BUILT}the compiler gave up and said nothing."


# Names as a linker writes them, and as a header does. JavaScript reads these patterns, too.
AS_IN_A_HEADER = (
    (r"\bglm::vec<([234]), float, \(glm::qualifier\)0>", r"glm::vec\1"),
    (r"\bstd::span<([\w:]{1,60}) const, \d{1,20}ul>", r"std::span<const \1>"),
    (r"\b([\w:]{1,60}(?:<[^<>]{1,60}>)?) const([&*])", r"const \1\2"),
)
_MAX_DEFINED = 200  # functions that are compared
_DEFINED = re.compile(r"\b(\w{1,60})\s?\([^;{}()]{0,500}\)\s{0,3}(?:const\s{0,3})?\{")


def defines(source: str, name: str) -> bool:
    """Whether it has a function of that name, whatever its arguments."""
    return name in _DEFINED.findall(source)


def _as_in_a_header(name: str) -> str:
    for pattern, plain in AS_IN_A_HEADER:
        name = re.sub(pattern, plain, name)
    return name


def _in_its_place(names: tuple[str, ...], source: str) -> str:
    """A line about what the file has that may be meant to be the first of these, or nothing."""
    if not source.strip():
        return "\nThe file is empty. Was it saved? `reset` with the number of the step puts the stub there."
    if same_code(source, ""):
        return "\nThe file holds nothing but comments. Is the code commented out?"
    name = names[0].partition("(")[0].rpartition("::")[2]
    defined = list(dict.fromkeys(_DEFINED.findall(source)))[:_MAX_DEFINED]
    if name in defined and re.search(rf"\binline\b[^;{{}}()]{{0,200}}\b{name}\s?\(", source):
        return f"\nThe file has {name}, but marked as inline, so that only the file itself can call it."
    if "::" in names[0].partition("(")[0].replace("raysteps::", "") and name in defined:
        return ""  # of another class: with other arguments than the class tells, it would not compile
    if name in defined:
        return f"\nThe file has {name}, but with other arguments than the header's, or outside of namespace raysteps."
    other = next((one for one in defined if one.lower() == name.lower()), None) or nearest(name, defined)
    return f"\nThe file has {other}: is that meant to be {name}? Upper and lower case differ, too." if other else ""


_COUNTERS = "thread_stats"  # as a source asks for them


def _at_its_use(message: str, step: Step, names: Collection[str], source: str) -> str:
    """The same with the place and the lines where the source first asks for one of these, if it does so itself."""
    found = next(uses(source, names), None)
    if found is None:
        return message
    _, at = found
    line, column = source.count("\n", 0, at) + 1, at - source.rfind("\n", 0, at)
    place = f"{step.file}:{line}:{column}"
    first, *more = message.removeprefix(NOT_BUILT).splitlines()
    return "\n".join([f"{NOT_BUILT}{place}: {first}", _context(source, line, column), *more])


def _of_counters(name: str) -> bool:
    return "t_stats" in name


def forbidden_message(step: Step, names: tuple[str, ...], owners: dict[str, tuple[Step, str]]) -> str:
    """A step that asks for what is not its own. `owners`: of functions of other steps, and how C++ writes these."""
    for name in names:
        if _of_counters(name):
            return f"{NOT_BUILT}it reaches for the counters of the grader, which are none of its business."
        other, _ = owners.get(name, (step, ""))
        if other.index > step.index:
            return later_message(other)
        if other.index < step.index:
            mine = [owners[one][1] for one in names if one in owners and owners[one][0] == other]
            return barred_message(step, other.id, list(map(function_name, mine)))
    return f"{NOT_BUILT}it calls a function of the kit that is not for the steps."


def later_message(other: Step) -> str:
    """A step that calls a function of this one."""
    return f"{NOT_BUILT}it calls a function of step {other.id}, which comes later."


def barred_message(step: Step, other: str, functions: list[str]) -> str:
    """A step that calls these functions of another, earlier one, by its id, though its manifest bars them."""
    return (
        f"{NOT_BUILT}step {step.id} may not call {join_and(functions)} of step {other}, which "
        f"{'do' if len(functions) > 1 else 'does'} what step {step.id} is about. Write it in {step.file} itself."
    )


def barred_here(step: Step, barred: Collection[str], source: str) -> str:
    """The same of those that it calls, with the place."""
    other = next(place for place, name in step.barred if name in barred)
    functions = [name for place, name in step.barred if place == other and name in barred]
    return _at_its_use(barred_message(step, other, functions), step, functions, source)


def calls_what_it_may_not(step: Step, steps: Sequence[Step], source: str) -> str:
    """Of a step that builds: what is wrong with it if it calls functions that its manifest bars, or those of a later
    step whose header it includes; else nothing. By its source alone, for whoever has no other means."""
    barred = borrowed_functions(source, step.barred_functions)
    if barred:
        return barred_here(step, barred, source)
    headers = set(included(source))
    for other in steps:
        if other.index > step.index and any(name.startswith(f'"steps/{other.id}/') for name in headers):
            called = borrowed_functions(source, set(other.functions) - set(step.functions))
            if called:
                return _at_its_use(later_message(other), step, called, source)
    return ""


def missing_message(names: tuple[str, ...]) -> str:
    """Functions that the contract asks for and the file lacks."""
    shown = join_and([name.replace("raysteps::", "") for name in names])
    which = "is missing. The file must define it" if len(names) == 1 else "are missing. The file must define them"
    return f"{NOT_BUILT}{shown} {which} exactly as the header declares."


def missing_here(step: Step, names: tuple[str, ...], source: str) -> str:
    """The same of names as a linker writes them, with what the file may have in their place."""
    names = tuple(map(_as_in_a_header, names))
    return missing_message(names) + (_in_its_place(names, source) or _of_another_step(step, source))


def hidden_message(names: tuple[str, ...]) -> str:
    """Functions that are there, and can be called from nowhere else."""
    shown = join_and([_as_in_a_header(name).replace("raysteps::", "") for name in names])
    one = len(names) == 1
    return (
        f"{NOT_BUILT}{shown} {'is' if one else 'are'} defined, but cannot be called from outside of the file: a pragma "
        f"or an attribute hides {'it, or it is no function' if one else 'them, or they are no functions'}."
    )


def _of_another_step(step: Step, source: str) -> str:
    """A line about a file that asks for the header of another step, and not for that of its own."""
    headers = [name.strip('<>"') for name in included(source) if name[1:].startswith("steps/")]
    if not headers or any(name.startswith(f"steps/{step.id}/") for name in headers):
        return ""
    return f"\nThe file includes {printable(headers[-1])}: is it that step's, saved in the place of {step.file}?"


def undefined_message(names: tuple[str, ...]) -> str:
    """A helper that was declared and forgotten, or has another signature where it is defined."""
    shown = join_and([shorten(name, 200) for name in names[:5]])
    are = "is" if len(names) == 1 else "are"
    return f"{NOT_BUILT}{shown} {are} called, but defined nowhere. Is the signature the same in both places?"


def bare_name(name: str) -> str:
    """Of a function as a linker writes it, what a source calls it by."""
    return name.partition("(")[0].rpartition("::")[2].strip()


def undefined_here(step: Step, names: tuple[str, ...], source: str) -> str:
    """The same of names as a linker writes them, with the place at which the file calls the first."""
    message = undefined_message(tuple(map(_as_in_a_header, names)))
    return _at_its_use(message, step, set(map(bare_name, names)), source)


def twice_message(name: str) -> str:
    """A function that stands there twice."""
    return (
        f"{NOT_BUILT}{name} is defined twice. Where two files have a helper of one name, put each into an "
        "unnamed namespace: namespace { ... }."
    )


def is_of_a_linker(output: str) -> bool:
    """Whether a function is missing, or there twice."""
    return bool(_MISSING.search(output) or _TWICE.search(output))


def missing_name(output: str) -> tuple[str, str] | None:
    """The first function that the linker does not find, and the line in which it says so."""
    missing = _MISSING.search(output)
    if missing is None or _TWICE.search(output):
        return None
    start, end = output.rfind("\n", 0, missing.start()) + 1, output.find("\n", missing.end())
    return missing["name"] or missing["other"], output[start : end if end >= 0 else len(output)]


def link_message(ran: TaskResult) -> str:
    """Mostly a function that the contract asks for and the file lacks."""
    if ran.hung:
        return f"{NOT_BUILT}the linker took too long."
    if ran.stopped == "memory":
        return f"{NOT_BUILT}the linker needed more memory than it may have."
    said = printable((ran.outcome.stderr + ran.outcome.stdout)[:_MAX_READ])  # Microsoft's linker complains on stdout
    missing, twice = _MISSING.search(said), _TWICE.search(said)
    if twice is not None:
        name = twice["name"] or twice["theirs"].partition(" already defined")[0]
        return twice_message(shorten(name, 200))
    if missing is None:
        return f"{NOT_BUILT}the linker gave up."
    return missing_message((shorten(missing["name"] or missing["other"], 200),))


def why_not_built(kit: BuiltKit, step: Step, compiled: Compiled, source: str) -> str:
    """What is wrong with a step of which there is no binary."""
    if compiled.forbidden:
        others = [other for other in read_all_steps(kit.project) if other.id != step.id]
        owners = {name: (other, shown) for other in others for name, shown in kit.functions(other).items()}
        wanted = {
            *map(unqualified_name, compiled.forbidden),
            *([_COUNTERS] if _of_counters(compiled.forbidden[0]) else []),
        }
        return _at_its_use(forbidden_message(step, compiled.forbidden, owners), step, wanted, source)
    if compiled.barred:
        return barred_here(step, compiled.barred, source)
    if compiled.unreadable:
        return f"{NOT_BUILT}its object holds more names than a step can have, or cannot be read."
    if compiled.undefined:
        return undefined_here(step, compiled.undefined, source)
    if compiled.missing:
        return missing_here(step, compiled.missing, source)
    if compiled.hidden:
        return hidden_message(compiled.hidden)
    return compile_message(step, source, compiled.ran)
