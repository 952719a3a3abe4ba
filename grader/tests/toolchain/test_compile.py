"""A compiler that does not work is nobody's mistake who handed something in."""

from dataclasses import replace
from pathlib import Path

import pytest

from raysteps.common.errors import GraderFault
from raysteps.common.platform import is_windows
from raysteps.common.process import Outcome
from raysteps.grading.build_messages import why_not_built
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import TaskResult
from raysteps.toolchain.compile import Compiled, StudentBuild, unresolved_names
from raysteps.toolchain.kit_artifacts import BuiltKit

pytestmark = pytest.mark.skipif(is_windows(), reason="stands in for the compiler by a shell script")
_SOURCE = "int answer() { return 42; }\n"


def _compiled(kit: BuiltKit, folder: Path, script: str) -> Compiled:
    """By a compiler that does first what the script says."""
    compiler = folder / "compiler"
    compiler.write_text(f'#!/bin/sh\n{script}\nexec {kit.description.compiler} "$@"\n')
    compiler.chmod(0o755)
    other = replace(kit, description=replace(kit.description, compiler=str(compiler)))
    step = kit.steps[0]
    return StudentBuild(other, LimitsOnly(), folder / "build").compile(step, _SOURCE.encode(), kit.limits_of(step))


def test_one_that_never_works_is_a_fault_of_the_grader(kit: BuiltKit, tmp_path: Path) -> None:
    with pytest.raises(GraderFault, match=r"does not work where .* exit code 3, and it says nothing"):
        _compiled(kit, tmp_path, "exit 3")


def test_one_that_gives_up_on_a_file_does_not_build_it(kit: BuiltKit, tmp_path: Path) -> None:
    compiled = _compiled(kit, tmp_path, f'case "$*" in *{kit.steps[0].file}*) exit 3 ;; esac')
    assert compiled.binary is None
    assert why_not_built(kit, kit.steps[0], compiled, _SOURCE).endswith("the compiler gave up and said nothing.")


@pytest.mark.parametrize(
    ("kind", "told"),
    [
        ('int f{0}() asm("{1}"); int f{0}() {{ return 1; }}', ""),
        ('__attribute__((weak)) int f{0}() asm("{1}"); int f{0}() {{ return 1; }}', ""),
        ('__attribute__((visibility("hidden"))) int f{0}() asm("{1}"); int f{0}() {{ return 1; }}', "hides them"),
        ('extern const int f{0} asm("{1}"); const int f{0} = 1;', "they are no functions"),
        ('extern thread_local int f{0} asm("{1}"); thread_local int f{0} = 1;', "they are no functions"),
    ],
)
def test_functions_that_nobody_can_call_are_named(kit: BuiltKit, tmp_path: Path, kind: str, told: str) -> None:
    """Else the program would find that out, test by test."""
    step = next(one for one in kit.steps if one.id == "07-tone-mapping")
    source = "\n".join(kind.format(number, name) for number, name in enumerate(kit.functions(step)))
    compiled = StudentBuild(kit, LimitsOnly(), tmp_path).compile(step, source.encode(), kit.limits_of(step))
    assert (compiled.binary is None) == bool(told)
    if told:
        message = why_not_built(kit, step, compiled, source)
        assert "to_byte(float) and tone_map(const glm::vec3&) are defined, but cannot be called" in message
        assert told in message


def test_what_a_linker_finds_nowhere_is_a_students_whatever_its_name() -> None:
    """But for what sanitizers have in the program itself."""
    names = ["c_helper", "__helper", "_Z6helperv", "__asan_report_load4", "__ubsan_handle_out_of_bounds_abort"]
    said = "".join(f"ld: step.o: undefined reference to `{name}'\n" for name in names)
    assert unresolved_names(TaskResult(Outcome(0, False, "", said, 0.1), {}, 0.1, "")) == set(names[:3])
