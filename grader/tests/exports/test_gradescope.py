"""results.json of Gradescope."""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from export_documents import HOSTILE, document, full, mixed, step_result
from PIL import Image

from raysteps.common.errors import GraderFault
from raysteps.course.manifest import Step
from raysteps.exports.formats import validate, write
from raysteps.exports.gradescope import VISIBILITIES, not_graded, submitters, to_gradescope
from raysteps.exports.hosted import by_id
from raysteps.results.model import Results, StepResult


def _converted(made: Results, steps: list[Step], **options: Any) -> dict[str, Any]:
    results = to_gradescope(made, by_id(steps), **options)
    validate(results, "gradescope")
    return results


@pytest.mark.parametrize("hidden", VISIBILITIES)
def test_scores_sum_to_the_points(steps: list[Step], hidden: Any) -> None:
    made = mixed(steps)
    tests = _converted(made, steps, hidden=hidden)["tests"]
    for result in made.steps:
        mine = [test for test in tests if test["number"].startswith(f"{int(result.id[:2])}.")]
        assert round(sum(test["score"] for test in mine), 9) == result.points
        assert round(sum(test["max_score"] for test in mine), 9) == result.max
    assert round(sum(test["score"] for test in tests), 9) == made.total.points


def test_numbers_and_names(steps: list[Step]) -> None:
    tests = _converted(mixed(steps), steps)["tests"]
    assert [test["number"] for test in tests[:2]] == ["1.1", "1.2"]
    assert len({test["number"] for test in tests}) == len(tests)
    names = [test["name"] for test in tests]
    assert "02 Intersection: test test 0" in names
    assert "07 Tone mapping: does not build" in names
    assert "08 Refraction (bonus): not started" in names


def test_a_failed_test_says_what_was_expected(steps: list[Step]) -> None:
    tests = _converted(mixed(steps), steps)["tests"]
    failed = next(test for test in tests if test["number"] == "2.7")
    assert failed["status"] == "failed"
    assert failed["output"] == "is wrong\nexpected: a == b\ngot: 1 == 2\nsee a.cpp:7"


def test_visible_entries_of_hidden_checks_show_no_input(steps: list[Step]) -> None:
    text = json.dumps(_converted(mixed(steps), steps))
    assert "origin inside" in text
    assert "secret" not in text


@pytest.mark.parametrize("hidden", ["hidden", "after_due_date", "after_published"])
def test_hidden_entries_tell_all_and_the_rest_tells_no_points(steps: list[Step], hidden: Any) -> None:
    made = mixed(steps)
    results = _converted(made, steps, hidden=hidden)
    entries = [test for test in results["tests"] if test["visibility"] == hidden]
    assert len(entries) == 3 * (len(steps) - 2), "one step does not build, and one was not started"
    assert any("input: secret input\nexpected: secret answer\ngot: its answer" in test["output"] for test in entries)
    shown = json.dumps([results["output"], [test for test in results["tests"] if test["visibility"] == "visible"]])
    assert "secret" not in shown
    assert str(made.total.points) not in results["output"]
    assert "partial" not in results["output"]


def test_leaderboard(steps: list[Step]) -> None:
    octree = [
        {"name": "06 Octree: work (1 is the reference's)", "value": 2.0, "order": "asc"},
        {"name": "06 Octree: memory (kB)", "value": 16.0, "order": "asc"},
    ]
    bvh = [
        {"name": "09 Bounding volumes (bonus): work (1 is the reference's)", "value": 2.0, "order": "asc"},
        {"name": "09 Bounding volumes (bonus): memory (kB)", "value": 20.0, "order": "asc"},
    ]
    assert _converted(full(steps), steps)["leaderboard"] == octree + bvh
    one_wrong = document([step_result(steps[5]), step_result(steps[8], share=0.9)])
    assert _converted(one_wrong, steps)["leaderboard"] == octree
    wrong = document([step_result(steps[5], share=0.5)])
    assert "leaderboard" not in _converted(wrong, steps)
    assert "leaderboard" not in _converted(document([step_result(steps[0])]), steps)
    not_started = StepResult(steps[8].id, "not-started", 0.0, 10.0, True)
    assert "leaderboard" not in _converted(document([not_started]), steps)


