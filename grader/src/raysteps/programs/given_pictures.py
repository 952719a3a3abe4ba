"""The reference's pictures as files of a students' kit, reference/NN-name/CASE.png, and what is known of them."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import write_json
from raysteps.common.marks import mark
from raysteps.kit.built_kit import BuiltKit
from raysteps.kit.manifest import ImageCase, Step
from raysteps.kit.project import Project
from raysteps.programs.pictures import Pixels, read_png, write_png
from raysteps.results.work import Work

_AGAIN = "take it from a fresh copy of the kit, or let ./raysteps update put it back"


def given_path(project: Project, step: Step, case: ImageCase) -> Path:
    """Where the picture is."""
    return project.given / step.id / f"{case.name}.png"


def write_given(project: Project, step: Step, case: ImageCase, scene: Path, pixels: Pixels, work: Work | None) -> None:
    """A picture without a word in it, and beside it what it was made of and what it cost."""
    path = given_path(project, step, case)
    write_png(pixels, path)
    write_json(
        path.with_suffix(".json"), {"scene": mark(scene.read_bytes()), "work": None if work is None else asdict(work)}
    )


@dataclass(frozen=True)
class _Given:
    path: Path
    facts: dict[str, Any]


def _find(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> _Given:
    for step in kit.steps:
        for case in step.images:
            if kit.project.root / case.scene == scene and case.args == args:
                path = given_path(kit.project, step, case)
                try:
                    facts = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))
                    same = facts["scene"] == mark(scene.read_bytes())
                except (OSError, ValueError, KeyError, TypeError) as error:
                    raise UsageError(f"{path.with_suffix('.json')}: cannot be read; {_AGAIN}") from error
                if not same:
                    raise UsageError(
                        f"{case.scene}: was changed; expected the scene of which {path.name} was made; {_AGAIN}"
                    )
                return _Given(path, facts)
    raise GraderFault(f"{scene}: a students' kit has no picture of it with {' '.join(args)}")


def given_picture(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> Pixels:
    """The picture of one of the manifests' cases."""
    path = _find(kit, scene, args).path
    try:
        return read_png(path)
    except (OSError, ValueError) as error:
        raise UsageError(f"{path}: cannot be read; {_AGAIN}") from error


def given_work(kit: BuiltKit, scene: Path, args: tuple[str, ...]) -> Work:
    """What it cost the reference."""
    given = _find(kit, scene, args)
    try:
        return Work(**given.facts["work"])
    except (KeyError, TypeError) as error:
        raise UsageError(f"{given.path.with_suffix('.json')}: holds no counters; {_AGAIN}") from error
