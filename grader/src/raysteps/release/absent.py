"""Stand-ins for steps that a kit does not have: the framework calls their functions."""

from raysteps.kit.manifest import Step
from raysteps.kit.project import Project
from raysteps.kit.stubs import pristine_stub

FOLDER = "framework/absent/steps"


def stand_in(stub: str) -> str:
    """A stub that says what it is no part of, and not what is to do."""
    lines = [line for line in stub.splitlines() if not line.strip().startswith("// TODO:")]
    return "\n".join(lines).replace("RAYSTEPS_TODO(", "RAYSTEPS_ABSENT(") + "\n"


def absent_files(project: Project, absent: list[Step]) -> dict[str, bytes]:
    """Contract and stand-in of each, by path."""
    files: dict[str, bytes] = {}
    for step in absent:
        for header in sorted((project.steps / step.id).glob("*.hpp")):
            files[f"{FOLDER}/{step.id}/{header.name}"] = header.read_bytes()
        files[f"{FOLDER}/{step.path.as_posix()}"] = stand_in(pristine_stub(project, step)).encode()
    return files
