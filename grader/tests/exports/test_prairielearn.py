"""results.json of PrairieLearn."""

import base64
import csv
import io
import json
import re
import uuid
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from export_documents import HOSTILE, document, full, mixed, step_result
from PIL import Image

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import encoded
from raysteps.course.manifest import Step
from raysteps.exports.formats import validate
from raysteps.exports.hosted import by_id
from raysteps.exports.prairielearn import (
    MAX_BYTES,
    not_gradable,
    question_info,
    question_page,
    score,
    to_prairielearn,
)
from raysteps.results.model import Diagnosis, PointSum, Results, Total
from raysteps.submission.load import load_submission

pytestmark = pytest.mark.portable


def _with_pictures(made: Results, folder: Path, size: tuple[int, int], *, noisy: bool) -> None:
    chance = np.random.default_rng(3)
    for result in made.steps:
        for image in result.images:
            for kind in ("mine", "reference", "difference"):
                setattr(image, kind, f"pictures/{result.id}/{image.name}-{kind}.png")
                path = folder / getattr(image, kind)
                path.parent.mkdir(parents=True, exist_ok=True)
                shape = (size[1], size[0], 3)
                pixels = chance.integers(0, 255, shape) if noisy else np.full(shape, 120)
                Image.fromarray(pixels.astype(np.uint8)).save(path)


def _pictures(results: dict[str, Any]) -> list[Image.Image]:
    uris = [image["url"] for test in results["tests"] for image in test.get("images", [])]
    return [Image.open(io.BytesIO(base64.b64decode(uri.removeprefix("data:image/png;base64,")))) for uri in uris]


def test_score_and_points(steps: list[Step], tmp_path: Path) -> None:
    made = mixed(steps)
    results = to_prairielearn(made, by_id(steps), tmp_path)
    validate(results, "prairielearn")
    assert results["score"] == round(made.total.points / 100, 6)
    assert round(sum(test["points"] for test in results["tests"]), 9) == made.total.points
    assert sum(test["max_points"] for test in results["tests"]) == 100, "a bonus is not part of the maximum"
    assert [test["name"][:2] for test in results["tests"]] == [step.number for step in steps]
    assert results["tests"][7]["name"] == "08 Refraction (bonus): at most 10 points"
    assert "secret" not in str(results)


def test_a_step_that_is_graded_alone_has_a_card_for_each_kind_of_check(steps: list[Step], tmp_path: Path) -> None:
    made = document([step_result(steps[1], share=0.37)])
    results = to_prairielearn(made, by_id(steps), tmp_path)
    validate(results, "prairielearn")
    names = [test["name"] for test in results["tests"]]
    assert names == ["tests", "pictures", "hidden cases", "with the steps before it"]
    assert sum(test["max_points"] for test in results["tests"]) == 20
    assert round(sum(test["points"] for test in results["tests"]), 9) == made.total.points
    bonus = to_prairielearn(document([step_result(steps[8])]), by_id(steps), tmp_path)
    assert sum(test["max_points"] for test in bonus["tests"]) == 10, "nothing else could be the maximum"


def test_what_is_wrong_is_said_in_lines_that_fit(steps: list[Step], tmp_path: Path) -> None:
    made = mixed(steps, "It goes wrong in many ways, and each of them is told. " * 8)
    made.steps[1].diagnoses = [
        Diagnosis(
            "mistake", "x", "the far root is taken first", "", "Both are solutions.", "Which one do you meet?", ["hit"]
        )
    ]
    results = to_prairielearn(made, by_id(steps), tmp_path)
    texts = [results["message"], *(test["message"] for test in results["tests"])]
    assert max(len(line) for text in texts for line in text.splitlines()) <= 96
    for line in ("the far root is taken first.", "Both are solutions.", "Seen in hit.", "Hint: Which one do you meet?"):
        assert any(said.endswith(line) for said in results["message"].splitlines())
    assert "  expected: a == b\n" in results["tests"][1]["message"]


def test_the_bonus_is_clipped_and_said(steps: list[Step], tmp_path: Path) -> None:
    results = to_prairielearn(full(steps), by_id(steps), tmp_path)
    assert results["score"] == 1.0
    assert results["message"].startswith("The bonus leads above 100 %")
    assert score(Total(5.0, 0.0, PointSum(5.0, 10.0))) == (0.5, "")


def test_a_picture_comes_with_the_reference_and_the_difference(steps: list[Step], tmp_path: Path) -> None:
    made = mixed(steps)
    _with_pictures(made, tmp_path, (160, 120), noisy=False)
    results = to_prairielearn(made, by_id(steps), tmp_path)
    validate(results, "prairielearn")
    pictures = _pictures(results)
    assert len(pictures) == sum(len(result.images) for result in made.steps)
    assert {picture.size for picture in pictures} == {(3 * 160 + 8, 120)}
    label = results["tests"][0]["images"][0]["label"]
    assert label == "balls-directions: yours, the reference's, the difference, 8 times brighter"


