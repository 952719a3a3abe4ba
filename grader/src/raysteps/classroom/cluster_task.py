"""What runs in a worker of a cluster. Each job is graded by a process of its own: a grader that crashes takes no
worker with it, and a worker that is lost takes its process with it."""

import threading
from typing import Any

from raysteps.classroom.graders import make_grader
from raysteps.classroom.messages import Answer, Job
from raysteps.classroom.slot import Slot

_lock = threading.Lock()
_free: list[Slot] = []
_busy: dict[Slot, str] = {}


def kit_of(grader: str, require_sandbox: bool) -> str:
    """The fingerprint of this machine's kit, which is built where it is not."""
    return make_grader(grader, require_sandbox=require_sandbox, say=print).fingerprint


def run_job(document: dict[str, Any]) -> dict[str, Any]:
    """Grades a job."""
    job = Job.from_json(document)
    with _lock:
        slot = _free.pop() if _free else Slot()
        _busy[slot] = job.run
    keep = False
    try:
        answer: Answer = slot.grade(job)
        keep = True
        return answer.to_json()
    finally:
        # In one step: a slot that is free and still counts as busy would be stopped for a run that it has left.
        with _lock:
            del _busy[slot]
            keep = keep and not slot.stopped
            if keep:
                _free.append(slot)
        if not keep:
            slot.close()


def stop_run(run: str) -> None:
    """Ends the jobs of a run, and processes that have nothing to do."""
    with _lock:
        idle = list(_free)
        _free.clear()
        for slot in [slot for slot, whose in _busy.items() if whose == run]:
            slot.stop()
    for slot in idle:
        slot.close()
