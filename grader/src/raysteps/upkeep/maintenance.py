"""The commands `dev stubs`, `dev samples` and `dev mistakes`, for those who maintain the kit."""

from raysteps.diagnosis.learning import known_mistakes
from raysteps.judge.plan import read_plan
from raysteps.kit.built_kit import Say
from raysteps.kit.kit_building import build_kit
from raysteps.kit.manifest import read_steps
from raysteps.kit.project import Project
from raysteps.kit.stubs import outdated_stubs, write_stubs
from raysteps.mistakes.catalogue import read_mutants
from raysteps.upkeep.handbook import command as handbook
from raysteps.upkeep.samples import outdated_samples, write_samples


def stubs(project: Project, *, check: bool) -> int:
    """Makes the stubs, or tells which are out of date."""
    steps = read_steps(project)
    changed = (outdated_stubs if check else write_stubs)(project, steps)
    return _tell([path.relative_to(project.root).as_posix() for path in changed], "dev stubs", check=check)


def samples(project: Project, *, check: bool) -> int:
    """Makes the samples, or tells which are out of date."""
    changed = (outdated_samples if check else write_samples)(project, read_steps(project))
    return _tell([path.relative_to(project.root).as_posix() for path in changed], "dev samples", check=check)


def mistakes(project: Project, say: Say, *, check: bool) -> int:
    """Makes the pages of docs/mistakes/, or tells which are out of date."""
    changed = (handbook.out_of_date if check else handbook.write)(project, say)
    return _tell(changed, "dev mistakes", check=check)


def learn(project: Project, say: Say) -> int:
    """Keeps what the known mistakes of all steps answer and draw."""
    kit = build_kit(project, say)
    for step in kit.steps:
        known_mistakes(kit, step, read_plan(project, step), read_mutants(project, step), say)
    return 0


def _tell(changed: list[str], command: str, *, check: bool) -> int:
    for name in changed:
        if check:
            print(f"{name} differs from what the solutions generate; ./raysteps {command} makes it anew")
        else:
            print(f"{name} written")
    return 1 if check and changed else 0
