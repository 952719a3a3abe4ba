"""A check is not run again where nothing that it can depend on has changed, and is where anything has."""

import importlib.metadata
import os
import subprocess
import sys
import time
from pathlib import Path, PurePosixPath

import pytest
from rich.console import Console

from raysteps.course.project import Project
from tools.selftest import run as selftest_checks
from tools.selftest import stamps
from tools.selftest.checks import Check, Report, Verdict, run_checks
from tools.selftest.inputs import Inputs, Sources, is_text
from tools.selftest.run import run_pytest
from tools.selftest.stamps import Stamps

_FILES = {
    "README.md": "# A kit\n",
    "docs/page.md": "A page\n",
    "docs/other.md": "Another\n",
    "docs/figures/one.png": "",
    "steps/01-one/README.md": "A handout\n",
    "steps/01-one/one.cpp": "int one();\n",
    "grader/src/raysteps/__init__.py": "",
    "grader/src/raysteps/page.html": "<p>",
    "grader/src/raysteps/one.py": '"""One."""\nfrom raysteps.deep import below\n',
    "grader/src/raysteps/two.py": "import raysteps.one\n",
    "grader/src/raysteps/other.py": "",
    "grader/src/raysteps/deep/__init__.py": "",
    "grader/src/raysteps/deep/below.py": 'PROGRAM = "keeper.py"\n',
    "grader/src/raysteps/deep/keeper.py": "",
    "grader/src/raysteps/cli/__init__.py": "",
    "grader/src/raysteps/cli/app.py": (
        'COMMANDS = (Command("site", "the docs", "raysteps.site"), Command("list", "", "raysteps.two"))\n'
    ),
    "grader/src/raysteps/site.py": 'def run(root): return (root / "docs").glob("*.md")\n',
    "grader/tests/conftest.py": 'pytest_plugins = ["sharing"]\n',
    "grader/tests/sharing.py": "import pytest\n@pytest.fixture\ndef shared():\n    from raysteps import other\n",
    "grader/tests/helper.py": "def help() -> None:\n    from raysteps import one\n",
    "grader/tests/test_two.py": "from raysteps import two\n",
    "grader/tests/test_helped.py": "import helper\n",
    "grader/tests/test_process.py": 'WORDS = ["-P", "-m", "raysteps.two"]\n',
    "grader/tests/test_command.py": 'WORDS = ["-P", "-m", "raysteps", "list"]\n',
    "grader/tests/test_script.py": 'def run(root): return root / "raysteps"\n',
    "grader/tests/test_documents.py": 'NAMES = ("docs/page.md",)\n',
    "grader/tests/test_handout.py": 'def test(project, step): (project.steps / step / "README.md").read_text()\n',
    "grader/tests/test_page.py": 'def test(root, name): (root / "docs" / f"{name}.md").read_text()\n',
    "grader/tests/test_every.py": 'def test(root): list(root.rglob("*.md"))\n',
    "grader/tests/test_site.py": 'from raysteps.cli.app import main\ndef test(): main(["site", "--out", "x"])\n',
    "grader/tests/test_listing.py": 'from raysteps.cli.app import main\ndef test(): main(["list"])\n',
    "grader/tests/test_program.py": 'PROGRAM = "from raysteps.deep import far, below\\nbelow.run()"\n',
    "grader/tests/test_shared.py": "def test(shared): assert shared\n",
    "grader/tests/test_made.py": 'def load(name): return __import__(f"raysteps.deep.{name}")\n',
}


_READ_ONCE = pytest.mark.xdist_group("stamps")  # all sources of the kit


@pytest.fixture
def small(tmp_path: Path) -> Project:
    """A repository of a few files."""
    for place, text in _FILES.items():
        (tmp_path / place).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / place).write_text(text, encoding="utf-8")
    (tmp_path / ".gitignore").write_text("/build/\n__pycache__/\n", encoding="utf-8")
    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    return Project(tmp_path)


def _sources(project: Project) -> Sources:
    return Sources(project, Stamps(project).files())


@pytest.fixture(scope="module")
def inputs(project: Project) -> dict[str, Inputs]:
    """Of all tests of the kit."""
    sources = _sources(project)
    return {place: sources.of_test(place) for place in sources.tests()}


