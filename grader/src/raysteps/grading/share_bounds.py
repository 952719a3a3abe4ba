"""How few objects a submission can have tested in the pictures where that is limited."""

from dataclasses import dataclass
from pathlib import Path

from raysteps.grading.hidden import scene_file
from raysteps.grading.visible_images import Gallery
from raysteps.judge.hidden_scenes import hidden_scenes
from raysteps.judge.plan import Plan
from raysteps.judge.scene_probes import ProbedScene, least_shares
from raysteps.kit.manifest import Step
from raysteps.programs.asking import ask_student, reference_answers
from raysteps.programs.pictures import Pixels
from raysteps.programs.rendering import reference_picture, reference_rays
from raysteps.programs.student_build import Program
from raysteps.sandbox.task import Ran


def _aspect(picture: Pixels) -> float:
    height, width = picture.shape[:2]
    return float(width / height)


@dataclass(frozen=True)
class ShareBounds:
    """Asked of the student's worker; `folder` holds the hidden scenes."""

    gallery: Gallery
    worker: Program
    step: Step
    plan: Plan
    seed: int
    folder: Path

    def _probed(self, name: str, path: Path, args: tuple[str, ...]) -> ProbedScene:
        kit = self.gallery.kit
        count = reference_rays(kit, path, args)
        rays = max(1, count.eye + count.onward)
        aspect = _aspect(reference_picture(kit, path, args))
        nff = path.read_text(encoding="utf-8")
        return ProbedScene(name, nff, aspect, count.surfaces, count.eye_hit / rays, count.onward / rays)

    def _scenes(self) -> list[ProbedScene]:
        project = self.gallery.kit.project
        visible = [image for image in self.step.images if image.max_share is not None]
        hidden = hidden_scenes(project, self.step, self.plan, self.seed)
        scenes = [self._probed(image.name, project.root / image.scene, image.args) for image in visible]
        limited = [scene for scene in hidden if scene.max_share is not None]
        return scenes + [self._probed(scene.name, scene_file(scene, self.folder), scene.args) for scene in limited]

    def least_shares(self) -> dict[str, float]:
        """By the names of the pictures, visible and hidden."""
        gallery = self.gallery

        def reference(cases: bytes, _seconds: float) -> Ran:
            return reference_answers(gallery.kit, cases)

        student = ask_student(gallery.sandbox, self.worker, gallery.limits)
        return least_shares(self._scenes(), student, reference, gallery.limits.seconds)
