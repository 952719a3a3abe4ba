"""What is uploaded to the systems that grade on their own machines: the kit, and scripts that run it there."""

import io
import os
import re
import shlex
import tarfile
import tomllib
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path, PurePosixPath

from raysteps.bootstrap.requirements import CMAKE, COMPILER, HIGHWAY, LIBRARIES, NINJA, SANDBOX, VENV
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import usable_folder, write_bytes
from raysteps.course.manifest import Step, course_manifests
from raysteps.course.project import Project
from raysteps.course.tracked_files import places
from raysteps.exports.autolab import no_scores
from raysteps.exports.prairielearn import question_info, question_name, question_page

# Archives and folders whose bytes depend on their content only.

_EPOCH = (1980, 1, 1, 0, 0, 0)


@dataclass(frozen=True)
class Member:
    """A regular file in an archive."""

    name: str
    data: bytes
    executable: bool = False

    @property
    def mode(self) -> int:
        return 0o755 if self.executable else 0o644


def as_zip(members: Sequence[Member]) -> bytes:
    """A zip that keeps the executable bits."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for member in members:
            info = zipfile.ZipInfo(member.name, _EPOCH)
            info.create_system = 3  # Unix: the upper half of external_attr is the mode
            info.external_attr = (0o100000 | member.mode) << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, member.data)
    return buffer.getvalue()


def as_tar(members: Sequence[Member]) -> bytes:
    """A plain tar."""
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for member in members:
            info = tarfile.TarInfo(member.name)
            info.size, info.mode = len(member.data), member.mode
            archive.addfile(info, io.BytesIO(member.data))
    return buffer.getvalue()


def into_folder(members: Sequence[Member], folder: Path) -> None:
    """Writes into a new or empty folder."""
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise UsageError(f"{folder}: is there already; expected the name of a new or an empty folder")
    usable_folder(folder)
    for member in members:
        path = folder / member.name
        write_bytes(path, member.data)
        path.chmod(member.mode)


# The files of the kit that another machine needs for grading.

_FILES = ("CMakeLists.txt", "CMakePresets.json", "LICENSE", "LICENSE-CC-BY-4.0.md", "README.md", "raysteps")
_FOLDERS = ("cmake", "framework", "grader", "scenes", "solutions", "steps")
_LEFT_OUT = (("grader", "tests"),)
_TOOLS = {"__pycache__", "build"}
_TOOL_ENDINGS = (".egg-info", ".pyc")


@dataclass(frozen=True)
class KitFile:
    """A file and its place in the kit."""

    place: PurePosixPath
    source: Path

    @property
    def executable(self) -> bool:
        return os.access(self.source, os.X_OK)


def _belongs(place: PurePosixPath) -> bool:
    parts = place.parts
    if len(parts) == 1:
        return parts[0] in _FILES
    if parts[0] not in _FOLDERS or any(parts[: len(folder)] == folder for folder in _LEFT_OUT):
        return False
    return not any(part in _TOOLS or part.startswith(".") or part.endswith(_TOOL_ENDINGS) for part in parts)


def kit_files(project: Project) -> list[KitFile]:
    """Sorted by place; links are not followed."""
    root = project.root
    listed = {*places(root, _FOLDERS), *map(PurePosixPath, _FILES)}
    found = [KitFile(place, root / place) for place in sorted(listed) if _belongs(place)]
    files = [file for file in found if file.source.is_file() and not file.source.is_symlink()]
    there = {file.place.parts[0] for file in files}
    missing = [name for name in (*_FILES, *_FOLDERS) if name not in there and not name.endswith((".md", "LICENSE"))]
    if missing:
        raise GraderFault(f"{root}: {', '.join(missing)} is missing, so this is no whole kit")
    return files


_REPOSITORY = re.compile(r"^[A-Za-z0-9][A-Za-z0-9._-]*/[A-Za-z0-9._-]+$")
_AUTOLAB = "raysteps-autolab"


def _template(name: str) -> str:
    return files("raysteps.exports").joinpath("templates", name).read_text(encoding="utf-8")


def _script(name: str, options: Sequence[str] = ()) -> bytes:
    """A shell script: with the functions that it shares with others, and the options of this export."""
    text = _template(name).replace("@KIT@\n", _template("kit.sh")).replace("@UNPACK@\n", _template("unpack.sh"))
    return text.replace("@OPTIONS@", shlex.join(options)).encode()


def _kit(project: Project, folder: str) -> list[Member]:
    made = course_manifests(project)  # course.toml stays here
    return [
        Member(f"{folder}/{file.place}", made.get(str(file.place)) or file.source.read_bytes(), file.executable)
        for file in kit_files(project)
    ]


def gradescope_zip(project: Project, options: Sequence[str]) -> bytes:
    """autograder.zip."""
    own = [
        Member("setup.sh", _script("setup.sh"), executable=True),
        Member("run_autograder", _script("run_autograder", options), executable=True),
    ]
    return as_zip([*own, *_kit(project, "kit")])


def autolab_tar(project: Project, options: Sequence[str], steps: Sequence[Step]) -> bytes:
    """autograde-Makefile and autograde.tar, which holds the kit and the driver; and hooks for a configuration file."""
    inner = [
        Member(f"{_AUTOLAB}/setup.sh", _script("setup.sh"), executable=True),
        Member(f"{_AUTOLAB}/driver.sh", _script("driver.sh", options), executable=True),
        *_kit(project, f"{_AUTOLAB}/kit"),
    ]
    makefile = _template("autograde-Makefile").replace("@NOTHING@", no_scores(step.id for step in steps))
    return as_tar(
        [
            Member("autograde-Makefile", makefile.encode()),
            Member("autograde.tar", as_tar(inner)),
            Member("hooks.rb", _template("hooks.rb").encode()),
        ]
    )


def _image(project: Project) -> list[Member]:
    """What the image for PrairieLearn is made from: nothing of the kit but the names of what it needs."""
    needs = (COMPILER, CMAKE, NINJA, VENV, *LIBRARIES, HIGHWAY, SANDBOX)
    packages = " ".join(sorted({"xz-utils", *(need.packages["apt-get"] for need in needs)}))
    package = tomllib.loads((project.root / "grader" / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    lines = [f"{line}\n" for line in (*package["dependencies"], *package["optional-dependencies"]["instructor"])]
    return [
        Member("image/Dockerfile", _template("Dockerfile").replace("@PACKAGES@", packages).encode()),
        Member("image/requirements.txt", "".join(lines).encode()),
    ]


def prairielearn_course(
    project: Project, options: Sequence[str], steps: Sequence[Step], chosen: Sequence[str], image: str
) -> list[Member]:
    """What is added to a course, and the image that grades there. `chosen`: the steps of the question; all of them when
    there are none."""
    if not image:
        raise UsageError("say what the image that grades will be called with --image ACCOUNT/NAME")
    question, bundle = f"questions/{question_name(chosen)}", "serverFilesCourse/raysteps"
    scripts = [
        Member(f"{bundle}/run.sh", _script("run.sh", options), executable=True),
        *(Member(f"{bundle}/{name}", _script(name), executable=True) for name in ("prepare.sh", "setup.sh")),
    ]
    return [
        Member(f"{question}/info.json", question_info(steps, chosen, image)),
        Member(f"{question}/question.html", question_page(steps)),
        *scripts,
        Member(f"{bundle}/kit.tar", as_tar(_kit(project, "kit"))),
        *_image(project),
    ]


def github_workflow(kit_repository: str | None, options: Sequence[str], *, legacy: bool) -> bytes:
    """A workflow that checks the kit out beside the submission."""
    if kit_repository is None or not _REPOSITORY.match(kit_repository):
        raise UsageError("say where the kit is with --kit OWNER/REPOSITORY; the workflow fetches it from there")
    text = _template("workflow-legacy.yaml" if legacy else "workflow.yaml")
    return text.replace("@REPOSITORY@", kit_repository).replace("@OPTIONS@", shlex.join(options)).encode()


def classroom50_autograder(options: Sequence[str]) -> bytes:
    """autograder.py for CLASSROOM/autograders/ASSIGNMENT/."""
    return _template("autograder.py.txt").replace("@OPTIONS@", repr(list(options))).encode()