def test_a_leaderboard_needs_counters(steps: list[Step]) -> None:
    older = document([step_result(steps[5])])
    for image in older.steps[0].images:
        image.work = image.reference_work = None
    assert "leaderboard" not in _converted(older, steps)


def test_hostile_text_stays_text(steps: list[Step]) -> None:
    results = _converted(mixed(steps, HOSTILE), steps, names=["<b>Ann</b>"])
    text = json.dumps(results, ensure_ascii=False)
    assert {results[key] for key in ("output_format", "test_output_format", "test_name_format")} == {"text"}
    assert "<script>" in text
    assert not any(ord(letter) < 32 or letter == "\u202e" for letter in text)
    assert results["stdout_visibility"] == "hidden"
    assert "seed" not in results["extra_data"]


def test_a_fault_has_no_score(tmp_path: Path) -> None:
    path = tmp_path / "results.json"
    write(not_graded("no compiler here"), "gradescope", path)
    results = json.loads(path.read_text())
    assert "no compiler here" in results["output"]
    assert "score" not in json.dumps(results).replace("no score yet", "")
    zero = not_graded("x") | {"score": 0}
    with pytest.raises(GraderFault, match="gradescope"):
        write(zero, "gradescope", tmp_path / "zero.json")
    assert [file.name for file in tmp_path.iterdir()] == ["results.json"]


@pytest.mark.parametrize(
    "breaking",
    [
        lambda results: results["tests"][0].pop("score"),
        lambda results: results.update(score=5),
        lambda results: results["tests"].clear(),
        lambda results: results["tests"][0].update(visibility="secret"),
        lambda results: results["tests"][0].update(number="one"),
        lambda results: results.update(more=1),
    ],
)
def test_the_schema_sees_what_is_wrong(steps: list[Step], breaking: Any) -> None:
    results = _converted(mixed(steps), steps)
    breaking(results)
    with pytest.raises(GraderFault):
        validate(results, "gradescope")


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ('{"users": [{"name": "Ann\\nLee", "email": "a@x"}, {"email": "b@x"}, {"name": ""}, 7]}', ["Ann Lee", "b@x"]),
        ('{"users": null}', []),
        ("[]", []),
        ("{", []),
        ('{"users": [{"name": 7}]}', []),
        ("[" * 100_000, []),
    ],
)
def test_metadata_is_read_with_patience(tmp_path: Path, text: str, names: list[str]) -> None:
    path = tmp_path / "submission_metadata.json"
    path.write_text(text)
    assert submitters(path) == names
    assert submitters(tmp_path / "none.json") == []


def test_a_pictures_check_shows_the_pictures(steps: list[Step], tmp_path: Path) -> None:
    made = document([step_result(steps[1], share=0.37, text=HOSTILE)])
    for image in made.steps[0].images:
        image.mine = image.reference = f"{image.name}.png"
        Image.new("RGB", (160, 120), (9, 9, 9)).save(tmp_path / image.mine)
    results = _converted(made, steps, folder=tmp_path)
    shown = [test for test in results["tests"] if test.get("output_format") == "html"]
    assert [test["name"].split(": picture ")[1] for test in shown] == [image.name for image in made.steps[0].images]
    for test in shown:
        tags = re.findall("<[^>]*>", test["output"])
        assert {tag.split()[0] for tag in tags} <= {"<br>", "<img"}, "what a program says is escaped"
        assert re.search(r'<img alt="[^"<>]+" src="data:image/png;base64,[A-Za-z0-9+/]+=*">', test["output"])
    assert "&lt;script&gt;" in shown[-1]["output"]
    assert not any("<img" in test["output"] for test in results["tests"] if test not in shown)


def test_pictures_have_a_limit(steps: list[Step], tmp_path: Path) -> None:
    made = full(steps)
    chance = np.random.default_rng(3)
    for result in made.steps:
        for image in result.images:
            image.mine = f"{result.id}-{image.name}.png"
            Image.fromarray(chance.integers(0, 255, (480, 640, 3)).astype(np.uint8)).save(tmp_path / image.mine)
    results = _converted(made, steps, folder=tmp_path)
    assert 300_000 < sum(len(test["output"]) for test in results["tests"] if "<img" in test["output"]) <= 500_000
