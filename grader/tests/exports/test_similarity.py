"""The sources of a class, as JPlag reads them."""

import argparse
import zipfile
from pathlib import Path

import pytest
from conftest import Sources
from rich.console import Console

from raysteps.cli import export as exports
from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.course.project import here


def _export(*words: str) -> int:
    parser = argparse.ArgumentParser()
    exports.add_arguments(parser)
    return exports.run(here(), parser.parse_args(["similarity", *words]), Console())


def _hand_in(folder: Path, steps: list[Step], sources: Sources) -> None:
    for step in steps:
        if step.id in sources:
            path = folder / "steps" / step.path
            path.parent.mkdir(parents=True)
            path.write_text(sources[step.id], encoding="utf-8")


@pytest.fixture
def folder(tmp_path: Path, steps: list[Step], solved: Sources, unsolved: Sources) -> Path:
    """Ann has all, Bob two steps in a zip and a stub, Cy nothing but stubs, and one entry is no submission."""
    place = tmp_path / "class"
    _hand_in(place / "ann", steps, solved)
    bob = {steps[1].id: solved[steps[1].id] + "// mine\n", steps[2].id: unsolved[steps[2].id] + "// to do\n"}
    with zipfile.ZipFile(place / "bob.zip", "w") as archive:
        for name, source in bob.items():
            archive.writestr(f"steps/{name}/{name[3:].replace('-', '_')}.cpp", source)
    _hand_in(place / "cy", steps, unsolved)
    (place / "notes.txt").write_text("nothing")
    return place


def test_a_folder_for_each_student_and_the_stubs_apart(
    folder: Path, tmp_path: Path, steps: list[Step], unsolved: Sources, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    assert _export(str(folder), "--out", str(out)) == 0
    said = capsys.readouterr()
    assert sorted(path.name for path in (out / "submissions").iterdir()) == ["ann", "bob"]
    assert [path.name for path in (out / "submissions" / "bob").rglob("*.cpp")] == ["intersection.cpp"]
    assert (out / "submissions/bob" / steps[1].path).read_text().endswith("// mine\n")
    assert {step.id: (out / "base-code" / step.path).read_text() for step in steps} == unsolved
    assert said.out == "java -jar jplag.jar -l cpp -bc base-code --result-file similarity submissions\n"
    assert "cy is left out: it holds no step that was begun" in said.err
    assert "notes.txt is left out" in said.err


def test_a_zip_of_some_steps_with_the_kits_solution(folder: Path, tmp_path: Path, steps: list[Step]) -> None:
    out = tmp_path / "similarity.zip"
    assert _export(str(folder), "--out", str(out), "--steps", "2", "--solutions") == 0
    with zipfile.ZipFile(out) as archive:
        rooms = [name.removesuffix(f"/{steps[1].path.as_posix()}") for name in archive.namelist()]
        assert rooms == ["base-code", "submissions/_kit-reference", "submissions/ann", "submissions/bob"]
        assert b"BEGIN SOLUTION" not in archive.read(f"submissions/_kit-reference/{steps[1].path.as_posix()}")


def test_one_alone_cannot_be_compared(folder: Path, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="holds 1 submission with work; expected two"):
        _export(str(folder), "--out", str(tmp_path / "out"), "--steps", "5")
