"""Pictures: the reference's, which are kept, and a student's, made in the sandbox."""

import contextlib
import hashlib
import json
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import content_hash, write_bytes, write_json
from raysteps.common.process import run
from raysteps.common.text import in_seconds, printable, shorten
from raysteps.course.manifest import ImageCase, Step, earlier
from raysteps.course.project import Project
from raysteps.images.compare import (
    PictureError,
    Pixels,
    error_without_work,
    mean_error,
    parse_ppm,
    read_png,
    read_ppm,
    write_png,
)
from raysteps.results.model import Termination, Work
from raysteps.sandbox.task import Input, Limits, Output, Sandbox, TaskResult, Word
from raysteps.toolchain.compile import Program
from raysteps.toolchain.kit_artifacts import BuiltKit

# The reference's pictures as files of a students' kit, reference/NN-name/CASE.png, and what is known of them.

_AGAIN = "take it from a fresh copy of the kit, or let ./raysteps update put it back"


def reference_image_path(project: Project, step: Step, case: ImageCase) -> Path:
    """Where the picture is."""
    return project.given / step.id / f"{case.name}.png"


def write_reference_image(
    project: Project, step: Step, case: ImageCase, scene: Path, pixels: Pixels, work: Work | None, for_nothing: float
) -> None:
    """A picture without a word in it, and beside it what it was made of, what it cost, and how wrong a picture is that
    took no work."""
    path = reference_image_path(project, step, case)
    write_png(pixels, path)
    write_json(
        path.with_suffix(".json"),
        {
            "scene": content_hash(scene.read_bytes()),
            "work": None if work is None else asdict(work),
            "for_nothing": for_nothing,
        },
    )


@dataclass(frozen=True)
class _Given:
    path: Path
    facts: dict[str, Any]


def _find(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> _Given:
    for step in kit.steps:
        for case in step.images:
            if kit.project.root / case.scene == scene and case.args == args:
                path = reference_image_path(kit.project, step, case)
                try:
                    facts = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))
                    same = facts["scene"] == content_hash(scene.read_bytes())
                except (OSError, ValueError, KeyError, TypeError) as error:
                    raise UsageError(f"{path.with_suffix('.json')}: cannot be read; {_AGAIN}") from error
                if not same:
                    raise UsageError(
                        f"{case.scene}: was changed; expected the scene of which {path.name} was made; {_AGAIN}"
                    )
                return _Given(path, facts)
    raise GraderFault(f"{scene}: a students' kit has no picture of it with {' '.join(args)}")


