"""The two ways in which bubblewrap can work: as an ordinary user, or as root where user namespaces are refused."""

import shutil
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Protocol

from raysteps.common.errors import GraderFault
from raysteps.sandbox.rlimits import processes_word
from raysteps.sandbox.task import Limits

_OWN_PROCESSES = 2  # bubblewrap itself, and the first process inside, which waits for the others
_SETUP = "/setup"
_BINDS = ("--ro-bind", "--ro-bind-try", "--bind")


@cache
def tool(name: str) -> str:
    path = shutil.which(name)
    if path is None:
        raise GraderFault(f"The program {name} was not found; it is part of util-linux.")
    return path


def _become(user: int | None) -> list[str]:
    """Words for setpriv."""
    return [f"--reuid={user}", f"--regid={user}", "--clear-groups", "--"]


class NamespaceMode(Protocol):
    """How bubblewrap is told to make namespaces and to change the user."""

    @property
    def starts_as_user(self) -> bool:
        """Whether bubblewrap itself runs as the user that was lent for the task."""

    def namespaces(self, options: frozenset[str]) -> list[str]: ...

    def around_tmp(self) -> list[str]:
        """Words before the one that mounts /tmp."""

    def folders(self, mounts: list[str]) -> list[str]:
        """Words before those that mount, for the folders that the mounts are in."""

    def before_start(self, limits: Limits, user: int | None) -> list[str]:
        """Words behind those of prlimit, before bubblewrap."""

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

    def before_start(self, limits: Limits, user: int | None) -> list[str]:
        if user is None:
            return []
        # By a program: Python becomes another user in a copy of its own process only, which takes longer.
        return [processes_word(limits.processes + _OWN_PROCESSES), tool("setpriv"), *_become(user)]

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

    def before_start(self, limits: Limits, user: int | None) -> list[str]:
        return []

    def before_command(self, limits: Limits, user: int | None) -> tuple[list[str], list[str]]:
        mounts: list[str] = []
        for name in ("prlimit", "setpriv"):
            mounts += ["--ro-bind", str(Path(tool(name)).resolve()), f"{_SETUP}/{name}"]
        limit = [f"{_SETUP}/prlimit", processes_word(limits.processes)]
        return mounts, [*limit, f"{_SETUP}/setpriv", "--no-new-privs", *_become(user)]


# The little of the host's file system that a task sees.

_SYSTEM = Path("/usr")
_LIBRARIES = ("lib", "lib32", "lib64", "libx32")
_TOOLS = ("bin", "include", "libexec")
_TEST_FRAMEWORKS = ("catch2",)  # a student's source has no business with them
_LOCAL = Path("/usr/local")
_FIRST_PROCESS = "/proc/1"


def compiler_command(name: str) -> Path:
    """The full path of a program, past links by way of /etc, which a task does not see. The last link stays: some
    compilers look at the name that they were called by."""
    found = shutil.which(name)
    if found is None:
        return Path(name)
    path = Path(found)
    while path.is_symlink():
        target = path.parent / path.readlink()
        if not (path.is_relative_to("/etc") or target.is_relative_to("/etc")):
            break
        path = target
    return path


def _own_prefix(compiler: Path) -> Path | None:
    """Where a compiler lives that is not the system's."""
    prefix = compiler.resolve().parent.parent
    return None if prefix in (_SYSTEM, Path("/")) or prefix.is_relative_to(_SYSTEM / "lib") else prefix


def _folders(prefix: Path, names: tuple[str, ...]) -> list[Path]:
    return [prefix / name for name in names if (prefix / name).is_dir() and not (prefix / name).is_symlink()]


def visible_folders(compiler: Path | None) -> list[Path]:
    """Libraries, and for tools also programs and headers."""
    seen = _folders(_SYSTEM, _LIBRARIES + (_TOOLS if compiler is not None else ()))
    prefix = None if compiler is None else _own_prefix(compiler)
    if prefix is not None:
        seen += _folders(prefix, _LIBRARIES + _TOOLS)
        seen += [folder for folder in prefix.glob("*-*-*") if (folder / "bin").is_dir()]
    # A compiler that was installed by hand brings the C++ library that its programs need.
    seen += [folder for folder in _folders(_LOCAL, ("lib", "lib64")) if (folder / "libstdc++.so.6").exists()]
    return list(dict.fromkeys(seen))


def top_folders(compiler: Path | None) -> list[Path]:
    """The folders of the same kind at the top, where they are not links into /usr."""
    return _folders(Path("/"), _LIBRARIES + (() if compiler is None else ("bin",)))


def hidden_folders(seen: list[Path], secrets: Sequence[Path]) -> list[Path]:
    """What lies in the visible folders and is not meant to be seen."""
    frameworks = [folder / name for folder in seen if folder.name == "include" for name in _TEST_FRAMEWORKS]
    inside = [secret.resolve() for secret in secrets if any(secret.resolve().is_relative_to(place) for place in seen)]
    return [path for path in (*frameworks, *inside) if path.is_dir()]


@cache  # a grade has a hundred tasks
def root_words(compiler: Path | None, secrets: tuple[Path, ...]) -> tuple[str, ...]:
    """The words for bubblewrap that make this root."""
    words: list[str] = []
    seen = [*visible_folders(compiler), *top_folders(compiler)]
    for folder in seen:
        words += ["--ro-bind", str(folder), str(folder)]
    for name in (*_LIBRARIES, "bin"):
        top = Path("/", name)
        if top.is_symlink():
            words += ["--symlink", str(top.readlink()), str(top)]
    for hidden in hidden_folders(seen, secrets):
        words += ["--tmpfs", str(hidden), "--remount-ro", str(hidden)]
    words += ["--ro-bind-try", "/etc/ld.so.cache", "/etc/ld.so.cache"]
    # The first process is bubblewrap's and may be of the task's user, who could write to its memory there.
    words += ["--proc", "/proc", "--tmpfs", _FIRST_PROCESS, "--remount-ro", _FIRST_PROCESS]
    words += ["--remount-ro", "/proc"]  # what the grader has set of a process stays so
    return (*words, "--dev", "/dev", "--remount-ro", "/dev")
