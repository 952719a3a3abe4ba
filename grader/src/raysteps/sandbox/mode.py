"""The two ways in which bubblewrap can work: as an ordinary user, or as root where user namespaces are refused."""

import shutil
from pathlib import Path
from typing import Protocol

from raysteps.common.errors import GraderFault
from raysteps.sandbox.rlimits import processes_word
from raysteps.sandbox.task import Limits

_OWN_PROCESSES = 2  # bubblewrap itself, and the first process inside, which waits for the others
_SETUP = "/setup"
_BINDS = ("--ro-bind", "--ro-bind-try", "--bind")


def tool(name: str) -> str:
    path = shutil.which(name)
    if path is None:
        raise GraderFault(f"The program {name} was not found; it is part of util-linux.")
    return path


class Mode(Protocol):
    """How bubblewrap is told to make namespaces and to change the user."""

    @property
    def starts_as_user(self) -> bool:
        """Whether bubblewrap itself runs as the user that was lent for the task."""

    def namespaces(self, options: frozenset[str]) -> list[str]: ...

    def around_tmp(self) -> list[str]:
        """Words before the one that mounts /tmp."""

    def folders(self, mounts: list[str]) -> list[str]:
        """Words before those that mount, for the folders that the mounts are in."""

    def limits(self, limits: Limits, user: int | None) -> list[str]:
        """Further words for prlimit."""

    def before_command(self, limits: Limits, user: int | None) -> tuple[list[str], list[str]]:
        """Mounts, and words that go before the command, inside."""


class AsUser:
    """In a user namespace, where the task can be root over nothing."""

    starts_as_user = True

    def namespaces(self, options: frozenset[str]) -> list[str]:
        return ["--unshare-all", "--unshare-user", *sorted(options & {"--disable-userns"})]

    def around_tmp(self) -> list[str]:
        return []

    def folders(self, mounts: list[str]) -> list[str]:
        return []

    def limits(self, limits: Limits, user: int | None) -> list[str]:
        return [] if user is None else [processes_word(limits.processes + _OWN_PROCESSES)]

    def before_command(self, limits: Limits, user: int | None) -> tuple[list[str], list[str]]:
        return [], []


class AsRoot:
    """As some systems allow namespaces to root only: root makes them, and becomes the user that was lent just before
    the command starts."""

    starts_as_user = False

    def namespaces(self, options: frozenset[str]) -> list[str]:
        words = ["--unshare-ipc", "--unshare-pid", "--unshare-net", "--unshare-uts", "--unshare-cgroup-try"]
        return [*words, "--cap-drop", "ALL", "--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID"]

    def around_tmp(self) -> list[str]:
        return ["--perms", "1777"]

    def folders(self, mounts: list[str]) -> list[str]:
        """bubblewrap would make them for root alone."""
        places = [Path(mounts[at + 2]) for at, word in enumerate(mounts) if word in _BINDS]
        above = {folder for place in places for folder in place.parents if folder.name}
        return [word for folder in sorted(above) for word in ("--perms", "0755", "--dir", str(folder))]

    def limits(self, limits: Limits, user: int | None) -> list[str]:
        return []

    def before_command(self, limits: Limits, user: int | None) -> tuple[list[str], list[str]]:
        mounts: list[str] = []
        for name in ("prlimit", "setpriv"):
            mounts += ["--ro-bind", str(Path(tool(name)).resolve()), f"{_SETUP}/{name}"]
        limit = [f"{_SETUP}/prlimit", processes_word(limits.processes)]
        become = [f"{_SETUP}/setpriv", f"--reuid={user}", f"--regid={user}", "--clear-groups", "--no-new-privs", "--"]
        return mounts, [*limit, *become]
