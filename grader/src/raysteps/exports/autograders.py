"""What is uploaded to the systems that grade on their own machines: the kit, and scripts that run it there."""

import io
import os
import re
import shlex
import tarfile
import tomllib
import zipfile
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, requires, version
from importlib.resources import files
from pathlib import Path, PurePosixPath
from typing import Literal

from raysteps import __version__
from raysteps.bootstrap.requirements import CMAKE, COMPILER, HIGHWAY, LIBRARIES, NINJA, SANDBOX, VENV, Requirement
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import new_or_empty_folder, write_bytes
from raysteps.common.text import join_and
from raysteps.course.manifest import Step, course_manifests
from raysteps.course.project import Project
from raysteps.course.settings import FILE as COURSE
from raysteps.course.settings import Course, read_course
from raysteps.course.tracked_files import list_files
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


TarMode = Literal["w", "w:gz", "w:xz", "w:bz2"]


def as_tar(members: Sequence[Member], mode: TarMode = "w") -> bytes:
    """A plain tar, or one that is compressed."""
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode=mode, format=tarfile.PAX_FORMAT) as archive:
        for member in members:
            info = tarfile.TarInfo(member.name)
            info.size, info.mode = len(member.data), member.mode
            archive.addfile(info, io.BytesIO(member.data))
    return buffer.getvalue()


def into_folder(members: Sequence[Member], folder: Path) -> None:
    """Writes into a new or empty folder."""
    new_or_empty_folder(folder)
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
    listed = {*list_files(root, _FOLDERS), *map(PurePosixPath, _FILES)}
    found = [KitFile(place, root / place) for place in sorted(listed) if _belongs(place)]
    files = [file for file in found if file.source.is_file() and not file.source.is_symlink()]
    there = {file.place.parts[0] for file in files}
    missing = [name for name in (*_FILES, *_FOLDERS) if name not in there and not name.endswith((".md", "LICENSE"))]
    if missing:
        raise GraderFault(
            f"{root}: {join_and(missing)} {'is' if len(missing) == 1 else 'are'} missing, so this is no whole kit"
        )
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
    made = course_manifests(project)  # course.toml stays here, but for the parts
    files = [
        Member(f"{folder}/{file.place}", made.get(str(file.place)) or file.source.read_bytes(), file.executable)
        for file in kit_files(project)
    ]
    parts = read_course(project).parts
    told = [Member(f"{folder}/{COURSE}", f"parts = {list(parts)}\n".encode())] if parts != Course().parts else []
    return [*files, *told]


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


# Container images: one list of what is installed, and for those that hold a kit what comes on top of it.

BASE = "docker.io/library/debian:bookworm-20250520-slim"  # a tag with a date is never moved
_BUILDING = (COMPILER, CMAKE, NINJA, VENV, *LIBRARIES)
_GRADING = (*_BUILDING, HIGHWAY, SANDBOX)
_PACKERS = ("xz-utils",)  # what prepare.sh packs with


def _name(line: str) -> str:
    """Of the package in a line of requirements, as packages are compared."""
    return re.sub(r"[-_.]+", "-", re.split(r"[^\w.-]", line)[0].lower())


def _pins(project: Project, *extras: str) -> list[str]:
    """What pyproject.toml pins, and of what that needs in turn the versions that are installed here."""
    package = tomllib.loads((project.root / "grader" / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    pinned = [*package["dependencies"], *(line for name in extras for line in package["optional-dependencies"][name])]
    waiting = [_name(line) for line in pinned]
    known: dict[str, str] = {}
    while waiting:
        name = waiting.pop()
        if name not in known:
            with suppress(PackageNotFoundError):  # for another system, or another Python
                known[name] = f"{name}=={version(name)}"
                waiting += [_name(line) for line in requires(name) or [] if "extra ==" not in line]
    return pinned + sorted(known[name] for name in known.keys() - {_name(line) for line in pinned})


def _installed(
    about: str, needs: Sequence[Requirement], more: Sequence[str], base: str, pins: Sequence[str]
) -> list[Member]:
    """Dockerfile and requirements.txt of an image without any file of the kit."""
    packages = " ".join(sorted({*more, *(need.packages["apt-get"] for need in needs)}))
    text = _template("Dockerfile").replace("@ABOUT@", about).replace("@BASE@", base).replace("@PACKAGES@", packages)
    return [
        Member("Dockerfile", text.encode()),
        Member("requirements.txt", "".join(f"{line}\n" for line in pins).encode()),
    ]


_IGNORED = "# Nothing else is sent to the engine.\n*\n!kit\n!requirements.txt\n!setup.sh\n"


def _with_kit(installed: Sequence[Member], title: str, folder: str, prepare: str) -> list[Member]:
    """`folder` is where commands are typed; `prepare` are the lines that come after the kit was copied."""
    dockerfile, *others = installed
    text = _template("Dockerfile-kit").replace("@PREPARE@\n", prepare)
    text = text.replace("@TITLE@", title).replace("@VERSION@", __version__).replace("@FOLDER@", folder)
    whole = Member(dockerfile.name, dockerfile.data + text.encode())
    return [whole, *others, Member(".dockerignore", _IGNORED.encode())]


def _course(project: Project) -> list[Member]:
    """course.toml and the late policy that it names, at the same places: a class is graded there as it is here."""
    course = read_course(project)
    if course.path is None:
        return []
    members = [Member(f"kit/{COURSE}", course.text.encode())]
    if course.late_policy is not None:
        try:
            place = course.late_policy.resolve().relative_to(course.path.parent.resolve())
            members.append(Member(f"kit/{place.as_posix()}", course.late_policy.read_bytes()))
        except (OSError, ValueError) as error:
            raise UsageError(
                f"{course.place('late_policy')}: {course.late_policy} cannot go into an image; expected a file that "
                "lies beside course.toml or below it"
            ) from error
    return members


def grader_image(project: Project, base: str = BASE) -> list[Member]:
    """What an image is built from that grades without a network. It holds the solutions, and course.toml."""
    about = "Grades submissions of Raysteps. It holds the solutions: push it nowhere where students can pull it."
    installed = _installed(about, _GRADING, (), base, _pins(project, "instructor"))
    kit = [Member(f"kit/{file.place}", file.source.read_bytes(), file.executable) for file in kit_files(project)]
    return [
        *_with_kit(installed, "Raysteps, grader", "/work", _template("Dockerfile-grader")),
        Member("setup.sh", _script("setup.sh"), executable=True),
        *kit,
        *_course(project),
    ]


def students_image(project: Project, base: str = BASE) -> list[Member]:
    """The same for an image to work in. The students' kit is not among it: `release` writes it into the folder kit."""
    about = "Builds and checks a student's own steps of Raysteps. It holds no solutions."
    installed = _installed(about, _BUILDING, (), base, _pins(project))
    return _with_kit(installed, "Raysteps, students' kit", "/opt/raysteps/kit", "")


def _image(project: Project) -> list[Member]:
    """What the image for PrairieLearn is made from: nothing of the kit but the names of what it needs."""
    about = "Grades on PrairieLearn: compilers and Python packages, and nothing of the kit, so it may be public."
    made = _installed(about, _GRADING, _PACKERS, BASE, _pins(project, "instructor"))
    return [Member(f"image/{member.name}", member.data) for member in made]


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
