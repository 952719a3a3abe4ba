"""The figures of the handouts: well made, all in use, and a stale one is found."""

import argparse
import re
import shutil
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from raysteps.common.errors import UsageError
from raysteps.course.project import Project
from raysteps.toolchain.kit_artifacts import BuiltKit
from tools.bench.docs import FIGURES
from tools.figures import command, renders
from tools.figures.command import FOLDER, Figure, figures
from tools.figures.drawing import Drawing
from tools.figures.renders import CannotDraw

_SVG = "{http://www.w3.org/2000/svg}"


def _drawings(project: Project) -> list[Path]:
    return sorted((project.root / FOLDER).glob("*.svg"))


def test_every_drawing_has_a_title_a_description_and_letters(project: Project) -> None:
    assert len(_drawings(project)) > 15
    for path in _drawings(project):
        root = ElementTree.parse(path).getroot()
        for name in ("title", "desc"):
            found = root.find(f"{_SVG}{name}")
            assert found is not None, path
            assert found.text, path
        assert root.findall(f"{_SVG}text"), path
        assert "prefers-color-scheme:dark" in path.read_text(encoding="utf-8"), path


def test_nothing_is_drawn_beyond_the_plate(project: Project) -> None:
    for path in _drawings(project):
        root = ElementTree.parse(path).getroot()
        width, height = (float(word) for word in root.attrib["viewBox"].split()[2:])
        for part in root.findall(f"{_SVG}text"):
            x, y, letters = float(part.attrib["x"]), float(part.attrib["y"]), len(part.text or "")
            if "transform" in part.attrib:  # a label that is turned
                continue
            length = 7.4 * letters  # as wide as these letters come
            left = x - {"start": 0.0, "middle": 0.5, "end": 1.0}[part.attrib["text-anchor"]] * length
            assert left >= -8, (path.name, part.text)
            assert left + length <= width + 8, (path.name, part.text)
            assert 8 <= y <= height, (path.name, part.text)


def test_every_figure_is_shown_somewhere(project: Project) -> None:
    documents = [project.root / "README.md", *project.steps.rglob("*.md"), *(project.root / "docs").rglob("*.md")]
    text = "\n".join(document.read_text(encoding="utf-8") for document in documents)
    for figure in figures():
        assert figure.path.removeprefix("docs/") in text, figure.path


def test_the_figures_that_need_no_counting_are_up_to_date(project: Project, kit: BuiltKit) -> None:
    """All others are checked by ./raysteps test."""
    names = ["0?-window", "0?-sphere", "0?-boxes", "0?-curve", "0?-after"]
    assert command.out_of_date(project, lambda text: None, names) == []
    assert kit.project == project


def test_a_stale_or_a_strange_figure_is_found(
    tmp_path: Path, project: Project, kit: BuiltKit, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(project.root / FOLDER, tmp_path / FOLDER)
    monkeypatch.setattr(command, "build_kit", lambda *_, **__: kit)
    monkeypatch.setattr(command, "figures", lambda: [one for one in figures() if one.name in ("02-sphere", "01-after")])
    copy = Project(tmp_path)
    chosen = argparse.Namespace(check=True, names=["02-sphere", "01-after"])
    console = Console(quiet=True)
    assert command.run(copy, chosen, console) == 0
    drawing = tmp_path / FOLDER / "02-sphere.svg"
    drawing.write_text(drawing.read_text(encoding="utf-8").replace("near", "far"), encoding="utf-8")
    renders.write(tmp_path / FOLDER / "01-after.png", np.zeros((180, 240, 3), np.uint8))
    (tmp_path / FOLDER / "sketch.png").write_bytes(b"of somebody")
    assert command.run(copy, chosen, console) == 1
    stale = command.out_of_date(copy, lambda text: None)
    assert {f"{FOLDER}/{name}" for name in ("02-sphere.svg", "01-after.png", "sketch.png")} <= set(stale)
    assert command.run(copy, argparse.Namespace(check=False, names=[]), console) == 0
    assert command.out_of_date(copy, lambda text: None) == []
    assert not (tmp_path / FOLDER / "sketch.png").exists()


def test_a_name_that_is_none_is_refused(project: Project) -> None:
    with pytest.raises(UsageError, match="there is no figure '10-nothing'; the figures are 01-after"):
        command.out_of_date(project, lambda text: None, ["10-nothing"])


def test_a_drawing_escapes_what_it_is_told() -> None:
    figure = Drawing(40, 30, "a < b", "c & d")
    figure.text((1, 20), "e < f")
    assert re.findall(r">(\w &\w+; \w)<", figure.svg()) == ["a &lt; b", "c &amp; d", "e &lt; f"]


def test_what_cannot_be_drawn_here_is_left_as_it_is(
    tmp_path: Path, kit: BuiltKit, monkeypatch: pytest.MonkeyPatch
) -> None:
    def draw(_: BuiltKit) -> str:
        raise CannotDraw("Xvfb is missing: install xvfb")

    (tmp_path / "window.png").write_bytes(b"as it was")
    said: list[str] = []
    monkeypatch.setattr(command, "build_kit", lambda *_, **__: kit)
    monkeypatch.setattr(command, "figures", lambda: [Figure("window", "window.png", draw)])
    assert command.out_of_date(Project(tmp_path), said.append) == []
    assert said == ["window.png is left as it is: Xvfb is missing: install xvfb"]
    assert command.run(Project(tmp_path), argparse.Namespace(check=False, names=["window"]), Console(quiet=True)) == 0
    assert (tmp_path / "window.png").read_bytes() == b"as it was"


def test_every_picture_of_the_documents_is_made_by_a_command(project: Project) -> None:
    made = {Path(figure.path).name for figure in figures()} | set(FIGURES)
    assert {path.name for path in (project.root / "docs" / "pictures").iterdir()} <= made
