"""What a new step may be called."""

import re

from raysteps.common.errors import UsageError
from raysteps.kit.manifest import read_all_steps
from raysteps.kit.project import Project

_NAME = re.compile(r"([0-9]{2})-([a-z]+(?:-[a-z]+)*)")
_LONGEST = 40
_NO_FILES_ON_WINDOWS = {"con", "prn", "aux", "nul"}


def check_name(project: Project, name: str) -> None:
    """Whether a step can be called so; else what to write instead."""
    found = _NAME.fullmatch(name)
    if found is None or len(name) > _LONGEST:
        raise UsageError(
            f"'{name}' is no name of a step; expected two digits and words of small letters, parted by '-', at most "
            f"{_LONGEST} characters, such as 10-fog"
        )
    number, words = found.groups()
    if words in _NO_FILES_ON_WINDOWS:
        raise UsageError(f"'{name}': Windows has no files called {words}; choose another name")
    steps = read_all_steps(project)
    following = f"{steps[-1].index + 1:02d}"
    taken = next((step.id for step in steps if step.number == number), None)
    if taken is not None:
        raise UsageError(f"'{name}': {taken} has this number already; the next one is {following}-{words}")
    if number != following:
        raise UsageError(f"'{name}': steps are counted without gaps; expected {following}-{words}")
    same = next((step.id for step in steps if step.id[3:] == words), None)
    if same is not None:
        raise UsageError(f"'{name}': {same} has this name already; its files would be mixed up with yours")
    for room in (project.steps, project.solutions):
        if (room / name).exists():
            raise UsageError(f"{room / name} is there already, without a step.toml; move it away first")
