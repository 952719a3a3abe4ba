"""Compiles and links one step of a student, in the sandbox. The commands are the kit's; only the source is not."""

import os
import re
from collections.abc import Mapping
from concurrent.futures import Future
from contextlib import AbstractContextManager, nullcontext, suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.files import content_hash, copy_program, write_bytes
from raysteps.common.platform import executable
from raysteps.common.process import Outcome, run
from raysteps.common.text import printable, shorten
from raysteps.course.manifest import Step
from raysteps.course.stubs import borrowed_functions, included, pristine_stub
from raysteps.sandbox.task import (
    AccountingSandbox,
    Input,
    Limits,
    Output,
    Sandbox,
    Task,
    TaskResult,
    TrustedCommand,
    Word,
)
from raysteps.toolchain.kit_artifacts import NONE_REPLACED, BuiltKit, Kind, ProgramLinker, Replaced
from raysteps.toolchain.limits import StepLimits
from raysteps.toolchain.link import (
    REPORT_UNDEFINED,
    compile_words,
    include_words,
    library_flags,
    library_name,
    link_words,
    undefined_symbols,
)

# What is in an object: the names that it defines and asks for.

_SECONDS = 60
_MAX_OUTPUT = 64 << 20
_HEX = frozenset("0123456789abcdef")


@dataclass(frozen=True)
class Symbols:
    """Linker names."""

    defined: frozenset[str]  # all that is defined and visible from outside
    wanted: frozenset[str]  # undefined


def parse_symbols(text: str) -> Symbols:
    """The output of `nm --extern-only --format=posix`, of an object or an archive."""
    defined, wanted = set(), set()
    for line in text.splitlines():
        words = line.split()
        if len(words) < 2 or len(words[1]) != 1:
            continue
        name, kind = words[0], words[1]
        if kind in "Uwv":
            wanted.add(name)
        else:
            defined.add(name)
    return Symbols(frozenset(defined), frozenset(wanted))


_NOT_OF_A_LIBRARY = re.compile(r"_Z(?:T[VIST])?N?K?(?!9__gnu_cxx|10__cxxabi)[0-9]")


def is_user_symbol(name: str) -> bool:
    """Whether a linker name is of a C++ function or class that is neither the compiler's nor the standard library's."""
    return _NOT_OF_A_LIBRARY.match(name) is not None


_OF_A_PROGRAM = re.compile(r"__(?:[a-z]+san|sanitizer|sancov)_")


def unresolved_names(ran: TaskResult) -> set[str]:
    """What a linker finds nowhere, without what sanitizers have in the program itself, as Clang links them."""
    said = (ran.outcome.stderr + ran.outcome.stdout)[:_MAX_READ]
    return {name for name in undefined_symbols(said) if _OF_A_PROGRAM.match(name) is None}


_NESTED = re.compile(r"_Z(?:T[VISWH])?(?:NK?)?")
_PART = re.compile(r"[0-9]{1,3}")


def unqualified_name(linker_name: str) -> str:
    """What the source calls a function or variable of which this is the linker's name; nothing where it shows none."""
    start = _NESTED.match(linker_name)
    at, name = start.end() if start else 0, ""
    while (size := _PART.match(linker_name, at)) is not None:
        at = size.end() + int(size[0])
        name = linker_name[size.end() : at]
    return name


_NM_ARGUMENTS = ("--extern-only", "--format=posix")


_MAY_HIDE = re.compile(rb"visibility|pragma|asm|alias")
_KINDS_OF_FUNCTIONS = ("T", "W", "i")  # usual, weak, and chosen when the library is loaded


def shown_functions(text: str) -> set[str]:
    """Of the output of such an nm about a library."""
    lines = map(str.split, text.splitlines())
    return {words[0] for words in lines if len(words) > 1 and words[1] in _KINDS_OF_FUNCTIONS}


def _without_kind_and_place(line: str) -> str:
    """The name at the start of a line of nm: behind it stand one letter and at most two numbers."""
    line = line.rstrip()
    for numbers in (2, 1, 0):
        name, *words = line.rsplit(" ", numbers + 1)
        if len(words) == numbers + 1 and len(words[0]) == 1 and _HEX.issuperset("".join(words[1:])):
            return name
    return line


