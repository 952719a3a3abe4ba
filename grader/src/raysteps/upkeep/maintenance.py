"""The commands `dev stubs`, `dev samples` and `dev mistakes`, for those who maintain the kit."""

import shutil
from pathlib import Path

from raysteps.diagnosis.learning import known_mistakes
from raysteps.judge.plan import read_plan
from raysteps.kit.built_kit import Say
from raysteps.kit.kit_building import build_kit
from raysteps.kit.manifest import read_all_steps, read_steps
from raysteps.kit.project import Project
from raysteps.kit.stubs import outdated_stubs, write_stubs
from raysteps.mistakes.catalogue import read_mutants
from raysteps.upkeep.handbook import command as handbook
from raysteps.upkeep.samples import outdated_samples, write_samples


def stubs(project: Project, *, check: bool) -> int:
    """Makes the stubs, or tells which are out of date."""
    changed = (outdated_stubs if check else write_stubs)(project, read_steps(project))
    return _tell(project, changed, [], "dev stubs", check=check)


def samples(project: Project, *, check: bool) -> int:
    """Makes the samples, or tells which are out of date."""
    changed = (outdated_samples if check else write_samples)(project, read_steps(project))
    strays = _strays(project, [project.samples / name / "steps" for name in ("complete", "partial")], check=check)
    return _tell(project, changed, strays, "dev samples", check=check)


def mistakes(project: Project, say: Say, *, check: bool) -> int:
    """Makes the pages of docs/mistakes/, or tells which are out of date."""
    changed = (handbook.out_of_date if check else handbook.write)(project, say)
    return _tell(project, [project.root / name for name in changed], [], "dev mistakes", check=check)


def learn(project: Project, say: Say) -> int:
    """Keeps what the known mistakes of all steps answer and draw."""
    kit = build_kit(project, say)
    for step in kit.steps:
        known_mistakes(kit, step, read_plan(project, step), read_mutants(project, step), say)
    return 0


def _strays(project: Project, rooms: list[Path], *, check: bool) -> list[Path]:
    """What was made for steps that are gone; removed, unless it is only to be told."""
    known = {step.id for step in read_all_steps(project)}
    found = [path for room in rooms for path in sorted(room.glob("[0-9][0-9]-*")) if path.name not in known]
    for path in [] if check else found:
        shutil.rmtree(path)
    return found


def _tell(project: Project, changed: list[Path], strays: list[Path], command: str, *, check: bool) -> int:
    for path in changed:
        name = path.relative_to(project.root).as_posix()
        if check:
            print(f"{name} differs from what the solutions generate; ./raysteps {command} makes it anew")
        else:
            print(f"{name} written")
    for path in strays:
        name = path.relative_to(project.root).as_posix()
        print(f"{name} belongs to no step; ./raysteps {command} removes it" if check else f"{name} removed")
    return 1 if check and (changed or strays) else 0
