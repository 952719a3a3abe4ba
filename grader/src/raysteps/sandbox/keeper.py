"""Starts a command under limits and, when it has ended, ends whatever it left behind. Run as a program of its own,
with the bare interpreter: `python -I -S keeper.py SETTINGS COMMAND...`; it imports nothing of the kit.

SETTINGS is a dictionary in the form of `marshal`, in hexadecimal digits: `status` (a file descriptor for the exit
code), `limits` (resource limits by name), `user` (a number, or None), `fences` (what to close, see lockdown.py, or
None), `folder`, `environment`.

A grade starts it many times, so it imports as little as it can: what reads JSON, or `contextlib`, takes as long to load
as all the rest.
"""

import ctypes
import importlib
import marshal
import os
import resource
import signal
import sys
import time

TYPE_CHECKING = False
if TYPE_CHECKING:  # the module takes long to load
    import typing

Settings = dict[str, "typing.Any"]
_PR_SET_PDEATHSIG = 1
_PR_SET_CHILD_SUBREAPER = 36
_PR_SET_NO_NEW_PRIVS = 38
_CANNOT_START = b"cannot start"

if TYPE_CHECKING:
    from raysteps.sandbox import lockdown as _lockdown
else:
    sys.path.append(os.path.dirname(__file__))  # noqa: PTH120  (pathlib takes long to load)
    _lockdown = importlib.import_module("lockdown")


def _prctl(option: int, value: int) -> None:
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(option, value, 0, 0, 0)


def _limit(limits: dict[str, int]) -> None:
    for name, most in limits.items():
        number = getattr(resource, name)
        _, hard = resource.getrlimit(number)
        if hard != resource.RLIM_INFINITY:
            most = min(most, hard)
        try:
            resource.setrlimit(number, (most, most))
        except (OSError, ValueError):
            continue  # a system that knows the name but not the limit


def _fence(fences: Settings) -> None:
    if fences["files"] is not None:
        _lockdown.restrict_files_by_landlock(fences["files"]["readable"], fences["files"]["writable"])
    if fences["system_calls"] is not None:
        _lockdown.restrict_system_calls_by_seccomp(bytes.fromhex(fences["system_calls"]))


def _become(user: int) -> None:
    os.setgroups([])
    os.setresgid(user, user, user)
    os.setresuid(user, user, user)


def _start(settings: Settings, command: list[str]) -> None:
    """In the child: never returns."""
    try:
        os.set_inheritable(settings["status"], False)
        os.setsid()
        os.chdir(settings["folder"])
        _limit(settings["limits"])
        if settings["user"] is not None:
            _become(settings["user"])
        _prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
        _prctl(_PR_SET_NO_NEW_PRIVS, 1)
        if settings["fences"] is not None:
            _fence(settings["fences"])
        for number in (signal.SIGPIPE, signal.SIGXFSZ, signal.SIGTERM):
            signal.signal(number, signal.SIG_DFL)
        os.execve(command[0], command, settings["environment"])  # noqa: S606  (there is no shell to want)
    except BaseException as error:
        os.write(2, f"{command[0]}: {error}\n".encode())
        os.write(settings["status"], _CANNOT_START)
    finally:
        os._exit(1)


def _kill_user(user: int) -> None:
    """As that user, whom nobody else has, the kernel can be told to end all at once."""
    killer = os.fork()
    if killer == 0:
        try:
            _become(user)
            os.kill(-1, signal.SIGKILL)
        finally:
            os._exit(0)
    os.waitpid(killer, 0)


def _kill_children(group: int) -> None:
    """Orphans come to this process, so at some time everything that is left is its child."""
    try:  # noqa: SIM105
        os.killpg(group, signal.SIGKILL)
    except OSError:
        pass
    try:
        with open("/proc/thread-self/children", "rb") as children:  # noqa: PTH123
            for word in children.read().split():
                os.kill(int(word), signal.SIGKILL)
    except OSError:
        pass


def _clear_up(child: int, user: int | None) -> None:
    while True:
        if user is None:
            _kill_children(child)
        else:
            _kill_user(user)
        try:
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass
        except ChildProcessError:
            return
        time.sleep(0.001)


def main() -> None:
    settings = marshal.loads(bytes.fromhex(sys.argv[1]))  # noqa: S302  (of the grader's own)
    command = sys.argv[2:]
    _prctl(_PR_SET_CHILD_SUBREAPER, 1)
    _prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)
    signal.signal(signal.SIGCHLD, lambda *_: None)  # some systems drop what is ignored before anybody waits for it
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM, signal.SIGCHLD})
    child = os.fork()
    if child == 0:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGTERM, signal.SIGCHLD})
        _start(settings, command)
    for number in (0, 1, 2):
        os.dup2(os.open(os.devnull, os.O_RDWR), number)
    code = -int(signal.SIGKILL)
    ended = False
    while not ended and signal.sigwait({signal.SIGTERM, signal.SIGCHLD}) == signal.SIGCHLD:
        while not ended:
            pid, status = os.waitpid(-1, os.WNOHANG)
            if pid == 0:
                break
            if pid == child:
                code = os.waitstatus_to_exitcode(status)
                ended = True
    _clear_up(child, settings["user"])
    if ended:
        os.write(settings["status"], str(code).encode())


if __name__ == "__main__":
    main()