def stored_reference_image(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> Pixels:
    """The picture of one of the manifests' cases."""
    path = _find(kit, scene, args).path
    try:
        return read_png(path)
    except (OSError, ValueError) as error:
        raise UsageError(f"{path}: cannot be read; {_AGAIN}") from error


def stored_reference_work(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> Work:
    """What it cost the reference."""
    given = _find(kit, scene, args)
    try:
        return Work(**given.facts["work"])
    except (KeyError, TypeError) as error:
        raise UsageError(f"{given.path.with_suffix('.json')}: holds no counters; {_AGAIN}") from error


def _stored_for_nothing(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> float:
    given = _find(kit, scene, args)
    try:
        return float(given.facts["for_nothing"])
    except (KeyError, TypeError, ValueError) as error:
        raise UsageError(f"{given.path.with_suffix('.json')}: holds no `for_nothing`; {_AGAIN}") from error


_REFERENCE_SECONDS = 600
_MAX_STATS = 1 << 16  # bytes; raytrace writes some hundred
_MAX_SHARE = 1e6  # of the scene that a ray is tested against; more than 1 where a surface stands in many boxes


@dataclass(frozen=True)
class Rendered:
    """A picture, or why there is none."""

    ran: TaskResult
    pixels: Pixels | None
    problem: str = ""
    share_tested: float | None = None
    work: Work | None = None


def _share_tested(stats: bytes) -> float | None:
    """From the statistics of raytrace: how much of the scene each ray was tested against."""
    try:
        share = float(json.loads(stats)["share_tested"])
    except Exception:  # whatever stands there; the reference's are read in the same way
        return None
    return share if 0 <= share <= _MAX_SHARE else None


def render(sandbox: Sandbox, program: Program, scene: Path, args: tuple[str, ...], limits: Limits) -> Rendered:
    """One picture by a student's program, which learns neither where it is nor what for."""
    words: tuple[Word, ...] = (Input(scene, "scene.nff"), *args, "--quiet")
    words += ("-o", Output("picture"), "--stats", Output("stats"))
    ran = sandbox.run(program.task(words, limits))
    if ran.outcome.timed_out or ran.stopped or ran.outcome.code != 0:
        return Rendered(ran, None)
    try:
        pixels = parse_ppm(ran.outputs.get("picture", b""))
    except PictureError as error:
        return Rendered(ran, None, str(error))
    stats = ran.outputs.get("stats", b"")[:_MAX_STATS]
    return Rendered(ran, pixels, share_tested=_share_tested(stats), work=read_work(stats))


def _kept(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> Path:
    """Where the reference's picture of a scene is kept; its statistics lie beside it."""
    if not scene.is_file():
        raise GraderFault(f"{scene}: is not there; expected the scene of a picture")
    key = hashlib.sha256(scene.read_bytes() + "\0".join(args).encode()).hexdigest()
    return kit.kept("pictures", f"{key[:32]}.ppm")


def _stats_beside(picture: Path) -> Path:
    return picture.with_suffix(".json")


def reference_picture(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> Pixels:
    """Rendered at the first call; a reference that cannot is the kit's fault. A students' kit has it ready."""
    if not kit.has_reference:
        return stored_reference_image(kit, scene, args)
    path = _kept(kit, scene, args)
    if _stats_beside(path).is_file():
        with contextlib.suppress(PictureError):
            return read_ppm(path)
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        picture, stats = Path(folder) / "picture.ppm", Path(folder) / "stats.json"
        command: list[str | Path] = [kit.reference("raytrace"), scene, *args, "-o", picture, "--quiet"]
        command += ["--stats", stats]
        outcome = run(command, seconds=_REFERENCE_SECONDS, cwd=Path(folder))
        try:
            pixels, told = read_ppm(picture), stats.read_bytes()
        except (PictureError, OSError) as error:
            said = outcome.stderr.strip() or str(error)
            raise GraderFault(f"the reference cannot render {scene.name}: {said}") from error
        write_bytes(_stats_beside(path), told)
        write_bytes(path, picture.read_bytes())
    return pixels


def at_step(args: tuple[str, ...], step: int) -> tuple[str, ...]:
    """The arguments of the same picture with what another step can do."""
    at = args.index("--step") if "--step" in args else len(args)
    return (*args[:at], *args[at + 2 :], "--step", str(step))


_FIRST_WITH_LIGHT = 3  # the pictures of the steps before show something else


def error_for_nothing(kit: BuiltKit, step: Step, scene: Path, args: tuple[str, ...]) -> float:
    """How wrong the best picture is that took no work in this step: one of a single colour, outlines, or what the steps
    before it draw. A tree changes no picture."""
    if not kit.has_reference:
        return _stored_for_nothing(kit, scene, args)
    reference = reference_picture(kit, scene, args)
    simple = error_without_work(reference)
    if step.index <= _FIRST_WITH_LIGHT or "--accel" in args or "--step" not in args:
        return simple
    before = reference_picture(kit, scene, at_step(args, earlier(step, kit.steps)[-1].index))
    return min(simple, mean_error(before, reference))


def reference_work(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> Work:
    """What the same picture costs the reference."""
    if not kit.has_reference:
        return stored_reference_work(kit, scene, args)
    reference_picture(kit, scene, args)
    path = _stats_beside(_kept(kit, scene, args))
    work = read_work(path.read_bytes())
    if work is None:
        raise GraderFault(f"{path}: expected what `raytrace --stats` writes; delete the folder {path.parent}")
    return work


# How a student's program ended, in words.

ENDLESS = "Is there an endless loop? Once a program of a step has hung, the next ones get less time."


def describe_exit(ran: TaskResult, what: str) -> tuple[Termination, str]:
    """`what` is what the program was to make, such as `The picture`. Only for a program that did not make it."""
    outcome = ran.outcome
    if ran.stopped == "memory":
        return "crashed", f"{what} needed more memory than a program may have here."
    if outcome.timed_out or ran.stopped in ("wall", "cpu"):
        return "timeout", f"{what} was not ready after {in_seconds(outcome.seconds)}. {ENDLESS}"
    if outcome.signal_name is not None:
        return "crashed", f"{what} was not made: the program crashed ({outcome.signal_words})."
    if outcome.code != 0:
        said = shorten(printable(outcome.stderr.strip().rpartition("\n")[2]), 200)
        return "crashed", f"{what} was not made: the program gave up with exit code {outcome.code}" + (
            f": {said}" if said else "."
        )
    return "wrong", ""


# What a picture cost, as raytrace --stats writes it.

_MAX_COUNT = 2**63  # a counter of the framework has 64 bits


def _count(value: object) -> int:
    if type(value) is not int or not 0 <= value < _MAX_COUNT:
        raise ValueError("not a counter")
    return value


def read_work(stats: bytes) -> Work | None:
    """None when these are no statistics of raytrace: a student's program may have written anything."""
    try:
        told = json.loads(stats)
        structure = told["structure"]
        return Work(
            rays=_count(sum(_count(told["rays"][kind]) for kind in ("eye", "shadow", "reflect", "refract"))),
            surface_tests=_count(told["surface_tests"]),
            box_tests=_count(told["box_tests"]),
            boxes=_count(structure["boxes"]),
            references=_count(structure["references"]),
            bytes=_count(structure["bytes"]),
        )
    except Exception:  # as above
        return None
