"""The command `image`: a container image that grades without a network, or one for students to work in."""

import argparse
import shutil
import subprocess
import tempfile
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.cli import release
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import usable_folder
from raysteps.common.platform import quote_command
from raysteps.common.process import run as ask
from raysteps.common.text import clean, print_plain, shorten
from raysteps.course.project import Project
from raysteps.exports.autograders import BASE, grader_image, into_folder, students_image
from raysteps.release.leaks import find_leaks
from raysteps.release.secrets import gather


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What the image is called, or where its files go; and what is in it."""
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--tag", metavar="NAME", help="build an image of this name, with docker or podman")
    what.add_argument("--context", type=Path, metavar="DIR", help="only write what would be built, into a new folder")
    parser.add_argument("--without-solutions", action="store_true", help="for students: check, watch and render")
    parser.add_argument(
        "--steps", "--only", nargs="+", default=[], metavar="STEP", help="with --without-solutions: as of `release`"
    )
    parser.add_argument("--base", default=BASE, metavar="IMAGE", help="a Debian or Ubuntu to begin with (%(default)s)")


# Programs that build images, and what they say of themselves.

_ENGINES = ("docker", "podman")
_ASK_SECONDS = 60


def _engine() -> str:
    """The first that answers: a docker without its daemon does not."""
    said = []
    for name in _ENGINES:
        if shutil.which(name) is None:
            said.append(f"{name} is not installed")
            continue
        outcome = ask([name, "version"], seconds=_ASK_SECONDS)
        if outcome.code == 0:
            return name
        lines = clean(outcome.stderr).strip().splitlines() or [f"it ends with exit code {outcome.code}"]
        said.append(f"{name} does not work: {shorten(lines[-1], 200)}")
    raise UsageError(
        f"{'; '.join(said)}. Expected one of them; or write the files with --context DIR, and build them elsewhere "
        "with `docker build DIR`"
    )


def _write(project: Project, arguments: argparse.Namespace, folder: Path, console: Console) -> bool:
    """All that the image is built from; not where something leaks to students."""
    if not arguments.without_solutions:
        into_folder(grader_image(project, arguments.base), folder)
        return True
    into_folder(students_image(project, arguments.base), folder)
    if not release.write(project, arguments.steps, None, folder / "kit", console):
        return False
    return not release.tell(console, find_leaks(gather(project), folder))


def _lines(tag: str, *, students: bool) -> str:
    """How it is used."""
    words = ["docker", "run", "--rm", "--network", "none"]
    if students:
        own = [*words, "-it", "--user", "$(id -u):$(id -g)", "-v", "$PWD:/opt/raysteps/kit", tag, "check"]
        return f"In a student's folder:\n  {_shown(own)}"
    words += ["--read-only", "-v", "$PWD/submission:/submission:ro", tag, "grade", "/submission"]
    return f"To grade a submission:\n  {_shown(words)}"


def _shown(words: list[str]) -> str:
    """What a shell fills in stands in double quotes."""
    return " ".join(f'"{word}"' if "$" in word else quote_command([word]) for word in words)


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """0 when the image or its folder is there, 1 where a solution would go out."""
    if not project.has_reference:
        raise UsageError("an image is made from the whole kit, with solutions/; this is a students' kit")
    if arguments.steps and not arguments.without_solutions:
        raise UsageError("--steps is for --without-solutions; an image that grades has all steps, and `grade --only`")
    if "\n" in arguments.base or not arguments.base.strip() or arguments.base.startswith("-"):
        raise UsageError(f"--base {arguments.base!r}: expected the name of an image, such as {BASE}")
    if arguments.context is not None:
        release.refuse_inside(project, arguments.context.resolve())
        if not _write(project, arguments, arguments.context, console):
            return 1
        if not arguments.without_solutions:
            console.print("It holds the solutions, and the seed of course.toml: nobody else may read it.")
        build = _shown(["docker", "build", "--tag", "NAME", str(arguments.context)])
        console.print(escape(f"To build it: {build}"), highlight=False)
        return 0
    engine = _engine()
    with tempfile.TemporaryDirectory(prefix="raysteps-image-") as name:
        folder = Path(name) / "context"
        usable_folder(folder)
        if not _write(project, arguments, folder, console):
            return 1
        words = [engine, "build", f"--tag={arguments.tag}", str(folder)]
        code = subprocess.run(words, check=False, stdin=subprocess.DEVNULL).returncode
    if code != 0:
        raise GraderFault(f"{engine} build ended with exit code {code}; the lines above say why")
    lines = _lines(arguments.tag, students=arguments.without_solutions).replace("docker run", f"{engine} run")
    print_plain(console, lines)
    return 0
