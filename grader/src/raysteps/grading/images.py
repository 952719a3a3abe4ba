"""The pictures of a step, made with the student's code and compared."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from raysteps.common.text import join_and
from raysteps.course.manifest import ImageCase, Step, with_option
from raysteps.grading.unit_tests import limits_after
from raysteps.images.compare import (
    MAX_PARTIAL_SHARE,
    Comparison,
    Pixels,
    compare,
    difference,
    is_flat,
    reduced_picture,
    write_png,
)
from raysteps.images.noise import NoisyComparison, bias_map
from raysteps.images.render import (
    PictureCriteria,
    RenderResult,
    describe_exit,
    judge_picture,
    picture_task,
    pixel_credit,
    read_rendered,
    reference_work,
    shown_reference,
)
from raysteps.results.model import ImageResult, Integration, Termination, TestResult
from raysteps.sandbox.task import Sandbox
from raysteps.toolchain.compile import Program
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.toolchain.limits import StepLimits

_TREE, _NO_TREE = "--accel", "none"


@dataclass
class ImageGrader:
    """What pictures are made and judged with, and where they go. Patience ends with the second program that
    a limit stops."""

    kit: BuiltKit
    sandbox: Sandbox
    limits: StepLimits
    out: Path
    made: dict[str, Pixels] = field(default_factory=dict)  # the step's own pictures, by name

    def record_stop(self) -> None:
        self.limits = self.limits.after_a_stop()

    def record_stops(self, tests: Sequence[TestResult]) -> None:
        self.limits = limits_after(tests, self.limits)

    def args_of(self, case: ImageCase) -> tuple[str, ...]:
        """In a students' kit without a tree where the picture does not ask for one: step 07 needs no step 06."""
        return case.args if self.kit.has_reference or case.has_tree else (*case.args, _TREE, _NO_TREE)

    def render(self, program: Program, scene: Path, args: tuple[str, ...], *, noisy: bool = False) -> RenderResult:
        limits = self.limits
        ran = self.sandbox.run(picture_task(program, scene, args, limits.of_program(), estimates=noisy))
        if ran.was_stopped:
            self.record_stop()
        return replace(read_rendered(ran, estimates=noisy), sooner=limits.is_impatient)


def trouble(rendered: RenderResult) -> tuple[Termination, str]:
    """What kept a picture from being made."""
    outcome, message = describe_exit(rendered.ran, "The picture", sooner=rendered.sooner)
    return outcome, message or f"{rendered.problem.capitalize()}."


NO_TESTS = "The picture is right, but no test of an object was counted: ask a surface with surface->hit(ray)."
TOO_MANY_TESTS = (
    "The picture is right, but each ray tested {share} % of the objects; at most {most} % are allowed: the boxes must "
    "spare the rays most of the tests."
)


def too_many_tests(share: float | None, most: float) -> str:
    """Why a right picture was made with too much work, or nothing."""
    if not share:
        return NO_TESTS
    if share <= most:
        return ""
    return TOO_MANY_TESTS.format(share=f"{share * 100:.3g}", most=f"{most * 100:.3g}")


def image_credit(
    kit: BuiltKit,
    step: Step,
    scene: Path,
    criteria: ImageCase | PictureCriteria,
    max_share: float | None,
    rendered: RenderResult,
    *,
    pixels_pass: bool,
) -> float:
    """What a picture that did not pass earns: by its pixels, and by the tests of objects that were spared."""
    pixels = MAX_PARTIAL_SHARE
    if rendered.pixels is not None and (not pixels_pass or criteria.max_noise is not None):
        pixels = pixel_credit(kit, step, scene, criteria, rendered)
    return round(pixels * _part_spared(rendered.share_tested, max_share), 6)


def _part_spared(share: float | None, most: float | None) -> float:
    """Of the tests that a picture has to spare; 0 where none was counted."""
    if most is None:
        return 1.0
    return min(1.0, max(0.0, 1 - share) / (1 - most)) if share and most < 1 else 0.0


def may_carry_data(kit: BuiltKit) -> bool:
    """Whether a picture could bring something out of a sandbox: of one's own steps it cannot, and in a students' kit
    there is nothing to bring."""
    return kit.boxed and kit.has_reference


