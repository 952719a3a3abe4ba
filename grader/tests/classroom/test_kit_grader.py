"""A class graded by the kit itself."""

import argparse
import json
from pathlib import Path

from class_documents import without_times
from rich.console import Console

from raysteps.cli.grade_class import add_arguments, run
from raysteps.course.manifest import Step
from raysteps.course.project import Project


def test_solved_and_unsolved(tmp_path: Path, project: Project, steps: list[Step], solved: dict[str, str]) -> None:
    first = steps[0]
    for name, source in (("all", solved[first.id]), ("none", "this is no C++\n")):
        path = tmp_path / "in" / name / "steps" / first.path
        path.parent.mkdir(parents=True)
        path.write_text(source)
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    documents = []
    for out, jobs in (("one", "1"), ("two", "2")):
        words = [str(tmp_path / "in"), "--out", str(tmp_path / out), "--only", first.number, "--jobs", jobs]
        assert run(project, parser.parse_args(words), Console(width=150)) == 0
        files = (tmp_path / out).glob("submissions/*/results.json")
        documents.append({path.parent.name: without_times(json.loads(path.read_text())) for path in files})
        pictures = (tmp_path / out / "submissions" / "all" / "pictures" / first.id).glob("*.png")
        assert len(list(pictures)) >= len(first.images)
    assert documents[0] == documents[1]
    points = {name: document["total"]["points"] for name, document in documents[0].items()}
    assert points == {"all": first.points, "none": 0}
    assert documents[0]["none"]["steps"][0]["status"] == "does-not-build"
