"""The scenes that are measured."""

from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.kit.project import Project
from raysteps.kit.scenes import generated

# At about the sizes of the Standard Procedural Databases.
_DEFAULTS = (("sphereflake", 4), ("tetrahedra", 6), ("rings", 11), ("gears", 4), ("mountain", 6))


def default_scenes(project: Project) -> list[Path]:
    """The kit's own, made when they are needed."""
    return [generated(project, kind, size) for kind, size in _DEFAULTS]


def checked(scenes: list[Path]) -> list[Path]:
    """Scenes that somebody named. Two of one name could not be told apart in a table."""
    for scene in scenes:
        if not scene.is_file():
            raise UsageError(f"{scene}: there is no such scene")
    names = [scene.stem for scene in scenes]
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        raise UsageError(f"{twice[0]}: two scenes have this name; expected different names")
    return scenes
