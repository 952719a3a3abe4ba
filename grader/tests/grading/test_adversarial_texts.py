"""Whatever a student or a compiler wrote: nobody waits for the grader to read it, and nothing but the documented errors
comes of it. Texts are so large that a pattern that looks at a part of them again and again takes minutes or hours."""

import contextlib
import gzip
import io
import os
import random
import tarfile
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from raysteps.common.documents import Malformed, as_text
from raysteps.common.errors import UsageError
from raysteps.common.process import Outcome
from raysteps.common.text import clean, harmless_log, printable
from raysteps.course.manifest import Step
from raysteps.course.stubs import same_code, tokens, unfinished_functions
from raysteps.grading.build_messages import compile_message, is_of_a_linker, link_message, missing_name
from raysteps.images.compare import PictureError, parse_ppm
from raysteps.images.render import RenderResult, exit_words, render
from raysteps.judge.functions import functions_of
from raysteps.judge.protocol import ProtocolError
from raysteps.judge.worker import answers_until_trouble
from raysteps.results.model import Results, StepResult
from raysteps.results.store import parse_results
from raysteps.sandbox.task import Isolation, Limits, Task, TaskResult
from raysteps.submission.encoding import decode
from raysteps.submission.entries import RejectedFile
from raysteps.submission.load import SourceLocator, load_submission
from raysteps.toolchain.catch2 import parse_report
from raysteps.toolchain.compile import Program, clean_log, is_user_symbol, parse_readable, parse_symbols

pytestmark = pytest.mark.portable

_MEGABYTE = 1 << 20
_SEED = int(os.environ.get("RAYSTEPS_FUZZ_SEED", "1"))
_ROUNDS = 300


def _ran(stderr: str = "", stdout: str = "", outputs: dict[str, bytes] | None = None, code: int = 1) -> TaskResult:
    return TaskResult(Outcome(code, False, stdout, stderr, 1.0), outputs or {}, 1.0, "")


class _Sandbox:
    """Whose task writes this."""

    isolation = Isolation()

    def __init__(self, outputs: dict[str, bytes]) -> None:
        self._outputs = outputs

    def run(self, task: Task) -> TaskResult:
        return _ran(outputs=self._outputs, code=0)


def _rendered(stats: bytes, tmp_path: Path) -> RenderResult:
    outputs = {"picture": b"P6 1 1 255\nabc", "stats": stats}
    return render(_Sandbox(outputs), Program(("raytrace",)), tmp_path / "scene.nff", (), Limits())


# A megabyte, shaped against each reader