def _counts(project: Project, test: str, place: str) -> bool:
    return _sources(project).of_test(f"grader/tests/test_{test}.py").belongs(place)


@pytest.mark.parametrize("test", ["two", "helped", "process", "command", "script"])
def test_what_is_imported_counts_however_far_away(small: Project, test: str) -> None:
    for name in ("one", "deep/__init__", "deep/below", "deep/keeper"):
        assert _counts(small, test, f"grader/src/raysteps/{name}.py"), name


def test_what_a_program_that_is_a_text_imports_counts(small: Project) -> None:
    assert _counts(small, "program", "grader/src/raysteps/deep/below.py")


@pytest.mark.parametrize("test", ["two", "helped", "process", "documents", "made"])
def test_what_is_not_imported_does_not(small: Project, test: str) -> None:
    assert not _counts(small, test, "grader/src/raysteps/other.py")
    assert not _counts(small, test, "grader/tests/test_command.py")


@pytest.mark.parametrize("test", ["command", "script"])
def test_all_counts_for_who_starts_the_program(small: Project, test: str) -> None:
    assert _counts(small, test, "grader/src/raysteps/other.py")


def test_a_fixture_counts_for_who_asks_for_it(small: Project) -> None:
    assert _counts(small, "shared", "grader/src/raysteps/other.py")


def test_a_name_that_is_made_when_it_runs_may_be_any(small: Project) -> None:
    assert _counts(small, "made", "grader/src/raysteps/deep/keeper.py")


@pytest.mark.parametrize(
    ("test", "read"),
    [
        ("two", []),
        ("documents", ["docs/figures/one.png", "docs/page.md"]),
        ("page", ["docs/figures/one.png", "docs/other.md", "docs/page.md"]),
        ("handout", ["docs/figures/one.png", "steps/01-one/README.md"]),
        ("every", ["README.md", "docs/figures/one.png", "docs/other.md", "docs/page.md", "steps/01-one/README.md"]),
        ("site", ["docs/figures/one.png", "docs/other.md", "docs/page.md"]),
        ("listing", []),
        ("command", []),
    ],
)
def test_documents_count_for_who_names_them(small: Project, test: str, read: list[str]) -> None:
    """By a file, a folder or a pattern, itself or by a command; and pictures, which documents show."""
    assert [place for place in sorted(_FILES) if is_text(place) and _counts(small, test, place)] == read


def test_what_is_neither_document_nor_python_counts_for_everybody(small: Project) -> None:
    for place in ("steps/01-one/one.cpp", "grader/src/raysteps/page.html", "grader/tests/conftest.py", "new"):
        assert _counts(small, "two", place), place


def test_every_import_of_the_kit_is_followed(project: Project) -> None:
    """What a test really has loaded is among what counts for it."""
    place = "grader/tests/course/test_manifest.py"
    program = (
        "import sys; sys.path[:0] = ['tests', 'tests/helpers', 'tests/course', '..']; import conftest, test_manifest\n"
        "print(*(m.__file__ for m in list(sys.modules.values()) if getattr(m, '__file__', None)), sep='\\n')"
    )
    words = [sys.executable, "-P", "-c", program]
    environment = os.environ | {"PYTHONPATH": str(project.root / "grader" / "src")}
    done = subprocess.run(
        words, cwd=project.root / "grader", env=environment, capture_output=True, text=True, check=True
    )
    loaded = [Path(line) for line in done.stdout.splitlines()]
    own = {path.relative_to(project.root).as_posix() for path in loaded if path.is_relative_to(project.root / "grader")}
    assert len(own) > 10
    assert own <= _sources(project).of_test(place).code


def _run(check: Check, project: Project, *, fresh: bool = False) -> int:
    return run_checks([check], Console(quiet=True), Stamps(project, fresh=fresh))


def _counting(ran: list[str], verdict: Verdict = "passed") -> Check:
    def run() -> Report:
        ran.append("once")
        return Report(verdict)

    return Check("it holds", run, lambda place: place.endswith(".cpp"))