def grade_image(image_grader: ImageGrader, program: Program, step: Step, case: ImageCase) -> ImageResult:
    """One picture, with copies of mine, reference and difference as PNG."""
    scene = image_grader.kit.project.root / case.scene
    reference = shown_reference(image_grader.kit, scene, case)
    rendered = image_grader.render(program, scene, image_grader.args_of(case), noisy=case.is_noisy)
    result = ImageResult(case.name, case.scene, False, case.max_wrong, max_share=case.max_share, noisy=case.is_noisy)
    result.seconds = round(rendered.ran.outcome.seconds, 2)
    folder = Path("pictures") / step.id
    result.reference = (folder / f"{case.name}-reference.png").as_posix()
    write_png(reference, image_grader.out / result.reference)
    if rendered.pixels is None:
        result.outcome, result.message = trouble(rendered)
        return result
    image_grader.made[case.name] = rendered.pixels
    verdict = judge_picture(image_grader.kit, scene, case, rendered)
    if not (verdict.passed or image_grader.kit.has_reference) and case.has_tree:
        verdict = _beside_no_tree(image_grader, program, scene, case, rendered.pixels) or verdict
    result.passed, result.wrong_share, result.message = verdict.passed, round(verdict.wrong_share, 6), verdict.message
    if case.max_share is not None:
        result.work, result.reference_work = rendered.work, reference_work(image_grader.kit, scene, case.args)
        result.share_tested = None if rendered.share_tested is None else round(rendered.share_tested, 6)
        problem = too_many_tests(rendered.share_tested, case.max_share)
        if result.passed and problem:
            result.passed, result.message = False, problem
    result.outcome = "ok" if result.passed else "wrong"
    result.share = 1.0
    if not result.passed:
        result.share = image_credit(
            image_grader.kit,
            step,
            scene,
            case,
            case.max_share,
            rendered,
            pixels_pass=verdict.passed,
        )
    if rendered.pixels.shape == reference.shape:
        mine = rendered.pixels
        if not case.is_noisy and may_carry_data(image_grader.kit):
            mine = reduced_picture(mine, reference, result.wrong_share)
        result.mine = (folder / f"{case.name}-mine.png").as_posix()
        write_png(mine, image_grader.out / result.mine)
        result.difference = (folder / f"{case.name}-difference.png").as_posix()
        write_png(_difference(verdict, mine, reference), image_grader.out / result.difference)
    return result


def _difference(verdict: Comparison, mine: Pixels, reference: Pixels) -> Pixels:
    """Of a noisy picture, where its light is off by more than chance explains."""
    if isinstance(verdict, NoisyComparison) and verdict.deviations is not None:
        height, width, _ = mine.shape
        return bias_map(verdict.deviations, (width, height))
    return difference(mine, reference)


def _beside_no_tree(
    image_grader: ImageGrader, program: Program, scene: Path, case: ImageCase, pixels: Pixels
) -> Comparison | None:
    """A tree must change no pixel. So where earlier steps are the student's, too, a picture is right if it is the one
    that the same program draws without a tree; none where it is not, or shows nothing."""
    plain = image_grader.render(program, scene, with_option(case.args, _TREE, _NO_TREE)).pixels
    if plain is None or is_flat(pixels):
        return None
    verdict = compare(pixels, plain, case.max_wrong)
    words = "The same as without a tree; what differs from the reference comes from an earlier step."
    return replace(verdict, message=words) if verdict.passed else None


def grade_integration(
    image_grader: ImageGrader, program: Program, step: Step, own: Sequence[Step], replaced: Mapping[str, Sequence[str]]
) -> Integration:
    """The step's first picture with the student's steps up to this one, `own`; `replaced` are the reference's among
    them, by why they are. Each step may differ by as much as its own pictures may, and in one picture the differences
    add up."""
    case = step.images[0]
    scene = image_grader.kit.project.root / case.scene
    rendered = image_grader.render(program, scene, case.args, noisy=case.is_noisy)
    if rendered.pixels is None:
        return Integration(False, f"{case.name}: {trouble(rendered)[1]}")
    most_wrong = sum(max(image.max_wrong for image in other.images) for other in own)
    verdict = judge_picture(image_grader.kit, scene, replace(case, max_wrong=most_wrong), rendered)
    if not verdict.passed:
        return Integration(False, f"{case.name}: {verdict.message}")
    whom = [f"{join_and(steps)}, which {why}" for why, steps in replaced.items() if steps]
    words = f"The picture is right. It was drawn with the reference's {', and '.join(whom)}." if whom else ""
    return Integration(True, words)
