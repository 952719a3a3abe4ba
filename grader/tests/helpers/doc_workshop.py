"""A copy of the kit to type the commands of the documents in, with what the documents take for granted."""

import os
import shutil
import subprocess
import tarfile
import zipfile
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from raysteps.common.markdown import blocks
from raysteps.course.project import Project
from raysteps.course.tracked_files import list_files
from raysteps.toolchain.fingerprint import fingerprint
from raysteps.toolchain.kit_artifacts import BuiltKit

_GRADEBOOK = """Student,ID,SIS User ID,SIS Login ID,Section,Ray tracer (12)
    Points Possible,,,,,100
"Lee, Ann",101,4711,ann,A,
"Ray, Bob",102,4712,bob,A,
"""
_WORKSHEET = """Identifier,"Full name","ID number","Email address",Status,Grade,"Maximum Grade","Grade can be changed",\
"Last modified (submission)","Last modified (grade)","Feedback comments"
"Participant 101","Ann Lee",4711,ann@example.edu,"Submitted for grading",,100.00,Yes,-,-,
"Participant 102","Bob Ray",4712,bob@example.edu,"Submitted for grading",,100.00,Yes,-,-,
"""
# What is copied: a person's own submissions and grades may lie beside it.
_FILES = (
    ".clang-format", ".editorconfig", ".gitattributes", ".gitignore", "CHANGELOG.md", "CMakeLists.txt",
    "CMakePresets.json", "CONTRIBUTING.md", "LICENSE", "LICENSE-CC-BY-4.0.md", "README.md", "SECURITY.md",
    "THIRD_PARTY.md", "raysteps",
)  # fmt: skip
_FOLDERS = (
    ".devcontainer", ".github", ".vscode", "bench", "cmake", "course", "docs", "framework", "grader", "scenes",
    "solutions", "steps", "tools",
)  # fmt: skip
_CAMERA, _OCTREE = "01-camera-rays/camera_rays.cpp", "06-octree/octree.cpp"  # quick to grade; in one, work is counted


@dataclass(frozen=True)
class Workshop:
    """`kit` is the copy, and `original` what it is a copy of. Other folders that the documents name lie beside it."""

    original: Project
    kit: Project

    @property
    def folder(self) -> Path:
        return self.kit.root.parent

    @property
    def home(self) -> Path:
        return self.folder / "home"


def _git(root: Path, *words: str) -> None:
    own = ("-c", "user.name=Ann", "-c", "user.email=ann@example.edu", "-c", "core.autocrlf=false")
    nobodys = os.environ | {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1"}
    subprocess.run(["git", "-C", root, *own, *words], check=True, capture_output=True, timeout=60, env=nobodys)


def _repository(root: Path) -> None:
    _git(root, "init", "-q")
    _git(root, "add", "-A")
    _git(root, "commit", "-q", "-m", "All of it")


def copy_of(kit: BuiltKit, root: Path) -> Project:
    """What git knows of the kit, with right steps, as a repository. It has the programs that were built for the
    original: they are the same, unless a source of the kit is not known to git."""
    project, copy = kit.project, Project(root)
    for place in (*map(PurePosixPath, _FILES), *list_files(project.root, _FOLDERS)):
        belongs = place.parts[0] in (*_FILES, *_FOLDERS) and "__pycache__" not in place.parts
        if belongs and (project.root / place).is_file():
            (root / place).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(project.root / place, root / place)
    _repository(root)
    shutil.copytree(copy.samples / "complete" / "steps", copy.steps, dirs_exist_ok=True)
    (copy.build / "kit").mkdir(parents=True)
    (copy.build / "kit" / kit.folder.name).symlink_to(kit.folder, target_is_directory=True)
    assert fingerprint(copy) == kit.folder.name, "the copy is another kit: is a file of the kit ignored by git?"
    return copy


def _hand_in(workshop: Workshop) -> None:
    complete, submissions = workshop.kit.samples / "complete" / "steps", workshop.kit.root / "submissions"
    (submissions / "4711" / "steps" / _CAMERA).parent.mkdir(parents=True)
    shutil.copy(complete / _CAMERA, submissions / "4711" / "steps" / _CAMERA)
    with zipfile.ZipFile(submissions / "archive-17.zip", "w") as archive:
        archive.write(complete / _CAMERA, f"steps/{_CAMERA}")
    with tarfile.open(submissions / "4713-cleo.tar", "w") as tar:
        tar.add(complete / _CAMERA, f"steps/{_CAMERA}")
    with zipfile.ZipFile(workshop.kit.root / "submission.zip", "w") as archive:
        for name in (_CAMERA, _OCTREE):
            archive.write(complete / name, f"steps/{name}")


def _copy_what_a_document_shows(workshop: Workshop) -> None:
    """The roster and the late policy, as they are first shown."""
    shown = [block.body for block in blocks((workshop.kit.root / "docs" / "class.md").read_text("utf-8"))]
    for name, start in (("students.csv", "id,name,"), ("late.toml", "deadline = ")):
        text = next(body for body in shown if body.startswith(start))
        (workshop.kit.root / name).write_text(text, encoding="utf-8")


def _name_results(workshop: Workshop) -> None:
    """Under their other names in the documents; earlier commands make them."""
    root = workshop.kit.root
    (root / "ann").symlink_to(root / "grades" / "ann")
    (root / "bob").symlink_to(root / "build" / "trial" / "submissions" / "complete")
    (root / "results.json").symlink_to(root / "ann" / "results.json")
    workshop.home.mkdir()
    for number in "123":
        (workshop.home / f"grades-{number}").symlink_to(root / f"grades-{number}")


def make_workshop(kit: BuiltKit, folder: Path) -> Workshop:
    workshop = Workshop(kit.project, copy_of(kit, folder / "kit"))
    root = workshop.kit.root
    _hand_in(workshop)
    _copy_what_a_document_shows(workshop)
    _name_results(workshop)
    (root / "gradebook.csv").write_text(_GRADEBOOK, encoding="utf-8")
    (root / "worksheet.csv").write_text(_WORKSHEET, encoding="utf-8")
    checkout = root / "path" / "to" / "checkout"
    shutil.copytree(root / "submissions" / "4711", checkout)
    _repository(checkout)
    for name in ("A.png", "B.png"):
        shutil.copy(root / "docs" / "figures" / "01-after.png", root / name)
    return workshop
