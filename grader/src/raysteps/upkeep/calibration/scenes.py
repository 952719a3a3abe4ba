"""The pictures of a step, visible and hidden, each with the limit that it is judged by."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from raysteps.common.files import write_bytes
from raysteps.judge.hidden_scenes import hidden_scenes
from raysteps.judge.plan import read_plan
from raysteps.kit.manifest import Step
from raysteps.kit.project import Project

Table = Literal["images", "twins", "random_scenes"]


@dataclass(frozen=True)
class View:
    """One picture to make."""

    scene: Path
    args: tuple[str, ...]


@dataclass(frozen=True)
class Limited:
    """One max_wrong of a manifest, and the pictures that it judges: of a hidden scene, one for each seed."""

    step: str
    table: Table
    name: str  # as the table has it: a twin is called like its picture
    max_wrong: float
    views: tuple[View, ...]

    @property
    def title(self) -> str:
        return f"{self.name}-twin" if self.table == "twins" else self.name

    def path(self, project: Project) -> Path:
        """Where the limit stands."""
        if self.table == "images":
            return project.steps / self.step / "step.toml"
        return project.solutions / self.step / "cases.toml"


def limited_pictures(project: Project, step: Step, seeds: range, folder: Path) -> list[Limited]:
    """The visible pictures, the twins and the made-up scenes, whose files are written into the folder."""
    limits = [
        Limited(step.id, "images", image.name, image.max_wrong, (View(project.root / image.scene, image.args),))
        for image in step.images
    ]
    plan = read_plan(project, step)
    if plan is None:
        return limits
    seeded = []
    for seed in seeds:
        scenes = []
        for scene in hidden_scenes(project, step, plan, seed):
            path = folder / f"{step.number}-{scene.name}-{seed}.nff"
            write_bytes(path, scene.nff.encode())
            scenes.append(View(path, scene.args))
        seeded.append(scenes)
    views = list(zip(*seeded, strict=True))
    for twin, of_twin in zip(plan.twins, views, strict=False):
        limits.append(Limited(step.id, "twins", twin.twin_of, twin.max_wrong, of_twin))
    for made_up, of_scene in zip(plan.random_scenes, views[len(plan.twins) :], strict=True):
        limits.append(Limited(step.id, "random_scenes", made_up.name, made_up.max_wrong, of_scene))
    return limits
