"""Commands that a report gives its reader to copy."""

from collections.abc import Mapping
from typing import Any

from raysteps.common.systems import own_command, typed
from raysteps.kit.manifest import Step


def check_command(step_id: str) -> str:
    """Checks one's own step."""
    return f"{own_command()} check {step_id[:2]}"


def replay_command(case: str) -> str:
    """Asks a case again; its file lies beside the report."""
    return f"{own_command()} replay {typed([case])}"


def inspect_command(image: Mapping[str, Any], step: Step | None) -> str | None:
    """Looks into a pixel of a picture, `{x}` and `{y}`; none where the kit does not know how the picture was made."""
    case = next((case for case in step.images if case.name == image["name"]), None) if step is not None else None
    if case is None or "{" in case.scene:
        return None
    return f"{own_command()} inspect {typed([case.scene])} {{x}} {{y}} {typed([*case.args, '--against', 'reference'])}"
