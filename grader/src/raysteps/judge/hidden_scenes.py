"""Scenes that no submission has seen: twins of the visible pictures, and made-up ones.

A twin shows the same things from a little farther round, in another size. A program that holds the visible pictures
themselves cannot draw it.
"""

from dataclasses import dataclass

from raysteps.common.errors import GraderFault
from raysteps.judge.drawing import Draw
from raysteps.judge.nff_changes import changed
from raysteps.judge.nff_random import random_scene
from raysteps.judge.plan import Plan, RandomPlan, TwinPlan
from raysteps.kit.manifest import ImageCase, Step
from raysteps.kit.project import Project

_SHARE_SLACK = 1.1  # from another place a ray meets other boxes


@dataclass(frozen=True)
class HiddenScene:
    """A picture to render with the student's code and the reference's: NFF and arguments of raytrace."""

    name: str
    twin_of: str | None
    nff: str
    args: tuple[str, ...]
    max_wrong: float
    max_share: float | None
    weight: float


def twin_name(image: str) -> str:
    """What the twin of a visible picture is called."""
    return f"{image}-twin"


def _with_size(args: tuple[str, ...], size: str) -> tuple[str, ...]:
    if "--size" not in args:
        return (*args, "--size", size)
    place = args.index("--size") + 1
    return (*args[:place], size, *args[place + 1 :])


def _twin(project: Project, step: Step, twin: TwinPlan, image: ImageCase, seed: int) -> HiddenScene:
    draw = Draw(f"{seed}/{step.id}/{twin.twin_of}")
    path = project.root / image.scene
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise GraderFault(f"{path}: cannot be read: {error.strerror}") from error
    nff = changed(text, draw, spheres=twin.moves == "camera and spheres")
    args = _with_size(image.args, twin.size)
    share = None if image.max_share is None else min(1.0, _SHARE_SLACK * image.max_share)
    return HiddenScene(twin_name(image.name), image.name, nff, args, twin.max_wrong, share, twin.weight)


def _random(step: Step, scene: RandomPlan, seed: int) -> HiddenScene:
    nff = random_scene(Draw(f"{seed}/{step.id}/{scene.name}"), scene.spheres, scene.triangles)
    return HiddenScene(scene.name, None, nff, scene.args, scene.max_wrong, scene.max_share, scene.weight)


def hidden_scenes(project: Project, step: Step, plan: Plan, seed: int) -> list[HiddenScene]:
    """The twins in the order of the visible pictures, then the made-up scenes."""
    images = {image.name: image for image in step.images}
    scenes = [_twin(project, step, twin, images[twin.twin_of], seed) for twin in plan.twins]
    return scenes + [_random(step, scene, seed) for scene in plan.random_scenes]
