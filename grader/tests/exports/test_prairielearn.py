"""results.json of PrairieLearn."""

import base64
import io
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from export_documents import HOSTILE, full, mixed
from PIL import Image

from raysteps.common.errors import GraderFault
from raysteps.common.files import encoded
from raysteps.course.manifest import Step
from raysteps.exports.formats import validate
from raysteps.exports.hosted import by_id
from raysteps.exports.prairielearn import MAX_BYTES, not_gradable, score, to_prairielearn
from raysteps.results.model import PointSum, Results, Total

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
    assert "secret" not in str(results)


def test_the_bonus_is_clipped_and_said(steps: list[Step], tmp_path: Path) -> None:
    results = to_prairielearn(full(steps), by_id(steps), tmp_path)
    assert results["score"] == 1.0
    assert results["message"].startswith("The bonus leads above 100 %")
    assert score(Total(5.0, 0.0, PointSum(5.0, 10.0))) == (0.5, "")


def test_small_pictures_come_along_whole(steps: list[Step], tmp_path: Path) -> None:
    made = mixed(steps)
    _with_pictures(made, tmp_path, (160, 120), noisy=False)
    results = to_prairielearn(made, by_id(steps), tmp_path)
    validate(results, "prairielearn")
    pictures = _pictures(results)
    assert len(pictures) == 3 * sum(len(result.images) for result in made.steps)
    assert {picture.size for picture in pictures} == {(160, 120)}


def test_large_pictures_are_shrunk(steps: list[Step], tmp_path: Path) -> None:
    made = mixed(steps)
    _with_pictures(made, tmp_path, (128, 96), noisy=True)
    results = to_prairielearn(made, by_id(steps), tmp_path)
    assert {picture.size for picture in _pictures(results)} == {(64, 48)}
    assert "left out" not in results["message"]
    assert len(encoded(results)) <= MAX_BYTES


def test_what_does_not_fit_is_left_out_those_that_passed_first(steps: list[Step], tmp_path: Path) -> None:
    made = mixed(steps, HOSTILE * 60)
    _with_pictures(made, tmp_path, (640, 480), noisy=True)
    results = to_prairielearn(made, by_id(steps), tmp_path)
    validate(results, "prairielearn")
    assert 500_000 < len(encoded(results)) <= MAX_BYTES
    assert re.search(r"[0-9]+ pictures did not fit and were left out\.", results["message"])
    shown = [test for test in results["tests"] if "images" in test]
    assert shown
    assert all(test["points"] < test["max_points"] for test in shown)
    assert shown[0]["images"][0]["label"].startswith("difference")


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
    assert results["format_errors"] == ["no compiler"]
    with pytest.raises(GraderFault):
        validate({**results, "score": 0}, "prairielearn")
    with pytest.raises(GraderFault):
        validate({"gradable": True, "score": 1.5, "tests": []}, "prairielearn")
