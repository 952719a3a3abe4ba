"""Starts a command under limits and, when it has ended, ends whatever it left behind. Run as a program of its own,
with the bare interpreter; it imports nothing of the kit:

- `python -I -S keeper.py SETTINGS COMMAND...`: keeps this command.
- `python -I -S keeper.py --fork-server SOCKET PARENT`: forks a keeper for each command that comes by the socket, as a
  child of the process PARENT.

SETTINGS is a dictionary in the form of `marshal`, in hexadecimal digits: `status` (a file descriptor for the exit
code), `limits` (resource limits by name), `user` (a number, or None), `fences` (what to close, see lockdown.py, or
None), `folder`, `environment`.

A grade needs hundreds of keepers. To start Python takes ten times as long as to fork it, and what reads JSON, or
`contextlib`, takes as long to load as all the rest.
"""

import _socket  # what `socket` adds takes long to load
import ctypes
import fcntl
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
        for number in (signal.SIGINT, signal.SIGPIPE, signal.SIGXFSZ, signal.SIGTERM):
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


def keep(settings: Settings, command: list[str]) -> None:
    """Runs the command until it ends, or whoever wants it does, and ends what it left behind."""
    _prctl(_PR_SET_CHILD_SUBREAPER, 1)
    _prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the grader, which ends this
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


# The fork server, on Linux.

_NUMBER_BYTES = 8
_MAX_FILES = 253  # that can come along, as the system has it


def _place(files: dict[int, int]) -> None:
    """Opens each file under the number that the command knows it by, and closes it under its own."""
    above = max([*files, *files.values()]) + 1
    moved = {number: fcntl.fcntl(file, fcntl.F_DUPFD, above) for number, file in files.items()}
    for file in files.values():
        os.close(file)
    for number, file in moved.items():
        os.dup2(file, number)
        os.close(file)


def _become_a_keeper(grader: int, wanted: bytes, files: list[int]) -> None:
    """Forks, and lets the parent end, so that the child becomes the grader's, which adopts orphans (monitor.py). The
    child writes its number to the first of the files and keeps the command. Returns in a process that is to end."""
    parent = os.getpid()
    if os.fork() > 0:
        return
    while os.getppid() == parent:
        os.sched_yield()
    _prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)
    if os.getppid() != grader:
        return
    os.write(files[0], os.getpid().to_bytes(_NUMBER_BYTES, "little"))
    os.close(files[0])
    settings, command, numbers = marshal.loads(wanted)  # noqa: S302  (of the grader's own)
    _place(dict(zip(numbers, files[1:], strict=True)))
    try:
        keep(settings, command)
    except BaseException as error:
        os.write(2, f"{type(error).__name__}: {error}\n".encode())


def _receive(asked: "_socket.socket", size: int) -> bytes:
    """So many bytes, or fewer where there is an end."""
    data = b""
    while len(data) < size and (part := asked.recv(size - len(data))):
        data += part
    return data


def fork_server(asked: "_socket.socket", grader: int) -> None:
    """Forks a keeper for each command that comes, until the other end is closed. A command comes with a file to answer
    by and with those that it is to have open."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    while True:
        head, extra, _, _ = asked.recvmsg(_NUMBER_BYTES, _socket.CMSG_SPACE(4 * _MAX_FILES))
        head += _receive(asked, _NUMBER_BYTES - len(head)) if head else b""
        size = int.from_bytes(head, "little")
        wanted = _receive(asked, size)
        if len(head) < _NUMBER_BYTES or len(wanted) < size:
            return
        files = memoryview(b"".join(data for _, _, data in extra)).cast("i").tolist()
        middle = os.fork()
        if middle == 0:
            try:
                asked.close()
                _become_a_keeper(grader, wanted, files)
            finally:
                os._exit(0)
        for file in files:
            os.close(file)
        os.waitpid(middle, 0)


def main() -> None:
    if sys.argv[1] == "--fork-server":
        fork_server(_socket.socket(fileno=int(sys.argv[2])), int(sys.argv[3]))
    else:
        keep(marshal.loads(bytes.fromhex(sys.argv[1])), sys.argv[2:])  # noqa: S302  (of the grader's own)


if __name__ == "__main__":
    main()