_BUILD_LOGS = [
    "/a" * (_MEGABYTE // 2),
    "/a" * (_MEGABYTE // 2) + " ",
    "\\a/b" * (_MEGABYTE // 4),
    "C:/a" * (_MEGABYTE // 4),
    "/include/core" * (_MEGABYTE // 13),
    "/x.cpp" * (_MEGABYTE // 6),
    "/" * _MEGABYTE,
    "undefined reference to `" * (_MEGABYTE // 24),
    "undefined reference to '" * (_MEGABYTE // 24),
    "LNK2005: " + " (" * (_MEGABYTE // 2),
    "LNK2005: ( already define" * (_MEGABYTE // 25),
    "a:1:1: error:" * (_MEGABYTE // 13),
    "a(1): error C" * (_MEGABYTE // 13),
    "a" * (_MEGABYTE - 20) + ":1:1: error: b",
    "a" * (_MEGABYTE - 20) + "(1): error C1: b",
    "\x1b[0;" * (_MEGABYTE // 4),
    "error:\n" * (_MEGABYTE // 7),
    "\n" * _MEGABYTE,
]


@pytest.mark.parametrize("said", _BUILD_LOGS, ids=lambda said: repr(said[:12]))
def test_a_megabyte_of_a_compiler(said: str, steps: list[Step]) -> None:
    assert len(clean_log(said)) <= 64_000
    assert len(compile_message(steps[0], said, _ran(said))) < 3000
    assert len(link_message(_ran(said))) < 1000
    assert is_of_a_linker(said) or missing_name(said) is None
    harmless_log(clean(said, _MEGABYTE))


@pytest.mark.parametrize("piece", ["symbol lookup error: ", "symbol lookup error: a: undefined symbol: ", "\x1b[0;"])
def test_a_megabyte_of_last_words(piece: str) -> None:
    assert len(exit_words(_ran(piece * (_MEGABYTE // len(piece))).outcome)) < 300


def test_last_words_are_read_at_their_beginning_only() -> None:
    words = "symbol lookup error: step: undefined symbol: tone_map"
    assert "defined nowhere" in exit_words(_ran(words).outcome)
    assert "defined nowhere" not in exit_words(_ran("x" * 3000 + words).outcome)


_NAMES = ["a ", " a", "a 0 ", " U", "x U 0 ", "0 ", "\t", "a\x0b"]


@pytest.mark.parametrize("piece", _NAMES, ids=repr)
def test_a_megabyte_of_a_symbol(piece: str) -> None:
    name = piece * (_MEGABYTE // len(piece)) + "!"
    parse_symbols(f"{name} T 0 4\n{name}")
    assert parse_readable(f"{name} T 0 4\n{name}\n", f"{name}\n{name} T 0 4\n")
    is_user_symbol("_Z" * (_MEGABYTE // 2))


def test_names_stand_before_a_letter_and_two_numbers() -> None:
    plain = "_Z1fv T 0000000000000000 000000000000000b\n_Z1gi U         \n_ZN1aplEv W 0 4\n_Z1b B 10\nx T\n"
    shown = "f() T 0000000000000000 000000000000000b\ng(int) U         \na::operator+() W 0 4\nb B 10\noperator x T\n"
    assert parse_readable(plain, shown) == {
        "_Z1fv": "f()", "_Z1gi": "g(int)", "_ZN1aplEv": "a::operator+()", "_Z1b": "b", "x": "operator x"
    }  # fmt: skip


@pytest.mark.parametrize(
    ("said", "shown"),
    [
        ("/tmp/x/include/core/ray.hpp:3:1: error: no", "core/ray.hpp:3:1: error: no"),
        (
            "In file included from /in/0/include/steps/04-shadows/shadows.hpp:7,",
            "In file included from steps/04-shadows",
        ),
        ("C:\\Jo\\include\\core\\ray.hpp(3)", "core/ray.hpp(3)"),
        ("/in/1/shadows.cpp:4:11: error", "shadows.cpp:4:11: error"),
        ("D:\\x\\shadows.cpp(4): error", "shadows.cpp(4): error"),
        ("'/usr/include/c++/12/vector' and 1/2 and a//b", "'/usr/include/c++/12/vector' and 1/2 and a//b"),
    ],
)
def test_a_log_shows_no_folders_of_the_grader(said: str, shown: str) -> None:
    assert clean_log(said).startswith(shown)


_SOURCES = [
    "/" + "\\\n" * (_MEGABYTE // 2),
    "*\\\n" * (_MEGABYTE // 3),
    "/*" + "*\\\n" * (_MEGABYTE // 3),
    '"' + "\\" * _MEGABYTE,
    '"\\\n' * (_MEGABYTE // 3),
    "u\\\n" * (_MEGABYTE // 3),
    "1e\\\n" * (_MEGABYTE // 4),
    "1" + "\\\n" * (_MEGABYTE // 2),
    "1'" * (_MEGABYTE // 2),
    'R"(' * (_MEGABYTE // 3),
    'uR"aaaaaaaaaaaaaaaa' * (_MEGABYTE // 19),
    "." * _MEGABYTE,
    "#\n" * (_MEGABYTE // 2),
    "RAYSTEPS_TODO(" * (_MEGABYTE // 14),
]


@pytest.mark.parametrize("source", _SOURCES, ids=lambda source: repr(source[:12]))
def test_a_megabyte_of_a_source(source: str, steps: list[Step]) -> None:
    assert same_code(source, source)
    assert unfinished_functions(source, steps[0]) == []
    decode(source.encode())


def _report(tags: str = "", inside: str = "", head: str = "") -> bytes:
    case = f'<TestCase name="t" tags="{tags}">{inside}<OverallResult success="false"/></TestCase>'
    totals = '<OverallResultsCases successes="0" failures="1"/>'
    return f"{head}<Catch2TestRun>{case}{totals}</Catch2TestRun>".encode()


@pytest.mark.parametrize(
    "report",
    [
        _report(tags="[" * _MEGABYTE),
        _report(inside=f"<Failure>{'!(' * (_MEGABYTE // 2)}</Failure>"),
        _report(inside="<Info>a</Info>" * 20_000 + "<Failure/>"),
        _report(inside="<Section>" * 10_000 + "</Section>" * 10_000),
        _report(inside=f'<Failure filename="{"/" * _MEGABYTE}"/>'),
        _report(inside="<Failure " + " ".join(f'a{n}=""' for n in range(100_000)) + "/>"),
    ],
    ids=["tags", "negated", "notes", "sections", "file", "attributes"],
)
def test_a_megabyte_of_a_report(report: bytes) -> None:
    for outcome in parse_report(report) or []:
        assert outcome.failure is None or len("".join(vars(outcome.failure).values())) < 20_000


_ENCODINGS = ["klingon", "rot13", "base64", "undefined", "utf-7", "idna", "x" * 9999]


@pytest.mark.parametrize("encoding", _ENCODINGS, ids=lambda name: name[:9])
def test_a_report_in_an_encoding_that_nobody_knows(encoding: str) -> None:
    parse_report(_report(head=f'<?xml version="1.0" encoding="{encoding}"?>'))


def test_a_megabyte_of_a_picture() -> None:
    for data in (b"P6" + b" " * _MEGABYTE, b"P6 1" + b"\n" * _MEGABYTE, b"P6 " + b"1" * _MEGABYTE):
        with pytest.raises(PictureError):
            parse_ppm(data)


_ZEROS = '"rays": {"eye": 1, "shadow": 0, "reflect": 0, "refract": 0}, "surface_tests": 0, "box_tests": 0'
_STRUCTURE = '"structure": {"boxes": 0, "references": 0, "bytes": 0}'


@pytest.mark.parametrize(
    "stats",
    [
        "{" * _MEGABYTE,
        "[" * _MEGABYTE,
        f'{{"share_tested": {"9" * 400}}}',
        f'{{"share_tested": "{"9" * 400}"}}',
        f'{{"share_tested": {"9" * 5000}}}',
        f'{{"share_tested": {"9" * _MEGABYTE}}}',
        '{"share_tested": 1e30}',
        '{"share_tested": -0.5}',
        '{"share_tested": NaN}',
        f"{{{_ZEROS.replace('1,', '9' * 400 + ',')}, {_STRUCTURE}}}",
        f"{{{_ZEROS.replace('1,', '9223372036854775807,').replace('0,', '9223372036854775807,')}, {_STRUCTURE}}}",
        '"\\ud800"',
    ],
    ids=lambda stats: stats[:30],
)
def test_statistics_of_any_size(stats: str, tmp_path: Path) -> None:
    """A number that no results.json holds is none."""
    seen = _rendered(stats.encode(), tmp_path)
    assert (seen.share_tested, seen.work) == (None, None)


def test_honest_statistics(tmp_path: Path) -> None:
    seen = _rendered(f'{{"share_tested": 0.25, {_ZEROS}, {_STRUCTURE}}}'.encode(), tmp_path)
    assert seen.share_tested == 0.25
    assert seen.work is not None
    assert seen.work.rays == 1


def test_a_megabyte_of_a_name(steps: list[Step]) -> None:
    places = SourceLocator(steps)
    for piece in (".c", "~", ".bak", "old ", "copy", "1"):
        assert places.near(("steps", piece * (_MEGABYTE // len(piece)) + ".cpp")) is None


def test_megabytes_for_a_terminal() -> None:
    for piece in ("\x1b", "\x1b[", "\x1b[0;", "\x1b[ ", "\r", "\u200b", "\ud800"):
        text = piece * (_MEGABYTE // len(piece))
        assert "\x1b" not in printable(text)
        assert len(clean(text)) <= 4000


# Anything at all: seeded, so that what fails once fails again


def _garbage(draw: random.Random, pieces: list[str], most: int = 40) -> str:
    return "".join(draw.choice(pieces) for _ in range(draw.randrange(most)))


def _damaged(draw: random.Random, data: bytes) -> bytes:
    """With some bytes changed, cut out or doubled."""
    result = bytearray(data)
    for _ in range(draw.randrange(1, 6)):
        at = draw.randrange(len(result) + 1)
        kind = draw.randrange(4)
        if kind == 0:
            result[at : at + 1] = bytes([draw.randrange(256)])
        elif kind == 1:
            del result[at : at + draw.randrange(1, 40)]
        elif kind == 2:
            result[at:at] = result[at : at + draw.randrange(1, 40)]
        else:
            result[at : at + 4] = draw.choice([b"\xff" * 4, b"\0" * 4, b"9" * 400, b"\x80\0\0\0"])
    return bytes(result)


def _fuzz(act: Callable[[random.Random], None], rounds: int = _ROUNDS) -> None:
    """The seed of the round that fails is named; RAYSTEPS_FUZZ_SEED begins elsewhere."""
    for seed in range(_SEED, _SEED + rounds):
        try:
            act(random.Random(seed))
        except Exception as error:
            raise AssertionError(f"RAYSTEPS_FUZZ_SEED={seed} fails") from error


_PIECES = [
    "/", "\\", " ", "\n", "\r", "\t", ":", "1", "0", "a", "Z", "_Z", "é", "\ud800", "\x1b[", "\x1b", "\0", "(", ")",
    "'", '"', "`", "error: ", "include/", "core/", "steps/", ".cpp", "x.cpp:1:1: error: y", "C:", " U ", " T 0 4",
    "LNK2005: ", "undefined reference to `", "multiple definition of `", "already defined", "\u2028", "\x85", "9" * 20,
]  # fmt: skip


def test_any_words_of_a_compiler(steps: list[Step]) -> None:
    def act(draw: random.Random) -> None:
        said = _garbage(draw, _PIECES)
        clean_log(said)
        parse_symbols(said)
        parse_readable(said, _garbage(draw, _PIECES))
        compile_message(steps[0], _garbage(draw, _PIECES), _ran(said))
        link_message(_ran(said))
        missing_name(said)
        tokens(said)
        clean(said)

    _fuzz(act)


def test_any_report() -> None:
    whole = _report(
        tags="[01][trace]",
        inside='<Section name="s"><Info>i</Info><Expression success="false" filename="a" line="1">'
        "<Original>!(a)</Original><Expanded>!true</Expanded><Exception>e</Exception></Expression></Section>",
        head='<?xml version="1.0" encoding="utf-8"?>',
    )
    assert parse_report(whole)
    _fuzz(lambda draw: (parse_report(_damaged(draw, whole)), None)[1], 2000)


def test_any_statistics(tmp_path: Path) -> None:
    whole = f'{{"share_tested": 0.25, {_ZEROS}, {_STRUCTURE}}}'.encode()

    def act(draw: random.Random) -> None:
        seen = _rendered(_damaged(draw, whole), tmp_path)
        assert seen.share_tested is None or 0 <= seen.share_tested < 1e7

    _fuzz(act, 1000)


def test_any_results() -> None:
    results = Results.of("somebody", [StepResult("01-camera-rays", "passed", 5.0, 5.0, False, messages=["m"])])
    whole = as_text(results).encode()
    assert parse_results(whole) == results

    def act(draw: random.Random) -> None:
        with contextlib.suppress(Malformed):
            parse_results(_damaged(draw, whole))

    _fuzz(act, 1000)


def _zip(files: dict[str, bytes]) -> bytes:
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    return data.getvalue()


def _tar(files: dict[str, bytes]) -> bytes:
    data = io.BytesIO()
    with tarfile.open(fileobj=data, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for name, text in files.items():
            header = tarfile.TarInfo(name)
            header.size = len(text)
            archive.addfile(header, io.BytesIO(text))
    return data.getvalue()


@pytest.mark.parametrize("ending", [".zip", ".tar", ".tar.gz"])
def test_any_archive(ending: str, steps: list[Step], tmp_path: Path) -> None:
    files = {f"steps/{step.path.as_posix()}": b"int x;\n" * 20 for step in steps[:3]} | {"ä" * 120 + ".cpp": b"int y;"}
    whole = _zip(files) if ending == ".zip" else _tar(files)
    path = tmp_path / f"jo{ending}"

    def act(draw: random.Random) -> None:
        data = _damaged(draw, whole)
        packed = gzip.compress(data, 1, mtime=0) if ending == ".tar.gz" else data
        path.write_bytes(_damaged(draw, packed) if draw.randrange(2) else packed)
        with contextlib.suppress(UsageError):
            load_submission(path, steps)

    _fuzz(act)


def test_any_source() -> None:
    def act(draw: random.Random) -> None:
        text = _garbage(draw, _PIECES).encode(draw.choice(["utf-8", "utf-16", "utf-32", "latin-1"]), "replace")
        with contextlib.suppress(RejectedFile):
            decode(_damaged(draw, text) if text else text)

    _fuzz(act, 1000)


_ANSWER = [
    "nan",
    "inf",
    "-inf",
    "1e308",
    "-1e308",
    "1e-45",
    "0",
    "-0",
    "1",
    "-1",
    "9" * 39,
    "9" * 41,
    "0.5",
    "x",
    "1_0",
    "4294967295",
]
_HEADS = ["hit", "miss", "tree", "bvh", "large", "boxes", "nodes", "yes", "no", "threw", "inside", "true", "1", ""]


@pytest.mark.parametrize("number", [f"{n:02}" for n in range(1, 10)])
def test_any_answer_of_a_worker(number: str) -> None:
    """A reader of answers refuses in its own words, or reads something that can be said."""
    for function in functions_of(number).values():

        def act(draw: random.Random, answer=function.answer) -> None:  # type: ignore[no-untyped-def]
            line = " ".join([draw.choice(_HEADS), *draw.choices(_ANSWER, k=draw.randrange(40))])
            try:
                read = answer.parse(line)
            except (ProtocolError, OverflowError):
                return
            answer.words(read)

        _fuzz(act)


def test_any_lines_of_a_worker() -> None:
    """What does not fit is no answer."""
    pieces = [
        "start 0\n",
        "done 0 x\n",
        "start 1\n",
        "done 1 y\n",
        "end 2\n",
        "\n",
        "done 1 ",
        "start",
        "\0",
        " ",
        "\ud800",
    ]

    def act(draw: random.Random) -> None:
        said = _garbage(draw, pieces)
        answers_until_trouble(lambda stdin, seconds: _ran(stdout=said, code=draw.randrange(-2, 2)), [], 1.0)

    _fuzz(act)
