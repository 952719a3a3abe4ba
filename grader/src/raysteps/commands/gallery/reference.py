"""The reference's pictures, which are kept from run to run."""

from raysteps.commands.gallery.scenes import Shown
from raysteps.commands.gallery.shots import TREES, Effort, Shot, picture_args
from raysteps.common.errors import GraderFault, UsageError
from raysteps.kit.built_kit import BuiltKit, Say
from raysteps.programs.rendering import reference_picture, reference_work


def _of_the_kit(kit: BuiltKit, scene: Shown) -> bool:
    """Else it is a file of the user's."""
    return scene.path.is_relative_to(kit.project.root)


def reference_shots(kit: BuiltKit, scene: Shown, size: str, say: Say) -> list[Shot]:
    """After every step."""
    shots = []
    for step in kit.steps:
        say(f"{scene.name}: step {step.number}")
        try:
            shots.append(Shot(reference_picture(kit, scene.path, picture_args(step, size))))
        except GraderFault as fault:
            if _of_the_kit(kit, scene):
                raise
            raise UsageError(f"--scene {scene.path}: {fault}") from fault
    return shots


def reference_efforts(kit: BuiltKit, scene: Shown, say: Say) -> dict[int, list[Effort]]:
    """By step: before and after. A scene of the user's has none when it is too large to be traced without a tree."""
    efforts = {}
    for tree in TREES:
        if not any(step.index == tree.step for step in kit.steps):
            continue
        say(f"{scene.name}: work in step {tree.step:02d}")
        try:
            efforts[tree.step] = [
                Effort(name, reference_picture(kit, scene.path, args), reference_work(kit, scene.path, args))
                for name, args in (tree.before, tree.after)
            ]
        except GraderFault:
            if _of_the_kit(kit, scene):
                raise
    return efforts
