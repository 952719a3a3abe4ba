"""The command `inspect`."""

import argparse
import re
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

from rich.console import Console
from rich.markup import escape

from raysteps.cli import STUDENTS_KIT, add_impl
from raysteps.cli.render import build_program, implementation_name, resolve_scene
from raysteps.cli.todo_steps import as_far_as_written, built_trees, default_step, refuse_missing_tree, unfinished
from raysteps.common import process
from raysteps.common.documents import Malformed, parse, plain
from raysteps.common.errors import UsageError
from raysteps.common.files import encoded, refuse_to_write, write_out
from raysteps.common.text import in_seconds, join_and, print_plain, printable
from raysteps.course.manifest import Step, chosen_step, read_all_steps, read_steps
from raysteps.course.project import Project
from raysteps.inspector.model import Record
from raysteps.inspector.pixel_page import write_page
from raysteps.inspector.records import Difference, contradiction
from raysteps.report.page import NotAPicture, PictureData, picture_data
from raysteps.toolchain.cmake import BuildTree, release_tree

# The program inspect: run, and its record read.

_SECONDS = 30
_MAX_BYTES = 64 << 20
_USAGE = 2


@dataclass(frozen=True)
class InspectOptions:
    """Which pixel of what; `options` are those of the program."""

    scene: str
    x: str
    y: str
    step: int
    options: tuple[str, ...] = ()
    path: str | None = None  # which sample of the pixel; there is but one before part two

    def words(self) -> list[str]:
        path = () if self.path is None else ("--path", self.path)
        return [self.scene, self.x, self.y, "--step", str(self.step), *self.options, *path]

    def of_step(self, step: Step) -> "InspectOptions":
        """The same pixel after an earlier step."""
        return replace(self, step=step.index, path=self.path if step.is_in_part_two else None)


@dataclass(frozen=True)
class InspectResult:
    """What the program said; `problem` is set where it did not come to its end."""

    text: str = ""
    record: Record | None = None
    remarks: str = ""  # from stderr, such as functions that are not written yet
    problem: str = ""


def _problem(outcome: process.Outcome) -> str:
    if outcome.timed_out:
        return f"did not come to an end in {in_seconds(_SECONDS)}. Is there an endless loop?"
    if outcome.signal_name is not None:
        return f"crashed ({outcome.signal_words})."
    return f"gave up with exit code {outcome.code}" if outcome.code != 0 else ""


def _read(path: Path) -> tuple[Record | None, str]:
    """Or what is wrong with it."""
    try:
        text = path.read_text(encoding="utf-8", errors="replace")  # a scene's name may be any bytes
        return parse(text.encode(), Record), ""
    except OSError:
        return None, "left no record that can be read"
    except (Malformed, RecursionError) as error:
        return None, f"left no record that can be read: {error}"


def inspect(program: Path, options: InspectOptions, *, seconds: float = _SECONDS) -> InspectResult:
    """Runs the program once; bad input is a usage error, whatever the steps are like."""
    with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
        file = Path(folder) / "record.json"
        outcome = process.run([program, *options.words(), "--json", file], seconds=seconds, cap=_MAX_BYTES)
        said = printable(outcome.stderr).strip()
        if outcome.code == _USAGE and not outcome.timed_out:
            raise UsageError(said.removeprefix("raysteps inspect: ") or "inspect gave up without a word")
        problem = _problem(outcome)
        record, problem = (None, problem) if problem else _read(file)
    return InspectResult(printable(outcome.stdout), record, said, problem)


def last_good_step(program: Path, options: InspectOptions, steps: Sequence[Step]) -> int:
    """Up to which step the program comes to its end; 0: not even in the first."""
    good = 0
    for step in steps:
        if step.index >= options.step:
            break
        outcome = process.run([program, *options.of_step(step).words(), "--quiet"], seconds=10)
        if outcome.code != 0 or outcome.timed_out:
            break
        good = step.index
    return good


# The command line.


def _pixel(word: str) -> str:
    """One of the two; told at once, as whoever writes both in one word would hear that Y is missing."""
    if not re.fullmatch(r"[0-9]{1,5}", word):
        raise argparse.ArgumentTypeError(f"expected X and Y, two whole numbers from 0 on like 80 60, found '{word}'")
    return word


