"""What is uploaded to the systems that grade on their own machines: the kit, and scripts that run it there."""

import re
import shlex
from collections.abc import Sequence
from importlib.resources import files

from raysteps.common.errors import UsageError
from raysteps.exports.archives import Member, as_tar, as_zip
from raysteps.exports.kit_files import kit_files
from raysteps.kit.project import Project

_REPOSITORY = re.compile(r"^[A-Za-z0-9][A-Za-z0-9._-]*/[A-Za-z0-9._-]+$")
_AUTOLAB = "raysteps-autolab"


def _template(name: str) -> str:
    return files("raysteps.exports").joinpath("templates", name).read_text(encoding="utf-8")


def _script(name: str, options: Sequence[str] = ()) -> bytes:
    """A shell script: with the function that calls the kit, and the options of this export."""
    text = _template(name).replace("@KIT@\n", _template("kit.sh"))
    return text.replace("@OPTIONS@", shlex.join(options)).encode()


def _kit(project: Project, folder: str) -> list[Member]:
    return [Member(f"{folder}/{file.place}", file.source.read_bytes(), file.executable) for file in kit_files(project)]


def gradescope_zip(project: Project, options: Sequence[str]) -> bytes:
    """autograder.zip."""
    own = [
        Member("setup.sh", _script("setup.sh"), executable=True),
        Member("run_autograder", _script("run_autograder", options), executable=True),
    ]
    return as_zip([*own, *_kit(project, "kit")])


def autolab_tar(project: Project, options: Sequence[str]) -> bytes:
    """autograde-Makefile and autograde.tar; the kit and the driver are in the latter."""
    inner = [
        Member(f"{_AUTOLAB}/setup.sh", _script("setup.sh"), executable=True),
        Member(f"{_AUTOLAB}/driver.sh", _script("driver.sh", options), executable=True),
        *_kit(project, f"{_AUTOLAB}/kit"),
    ]
    makefile = Member("autograde-Makefile", _template("autograde-Makefile").encode())
    return as_tar([makefile, Member("autograde.tar", as_tar(inner))])


def prairielearn_folder(project: Project, options: Sequence[str]) -> list[Member]:
    """A folder for serverFilesCourse that is also what the grading image is built from."""
    return [
        Member("run.sh", _script("run.sh", options), executable=True),
        Member("setup.sh", _script("setup.sh"), executable=True),
        Member("Dockerfile", _template("Dockerfile").encode()),
        *_kit(project, "kit"),
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
