"""Something secret in a file that goes out is found there, whatever the file is for."""

import argparse
import json
import subprocess
from pathlib import Path

import pytest
from rich.console import Console

from raysteps.cli import release as command
from raysteps.common.errors import UsageError
from raysteps.course.manifest import read_steps
from raysteps.course.project import Project
from raysteps.course.tracked_files import list_files
from raysteps.release import build_release as making
from raysteps.release.contents import kit_contents
from raysteps.release.leaks import find_leaks
from raysteps.release.secrets import gather, read_allowlist, words_in
from raysteps.toolchain.kit_artifacts import BuiltKit

_SEED = 918273


@pytest.fixture
def copy(project: Project, tmp_path: Path) -> Project:
    """The files of the kit, without its history."""
    for place in list_files(project.root):
        if (project.root / place).is_file():
            target = tmp_path / "copy" / place
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes((project.root / place).read_bytes())
    return Project(tmp_path / "copy")


def _release(project: Project, folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Of all steps, without the pictures that the reference draws."""
    steps = read_steps(project)
    monkeypatch.setattr(making, "write_reference_artifacts", lambda *_: None)
    kit = BuiltKit(project, folder, "0123456789 test", steps, description=None, tests={}, interpreter=None)  # type: ignore[arg-type]
    making.write_release(kit, steps, "Course", folder)
    return folder


def _plant(project: Project, name: str, text: str) -> None:
    path = project.root / name
    path.parent.mkdir(parents=True, exist_ok=True)
    before = path.read_text(encoding="utf-8") if path.is_file() else ""
    path.write_text(before + text, encoding="utf-8")


def test_in_every_kind_of_file_that_goes_out(
    copy: Project, solved: dict[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = solved["02-intersection"]
    solution = text[text.index("std::optional<HitRecord> closest_hit") : text.rindex("}  // namespace")]
    room = copy.solutions / "02-intersection"
    cases = "\n".join((room / "cases.toml").read_text(encoding="utf-8").splitlines()[4:12])
    mutants = (room / "mutants.toml").read_text(encoding="utf-8")
    package = "grader/src/raysteps"
    judge = (copy.root / package / "judge/cases/intersection.py").read_text(encoding="utf-8")
    planted = {
        "steps/02-intersection/intersection.hpp": solution,
        "steps/04-shadows/README.md": f"\n```cpp\n{solution}```\n",
        "steps/05-reflection/step.toml": "".join(f"\n# {line}" for line in solution.splitlines()),
        "steps/06-octree/octree_test.cpp": f"\n// {' '.join(solution.split())}\n",
        "framework/core/sphere.hpp": solution,
        "docs/formats.md": f"\n{cases}\n",
        "docs/pages.md": f"\nThe course draws its cases with `--seed {_SEED}`.\n",
        "scenes/generators/spheres_of_the_judge.py": judge,
        f"{package}/common/x.json": json.dumps({"find": mutants[mutants.index("/ approach;") :].partition("'''")[0]}),
        f"{package}/report/static/x.js": "// " + mutants[mutants.index('sees = "Surfaces behind') :].partition("\n")[0],
        f"{package}/release/overlay/notes.md": solution,
    }
    monkeypatch.delenv("RAYSTEPS_COURSE")
    (copy.root / "course.toml").write_text(f"seed = {_SEED}\n", encoding="utf-8")
    made = (
        "framework/core/notes.egg-info/a.txt",
        "scenes/__pycache__/b.txt",
        f"{package}/release/overlay/c.egg-info/d",
    )
    for name, words in [*planted.items(), *((name, solution) for name in made)]:
        _plant(copy, name, words)
    found = {leak.place for leak in find_leaks(gather(copy), _release(copy, tmp_path / "kit", monkeypatch))}
    places_out = {name.removeprefix(f"{package}/release/overlay/") for name in planted}
    assert found == places_out, "what setting up makes does not go out"


def test_only_files_of_a_step_are_taken_and_none_that_git_does_not_know(
    copy: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def git(*words: str) -> None:
        subprocess.run(["git", "-C", copy.root, "-c", "user.name=a", "-c", "user.email=a@b.c", *words], check=True)

    git("init", "--quiet")
    git("add", ".")
    for name in ("notes.md", "intersection.cpp.orig", "old.cpp"):
        (copy.steps / "02-intersection" / name).write_text("mine\n", encoding="utf-8")
    (copy.root / "grader/src/raysteps/common/.text.py.swp").write_text("mine\n", encoding="utf-8")
    _release(copy, tmp_path / "first", monkeypatch)
    out = {path.name for path in (tmp_path / "first/steps/02-intersection").iterdir()}
    assert out == {"README.md", "intersection.cpp", "intersection.hpp", "intersection_test.cpp", "step.toml"}
    assert not list((tmp_path / "first").rglob("*.swp"))

    for name in ("steps/02-intersection/old.hpp", "grader/src/raysteps/common/x.json", "course/github-workflow.yml"):
        path = copy.root / name
        before = path.read_bytes() if path.is_file() else None
        git("rm", "--quiet", "--cached", "--ignore-unmatch", name)
        path.write_text("{}\n", encoding="utf-8")
        with pytest.raises(UsageError, match=f"{name}: would go out, but git does not know it"):
            _release(copy, tmp_path / "second", monkeypatch)
        git("add", name)
        assert before is None or path.write_bytes(before)
    assert not (tmp_path / "second").exists()


def test_a_step_that_git_does_not_know_is_told_before_anything_is_built(
    copy: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def built(*_: object) -> None:
        raise AssertionError("the kit was built")

    monkeypatch.setattr(command, "build_kit", built)
    subprocess.run(["git", "init", "--quiet", copy.root], check=True)
    subprocess.run(["git", "-C", copy.root, "add", ".", ":!steps/09-bvh"], check=True)
    arguments = argparse.Namespace(check=None, out=tmp_path / "out", steps=None, course="Course", play=None)
    with pytest.raises(UsageError, match=r"steps/09-bvh/bvh\.hpp.*: would go out, but git does not know them"):
        command.run(copy, arguments, Console(quiet=True))
    assert not (tmp_path / "out").exists()


def test_what_is_public_though_it_is_alike_is_still_there(project: Project) -> None:
    """An entry of shared.toml that nothing needs any more would forgive something else."""
    secrets = gather(project, shared=[])
    released = kit_contents(project, read_steps(project), [])
    for one in read_allowlist():
        wanted = " ".join(word.text for word in words_in(one.words))
        for name in one.files:
            assert name in released, f"{name} of shared.toml does not go out"
            words = words_in(released[name].decode())
            assert wanted in " ".join(word.text for word in words), f"{name} has no longer: {one.words}"
            origins = {origin.partition(":")[0] for _, _, origin in secrets.sequences.matches(words)}
            assert one.origin in origins, f"{name} has no longer anything of {one.origin}"