_STRUCTURES = {
    "none": "none before step 6",
    "boxes": "boxes: the paper's",
    "octree": "octree from step 6 on",
    "bvh": "bvh for step 9",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which pixel of which picture, and whose steps."""
    parser.add_argument("scene", metavar="SCENE", help="such as scenes/lessons/three-spheres.nff")
    parser.add_argument("x", metavar="X", type=_pixel, help="pixels from the left, from 0")
    parser.add_argument("y", metavar="Y", type=_pixel, help="pixels from the top, from 0")
    parser.add_argument("--step", metavar="N", help="with what the course has after step N (8, or the kit's last step)")
    parser.add_argument("--size", metavar="WxH", help="pixels of the picture (the scene's own)")
    parser.add_argument("--depth", metavar="D", help="longest chain of rays, the eye ray included (5)")
    parser.add_argument("--view", choices=["color", "normals"], help="what step 2 shows (color)")
    words = "from step 10 on: sample N of the pixel, from 1 on, instead of the ray through its middle"
    parser.add_argument("--path", metavar="N", help=words)
    kit = parser.get_default(STUDENTS_KIT)
    offered = list(_STRUCTURES) if kit is None else ["none", *built_trees(kit)]
    parser.add_argument(
        "--accel",
        choices=list(_STRUCTURES),
        metavar=f"{{{','.join(offered)}}}",
        help=f"what a ray is tested against ({', '.join(_STRUCTURES[name] for name in offered)})",
    )
    add_impl(parser)
    if kit is None:
        parser.add_argument(
            "--against",
            choices=["reference"],
            help="both trees side by side, and where they part; exit code 1 if they do",
        )
    else:
        parser.set_defaults(against=None)
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the record there, too")
    parser.add_argument("--html", type=Path, metavar="FILE", help="write a page with the rays in three dimensions")


def _options(project: Project, arguments: argparse.Namespace) -> InspectOptions:
    if arguments.step is not None:
        arguments.step = str(chosen_step(project, arguments.step).index)
    named = ["step", "size", "depth", "view", "accel"]
    words = [w for name in named if (value := getattr(arguments, name)) is not None for w in (f"--{name}", value)]
    if arguments.impl == "mine":
        refuse_missing_tree(project, words)
        more, said = as_far_as_written(project, words)
        words += more
        if said:
            print(f"raysteps: {said}", file=sys.stderr)
    at = words.index("--step") if "--step" in words else len(words)
    step = int((words[at + 1 : at + 2] or [default_step(project)])[0])
    given = (*words[:at], *words[at + 2 :])
    return InspectOptions(arguments.scene, arguments.x, arguments.y, step, given, arguments.path)


def _say_unfinished(project: Project, options: InspectOptions) -> None:
    left = unfinished(project, options.step)
    if left and left[0][0].index == 1 and len(left[0][1]) == len(left[0][0].functions):
        file = f"steps/{left[0][0].path.as_posix()}"
        other = ", or look at the reference: --impl reference" if project.has_reference else ""
        raise UsageError(
            f"your steps are not started: expected a camera in {file}, found the stub. Write it first{other}"
        )
    for step, functions in left:
        print(f"raysteps: step {step.number}: {join_and(functions)} not written yet", file=sys.stderr)


def _tell_problem(project: Project, inspected: InspectResult, program: Path, options: InspectOptions) -> None:
    good = last_good_step(program, options, read_all_steps(project))
    up_to = f" With --step {good} it comes to its end." if 0 < good < options.step else ""
    print(f"raysteps: {implementation_name(program)} {inspected.problem}{up_to}", file=sys.stderr)


def _write_json(arguments: argparse.Namespace, inspected: InspectResult, console: Console) -> None:
    if arguments.json is not None and inspected.record is not None:
        write_out(arguments.json, encoded(plain(inspected.record)))
        print_plain(console, f"Record: {arguments.json}")


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """0 when the pixel could be followed and, where two are compared, they agree."""
    options = _options(project, arguments)
    if arguments.against and arguments.impl == "reference":
        raise UsageError("--against reference: expected your own steps beside it, found --impl reference")
    options = replace(options, scene=resolve_scene(project, arguments.scene))
    for path in (arguments.json, arguments.html):
        if path is not None:
            refuse_to_write(path)
    if arguments.impl == "mine":
        _say_unfinished(project, options)

    tree = release_tree(project)
    program = build_program(tree, "inspect", arguments.impl)
    reference = build_program(tree, "inspect", "reference") if arguments.against else None
    inspected = inspect(program, options)
    if inspected.problem:
        _tell_problem(project, inspected, program, options)
        return 1
    _write_json(arguments, inspected, console)
    pictures = {}
    if arguments.html is not None:
        impls = {"mine": arguments.impl} | ({"reference": "reference"} if arguments.against else {})
        found = {name: _picture(tree, impl, inspected, options) for name, impl in impls.items()}
        pictures = {name: picture for name, picture in found.items() if picture is not None}
    if reference is not None:
        code = compare(project, inspected, inspect(reference, options), console, arguments.html, pictures)
        _tell_contradiction(project, inspected, console)
        return code
    assert inspected.record is not None
    sys.stdout.write(inspected.text)
    sys.stdout.flush()
    _tell_contradiction(project, inspected, console)
    _write_html(arguments.html, console, inspected.record, pictures=pictures)
    return 1 if inspected.record.endless else 0


_MAX_PIXELS = 1 << 20  # of a picture in a page
_PICTURE_SECONDS = 60


def _picture(tree: BuildTree, impl: str, inspected: InspectResult, options: InspectOptions) -> PictureData | None:
    """The picture that the pixel is one of; none where it is very large, or does not come to its end."""
    assert inspected.record is not None
    camera = inspected.record.camera
    if camera["width"] * camera["height"] > _MAX_PIXELS:
        return None
    program = build_program(tree, "raytrace", impl)
    with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
        target = Path(folder) / "picture.png"
        words = [options.scene, "--step", str(options.step), *options.options, "--quiet", "-o", str(target)]
        outcome = process.run([program, *words], seconds=_PICTURE_SECONDS)
        try:
            return picture_data(target) if outcome.code == 0 else None
        except NotAPicture:
            return None


def _tell_contradiction(project: Project, inspected: InspectResult, console: Console) -> None:
    """Where tests pass and every picture is wrong, a record that an earlier step hands on is often to blame."""
    found = contradiction(inspected.record) if inspected.record is not None else None
    if found is None:
        return
    step = next((step for step in read_steps(project) if found.function in step.functions), None)
    console.print(f"[bold red]A hit record contradicts its ray[/bold red]: {escape(found.words)}.", highlight=False)
    if step is not None:
        place = f"[bold]{escape(found.function)}[/bold] in steps/{escape(step.path.as_posix())}"
        console.print(f"  Look at {place} (step {step.number}), which makes the record.", highlight=False)


def _write_html(
    path: Path | None,
    console: Console,
    record: Record,
    reference: Record | None = None,
    divergence: Difference | None = None,
    pictures: Mapping[str, PictureData] = MappingProxyType({}),
) -> None:
    if path is not None:
        write_page(record, reference, divergence, path, pictures)
        print_plain(console, f"Page: {path}")


def compare(
    project: Project, mine: InspectResult, reference: InspectResult, console: Console, html: Path | None = None,
    pictures: Mapping[str, PictureData] = MappingProxyType({}),
) -> int:  # fmt: skip
    """Both trees, and the first place where they part."""
    # What knows the formulas of the steps is not for students.
    from raysteps.inspector.divergence import find_divergence
    from raysteps.inspector.side_by_side import print_trees, print_verdict

    assert mine.record is not None
    if reference.record is None:
        raise UsageError(f"the reference's program {reference.problem}")
    divergence = find_divergence(mine.record, reference.record)
    print_trees(console, mine.record, reference.record, divergence)
    print_verdict(console, read_steps(project), mine.record, reference.record, divergence)
    _write_html(html, console, mine.record, reference.record, divergence, pictures)
    return 0 if divergence is None else 1
