"""A box holds a student's step and nothing that earns points; and what is asked of it is what one program would do."""

from pathlib import Path

import pytest
from machine_code import reference_code

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.stubs import without_markers
from raysteps.images.render import RenderResult, reference_picture, reference_work, render
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Input, Task
from raysteps.toolchain.compile import Program, StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.toolchain.limits import limits_of

Binaries = dict[str, Path]  # by the numbers of their steps


@pytest.fixture(scope="module")
def binaries(kit: BuiltKit, solved: dict[str, str], tmp_path_factory: pytest.TempPathFactory) -> Binaries:
    """The solutions as a student's libraries, compiled once by one build, as those of a submission are."""
    build = StudentBuild(kit, LimitsOnly(), tmp_path_factory.mktemp("solved"))
    return {step.number: _compiled(build, step, solved[step.id]) for step in kit.steps}


def test_no_reference_is_in_a_box(kit: BuiltKit, binaries: Binaries, tmp_path: Path) -> None:
    code = reference_code(kit)
    assert len(code) > 3 * len(kit.steps)
    # It would be found: every reference is in the program that draws the expected pictures.
    whole = kit.reference("raytrace").read_bytes()
    assert sum(piece in whole for piece in code.values()) > 0.9 * len(code)
    for step in kit.steps:
        for together in (False, True):
            program = _program(kit, step, binaries, tmp_path / f"{step.number}{together}", together=together)
            own = [other.number for other in kit.steps if other == step or (together and other.index < step.index)]
            for given in Task(program.words).all_inputs():
                if given.inner_name == "steps":
                    continue  # the student's own, here the reference's code
                data = given.path.read_bytes()
                assert [name for name, piece in code.items() if piece in data] == []
            libraries = next(word.path for word in program.words if isinstance(word, Input))
            assert {path.stem.removeprefix("libstep-") for path in libraries.iterdir()} <= set(own)


def _compiled(build: StudentBuild, step: Step, source: str) -> Path:
    compiled = build.compile(step, source.encode(), limits_of(step, {}))
    assert compiled.binary is not None, compiled.ran.outcome.stderr
    return compiled.binary


def _program(kit: BuiltKit, step: Step, binaries: Binaries, folder: Path, *, together: bool = False) -> Program:
    own = {other.number for other in kit.steps if other == step or (together and other.index < step.index)}
    theirs = {number: binary for number, binary in binaries.items() if number in own}
    build = StudentBuild(kit, LimitsOnly(), folder)
    program, ran = build.program("raytrace", step, theirs, limits_of(step, {}), together=together)
    assert program is not None, ran
    assert program.home is not None
    return program


def _last_case(
    step: Step, project: Project, kit: BuiltKit, program: Program
) -> tuple[Path, tuple[str, ...], RenderResult]:
    case = step.images[-1]
    at = case.args.index("--size") + 1
    scene, args = project.root / case.scene, (*case.args[:at], "61x47", *case.args[at + 1 :])
    return scene, args, render(LimitsOnly(), program, scene, args, limits_of(step, {}).of_program())


@pytest.mark.parametrize("together", [False, True])
def test_the_same_picture_and_the_same_counts(
    kit: BuiltKit, project: Project, binaries: Binaries, tmp_path: Path, *, together: bool
) -> None:
    for step in kit.steps:
        program = _program(kit, step, binaries, tmp_path / step.number, together=together)
        scene, args, rendered = _last_case(step, project, kit, program)
        assert rendered.pixels is not None, rendered.ran.outcome.stderr
        assert (rendered.pixels == reference_picture(kit, scene, args)).all(), step.id
        assert rendered.work == reference_work(kit, scene, args), step.id


