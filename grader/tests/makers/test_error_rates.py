"""How often the judge errs: what is counted, and a small run."""

import re
from pathlib import Path

import pytest
from rich.console import Console

from raysteps.common.errors import UsageError
from raysteps.course.manifest import choose, kit_steps
from raysteps.course.mutants import reference_source
from raysteps.course.project import Project
from raysteps.judge.plan import read_plan
from raysteps.results.model import CaseGroup, HiddenResult
from tools.bench.docs import replace_part
from tools.calibration import error_rates
from tools.calibration.error_rates import (
    FACTORS,
    PLANTED,
    ErrorOptions,
    StepRates,
    Tally,
    averages_of,
    errors,
    rows_of,
)


def _result(function: str, **right: int) -> HiddenResult:
    """Of ten cases of each kind, so many right."""
    groups = [CaseGroup(name, 10, number, share=number / 10) for name, number in right.items()]
    share = 1.0 if all(number == 10 for number in right.values()) else 0.5
    return HiddenResult(function, "function", share, 1.0, message="mean is wrong", groups=groups)


@pytest.mark.portable
def test_every_bias_has_its_place_in_the_reference(project: Project) -> None:
    steps = {step.number: step for step in kit_steps(project)}
    assert {planted.number for planted in PLANTED} == {"12", "13", "14", "15"}
    for planted in PLANTED:
        step = steps[planted.number]
        assert planted.function in step.functions
        source = reference_source(project, step)
        biased = {planted.applied(source, factor) for factor in FACTORS}
        assert len(biased) == len(FACTORS)
        assert all("FACTOR" not in text and re.search(r"1\.0[125]F", text) for text in biased)


@pytest.mark.portable
def test_a_grade_is_wrong_when_a_function_loses_anything() -> None:
    tally, averages = Tally(), {("path_light", "mean")}
    tally.add(1, "the reference", [_result("path_light", mean=10, exact=10)], averages)
    assert (tally.grades, tally.wrong, tally.first) == (1, 0, "")
    tally.add(2, "another", [_result("path_light", mean=10, exact=9)], averages)
    tally.add(3, "a third", [_result("path_light", mean=9, exact=9), _result("scatter", mean=10)], averages)
    assert (tally.grades, tally.wrong, tally.by_averages) == (3, 2, 1)
    assert tally.first == "another, seed 2: mean is wrong"


@pytest.mark.portable
def test_a_row_for_each_step_and_each_bias(project: Project) -> None:
    (step,) = choose(kit_steps(project), ["13"])
    planted = {
        ("path_light", factor): Tally(20, found, found // 2) for factor, found in zip(FACTORS, (4, 9, 20), strict=True)
    }
    rates = StepRates(step, True, Tally(60, 1), 6, planted)
    assert list(rows_of([rates])) == [
        ("13-path-tracing", "6 right solutions", "1 of 60", "", "", ""),
        ("", "the reference, `path_light` biased", "", "4 (2) of 20", "9 (4) of 20", "20 (10) of 20"),
    ]


@pytest.mark.portable
def test_the_cases_that_ask_for_a_mean_are_known(project: Project) -> None:
    found = {}
    for step in choose(kit_steps(project), ["12", "13", "15"]):
        plan = read_plan(project, step)
        assert plan is not None
        found[step.number] = {function for function, _ in averages_of(step, plan, 1)}
    assert found == {"12": set(), "13": {"path_light"}, "15": {"mis_path_light"}}


@pytest.mark.portable
def test_the_page_has_a_part_for_the_table(project: Project) -> None:
    page = (project.root / "docs" / "judge.md").read_text(encoding="utf-8")
    assert "\nnew\n" in replace_part(page, "errors", "new", "judge.md")


@pytest.mark.portable
@pytest.mark.parametrize(
    ("options", "said"),
    [
        (ErrorOptions(only=("3",)), "--only 03: nothing of its grade is left to chance; expected steps of part two"),
        (ErrorOptions(only=("9-11",)), "--only 09: nothing of its grade is left to chance"),
        (ErrorOptions(grades=0), "--grades 0: expected 1 or more"),
    ],
)
def test_what_cannot_be_measured_is_refused_at_once(project: Project, options: ErrorOptions, said: str) -> None:
    with pytest.raises(UsageError, match=re.escape(said)):
        errors(project, options, Console(), lambda words: None)


@pytest.mark.slow
def test_a_bias_is_found_and_right_solutions_are_not_accused(
    project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(error_rates, "FACTORS", (1.05,))
    console = Console(width=150, file=(tmp_path / "told").open("w"))
    options = ErrorOptions(grades=1, planted=1, only=("13",))
    assert errors(project, options, console, lambda words: None) == 0
    assert "0 of 6 grades of right solutions are false" in capsys.readouterr().out
    console.file.flush()
    told = (tmp_path / "told").read_text()
    assert "`path_light` biased" in told
    assert "1 (1) of 1" in told
