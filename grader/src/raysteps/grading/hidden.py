"""The hidden part of a step: the judge's cases, and scenes that nobody has seen."""

import hashlib
from pathlib import Path

from raysteps.common.files import write_bytes
from raysteps.grading.settings import Settings
from raysteps.grading.visible_images import Gallery, too_many_tests, trouble
from raysteps.judge.examples import Examples
from raysteps.judge.hidden_scenes import HiddenScene, hidden_scenes
from raysteps.judge.judging import judge_functions
from raysteps.judge.plan import Plan
from raysteps.kit.built_kit import Say
from raysteps.kit.manifest import Step
from raysteps.programs.asking import ask_student, reference_answers, reference_unkept
from raysteps.programs.pictures import compare
from raysteps.programs.rendering import reference_picture
from raysteps.programs.student_build import Program
from raysteps.results.model import HiddenResult
from raysteps.sandbox.task import Ran


def ask_functions(
    gallery: Gallery, worker: Program, step: Step, plan: Plan, settings: Settings, say: Say
) -> list[HiddenResult]:
    """All functions of a step."""
    student = ask_student(gallery.sandbox, worker, gallery.limits)

    def reference(cases: bytes, _seconds: float) -> Ran:
        return reference_answers(gallery.kit, cases)

    def unkept(cases: bytes, _seconds: float) -> Ran:
        return reference_unkept(gallery.kit, cases)

    shown = settings.feedback == "full"  # else the cases are withheld, and nobody needs a small one
    examples = Examples(student, unkept, gallery.out, say) if shown else None
    return judge_functions(step, plan, student, reference, settings.seed, gallery.limits.seconds, examples)


def _judge_scene(gallery: Gallery, program: Program, scene: HiddenScene, folder: Path) -> HiddenResult:
    path = folder / f"{hashlib.sha256(scene.nff.encode()).hexdigest()[:16]}.nff"
    write_bytes(path, scene.nff.encode())
    reference = reference_picture(gallery.kit, path, scene.args)
    rendered = gallery.render(program, path, scene.args)
    result = HiddenResult(scene.name, "picture", 0.0, weight=scene.weight)
    result.seconds = round(rendered.ran.outcome.seconds, 2)
    if rendered.pixels is None:
        result.outcome, result.message = trouble(rendered)
        return result
    verdict = compare(rendered.pixels, reference, scene.max_wrong)
    problem = verdict.message
    if verdict.passed and scene.max_share is not None:
        problem = too_many_tests(rendered.share_tested, scene.max_share)
    result.wrong_share = round(verdict.wrong_share, 6)
    result.message, result.share = problem, 0.0 if problem else 1.0
    result.outcome = "wrong" if problem else "ok"
    return result


def render_scenes(
    gallery: Gallery, program: Program, step: Step, plan: Plan, seed: int, folder: Path
) -> list[HiddenResult]:
    """Scenes made for this seed. The file's name says nothing about what it is for."""
    scenes = hidden_scenes(gallery.kit.project, step, plan, seed)
    return [_judge_scene(gallery, program, scene, folder) for scene in scenes]
