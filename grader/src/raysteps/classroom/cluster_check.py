"""Whether the workers of a cluster have the kit that a class is graded with."""

from typing import Any

from raysteps.classroom.cluster_task import kit_of
from raysteps.common.errors import GraderFault

_LOOK_SECONDS = 2


def check_kits(client: Any, kit: str, grader: str, *, require_sandbox: bool) -> None:
    """Another kit would give other grades: better to learn that before anything is graded."""
    import distributed

    asked = {
        worker: client.submit(kit_of, grader, require_sandbox, workers=[worker], allow_other_workers=False, pure=False)
        for worker in client.nthreads()
    }
    problems = []
    while asked:
        for worker, future in list(asked.items()):
            try:
                found = future.result(timeout=_LOOK_SECONDS)
            except (TimeoutError, distributed.TimeoutError):
                if worker in client.nthreads():
                    continue
                found = kit  # it is gone, and checks nothing any more
            except Exception as error:
                found = f"cannot grade: {error}"
            del asked[worker]
            if found != kit:
                problems.append(f"{worker}: {found}")
    if problems:
        lines = "\n  ".join(problems)
        raise GraderFault(
            f"these workers do not have the kit of this machine ({kit}):\n  {lines}\n"
            "Install the same version of the kit, and the same compiler, on every machine."
        )
