"""What a step may ask of the kit, and what it must define."""

from dataclasses import replace
from pathlib import Path

import pytest
from conftest import MakeSubmission, Sources

from raysteps.common.errors import GraderFault
from raysteps.course.manifest import Step
from raysteps.grading import pipeline
from raysteps.grading.pipeline import grade_submission
from raysteps.judge.hidden_tests import run_hidden_tests
from raysteps.results.model import HiddenResult, Settings, StepResult
from raysteps.results.store import read_results
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.submission.load import load_submission
from raysteps.toolchain.compile import StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit

STEP = "02-intersection"
_BVH = "09-bvh"


@pytest.fixture(autouse=True)
def _closed_steps(kit: BuiltKit) -> None:
    if kit.description.seal is None:
        pytest.skip("steps are libraries on Linux only")


def _grade(kit: BuiltKit, submission: Path, out: Path) -> StepResult:
    return grade_submission(
        kit, load_submission(submission, kit.steps), Settings(only=(STEP,)), LimitsOnly(), out
    ).steps[0]


def _with(solved: Sources, statement: str, include: str) -> dict[str, str]:
    body = "std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {\n"
    assert body in solved[STEP]
    return {STEP: f'#include "{include}"\n' + solved[STEP].replace(body, body + statement + "\n")}


def _first_line(source: str, call: str) -> tuple[str, str]:
    """`line:column` of the call, and it between its neighbours."""
    lines = source.splitlines()
    line = next(number for number, text in enumerate(lines, 1) if call in text)
    column = lines[line - 1].index(call) + 1
    shown = [f"{number:5} | {lines[number - 1]}" for number in (line - 1, line, line + 1)]
    return f"{line}:{column}", "\n".join([*shown[:2], f"      | {' ' * (column - 1)}^", shown[2]])


def test_a_function_of_a_later_step_is_out_of_reach(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources
) -> None:
    sources = _with(solved, "return closest_hit_in_octree(build_octree(surfaces), ray);", "steps/06-octree/octree.hpp")
    result = _grade(kit, make_submission("later", sources), tmp_path / "out")
    assert (result.status, result.points) == ("does-not-build", 0)
    place, shown = _first_line(sources[STEP], "closest_hit_in_octree(")
    assert result.messages == [
        f"It does not build: intersection.cpp:{place}: it calls a function of step 06-octree, which comes later."
        f"\n{shown}"
    ]


def _without_libraries(kit: BuiltKit) -> BuiltKit:
    """As on a system whose linker closes no step, such as Windows."""
    return replace(kit, description=replace(kit.description, seal=None))


@pytest.mark.parametrize("libraries", [True, False])
@pytest.mark.parametrize(
    "use",
    ["return closest_hit_in_octree({}, ray);", "static auto* volatile find = &closest_hit_in_octree; (void)find;"],
)
def test_what_does_the_work_of_a_step_elsewhere_is_out_of_its_reach(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources, use: str, libraries: bool
) -> None:
    kit = kit if libraries else _without_libraries(kit)
    body = "std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {\n"
    assert body in solved[_BVH]
    source = '#include "steps/06-octree/octree.hpp"\n' + solved[_BVH].replace(body, f"{body}{use}\n")
    submission = load_submission(make_submission("earlier", {_BVH: source}), kit.steps)
    result = grade_submission(kit, submission, Settings(only=(_BVH,)), LimitsOnly(), tmp_path / "out").steps[0]
    assert (result.status, result.points) == ("does-not-build", 0)
    place, shown = _first_line(source, "closest_hit_in_octree")
    assert result.messages == [
        f"It does not build: bvh.cpp:{place}: step 09-bvh may not call closest_hit_in_octree of step 06-octree, which "
        f"does what step 09-bvh is about. Write it in bvh.cpp itself.\n{shown}"
    ]


def test_a_function_of_ones_own_may_have_the_name_of_one_that_is_barred(
    kit: BuiltKit, tmp_path: Path, solved: Sources
) -> None:
    bvh = kit.steps[8]
    own = "namespace { int build_octree() { return 1; } [[maybe_unused]] const int k_own = build_octree(); }\n"
    for one in (kit, _without_libraries(kit)):
        build = StudentBuild(one, LimitsOnly(), tmp_path)
        compiled = build.compile(bvh, (solved[_BVH] + own).encode(), one.limits_of(bvh))
        assert compiled.binary is not None, compiled


def test_a_step_may_ask_for_what_no_manifest_bars(kit: BuiltKit) -> None:
    octree, bvh = kit.steps[5], kit.steps[8]
    barred = kit.functions(octree).keys() - kit.allowed(bvh)
    assert barred == kit.linker_names(octree, bvh.barred_functions)
    assert len(barred) == len(bvh.barred) > 0
    assert all(name not in (kit.folder / "steps" / "09.dynamic").read_text("utf-8") for name in barred)
    for step in kit.steps[5:8]:
        assert kit.functions(octree).keys() <= kit.allowed(step)


