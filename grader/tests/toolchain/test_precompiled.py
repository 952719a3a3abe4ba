"""Headers that are compiled once save time, and a file sees no name more than it includes."""

import os
from pathlib import Path

import pytest

from raysteps.common.process import run
from raysteps.course.manifest import Step
from raysteps.course.stubs import included, pristine_stub
from raysteps.grading.build_messages import why_not_built
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Input, Output, Sandbox, Task, TaskResult, Word
from raysteps.toolchain.compile import Compiled, StudentBuild, build_log
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.toolchain.limits import limits_of

_STEP = "07"
# Ambiguous where <algorithm> is included.
_OWN_CLAMP = """
using namespace std;
template <typename T> T clamp(const T& x, const T& low, const T& high) { return x < low ? low : high < x ? high : x; }
int between = clamp(3, 1, 2);
"""


@pytest.fixture(autouse=True)
def _gnu(kit: BuiltKit) -> None:
    if not kit.description.compiler_version.startswith("GNU"):
        pytest.skip("only g++ is given compiled headers")


class _Told:
    """Has g++ tell of each header that it reads."""

    isolation = LimitsOnly.isolation

    def __init__(self) -> None:
        self.compiled_headers: list[str] = []

    @staticmethod
    def _outside(word: Word) -> str | Path:
        match word:
            case Input():
                return word.path
            case Output():
                return os.devnull
            case _:
                return word

    def run(self, task: Task) -> TaskResult:
        if "-c" in task.command:
            words = [self._outside(word) for word in task.command]
            lines = run([*words, "-H"], seconds=60).stderr.splitlines()
            self.compiled_headers += [line for line in lines if line.startswith("! ")]
        return LimitsOnly().run(task)


def _compiled(kit: BuiltKit, step: Step, source: str, folder: Path, sandbox: Sandbox) -> Compiled:
    return StudentBuild(kit, sandbox, folder).compile(step, source.encode(), limits_of(step, {}))


def test_they_are_taken_for_every_file_that_begins_as_its_stub(
    kit: BuiltKit, solved: dict[str, str], tmp_path: Path
) -> None:
    for step in kit.steps:
        told = _Told()
        compiled = _compiled(kit, step, solved[step.id], tmp_path / step.number, told)
        assert compiled.binary is not None
        assert len(told.compiled_headers) == 1, step.id


def test_names_of_headers_that_a_file_does_not_include_stay_free(kit: BuiltKit, tmp_path: Path) -> None:
    step = next(step for step in kit.steps if step.number == _STEP)
    headers = included(pristine_stub(kit.project, step))
    assert "<algorithm>" in headers

    def code(more: str) -> int:
        others = "".join(f"#include {name}\n" for name in headers if name != "<algorithm>")
        folder = tmp_path / str(len(more))
        return _compiled(kit, step, others + more + _OWN_CLAMP, folder, LimitsOnly()).ran.outcome.code

    line = "#include <algorithm>\n"
    assert code(line) != 0
    assert [code(more) for more in ("", f"/*\n{line}*/\n", f"// {line}", f"#if 0\n{line}#endif\n")] == [0, 0, 0, 0]


def test_a_file_that_holds_all_of_it_twice_is_told_so(kit: BuiltKit, solved: dict[str, str], tmp_path: Path) -> None:
    step = next(step for step in kit.steps if step.number == _STEP)
    source = 2 * f"{solved[step.id]}\n"
    message = why_not_built(kit, step, _compiled(kit, step, source, tmp_path, LimitsOnly()), source)
    assert "redefinition of" in message
    assert "It is defined twice, in this file" in message


def test_messages_name_the_students_file(kit: BuiltKit, solved: dict[str, str], tmp_path: Path) -> None:
    step = next(step for step in kit.steps if step.number == _STEP)
    source = f"{solved[step.id]}\nint wrong = std::clamp(1, 2.0F, 3);\n"
    log = build_log(_compiled(kit, step, source, tmp_path, LimitsOnly()).ran)
    assert f"from {step.file}" in log
    assert "precompiled" not in log