def parse_readable(plain: str, readable: str) -> dict[str, str]:
    """Linker names and how C++ writes them, of two outputs of nm for the same symbols in the same order."""
    lists = [[_without_kind_and_place(line) for line in text.splitlines()] for text in (plain, readable)]
    return dict(zip(*lists, strict=False))


def readable_names(nm: str, path: Path) -> dict[str, str]:
    """Linker names of one of the kit's own objects, and how C++ writes them."""
    words = [nm, *_NM_ARGUMENTS, "--defined-only", "--no-sort"]
    plain, readable = (
        run([*words, *option, path], seconds=_SECONDS, cap=_MAX_OUTPUT).stdout for option in ((), ("--demangle",))
    )
    return parse_readable(plain, readable)


def symbols_of(nm: str, path: Path) -> Symbols:
    """Of one of the kit's own files."""
    outcome = run([nm, *_NM_ARGUMENTS, path], seconds=_SECONDS, cap=_MAX_OUTPUT)
    if outcome.code != 0:
        raise GraderFault(f"{path}: its symbols cannot be read: {outcome.stderr}")
    return parse_symbols(outcome.stdout)


_MAX_SYMBOLS = 1_000_000  # characters of the list of them; a step has some thousand


_MAX_LOG = 64_000
_MAX_READ = 4 * _MAX_LOG  # characters that are looked through
# The parts of a path are looked at one after the other, and none of them twice, however a message is shaped.
_PATH = re.compile(r"(?:\b[A-Za-z]:)?(?:[/\\][^\s:/\\]+)+[/\\]?")
_SOURCE = re.compile(r"\w+\.cpp\b")
_TEMPORARY = re.compile(r"cc\w{6}(\.\w+)")  # as GCC calls its files, each time by another name


def _without_folders(found: re.Match[str]) -> str:
    """A path as a student knows it: from the kit's headers on, or the name of a source."""
    parts = found[0].replace("\\", "/").split("/")
    temporary = _TEMPORARY.fullmatch(parts[-1])
    if temporary is not None:
        return f"temporary{temporary[1]}"
    for at in range(len(parts) - 2, 0, -1):
        if parts[at - 1] == "include" and parts[at] in ("core", "steps"):
            return "/".join(parts[at:])
    source = next((at for at in range(len(parts) - 1, 1, -1) if _SOURCE.match(parts[at])), None)
    return found[0] if source is None else "/".join(parts[source:])


def clean_log(said: str) -> str:
    """What a compiler said, as text that cannot steer a terminal, and without the grader's folders."""
    return shorten(_PATH.sub(_without_folders, printable(said[:_MAX_READ])).strip(), _MAX_LOG)


def build_log(ran: TaskResult) -> str:
    """All that the compiler said."""
    return clean_log(ran.outcome.stderr + ran.outcome.stdout)


@dataclass(frozen=True)
class Compiled:
    """The step's library (where steps are none: its object), or why there is none."""

    binary: Path | None
    ran: TaskResult
    forbidden: tuple[str, ...] = ()  # linker names that the step may not ask for
    missing: tuple[str, ...] = ()  # functions that the step should define
    hidden: tuple[str, ...] = ()  # those that it defines so that nobody can call them
    undefined: tuple[str, ...] = ()  # functions that the step calls and nobody defines
    unreadable: bool = False  # an object that no compiler makes of what a student writes
    barred: tuple[str, ...] = ()  # functions that the step may not call, as step.toml calls them; see _by_its_source


@dataclass(frozen=True)
class CompiledAhead:
    """Steps whose compiler was started before anybody asked for them, by id, and where it runs."""

    steps: Mapping[str, "Future[Compiled]"] = field(default_factory=dict)
    sandbox: AccountingSandbox | None = None

    @property
    def cpu_seconds(self) -> float:
        """What that took so far."""
        return 0.0 if self.sandbox is None else self.sandbox.cpu_seconds

    def until_interrupted(self) -> AbstractContextManager[None]:
        """See AccountingSandbox."""
        return nullcontext() if self.sandbox is None else self.sandbox.until_interrupted()


NOTHING_AHEAD = CompiledAhead()


