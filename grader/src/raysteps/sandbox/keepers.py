"""Starts keepers (keeper.py): on Linux by a fork server, elsewhere each as a program of its own."""

import array
import atexit
import marshal
import os
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Sequence
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import IO, Any, Self

from raysteps.sandbox.beside import readable
from raysteps.sandbox.task import StartedProcess

_KEEPER = [sys.executable, "-I", "-S", str(Path(__file__).with_name("keeper.py"))]
_NUMBER_BYTES = 8  # as keeper.py has it, which is no part of the package
_PATIENCE = 20.0  # seconds, for a server that answers in thousandths of one
_MAX_FAILURES = 3


class _Forked:
    """A keeper that a server forked: a child of this process all the same."""

    def __init__(self, pid: int, stdout: IO[bytes] | None, stderr: IO[bytes] | None) -> None:
        self.pid = pid
        self.stdout = stdout
        self.stderr = stderr
        self.returncode: int | Any = None

    def _send(self, number: int) -> None:
        if self.returncode is None:
            with suppress(ProcessLookupError):
                os.kill(self.pid, number)

    def terminate(self) -> None:
        self._send(signal.SIGTERM)

    def kill(self) -> None:
        self._send(signal.SIGKILL)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        for pipe in (self.stdout, self.stderr):
            if pipe is not None:
                pipe.close()
        if self.returncode is None:
            self.kill()
            with suppress(ChildProcessError):
                _, status = os.waitpid(self.pid, 0)
                self.returncode = os.waitstatus_to_exitcode(status)


class _ForkServer:
    """A process that has loaded Python and forks keepers."""

    def __init__(self) -> None:
        self._socket, theirs = socket.socketpair()
        self._socket.settimeout(_PATIENCE)
        try:
            self.process = subprocess.Popen(
                [*_KEEPER, "--fork-server", str(theirs.fileno()), str(os.getpid())],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                pass_fds=(theirs.fileno(),),
                cwd="/",
            )
        except BaseException:
            self._socket.close()
            raise
        finally:
            theirs.close()

    def ask(self, wanted: bytes, files: Sequence[int]) -> None:
        """For a keeper that has these files. Raises OSError where nobody listens."""
        rights = (socket.SOL_SOCKET, socket.SCM_RIGHTS, array.array("i", files))
        self._socket.sendmsg([len(wanted).to_bytes(_NUMBER_BYTES, "little")], [rights])
        self._socket.sendall(wanted)

    def end(self) -> None:
        """Kills the process, not the keepers that it forked."""
        self._socket.close()
        self.process.kill()
        self.process.wait()

    def leave_to_parent(self) -> None:
        """Where this process was forked from the one that started the server."""
        self._socket.close()
        self.process.returncode = 0


class _Servers:
    """The server of this process, started when a keeper is wanted; a new one where it failed. Safe for threads."""

    def __init__(self) -> None:
        self._turn = threading.Lock()
        self._server: _ForkServer | None = None
        self._failures = 0

    def fork(self, settings: dict[str, Any], command: list[str], files: dict[int, int]) -> int | None:
        """The number of a keeper's process, which has each of the files open under the number that is its key. None
        where no server forks one: then no command runs, either."""
        if self._failures >= _MAX_FAILURES:
            return None
        wanted = marshal.dumps((settings, command, list(files)))
        answer, theirs = os.pipe()
        try:
            try:
                server = self._ask(wanted, [theirs, *files.values()])
            finally:
                os.close(theirs)
            said = os.read(answer, _NUMBER_BYTES) if server is not None and readable(answer, _PATIENCE) else b""
        finally:
            os.close(answer)
        if len(said) == _NUMBER_BYTES:
            return int.from_bytes(said, "little")
        self._forget(server)
        return None

    def _ask(self, wanted: bytes, files: Sequence[int]) -> _ForkServer | None:
        with self._turn:
            try:
                self._server = self._server or _ForkServer()
                self._server.ask(wanted, files)
            except OSError:
                self._end()
                return None
            return self._server

    def _end(self) -> None:
        if self._server is not None:
            self._server.end()
        self._server = None

    def _forget(self, server: _ForkServer | None) -> None:
        """Only this one: by now another thread may have started the next."""
        with self._turn:
            self._failures += 1
            if server is not None and self._server is server:
                self._end()

    def end(self) -> None:
        with self._turn:
            self._end()

    def start_anew(self) -> None:
        """After a fork, in the child, whatever other threads did."""
        self._turn = threading.Lock()
        if self._server is not None:
            self._server.leave_to_parent()
        self._server = None


_servers = _Servers()
atexit.register(_servers.end)
if sys.platform == "linux":
    os.register_at_fork(after_in_child=_servers.start_anew)


def _fork(
    settings: dict[str, Any],
    command: list[str],
    stdin: int,
    outputs: tuple[int | None, int | None],
    files: Sequence[int],
) -> _Forked | None:
    with ExitStack() as theirs, ExitStack() as mine:

        def pipe() -> tuple[IO[bytes], int]:
            ends = os.pipe()
            theirs.callback(os.close, ends[1])
            return mine.enter_context(os.fdopen(ends[0], "rb", 0)), ends[1]

        (out, to_out), (errors, to_errors) = (pipe() if file is None else (None, file) for file in outputs)
        named = {0: stdin, 1: to_out, 2: to_errors} | {file: file for file in files}
        pid = _servers.fork(settings, command, named)
        if pid is None:
            return None
        mine.pop_all()
        return _Forked(pid, out, errors)


def start_keeper(
    settings: dict[str, Any],
    command: list[str],
    *,
    stdin: int,
    stdout: int | None,
    stderr: int | None = None,
    files: Sequence[int],
) -> StartedProcess:
    """Starts a keeper of the command, for which these files stay open under their numbers. What it says comes by pipes,
    unless a file is given for it. Whoever calls this adopts orphans on Linux."""
    forked = _fork(settings, command, stdin, (stdout, stderr), files) if sys.platform == "linux" else None
    return forked or subprocess.Popen(
        [*_KEEPER, marshal.dumps(settings).hex(), *command],
        stdin=stdin,
        stdout=subprocess.PIPE if stdout is None else stdout,
        stderr=subprocess.PIPE if stderr is None else stderr,
        pass_fds=files,
        cwd="/",
    )