def test_the_counters_are_out_of_reach(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources
) -> None:
    sources = _with(solved, "thread_stats().surface_tests = 0;", "core/stats.hpp")
    result = _grade(kit, make_submission("counters", sources), tmp_path / "out")
    assert result.status == "does-not-build"
    place, shown = _first_line(sources[STEP], "thread_stats()")
    assert result.messages[0].startswith(f"It does not build: intersection.cpp:{place}: it reaches for the counters")
    assert result.messages[0].endswith(shown)


def test_a_function_of_an_earlier_step_is_there(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources
) -> None:
    assert "point_at(ray" in solved[STEP]
    assert _grade(kit, make_submission("earlier", {STEP: solved[STEP]}), tmp_path / "out").status == "passed"


def test_a_missing_function_is_named(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources
) -> None:
    source = solved[STEP].replace("closest_hit(const SurfaceList&", "nearest_hit(const SurfaceList&")
    result = _grade(kit, make_submission("missing", {STEP: source}), tmp_path / "out")
    assert result.status == "does-not-build"
    assert result.messages[0].startswith("It does not build: closest_hit(")
    assert "is missing. The file must define it exactly" in result.messages[0]


def test_what_a_file_defines_beside_its_functions_stays_its_own(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources
) -> None:
    extra = """
    #include <cstdlib>
    int main() { return 0; }
    void* operator new(std::size_t size) { return std::malloc(size); }
    void operator delete(void* place) noexcept { std::free(place); }
    void operator delete(void* place, std::size_t) noexcept { std::free(place); }
    namespace raysteps { float tone_map_channel(float) { return 0.5F; } }
    extern "C" int write(int, const void*, unsigned long) { return 0; }
    """
    result = _grade(kit, make_submission("extra", {STEP: solved[STEP] + extra}), tmp_path / "out")
    assert result.status == "passed", result.messages


@pytest.mark.parametrize(
    ("declared", "called", "shown"),
    [
        ("namespace raysteps { float helper(float); }", "(void)helper(1.0F);", "raysteps::helper(float)"),
        ("float own_helper(float);", "(void)::own_helper(1.0F);", "own_helper(float)"),
        ('extern "C" float c_helper(float);', "(void)c_helper(1.0F);", "c_helper"),
    ],
)
def test_a_helper_that_nobody_defines_is_named(
    kit: BuiltKit,
    tmp_path: Path,
    make_submission: MakeSubmission,
    solved: Sources,
    declared: str,
    called: str,
    shown: str,
) -> None:
    source = declared + "\n" + _with(solved, called, "core/ray.hpp")[STEP]
    result = _grade(kit, make_submission("helper", {STEP: source}), tmp_path / "out")
    assert result.status == "does-not-build"
    place, lines = _first_line(source, called.removeprefix("(void)").removeprefix("::"))
    assert result.messages[0].startswith(
        f"It does not build: intersection.cpp:{place}: {shown} is called, but defined nowhere."
    )
    assert result.messages[0].endswith(lines)


def test_the_standard_library_is_within_reach(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources
) -> None:
    use = """
    [[maybe_unused]] static const std::size_t once = [&ray] {
        static thread_local std::vector<std::string> words;
        std::thread([] {}).join();
        try { words.push_back(std::regex_replace("a", std::regex("a"), "b")); } catch (const std::exception&) { throw; }
        std::clog << words.size() << typeid(ray).name();
        return words.size();
    }();
    """
    headers = "".join(
        f"#include <{name}>\n" for name in ("iostream", "regex", "string", "thread", "typeinfo", "vector")
    )
    source = headers + _with(solved, use, "core/ray.hpp")[STEP]
    result = _grade(kit, make_submission("library", {STEP: source}), tmp_path / "out")
    assert result.status == "passed", result.messages


def test_a_surprise_in_one_step_is_told_and_leaves_the_others_alone(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What nobody foresaw is the grader's fault, exit code 4; what it saw of other steps is written all the same."""

    def surprised(step: Step, *rest: object) -> list[HiddenResult]:
        if step.id == STEP:
            raise ZeroDivisionError("\x1b[31mnobody thought of it")
        return run_hidden_tests(step, *rest)  # type: ignore[arg-type]

    monkeypatch.setattr(pipeline, "run_hidden_tests", surprised)
    other = "07-tone-mapping"
    submission = load_submission(make_submission("jo", {STEP: solved[STEP], other: solved[other]}), kit.steps)
    with pytest.raises(GraderFault, match=f"^not graded: {STEP}: ZeroDivisionError: nobody thought of it; "):
        grade_submission(kit, submission, Settings(only=(STEP, other)), LimitsOnly(), tmp_path, course="Optics")
    told = read_results(tmp_path / "results.json")
    assert told.course == "Optics"
    lost, kept = told.steps
    assert (lost.status, lost.points, lost.tests) == ("failed", 0, [])
    assert "not graded, by a fault of the grader" in lost.messages[0]
    assert (kept.status, kept.points) == ("passed", kept.max)
