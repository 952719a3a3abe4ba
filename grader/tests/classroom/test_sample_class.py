"""The generated class."""

from collections import Counter
from pathlib import Path

import pytest
from sample_class import FORMS, KINDS, MISTAKES, make_class

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.stubs import same_code
from raysteps.submission.load import load_submission


def _files(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_the_same_seed_gives_the_same_class(tmp_path: Path, project: Project) -> None:
    made = make_class(project, tmp_path / "a", 40, 3)
    make_class(project, tmp_path / "b", 40, 3)
    make_class(project, tmp_path / "c", 40, 4)
    assert _files(tmp_path / "a") == _files(tmp_path / "b")
    assert _files(tmp_path / "a") != _files(tmp_path / "c")
    assert len(list((tmp_path / "a").iterdir())) == 40
    assert {one.kind for one in made} == set(KINDS)
    assert {one.form for one in made} == set(FORMS)
    assert set(Counter(one.kind for one in made).values()) == {4}


def test_every_submission_is_what_it_says(
    tmp_path: Path, project: Project, steps: list[Step], solved: dict[str, str], unsolved: dict[str, str]
) -> None:
    seen: Counter[str] = Counter()
    for one in make_class(project, tmp_path, 60, 5):
        sources = {step: data.decode() for step, data in load_submission(one.path, steps).sources.items()}
        different = [step for step, text in sources.items() if not same_code(text, solved[step])]
        seen[one.form] += 1
        match one.kind:
            case "complete":
                assert sources == solved
            case "stubs":
                assert sources == unsolved
            case "missing files":
                assert not different
                assert 1 < len(sources) < len(steps) - 1
            case "half":
                assert all(sources[step] == unsolved[step] for step in different)
                assert 1 < len(different) < len(steps) - 1
            case "mistakes":
                assert 1 <= len(different) <= 3
                assert len(sources) == len(steps)
            case _:
                assert len(different) == 1
                assert len(sources) == len(steps)
    assert set(seen.values()) == {10}


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda mistake: f"{mistake[0]} {mistake[2]}")
def test_mistakes_fit_the_solutions(mistake: tuple[str, str, str], steps: list[Step], solved: dict[str, str]) -> None:
    number, find, replacement = mistake
    step = next(step.id for step in steps if step.number == number)
    assert solved[step].count(find) == 1
    assert not same_code(find, replacement)