@dataclass(frozen=True)
class Program:
    """A student's step and the program that needs it: one process, or where `home` is given two, of which the first
    holds the student's code."""

    words: tuple[Word, ...]
    home: Path | None = None

    def task(self, args: tuple[Word, ...], limits: Limits, stdin: bytes = b"") -> Task:
        """The program run with these arguments."""
        if self.home is None:
            return Task((*self.words, *args), limits, stdin=stdin)
        return Task(self.words, limits, beside=TrustedCommand((Input(self.home), *args), stdin))


_MAX_KEPT = 40  # libraries: each save of a student makes one


@dataclass(frozen=True)
class KeptLibraries:
    """A student's own libraries by what they were made of, so that a save compiles one step and a check after it none.
    Only for whoever works on their own steps: in a grade nothing is taken from an earlier one."""

    folder: Path

    def _place(self, kit: BuiltKit, step: Step, source: bytes) -> Path:
        words = (kit.fingerprint, kit.description.compiler, *kit.description.compile_flags, *kit.description.link_flags)
        made_of = content_hash("\0".join([*words, step.id, ""]).encode() + source)
        return self.folder / f"{made_of[:32]}.library"

    def find(self, kit: BuiltKit, step: Step, source: bytes) -> tuple[bytes, str] | None:
        """The library and what the compiler said of it."""
        place = self._place(kit, step, source)
        try:
            found = place.read_bytes(), place.with_suffix(".log").read_text(encoding="utf-8")
            os.utime(place)
        except (OSError, ValueError):
            return None
        return found

    def keep(self, kit: BuiltKit, step: Step, source: bytes, library: bytes, said: str) -> None:
        """For the next time, if there is room. What was not asked for longest goes."""
        with suppress(OSError):
            place = self._place(kit, step, source)
            write_bytes(place.with_suffix(".log"), said.encode())
            write_bytes(place, library)
            kept = sorted(self.folder.glob("*.library"), key=lambda path: path.stat().st_mtime, reverse=True)
            for old in kept[_MAX_KEPT:]:
                old.unlink(missing_ok=True)
                old.with_suffix(".log").unlink(missing_ok=True)


def own_libraries(kit: BuiltKit) -> KeptLibraries:
    """Those of the student whose kit it is."""
    return KeptLibraries(kit.project.build / "own")


_NO_WORK = TaskResult(Outcome(0, False, "", "", 0.0), {}, 0.0, "")


def _checked_by_source(step: Step, source: bytes, raw: Path, ran: TaskResult) -> Compiled:
    """Where steps are no libraries, nothing but the source tells that it calls what it may not: else a student of such
    a system would hear of it in the grade only."""
    text = source.decode("utf-8", "replace")
    barred = tuple(sorted(borrowed_functions(text, step.barred_functions)))
    return Compiled(None if barred else raw, ran, barred=barred)


