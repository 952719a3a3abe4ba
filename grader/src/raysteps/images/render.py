"""Pictures: the reference's, which are kept, and a student's, made in the sandbox."""

import hashlib
import json
import re
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import content_hash, write_bytes, write_json
from raysteps.common.process import Outcome, run
from raysteps.common.text import in_seconds, printable, shorten
from raysteps.course.manifest import ImageCase, Step, earlier, with_option
from raysteps.course.project import Project
from raysteps.images.compare import (
    Comparison,
    PictureError,
    Pixels,
    baseline_error,
    compare,
    mean_error,
    parse_ppm,
    partial_credit,
    read_png,
    read_ppm,
    write_png,
)
from raysteps.images.noise import (
    Estimates,
    EstimatesError,
    as_lists,
    as_picture,
    compare_estimates,
    from_lists,
    read_estimates,
    with_samples,
)
from raysteps.results.model import Termination, Work
from raysteps.sandbox.task import Input, Limits, Output, Sandbox, Task, TaskResult, Word
from raysteps.toolchain.compile import Program, unqualified_name
from raysteps.toolchain.kit_artifacts import BuiltKit

# The reference's pictures as files of a students' kit, reference/NN-name/CASE.png, and what is known of them.

_AGAIN = "take it from a fresh copy of the kit, or let ./raysteps update put it back"


def reference_image_path(project: Project, step: Step, case: ImageCase) -> Path:
    """Where the picture is."""
    return project.given / step.id / f"{case.name}.png"