@pytest.mark.parametrize("own", ["01 03 04 05 06 07 08 09", "10 11 12 13", "10 11 12 13 14 15"])
def test_steps_of_a_student_beside_others_of_the_reference(
    whole_kit: BuiltKit, project: Project, tmp_path: Path, own: str
) -> None:
    """What these others call may be a student's, too: a scene that is asked what a ray meets asks the box."""
    steps = [step for step in whole_kit.steps if step.number in own.split()]
    build = StudentBuild(whole_kit, LimitsOnly(), tmp_path)
    sources = {step.number: without_markers((project.solutions / step.path).read_text("utf-8")) for step in steps}
    binaries = {step.number: _compiled(build, step, sources[step.number]) for step in steps}
    program, ran = build.program("raytrace", steps[-1], binaries, limits_of(steps[-1], {}), together=True)
    assert program is not None, ran
    for step in (steps[-1], steps[0]):
        scene, args, rendered = _last_case(step, project, whole_kit, program)
        assert rendered.pixels is not None, rendered.ran.outcome.stderr
        assert (rendered.pixels == reference_picture(whole_kit, scene, args)).all(), step.id


def test_every_stand_in_says_that_it_is_one(project: Project) -> None:
    """By that a program knows which questions it can answer without asking."""
    paths = sorted((project.root / "framework" / "remote" / "stand_ins").glob("*.cpp"))
    assert paths
    for path in paths:
        assert "= remote::stand_in(FunctionId::" in path.read_text("utf-8"), path.name


@pytest.mark.parametrize(("at", "name"), [(5, "explicit-stack"), (8, "median-split")])
def test_what_an_honest_search_does_between_two_tests_is_its_own(
    kit: BuiltKit, project: Project, tmp_path: Path, *, at: int, name: str
) -> None:
    """Lists that are kept for the thread, and leaves in any order: as in one program, counts too."""
    step = kit.steps[at]
    source = (project.solutions / step.id / "alternatives" / f"{name}.cpp").read_text("utf-8")
    build = StudentBuild(kit.in_one_process(), LimitsOnly(), tmp_path / "one")
    binaries = {step.number: _compiled(build, step, source)}
    boxed = _program(kit, step, binaries, tmp_path / "boxed")
    alone, _ = build.program("raytrace", step, binaries, limits_of(step, {}))
    assert alone is not None
    assert alone.home is None
    seen = [_last_case(step, project, kit, program)[2] for program in (boxed, alone)]
    assert seen[0].pixels is not None, seen[0].ran.outcome.stderr
    assert seen[1].pixels is not None
    assert (seen[0].pixels == seen[1].pixels).all()
    assert seen[0].work == seen[1].work


def test_a_box_that_ends_is_what_became_of_the_step(
    kit: BuiltKit, project: Project, solved: dict[str, str], tmp_path: Path
) -> None:
    step = kit.steps[0]
    begins = "Ray primary_ray("
    endings = {"std::abort();": -6, "std::exit(0);": 0, "for (volatile int i = 0;;) { i = 1; }": -9, "throw 1;": 2}
    for number, (statement, code) in enumerate(endings.items()):
        source = "#include <cstdlib>\n" + solved[step.id]
        at = source.index("{", source.index(begins)) + 1
        broken = f"{source[:at]} if (x == 3 && y == 2) {{ {statement} }} {source[at:]}"
        folder = tmp_path / str(number)
        binary = _compiled(StudentBuild(kit, LimitsOnly(), folder), step, broken)
        program = _program(kit, step, {step.number: binary}, folder)
        case = step.images[0]
        limits = limits_of(step, {"seconds": 2.0}).of_program()
        rendered = render(LimitsOnly(), program, project.root / case.scene, case.args, limits)
        assert rendered.pixels is None
        assert rendered.ran.outcome.code == code


def test_a_step_may_print_and_read_while_it_is_loaded(
    kit: BuiltKit, project: Project, solved: dict[str, str], tmp_path: Path
) -> None:
    """As in one program: the wire is out of its way before the constructors of its library begin."""
    step = kit.steps[0]
    talks = "static const bool talked = [] { int x = 0; std::cout << x << std::endl; std::cin >> x; return true; }();\n"
    source = f"#include <iostream>\n{talks}{solved[step.id]}"
    binary = _compiled(StudentBuild(kit, LimitsOnly(), tmp_path), step, source)
    program = _program(kit, step, {step.number: binary}, tmp_path / "program")
    _, _, rendered = _last_case(step, project, kit, program)
    assert rendered.pixels is not None, rendered.ran.outcome.stderr
    assert rendered.ran.outcome.stderr == "0\n"