class StudentBuild:
    """Builds into a folder of its own."""

    def __init__(self, kit: BuiltKit, sandbox: Sandbox, folder: Path, kept: KeptLibraries | None = None) -> None:
        self._kit = kit
        self._sandbox = sandbox
        self._folder = folder
        self._kept = kept if kit.description.seal is not None else None

    def _run(self, limits: StepLimits, *command: Word) -> TaskResult:
        return self._sandbox.run(Task(tuple(command), limits.of_tools(), tools=True))

    def compile(self, step: Step, source: bytes, limits: StepLimits) -> Compiled:
        """The binary shows only the functions of the step, whatever the source defines."""
        found = self._kept.find(self._kit, step, source) if self._kept is not None else None
        if found is not None:
            library, said = found
            ran = replace(_NO_WORK, outcome=replace(_NO_WORK.outcome, stderr=said))
            return Compiled(self._write_library(step, library), ran)
        compiled = self._compile(step, source, limits)
        if self._kept is not None and compiled.binary is not None:
            said = compiled.ran.outcome.stderr + compiled.ran.outcome.stdout
            self._kept.keep(self._kit, step, source, compiled.binary.read_bytes(), said)
        return compiled

    def _compile(self, step: Step, source: bytes, limits: StepLimits) -> Compiled:
        path = self._folder / step.path
        write_bytes(path, source)
        description = self._kit.description
        words: list[Word] = [description.compiler, *description.compile_flags]
        needed, there = (
            included(text) for text in (pristine_stub(self._kit.project, step), source.decode("utf-8", "replace"))
        )
        # Names that the file does not include stay out; and GCC takes a precompiled header once only.
        if set(needed) <= set(there) and len(there) == len({name.strip('<>"') for name in there}):
            words += ["-I", Input(self._kit.folder / "precompiled")]
        words += include_words(description, Input(self._kit.include), [Input(it) for it in description.more_includes])
        words += compile_words(description, Input(path, step.file), Output("object"))
        ran = self._run(limits, *words)
        data = ran.outputs.get("object")
        if ran.outcome.code != 0 or ran.outcome.timed_out or not data:
            if not ran.was_stopped and not build_log(ran):
                self._require_compiler(limits)
            return Compiled(None, ran)
        raw = self._write(f"{step.number}.o", data)
        if description.seal is None:
            return _checked_by_source(step, source, raw, ran)
        return self._close(step, raw, ran, limits, may_hide=bool(_MAY_HIDE.search(source)))

    def _require_compiler(self, limits: StepLimits) -> None:
        """One that says nothing may not run here at all, which is nobody's mistake who handed something in: it has to
        compile an empty file."""
        description, empty = self._kit.description, self._folder / "empty.cpp"
        write_bytes(empty, b"")
        words: list[Word] = [description.compiler, *description.compile_flags]
        words += compile_words(description, Input(empty, empty.name), Output("object"))
        ran = self._run(limits, *words)
        if not ran.outputs.get("object"):
            how = ran.outcome.signal_name or f"exit code {ran.outcome.code}"
            raise GraderFault(
                f"The compiler does not work where submissions are compiled (in: {self._sandbox.isolation.name}): even "
                f"of an empty file {description.compiler} makes nothing: {how}, and it says "
                f"{build_log(ran) or 'nothing'}. Has this container, or this user, fewer rights than usual?"
            )

    def _close(self, step: Step, raw: Path, compiled: TaskResult, limits: StepLimits, *, may_hide: bool) -> Compiled:
        """Turns an object into a library, unless it asks for what is not its own or lacks what it should have. Where
        nothing in its source hides functions, nobody looks whether it does: that takes another program."""
        description = self._kit.description
        assert description.seal is not None
        listed = self._run(limits, description.seal.nm, *_NM_ARGUMENTS, Input(raw, "step.o"))
        text = listed.outcome.stdout
        if listed.outcome.code != 0 or listed.outcome.timed_out or len(text) >= _MAX_SYMBOLS:
            return Compiled(None, compiled, unreadable=True)
        symbols = parse_symbols(text)
        foreign = symbols.wanted - self._kit.allowed(step)
        strange = sorted(name for name in foreign if is_user_symbol(name))
        forbidden = tuple(name for name in strange if name in self._kit.known() or "5Catch" in name)
        missing = tuple(shown for name, shown in self._kit.functions(step).items() if name not in symbols.defined)
        undefined = self._shown(raw, [name for name in strange if name not in forbidden], limits)
        if forbidden or missing or undefined:
            return Compiled(None, compiled, forbidden, missing, undefined=undefined)
        words: list[Word] = [description.compiler, *description.link_flags, *library_flags(step.number)]
        words += [Input(self._kit.exports(step), "exports"), Input(raw, "step.o"), *REPORT_UNDEFINED]
        ran = self._run(limits, *words, "-o", Output("library"))
        data = ran.outputs.get("library")
        if not data:
            return Compiled(None, ran)
        nowhere = sorted(unresolved_names(ran) & foreign)
        if nowhere:  # such as what is declared as C and was forgotten
            return Compiled(None, compiled, undefined=self._shown(raw, nowhere, limits))
        path = self._write_library(step, data)
        hidden = self._hidden(step, path, limits) if may_hide else ()
        return Compiled(None if hidden else path, compiled, hidden=hidden)

    def _hidden(self, step: Step, library: Path, limits: StepLimits) -> tuple[str, ...]:
        """Functions of the step that its library does not show, by a pragma or attribute, or that are none."""
        assert self._kit.description.seal is not None
        words = (self._kit.description.seal.nm, "--dynamic", "--defined-only", *_NM_ARGUMENTS)
        listed = self._run(limits, *words, Input(library, "library")).outcome
        shown = shown_functions(listed.stdout)
        functions = self._kit.functions(step).items() if listed.code == 0 else ()
        return tuple(readable for name, readable in functions if name not in shown)

    def _shown(self, raw: Path, names: list[str], limits: StepLimits) -> tuple[str, ...]:
        """Linker names of an object as C++ writes them."""
        tools = self._kit.description.seal
        if not names or tools is None:
            return ()
        words = (tools.nm, *_NM_ARGUMENTS, "--undefined-only", "--no-sort")
        plain = self._run(limits, *words, Input(raw, "step.o")).outcome.stdout
        readable = self._run(limits, *words, "--demangle", Input(raw, "step.o")).outcome.stdout
        shown = parse_readable(plain, readable)
        return tuple(shown.get(name, name) for name in names)

    def program(
        self,
        kind: Kind,
        step: Step,
        binaries: Mapping[str, Path],
        limits: StepLimits,
        *,
        together: bool = False,
        replaced: Replaced = NONE_REPLACED,
    ) -> tuple[Program | None, TaskResult | None]:
        """The kit's program with these binaries, by step; none, and what the linker said, when they do not fit. All
        other steps are the reference's; those up to this one are loaded like the student's if `together`. Where the
        step's other functions call one of the `replaced`, it is the reference's, too."""
        own = [other for other in self._kit.steps if other.number in binaries]
        boxes = self._kit.boxes(own) if self._kit.interpreter is not None else None
        if boxes is not None:
            return self._boxed(boxes, kind, own, binaries, replaced), None
        all_binaries = list(binaries.values())
        if together:
            missing = [one for one in self._kit.handed_in_up_to(step) if one.number not in binaries]
            all_binaries += [self._kit.reference_step(other) for other in missing]
        if self._kit.interpreter is not None:
            program = self._kit.program(kind, step, self._folder, together=together, replaced=replaced)
            return Program((*self._loader(f"{kind}-{step.number}", all_binaries), Input(program, kind))), None
        parts = [*all_binaries, *self._kit.rest(kind, step, together=together)]
        output = Output(executable(Path("program")).name)
        target: Word = output
        inputs: list[Word] = [Input(part, part.name) for part in parts]
        ran = self._run(limits, *link_words(self._kit.description, inputs, target))
        data = ran.outputs.get(output.name)
        if not data:
            return None, ran
        name = f"{kind}-{step.number}{'-together' if together else ''}"
        path = self._folder / executable(Path(name)).name
        written = self._write(f"{name}.linked", data)
        copy_program(written, path)
        written.unlink()
        return Program((Input(path, kind),)), None

    def _boxed(
        self, boxes: ProgramLinker, kind: Kind, own: list[Step], binaries: Mapping[str, Path], replaced: Replaced
    ) -> Program:
        numbers = [step.number for step in own]
        box = boxes.box(numbers, self._folder, replaced)
        home = boxes.home(f"test-{numbers[-1]}" if kind == "test" else kind, numbers, self._folder, replaced)
        loader = self._loader(box.name, [binaries[number] for number in numbers])
        return Program((*loader, Input(box, "box")), home)

    def _loader(self, name: str, libraries: list[Path]) -> tuple[Word, ...]:
        """Starts a program with these libraries."""
        assert self._kit.interpreter is not None
        return (self._kit.interpreter, "--library-path", Input(self._in_one_folder(name, libraries), "steps"))

    def _in_one_folder(self, name: str, libraries: list[Path]) -> Path:
        """Where the loader looks; a single library may stay where it is."""
        if len(libraries) > 1:
            for library in libraries:
                write_bytes(self._folder / name / library.name, library.read_bytes())
            return self._folder / name
        return libraries[0].parent

    def _write_library(self, step: Step, data: bytes) -> Path:
        """In a folder of its own: a task gets a copy of all that is in it."""
        return self._write(f"libraries/{step.number}/{library_name(step.number)}", data)

    def _write(self, name: str, data: bytes) -> Path:
        path = self._folder / name
        write_bytes(path, data)
        return path