def test_a_check_runs_again_only_when_an_input_changed(small: Project) -> None:
    ran: list[str] = []
    check = _counting(ran)
    assert _run(check, small) == _run(check, small) == 0
    assert len(ran) == 1
    (small.root / "README.md").write_text("another text", encoding="utf-8")
    _run(check, small)
    assert len(ran) == 1
    (small.root / "steps" / "01-one" / "one.cpp").write_text("int two();\n", encoding="utf-8")
    _run(check, small)
    assert len(ran) == 2
    (small.root / "steps" / "01-one" / "new.cpp").write_text("", encoding="utf-8")
    _run(check, small)
    assert len(ran) == 3
    _run(check, small, fresh=True)
    assert len(ran) == 4


def test_what_it_prints_to_is_no_input(small: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    ran: list[str] = []
    with (small.root / "all.cpp").open("w", encoding="utf-8") as printed, monkeypatch.context() as patch:
        patch.setattr(stamps, "_PRINTED", (printed.fileno(),))
        for _ in range(2):
            print("passed: it holds", file=printed, flush=True)
            _run(_counting(ran), small)
    assert len(ran) == 1
    _run(_counting(ran), small)
    assert len(ran) == 2, "anybody else's file is one"


def test_another_machine_is_another_matter(small: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    ran: list[str] = []
    _run(_counting(ran), small)
    monkeypatch.setattr(stamps, "machine_mark", lambda: "with a new compiler")
    _run(_counting(ran), small)
    assert len(ran) == 2


def test_a_machine_is_the_same_once_the_kit_was_set_up_in_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Which writes a description of the kit beside its sources, and one that is installed: the same package twice."""
    mark = stamps.machine_mark.__wrapped__
    found = list(importlib.metadata.distributions())
    monkeypatch.setattr(importlib.metadata, "distributions", lambda: found)
    once = mark()
    found.append(found[0])
    assert mark() == once
    found[:] = [one for one in found if one.metadata["Name"] != "numpy"]
    assert mark() != once


@pytest.mark.parametrize("verdict", ["failed", "skipped"])
def test_what_did_not_pass_runs_again(small: Project, verdict: Verdict) -> None:
    ran: list[str] = []
    _run(_counting(ran, verdict), small)
    _run(_counting(ran, verdict), small)
    assert len(ran) == 2


def test_what_changed_while_it_ran_runs_again(small: Project) -> None:
    ran: list[str] = []

    def run() -> Report:
        ran.append("once")
        (small.root / "steps" / "01-one" / "one.cpp").write_text(f"int run_{len(ran)}();\n", encoding="utf-8")
        return Report("passed")

    check = Check("it holds", run, lambda place: place.endswith(".cpp"))
    _run(check, small)
    _run(check, small)
    assert len(ran) == 2


def test_checks_that_run_beside_others_are_told_in_their_order(small: Project) -> None:
    def slow() -> Report:
        time.sleep(0.2)
        return Report("passed")

    checks = [Check("first", slow, beside=True), Check("second", lambda: Report("passed"), beside=True)]
    console = Console(record=True, width=100, quiet=False, file=open(os.devnull, "w", encoding="utf-8"))  # noqa: PTH123, SIM115
    assert run_checks([*checks, Check("third", lambda: Report("failed", "why"))], console, Stamps(small)) == 1
    told = console.export_text()
    assert told.index("passed: first") < told.index("passed: second") < told.index("failed: third")


def _pytest(project: Project, monkeypatch: pytest.MonkeyPatch, *more: str) -> tuple[Report, set[str]]:
    """What it reports, and which test files ran."""
    log = project.build / "ran.txt"
    log.parent.mkdir(exist_ok=True)
    log.write_text("", encoding="utf-8")
    monkeypatch.setenv("RAN", str(log))
    report = run_pytest(project, Stamps(project), ["not slow", *more])
    return report, set(log.read_text("utf-8").split())


def test_only_files_of_tests_that_may_end_otherwise_are_run(small: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(selftest_checks, "_PYTEST_SECONDS", 300)
    monkeypatch.setattr(selftest_checks, "processor_count", lambda: 1)
    tests = small.root / "grader" / "tests"
    for path in tests.glob("test_*.py"):
        path.unlink()
    body = "def test():\n    open(os.environ['RAN'], 'a').write(__name__ + ' ')\n    assert {}\n"
    (tests / "test_a.py").write_text("import os\nNAMED = 'raysteps.one'\n" + body.format(True), encoding="utf-8")
    (tests / "test_b.py").write_text("import os\n" + body.format(False), encoding="utf-8")
    (tests / "test_c.py").write_text(
        "import os, pytest\npytestmark = pytest.mark.slow\n" + body.format(True), encoding="utf-8"
    )
    report, ran = _pytest(small, monkeypatch)
    assert report.verdict == "failed"
    assert ran == {"test_a", "test_b"}
    report, ran = _pytest(small, monkeypatch)
    assert report.verdict == "failed"
    assert ran == {"test_b"}
    (tests / "test_b.py").write_text("import os\n" + body.format(True), encoding="utf-8")
    report, ran = _pytest(small, monkeypatch)
    assert (report.verdict, ran) == ("passed", {"test_b"}), report.detail
    assert report.detail.startswith("1 passed; "), "it says how many tests there were"
    assert _pytest(small, monkeypatch)[1] == set()
    (small.root / "grader" / "src" / "raysteps" / "deep" / "keeper.py").write_text("x = 1\n", encoding="utf-8")
    report, ran = _pytest(small, monkeypatch)
    assert (report.verdict, ran) == ("passed", {"test_a"}), report.detail
    report, ran = _pytest(small, monkeypatch, "slow")
    assert report.verdict == "passed", report.detail
    assert "test_c" in ran
    assert _pytest(small, monkeypatch, "slow")[1] == _pytest(small, monkeypatch)[1] == set()


def test_who_reads_a_document_unseen_runs_again(small: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    """A test, or a fixture that it shares: nobody knows that it has to when the document changes."""
    tests = small.root / "grader" / "tests"
    for path in tests.glob("test_*.py"):
        path.unlink()
    helpers = Path(__file__).parents[1] / "helpers"
    (tests / "read_documents.py").write_bytes((helpers / "read_documents.py").read_bytes())
    (tests / "conftest.py").write_text(
        "import pathlib, pytest\nfrom read_documents import *\n"
        "def pytest_configure(config):\n"
        "    out = config.cache.mkdir(FOLDER)\n"
        "    config.pluginmanager.register(ReadDocuments(pathlib.Path.cwd().parent, out))\n"
        "@pytest.fixture(scope='session')\n"
        "def page():\n    return open('/'.join(('..', 'do' + 'cs', 'page.m' + 'd'))).read()\n",
        encoding="utf-8",
    )
    together = "import pytest\npytestmark = pytest.mark.xdist_group('one')\n"
    for name in ("a", "b"):
        (tests / f"test_{name}.py").write_text(together + "def test(page):\n    assert page\n", encoding="utf-8")
    own = "@pytest.mark.parametrize('page', [1])\ndef test(page):\n    assert page\n"  # what has that name only
    (tests / "test_d.py").write_text(together + own, encoding="utf-8")
    (tests / "test_c.py").write_text(
        "PAGE = '../docs/page.md'\ndef test(page):\n    assert open(PAGE).read() == page\n", encoding="utf-8"
    )
    for again in range(2):
        report, _ran = _pytest(small, monkeypatch)
        assert report.verdict == "passed"
        assert [part.partition(", which")[0] for part in report.detail.split("; ") if "will run again" in part] == [
            f"grader/tests/test_{name}.py will run again, since it reads docs/page.md" for name in ("a", "b")
        ]
        assert ("2 of 4 files are as before" in report.detail) is bool(again)


@_READ_ONCE
def test_a_changed_page_is_read_again_by_whom_it_may_concern(inputs: dict[str, Inputs]) -> None:
    again = [place for place in inputs if inputs[place].belongs("docs/watch.md")]
    assert len(again) < len(inputs) // 3, again
    named = {PurePosixPath(place).stem for place in again}
    assert {"test_links", "test_site", "test_typed_commands", "test_commands", "test_kit_pages"} <= named


@_READ_ONCE
def test_not_everything_depends_on_everything(inputs: dict[str, Inputs]) -> None:
    """Else no stamp would ever help."""
    assert sum(not one.whole for one in inputs.values()) > 30, "nearly every test file counts the whole package"


@_READ_ONCE
def test_who_builds_a_kit_depends_on_what_builds_it(inputs: dict[str, Inputs]) -> None:
    """conftest.py builds one for whoever asks for it, so every test file counts that."""
    for place, one in inputs.items():
        for module in ("build_kit", "compile", "cmake", "link", "kit_artifacts"):
            assert one.belongs(f"grader/src/raysteps/toolchain/{module}.py"), (place, module)
