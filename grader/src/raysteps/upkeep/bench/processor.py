"""Processor time of programs that were started and waited for."""

import sys

from raysteps.common.errors import UsageError

if sys.platform != "win32":
    import resource


def children_seconds() -> float:
    if sys.platform == "win32":
        raise UsageError("this measurement needs Linux or macOS: Windows does not tell what ended programs used")
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
