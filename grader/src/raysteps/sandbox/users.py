"""Lends every running task a user of its own, so that limits that count by user count one task only."""

import os
import pwd
import secrets
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from raysteps.common.errors import GraderFault

# Below 65536, so that containers have them too, and in a range that neither Debian nor systemd gives to anybody.
_FIRST = 60600
_COUNT = 512


def _is_mapped(uid: int, table: str) -> bool:
    for line in Path(table).read_text(encoding="ascii").splitlines():
        first, _, count = (int(word) for word in line.split())
        if first <= uid < first + count:
            return True
    return False


_CHOWN, _READ_ALL = 0b001, 0b110  # the rights CAP_CHOWN, and CAP_DAC_OVERRIDE or CAP_DAC_READ_SEARCH


def has_rights_of_root(status: str) -> bool:
    """Whether a process may give a folder to another user and read what that user makes there: root may not in each
    container. `status`: as /proc/self/status tells."""
    words = next((line.split() for line in status.splitlines() if line.startswith("CapEff:")), ["", "0"])
    rights = int(words[1], 16)
    return bool(rights & _CHOWN and rights & _READ_ALL)


def can_lend_users() -> bool:
    """Whether this process may become those users at all, and have them work for it."""
    if os.geteuid() != 0:
        return False
    try:
        return has_rights_of_root(Path("/proc/self/status").read_text(encoding="utf-8")) and all(
            _is_mapped(_FIRST, table) and _is_mapped(_FIRST + _COUNT - 1, table)
            for table in ("/proc/self/uid_map", "/proc/self/gid_map")
        )
    except (OSError, ValueError):
        return False


def _is_somebody(uid: int) -> bool:
    try:
        pwd.getpwuid(uid)
    except KeyError:
        return False
    return True


@contextmanager
def lent_user() -> Iterator[int]:
    """A user that no other task of any grader on this machine has. The lock is a name without a file (an abstract
    socket): the kernel gives it back when the grader dies, and nothing is left on the disk."""
    start = secrets.randbelow(_COUNT)
    for offset in range(_COUNT):
        uid = _FIRST + (start + offset) % _COUNT
        if _is_somebody(uid):
            continue
        with socket.socket(socket.AF_UNIX) as lock:
            try:
                lock.bind(f"\0raysteps-sandbox-user-{uid}")
            except OSError:
                continue
            yield uid
            return
    raise GraderFault(f"All {_COUNT} users for sandboxes are taken; are that many graders running?")
