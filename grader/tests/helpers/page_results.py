"""Results for the tests of pages: of any status, with text that would like to be HTML, and with pictures."""

import json
from pathlib import Path

import numpy as np
import numpy.typing as npt

from raysteps.common.documents import plain
from raysteps.course.manifest import Step
from raysteps.images.compare import difference, write_png
from raysteps.results.model import (
    CaseGroup,
    Diagnosis,
    HiddenResult,
    Histogram,
    ImageResult,
    Integration,
    Results,
    StepResult,
    TestResult,
    Work,
)
from raysteps.results.store import parse_results

NASTY = "<script>alert(1)</script>"
Pixels = npt.NDArray[np.uint8]


def _noise(seed: int, shape: tuple[int, int]) -> Pixels:
    return np.random.default_rng(seed).integers(0, 256, (*shape, 3), dtype=np.uint8)


def _image(folder: Path, step: Step, at: int, shape: tuple[int, int], *, right: bool) -> ImageResult:
    case = step.images[at]
    reference = _noise(at, shape)
    mine = reference if right else _noise(at + 100, shape)
    names = {kind: f"pictures/{step.id}/{case.name}-{kind}.png" for kind in ("mine", "reference", "difference")}
    write_png(reference, folder / names["reference"])
    write_png(mine, folder / names["mine"])
    write_png(difference(mine, reference), folder / names["difference"])
    work = Work(1000, 4000, 900, 73, 500, 20000) if case.max_share is not None else None
    return ImageResult(
        case.name,
        case.scene,
        right,
        case.max_wrong,
        wrong_share=0.0 if right else 0.99,
        max_share=case.max_share,
        share_tested=0.4 if work else None,
        work=work,
        reference_work=work,
        message="" if right else f"99% of the pixels are wrong {NASTY}",
        outcome="ok" if right else "wrong",
        mine=names["mine"],
        reference=names["reference"],
        difference=names["difference"],
    )


def passed_step(step: Step, folder: Path, shape: tuple[int, int] = (24, 32)) -> StepResult:
    """All is right."""
    return StepResult(
        step.id,
        "passed",
        step.points,
        step.points,
        step.bonus,
        tests=[TestResult("a test that passes", True)],
        images=[_image(folder, step, at, shape, right=True) for at in range(len(step.images))],
        hidden=[HiddenResult("mirror", "function", 1.0)],
        cumulative=Integration(True),
    )


def wrong_step(step: Step, folder: Path, shape: tuple[int, int] = (24, 32)) -> StepResult:
    """One of two tests passes, no picture does, and half of the hidden part is right."""
    share = step.weight_tests / 2 + step.weight_hidden / 2
    lost = HiddenResult(
        "mirror",
        "function",
        0.5,
        groups=[CaseGroup(f"any {NASTY}", 40, 20)],
        message=f"the direction is wrong {NASTY}",
        given=f"direction (1, 0, 0) {NASTY}",
        expected=f"(0, 1, 0) {NASTY}",
        actual=f"(0, 0, 1) {NASTY}",
        case=f"cases/{step.number}-mirror.json",
        outcome="wrong",
        histogram=Histogram(f"directions {NASTY}", [30, 10, 0, 0], [10.0, 10.0, 10.0, 10.0]),
    )
    return StepResult(
        step.id,
        "partial",
        round(step.points * share, 2),
        step.points,
        step.bonus,
        tests=[
            TestResult("a test that passes", True),
            TestResult(f"a test {NASTY}", False, f"said {NASTY}", f"a == {NASTY}", f"1 == {NASTY}", "a_test.cpp:7"),
        ],
        images=[_image(folder, step, at, shape, right=False) for at in range(len(step.images))],
        hidden=[lost],
        diagnoses=[
            Diagnosis("mistake", "normal-not-unit", "the normal is not of length 1", "stains", "it was not divided",
                      "what is its length?", ["mirror"], ["the light is not"]),
            Diagnosis("finding", "where", f"{NASTY} is wrong where z < 0"),
        ],
        build_log=f"warning: unused {NASTY}",
        cumulative=Integration(False, "This step itself is not right yet."),
        messages=["1 of 2 tests failed.", f"more {NASTY}"],
    )  # fmt: skip


def idle_step(step: Step) -> StepResult:
    """Nothing was handed in."""
    message = f"{step.file} was not handed in."
    return StepResult(step.id, "not-started", 0.0, step.points, step.bonus, messages=[message])


def document_of(steps: list[StepResult], name: str = "ann") -> Results:
    """As `grade` writes it."""
    return Results.of(name, steps, "0123 GNU 12.2.0")


_NEWER = ("version", "course", "handed_in", "work", "reference_work")  # that older kits did not write


def _without(document: object) -> object:
    if isinstance(document, dict):
        return {key: _without(value) for key, value in document.items() if key not in _NEWER}
    return [_without(value) for value in document] if isinstance(document, list) else document


def of_older_kit(results: Results) -> Results:
    """As they are read when an older kit wrote them."""
    return parse_results(json.dumps(_without(plain(results))).encode())