def test_a_tiny_picture_is_enlarged(steps: list[Step], tmp_path: Path) -> None:
    made = document([step_result(steps[0])])
    _with_pictures(made, tmp_path, (12, 16), noisy=True)
    assert {picture.size for picture in _pictures(to_prairielearn(made, by_id(steps), tmp_path))} == {(152, 64)}


def test_large_pictures_are_shrunk(steps: list[Step], tmp_path: Path) -> None:
    made = mixed(steps)
    _with_pictures(made, tmp_path, (128, 96), noisy=True)
    results = to_prairielearn(made, by_id(steps), tmp_path)
    assert {picture.size for picture in _pictures(results)} == {(3 * 64 + 8, 48)}
    assert "left out" not in results["message"]
    assert len(encoded(results)) <= MAX_BYTES


def test_what_does_not_fit_is_left_out_those_that_passed_first(steps: list[Step], tmp_path: Path) -> None:
    made = mixed(steps, HOSTILE * 60)
    _with_pictures(made, tmp_path, (500, 300), noisy=True)
    results = to_prairielearn(made, by_id(steps), tmp_path)
    validate(results, "prairielearn")
    assert 500_000 < len(encoded(results)) <= MAX_BYTES
    assert re.search(r"[0-9]+ pictures did not fit and were left out\.", results["message"])
    shown = {image["label"].split(":")[0] for test in results["tests"] for image in test.get("images", [])}
    passed = {image.name for result in made.steps for image in result.images if image.passed}
    assert shown
    assert not shown & passed


def test_long_texts_are_cut_before_the_limit_breaks(steps: list[Step], tmp_path: Path) -> None:
    made = mixed(steps, "x" * 50_000)
    for result in made.steps:
        result.tests *= 40
    results = to_prairielearn(made, by_id(steps), tmp_path)
    assert len(encoded(results)) <= MAX_BYTES


@pytest.mark.parametrize("place", ["../outside.png", "missing.png", "text.png"])
def test_odd_pictures_are_ignored(steps: list[Step], tmp_path: Path, place: str) -> None:
    Image.new("RGB", (4, 4)).save(tmp_path / "outside.png")
    folder = tmp_path / "results"
    folder.mkdir()
    (folder / "text.png").write_text("not a picture")
    made = mixed(steps)
    made.steps[1].images[0].mine = place
    assert _pictures(to_prairielearn(made, by_id(steps), folder)) == []


def test_a_fault_takes_no_attempt() -> None:
    results = not_gradable("no \x1b[31mcompiler")
    validate(results, "prairielearn")
    assert results["message"] == "The grader could not do its work: no compiler"
    assert "No attempt was used up" in results["format_errors"][0]
    with pytest.raises(GraderFault):
        validate({**results, "score": 0}, "prairielearn")
    with pytest.raises(GraderFault):
        validate({"gradable": True, "score": 1.5, "tests": []}, "prairielearn")


def _file_names(page: str) -> tuple[str, list[str]]:
    """As PrairieLearn reads the attribute, by its page on pl-file-upload: a list in CSV without quotes, with the
    backslash before a comma that belongs to a name. Of several lines it takes the first only."""
    attribute, value = re.search(r'<pl-file-upload ([a-z-]+)="([^"]*)">', page).groups()  # type: ignore[union-attr]
    reader = csv.reader(io.StringIO(value), quoting=csv.QUOTE_NONE, escapechar="\\", skipinitialspace=True, strict=True)
    return attribute, next(reader)


def test_the_question_asks_for_the_files_of_its_steps(steps: list[Step], tmp_path: Path) -> None:
    attribute, names = _file_names(question_page(steps).decode())
    assert attribute == "optional-file-names", "a student hands in what is begun"
    assert names == [name for step in steps for name in step.files]
    assert _file_names(question_page([steps[3]]).decode()) == ("file-names", ["shadows.cpp"])
    for name in names:
        (tmp_path / name).write_text("// mine\n")
    assert set(load_submission(tmp_path, steps).sources) == {step.id for step in steps}, "they lie in no folders there"


def test_files_that_cannot_be_told_apart_are_refused(steps: list[Step]) -> None:
    with pytest.raises(UsageError, match=r"shadows\.cpp, shadows\.cpp"):
        question_page([steps[3], steps[3]])


def test_the_questions_description(steps: list[Step]) -> None:
    """By PrairieLearn's schema infoQuestion: these are required, and others of options are refused."""
    info = json.loads(question_info(steps, [], "me/raysteps"))
    assert {"uuid", "type", "title", "topic"} <= set(info)
    assert uuid.UUID(info["uuid"]).version == 5
    assert (info["type"], info["gradingMethod"]) == ("v3", "External")
    options = info["externalGradingOptions"]
    assert set(options) <= {"image", "entrypoint", "serverFilesCourse", "timeout", "enableNetworking", "environment"}
    assert options["timeout"] <= 600
    assert options["entrypoint"][0].startswith("/grade/serverFilesCourse/raysteps/")
    one = json.loads(question_info([steps[1]], ["02"], "me/raysteps"))
    assert one["uuid"] != info["uuid"]
    assert one["title"] == "02 Intersection"
    assert question_info(steps, [], "me/raysteps") == question_info(steps, [], "me/raysteps")
