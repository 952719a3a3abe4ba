"""The pages of known mistakes."""

import re
from pathlib import Path

import numpy as np

from raysteps.course.manifest import Step
from raysteps.course.mutants import read_mutants
from raysteps.course.project import Project
from raysteps.images.compare import Pixels
from tools.mistake_pages import Exhibit, index_page, is_current, step_page, write_image


def _pixels(seed: int) -> Pixels:
    return np.random.default_rng(seed).integers(0, 256, (12, 16, 3), dtype=np.uint8)


def _exhibits(project: Project, step: Step) -> list[Exhibit]:
    first, second = read_mutants(project, step)[:2]
    name = step.images[0].name
    return [
        Exhibit(first, name, _pixels(1), [name], [first.function]),
        Exhibit(second, None, None, [], [second.function]),
    ]


def test_a_page_shows_right_and_wrong_and_all_that_a_student_reads(project: Project, steps: list[Step]) -> None:
    step = steps[3]
    shown = _exhibits(project, step)
    page = step_page(step, shown)
    rows = [line for line in page.splitlines() if line.startswith("| ") and "(`" in line]
    assert len(rows) == 2
    for exhibit, row in zip(shown, rows, strict=True):
        for words in (exhibit.mutant.sees, exhibit.mutant.cause, exhibit.mutant.hint):
            assert words.replace("|", "\\|") in row
        assert row.replace("\\|", "").count("|") == 4
    assert rows[0].count("pictures/04-") == 2
    assert "No picture of the step shows it." in rows[1]


def _code(text: str) -> str:
    return re.sub(r"\s|F\b", "", text)


def test_no_text_gives_the_line_away(project: Project, steps: list[Step]) -> None:
    """Neither the right line nor the part of it that makes the difference stands in what a student reads."""
    for step in steps:
        for mutant in read_mutants(project, step):
            texts = _code(f"{mutant.name} {mutant.hint} {mutant.cause} {mutant.sees}")
            for line in mutant.find.splitlines():
                if len(_code(line)) > 5:
                    assert _code(line) not in texts, mutant.id


def test_the_index_leads_to_every_step(project: Project, steps: list[Step]) -> None:
    index = index_page([(step, _exhibits(project, step)) for step in steps])
    for step in steps:
        assert f"({step.id}.md) | 2 | 1 |" in index


def test_a_picture_is_current_until_it_shows_something_else(tmp_path: Path) -> None:
    path = tmp_path / "mistake.png"
    assert not is_current(path, _pixels(1))
    write_image(path, _pixels(1))
    assert is_current(path, _pixels(1))
    assert not is_current(path, _pixels(2))
    path.write_bytes(b"no picture")
    assert not is_current(path, _pixels(1))