def write_reference_image(kit: BuiltKit, project: Project, step: Step, case: ImageCase) -> None:
    """A picture without a word in it, and beside it what it was made of, what it cost, how wrong a picture is that took
    no work, and, where it is noisy, the means of its parts."""
    path = reference_image_path(project, step, case)
    scene = kit.project.root / case.scene
    write_png(shown_reference(kit, scene, case), path)
    work = reference_work(kit, scene, case.args) if case.max_share is not None else None
    write_json(
        path.with_suffix(".json"),
        {
            "scene": content_hash(scene.read_bytes()),
            "work": None if work is None else asdict(work),
            "for_nothing": step_baseline_error(kit, step, scene, case),
            "parts": as_lists(reference_parts(kit, scene, case)) if case.is_noisy else None,
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


def _stored_baseline_error(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> float:
    given = _find(kit, scene, args)
    try:
        return float(given.facts["for_nothing"])
    except (KeyError, TypeError, ValueError) as error:
        raise UsageError(f"{given.path.with_suffix('.json')}: holds no `for_nothing`; {_AGAIN}") from error


def stored_parts(picture: Path) -> Estimates:
    """The means that lie beside a noisy one."""
    path = picture.with_suffix(".json")
    try:
        return from_lists(json.loads(path.read_text(encoding="utf-8"))["parts"])
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise UsageError(f"{path}: holds no means of parts; {_AGAIN}") from error


ESTIMATES = ".estimates"
_REFERENCE_SECONDS = 600
_SCENE = "scene.nff"  # whatever its form
_MAX_STATS = 1 << 16  # bytes; raytrace writes some hundred
_MAX_SHARE = 1e6  # of the scene that a ray is tested against; more than 1 where a surface stands in many boxes


# What statistics can be instead, which a student's program wrote: no JSON, other kinds of values, no such keys, numbers
# beyond a float, or a thousand brackets.
_BAD_STATS = (ValueError, TypeError, KeyError, OverflowError, RecursionError)


@dataclass(frozen=True)
class RenderResult:
    """A picture, or why there is none."""

    ran: TaskResult
    pixels: Pixels | None
    problem: str = ""
    share_tested: float | None = None
    work: Work | None = None
    estimates: Estimates | None = None  # where they were asked for
    sooner: bool = False  # it had less time than the step says


def _share_tested(stats: bytes) -> float | None:
    """From the statistics of raytrace: how much of the scene each ray was tested against."""
    try:
        share = float(json.loads(stats)["share_tested"])
    except _BAD_STATS:
        return None
    return share if 0 <= share <= _MAX_SHARE else None


def picture_task(
    program: Program, scene: Path, args: tuple[str, ...], limits: Limits, *, estimates: bool = False
) -> Task:
    """One picture by a student's program, which learns neither where it is nor what for."""
    words: tuple[Word, ...] = (Input(scene, _SCENE), *args, "--quiet")
    words += ("-o", Output("picture"), "--stats", Output("stats"))
    words += ("--estimates", Output("estimates")) if estimates else ()
    return program.task(words, limits)


def read_rendered(ran: TaskResult, *, estimates: bool = False) -> RenderResult:
    """What came of such a task."""
    if ran.outcome.timed_out or ran.stopped or ran.outcome.code != 0:
        return RenderResult(ran, None)
    try:
        pixels = parse_ppm(ran.outputs.get("picture", b""))
        means = read_estimates(ran.outputs.get("estimates", b"")) if estimates else None
    except (PictureError, EstimatesError) as error:
        return RenderResult(ran, None, str(error))
    stats = ran.outputs.get("stats", b"")[:_MAX_STATS]
    return RenderResult(ran, pixels, share_tested=_share_tested(stats), work=read_work(stats), estimates=means)


def render(
    sandbox: Sandbox,
    program: Program,
    scene: Path,
    args: tuple[str, ...],
    limits: Limits,
    *,
    estimates: bool = False,
) -> RenderResult:
    """Runs the program for one picture; the result holds no pixels where it made none, and why."""
    task = picture_task(program, scene, args, limits, estimates=estimates)
    return read_rendered(sandbox.run(task), estimates=estimates)


def _kept(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> Path:
    """Where the reference's picture of a scene is kept; its statistics lie beside it."""
    if not scene.is_file():
        raise GraderFault(f"{scene}: is not there; expected the scene of a picture")
    key = hashlib.sha256(scene.read_bytes() + "\0".join(args).encode()).hexdigest()
    return kit.kept("pictures", f"{key[:32]}.ppm")


def _stats_beside(picture: Path) -> Path:
    return picture.with_suffix(".json")


def _drawn(kit: BuiltKit, scene: Path, args: tuple[str, ...], *, estimates: bool = False) -> Path:
    """The reference's picture, rendered at the first call; a reference that cannot is the kit's fault."""
    path = _kept(kit, scene, args)
    beside = [_stats_beside(path), *([path.with_suffix(ESTIMATES)] if estimates else [])]
    if path.is_file() and all(file.is_file() for file in beside):
        return path
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        alone, picture, stats, means = (Path(folder) / name for name in (_SCENE, "picture.ppm", "stats", "estimates"))
        alone.write_bytes(scene.read_bytes())  # as a student's program has it: with nothing beside it
        command: list[str | Path] = [kit.reference("raytrace"), alone, *args, "-o", picture, "--quiet"]
        command += ["--stats", stats]
        command += ["--estimates", means] if estimates else []
        outcome = run(command, seconds=_REFERENCE_SECONDS, cwd=Path(folder))
        try:
            read_ppm(picture)
            told = [stats.read_bytes(), *([means.read_bytes()] if estimates else [])]
        except (PictureError, OSError) as error:
            said = outcome.stderr.strip() or str(error)
            raise GraderFault(
                f"the reference cannot render {scene.name} with {' '.join(args)}, with no other file beside it: {said}"
            ) from error
        for file, data in zip(beside, told, strict=True):
            write_bytes(file, data)
        write_bytes(path, picture.read_bytes())
    return path


def _read_drawn(kit: BuiltKit, scene: Path, args: tuple[str, ...], *, estimates: bool = False) -> Pixels:
    try:
        return read_ppm(_drawn(kit, scene, args, estimates=estimates))
    except PictureError:  # half a file, as after a full disk
        _kept(kit, scene, args).unlink(missing_ok=True)
        return read_ppm(_drawn(kit, scene, args, estimates=estimates))


def reference_picture(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> Pixels:
    """A students' kit has it ready."""
    return _read_drawn(kit, scene, args) if kit.has_reference else stored_reference_image(kit, scene, args)


@dataclass(frozen=True)
class PictureCriteria:
    """What is asked of a picture: how many pixels may be wrong, and of a noisy one how much noisier than the
    reference's it may be. `more_samples`: how many times as many samples the reference's noisy picture has."""

    args: tuple[str, ...]
    max_wrong: float
    max_noise: float | None = None
    more_samples: int = ImageCase.more_samples


def shown_reference(kit: BuiltKit, scene: Path, criteria: ImageCase | PictureCriteria) -> Pixels:
    """The reference's picture: of a noisy one, that with more samples, drawn once with the estimates beside it."""
    if criteria.max_noise is None or not kit.has_reference:
        return reference_picture(kit, scene, criteria.args)
    return _read_drawn(kit, scene, with_samples(criteria.args, criteria.more_samples), estimates=True)


def reference_parts(kit: BuiltKit, scene: Path, criteria: ImageCase | PictureCriteria) -> Estimates:
    """The means of the parts of a noisy picture."""
    if not kit.has_reference:
        return stored_parts(_find(kit, scene, criteria.args).path)
    args = with_samples(criteria.args, criteria.more_samples)

    def read() -> Estimates:
        return read_estimates(_drawn(kit, scene, args, estimates=True).with_suffix(ESTIMATES).read_bytes()).in_parts()

    try:
        return read()
    except EstimatesError:  # half a file, as after a full disk
        _kept(kit, scene, args).with_suffix(ESTIMATES).unlink(missing_ok=True)
        return read()


def judge_picture(
    kit: BuiltKit, scene: Path, criteria: ImageCase | PictureCriteria, rendered: RenderResult
) -> Comparison:
    """What was made, beside the reference's."""
    assert rendered.pixels is not None
    if criteria.max_noise is None or rendered.estimates is None:
        return compare(rendered.pixels, reference_picture(kit, scene, criteria.args), criteria.max_wrong)
    rows, columns, _ = shown_reference(kit, scene, criteria).shape
    parts = reference_parts(kit, scene, criteria)
    return compare_estimates(rendered.estimates, parts, (columns, rows), criteria.more_samples, criteria.max_noise)


def pixel_credit(
    kit: BuiltKit, step: Step, scene: Path, criteria: ImageCase | PictureCriteria, rendered: RenderResult
) -> float:
    """What a picture that does not pass still earns; of a noisy one, by the light of its parts."""
    assert rendered.pixels is not None
    baseline = step_baseline_error(kit, step, scene, criteria)
    if criteria.max_noise is None or rendered.estimates is None:
        return partial_credit(rendered.pixels, reference_picture(kit, scene, criteria.args), baseline)
    right = as_picture(reference_parts(kit, scene, criteria).mean)
    return partial_credit(as_picture(rendered.estimates.in_parts().mean), right, baseline)


def at_step(args: tuple[str, ...], step: int) -> tuple[str, ...]:
    """The arguments of the same picture with what another step can do."""
    return with_option(args, "--step", str(step))


_FIRST_WITH_LIGHT = 3  # the pictures of the steps before show something else


def step_baseline_error(kit: BuiltKit, step: Step, scene: Path, criteria: ImageCase | PictureCriteria) -> float:
    """How wrong the best picture is that took no work in this step: one of a single colour, outlines, or what the steps
    before it draw. A tree changes no picture."""
    args = criteria.args
    if not kit.has_reference:
        return _stored_baseline_error(kit, scene, args)

    def drawn(at: ImageCase | PictureCriteria) -> Pixels:
        if at.max_noise is None:
            return reference_picture(kit, scene, at.args)
        return as_picture(reference_parts(kit, scene, at).mean)

    reference = drawn(criteria)
    simple = baseline_error(reference)
    if step.index <= _FIRST_WITH_LIGHT or "--accel" in args or "--step" not in args:
        return simple
    before = PictureCriteria(
        at_step(args, earlier(step, kit.steps)[-1].index), criteria.max_wrong, criteria.max_noise, criteria.more_samples
    )
    return min(simple, mean_error(drawn(before), reference))


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

ENDLESS = "Is there an endless loop?"


def not_in_time(what: str, seconds: float, *, sooner: bool) -> str:
    """Of what was stopped. The one number that is told is the time that the step has: where programs before have used
    it up, this one had less (`sooner`), and is said to be one more of them."""
    if sooner:
        return f"{what} was stopped, too. {ENDLESS} Once programs of a step were stopped, the next ones have less time."
    return f"{what} was stopped after {in_seconds(seconds)}. {ENDLESS}"


# As the loader says it of a function that is no C++, which the linker leaves to the loader; a source can hide it there.
_NOWHERE = re.compile(r"symbol lookup error: .+?: undefined symbol: ([^\s,]+)")
_MAX_LINE = 2000  # characters of the last one that are looked through


def exit_words(outcome: Outcome) -> str:
    """The exit code of a program that gave up, and its last words."""
    last = outcome.last_line[:_MAX_LINE]
    nowhere = _NOWHERE.search(last)
    if nowhere is not None:
        name = unqualified_name(nowhere[1]) or nowhere[1]
        last = f"the program asks for {shorten(name, 100)}, which is defined nowhere that it could see"
    said = shorten(printable(last), 200)
    code = f"exit code {outcome.code}" + ("" if outcome.code else ", as by a call of exit(0)")
    return f"{code}: {said}" if said else code


def describe_exit(ran: TaskResult, what: str, *, sooner: bool = False) -> tuple[Termination, str]:
    """`what` is what the program was to make, such as `The picture`. Only for a program that did not make it."""
    outcome = ran.outcome
    if ran.stopped == "memory":
        return "crashed", f"{what} needed more memory than a program may have here."
    if ran.hung:
        return "timeout", not_in_time(what, outcome.seconds, sooner=sooner)
    if outcome.signal_name is not None:
        return "crashed", f"{what} was not made: the program crashed ({outcome.signal_words})."
    if outcome.code != 0 or not any(ran.outputs.values()):
        words = exit_words(outcome)
        return "crashed", f"{what} was not made: the program gave up with {words}{'' if ': ' in words else '.'}"
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
    except _BAD_STATS:
        return None
