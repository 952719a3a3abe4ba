"""What reads the kit's own code without running it: linters and formatters, the same for `test`, `dev lint` and git."""

import json
import re
import shutil
import sys
import sysconfig
from functools import partial
from pathlib import Path

from raysteps.common.files import write_json
from raysteps.common.platform import executable
from raysteps.course.project import Project
from raysteps.course.tracked_files import list_files
from raysteps.toolchain.cmake import BuildTree
from tools.selftest.checks import Check, Report
from tools.selftest.programs import command

LANGUAGES = ("python", "scripts", "cpp")
_PYTHON = (".", "../tools")
TIDY = "tidy"  # for C++ as well; by itself, as it takes minutes
_TIDY_SECONDS = 1800
# Submissions by others keep their form, samples follow the solutions, and templates are not C++ yet.
_FORMATTED = re.compile(r"(?!grader/tests/|grader/samples/).*(?<!/templates)/[^/]+\.[ch]pp")


def _tool(name: str) -> Path:
    """A program that a package of the extra `dev` brings."""
    return executable(Path(sysconfig.get_path("scripts")) / name)


def _biome(project: Project, *words: str) -> Report:
    """Its package has it for Linux on x86-64; elsewhere it may be installed otherwise."""
    program = _tool("biome") if _tool("biome").is_file() else shutil.which("biome")
    if program is None:
        return Report("skipped", "install: Biome, https://biomejs.dev")
    return command([program, "check", *words], project.root)


def _cpp(project: Project, *words: str) -> Report:
    names = [place for place in list_files(project.root) if _FORMATTED.fullmatch(place.as_posix())]
    files = [path for name in names if (path := project.root / name).is_file()]
    return command([_tool("clang-format"), *words, *files], project.root)


_WEB = "framework/web"
_LIKE_WEB = "framework/apps/raytrace.cpp"  # includes of the same rooms
_WEB_ALONE = "exceptions.cpp"  # of instructions that only WebAssembly has


def _each_once(folder: Path, root: Path) -> Path:
    """Where the commands of a build folder stand once for each source: some belong to several programs. What only the
    compiler of the page to work in compiles is listed as if this one did."""
    commands = json.loads((folder / "compile_commands.json").read_text(encoding="utf-8"))
    once = {command["file"]: command for command in commands}
    like = once[str(root / _LIKE_WEB)]
    for path in sorted((root / _WEB).glob("*.cpp")):
        if path.name != _WEB_ALONE:
            words = like["command"].replace(like["file"], str(path))
            foreign = "-Wno-unknown-attributes"  # of functions that a page gives
            once[str(path)] = like | {"command": f"{words} {foreign}", "file": str(path)}
    write_json(folder / "once" / "compile_commands.json", list(once.values()))
    return folder / "once"


def _tidy(project: Project, *words: str) -> Report:
    """Looks at each source but tests and stubs as the preset `dev` compiles it, yet with no header that others brought;
    nothing has to be built."""
    tree = BuildTree(project, "dev", project.build / "tidy", project.steps, ("-DRAYSTEPS_PRECOMPILE=OFF",))
    with tree.locked():
        tree.configure()
    sources = rf"^{re.escape(project.root.as_posix())}/(bench|framework|solutions)/(?!testing/|io/fuzz/|.*_test\.)"
    runner: list[str | Path] = [sys.executable, _tool("run-clang-tidy.py"), "-clang-tidy-binary", _tool("clang-tidy")]
    runner += ["-quiet", "-p", _each_once(tree.folder, project.root), *words, sources]
    return command(runner, project.root, _TIDY_SECONDS, progress=r"\[ *\d+/\d+\]")


def _is_python(place: str) -> bool:
    return place.startswith(("grader/", "tools/"))


def _is_script(place: str) -> bool:
    return place == "biome.json" or place.endswith(".js")


def _is_cpp(place: str) -> bool:
    return place.startswith((".clang-", "cmake/", "CMake")) or place.endswith((".cpp", ".hpp", "CMakeLists.txt"))


def lint_checks(project: Project, languages: tuple[str, ...]) -> list[Check]:
    """Those of the languages."""
    grader = project.root / "grader"
    python: list[str | Path] = [sys.executable, "-m"]
    ruff = [*python, "ruff"]
    checks = {
        "python": [
            Check("mypy --strict", partial(command, [*python, "mypy"], grader), _is_python, beside=True),
            Check("ruff check", partial(command, [*ruff, "check", *_PYTHON], grader), _is_python, beside=True),
            Check(
                "ruff format", partial(command, [*ruff, "format", "--check", *_PYTHON], grader), _is_python, beside=True
            ),
        ],
        "scripts": [Check("biome", partial(_biome, project, "--error-on-warnings"), _is_script, beside=True)],
        "cpp": [Check("clang-format", partial(_cpp, project, "--dry-run", "-Werror"), _is_cpp, beside=True)],
        TIDY: [Check("clang-tidy", partial(_tidy, project), _is_cpp)],
    }
    return [check for language in languages for check in checks[language]]


def reformat(project: Project, languages: tuple[str, ...]) -> list[Check]:
    """Formats in place, and mends what the linters can mend without a doubt."""
    grader = project.root / "grader"
    python: list[str | Path] = [sys.executable, "-m", "ruff"]
    checks = {
        "python": [
            Check("ruff check --fix", partial(command, [*python, "check", "--fix", *_PYTHON], grader)),
            Check("ruff format", partial(command, [*python, "format", *_PYTHON], grader)),
        ],
        "scripts": [Check("biome", partial(_biome, project, "--write"))],
        "cpp": [Check("clang-format", partial(_cpp, project, "-i"))],
        TIDY: [Check("clang-tidy -fix", partial(_tidy, project, "-fix"))],
    }
    return [check for language in languages for check in checks[language]]
