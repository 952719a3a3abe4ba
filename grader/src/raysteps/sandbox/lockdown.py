"""Takes rights away from the process that calls it, for good: files by Landlock, system calls by seccomp. The keeper
loads it by its path, so it imports nothing of the kit.
"""

import ctypes
import errno
import os
import struct
import sys

_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446
_ASK_VERSION = 1
_PATH_BENEATH = 1
_PR_SET_SECCOMP = 22
_SECCOMP_MODE_FILTER = 2

_EXECUTE, _WRITE_FILE, _READ_FILE, _READ_DIR = 1 << 0, 1 << 1, 1 << 2, 1 << 3
_TRUNCATE = 1 << 14
_ON_FILES = _EXECUTE | _WRITE_FILE | _READ_FILE | _TRUNCATE
_READING = _EXECUTE | _READ_FILE | _READ_DIR
# How many kinds of access to files each version of Landlock knows.
_KINDS = {1: 13, 2: 14, 3: 15, 4: 15}
_KINDS_NOW = 16
_TCP_SINCE, _TCP = 4, 0b11
_SCOPES_SINCE, _SCOPES = 6, 0b11  # abstract sockets, and signals to processes outside


def _call(number: int, *arguments: object) -> int:
    kernel = ctypes.CDLL(None, use_errno=True)
    result = int(kernel.syscall(ctypes.c_long(number), *arguments))
    if result < 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
    return result


def landlock_version() -> int:
    """0 where the kernel has no Landlock, or does not use it."""
    try:
        return _call(_CREATE_RULESET, None, ctypes.c_size_t(0), ctypes.c_uint32(_ASK_VERSION))
    except (OSError, AttributeError):
        return 0


def scopes_signals(version: int) -> bool:
    return version >= _SCOPES_SINCE


def _allow(rules: int, path: str, access: int) -> None:
    try:
        fd = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except FileNotFoundError:
        return
    try:
        if not os.path.isdir(path):  # noqa: PTH112  (pathlib takes long to load)
            access &= _ON_FILES
        rule = struct.pack("=Qi", access, fd)
        _call(_ADD_RULE, ctypes.c_int(rules), ctypes.c_int(_PATH_BENEATH), rule, ctypes.c_uint32(0))
    finally:
        os.close(fd)


def restrict_files_by_landlock(readable: list[str], writable: list[str]) -> None:
    """From now on only these, and what lies in them."""
    version = landlock_version()
    everything = (1 << _KINDS.get(version, _KINDS_NOW)) - 1
    handled = struct.pack(
        "=QQQ", everything, _TCP if version >= _TCP_SINCE else 0, _SCOPES if scopes_signals(version) else 0
    )
    size = 24 if scopes_signals(version) else 16 if version >= _TCP_SINCE else 8
    rules = _call(_CREATE_RULESET, handled, ctypes.c_size_t(size), ctypes.c_uint32(0))
    for path in readable:
        _allow(rules, path, _READING)
    for path in writable:
        _allow(rules, path, everything & ~_EXECUTE)
    _call(_RESTRICT_SELF, ctypes.c_int(rules), ctypes.c_uint32(0))
    os.close(rules)


def restrict_system_calls_by_seccomp(instructions: bytes) -> None:
    """From now on all but those that the filter refuses."""
    buffer = ctypes.create_string_buffer(instructions, len(instructions))
    program = struct.pack("@HP", len(instructions) // 8, ctypes.addressof(buffer))
    kernel = ctypes.CDLL(None, use_errno=True)
    if kernel.prctl(_PR_SET_SECCOMP, _SECCOMP_MODE_FILTER, program, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))


# The system calls that a task has no use for: a filter for the kernel, made without any library.

_LOAD, _EQUAL, _AT_LEAST, _ANY_BIT, _RETURN = 0x20, 0x15, 0x35, 0x45, 0x06
_ALLOW, _KILL, _ERRNO = 0x7FFF0000, 0x80000000, 0x00050000
_NUMBER, _ARCHITECTURE, _FIRST_ARGUMENT, _SECOND_ARGUMENT, _THIRD_ARGUMENT = 0, 4, 16, 24, 32
_X32 = 0x40000000
_NEW_NAMESPACES = 0x7E020000  # CLONE_NEWNS, NEWCGROUP, NEWUTS, NEWIPC, NEWUSER, NEWPID, NEWNET

# Sockets, also two that belong to each other: no network, and nobody who listens under a name. Memory without a file or
# a process: no limit would count it. Locks, watches and times of files that the machine has once for all tasks: by them
# one could tell another something, and the times of a device stay. What makes all wait for the disk. Queues of events
# and of work on files, of which all processes, or all of a user, have so many together. The rest: the kernel's rarely
# used corners and its log, other processes, keys that outlive the task.
_X86_64 = {
    "socket": 41, "socketpair": 53, "syslog": 103, "shmget": 29, "semget": 64, "msgget": 68, "mq_open": 240,
    "memfd_create": 319, "memfd_secret": 447,
    "ptrace": 101, "process_vm_readv": 310, "process_vm_writev": 311, "kcmp": 312, "pidfd_getfd": 438,
    "add_key": 248, "request_key": 249, "keyctl": 250, "bpf": 321, "perf_event_open": 298, "userfaultfd": 323,
    "io_uring_setup": 425, "open_by_handle_at": 304, "unshare": 272, "setns": 308, "mount": 165, "umount2": 166,
    "pivot_root": 155, "open_tree": 428, "move_mount": 429, "fsopen": 430,
    "flock": 73, "inotify_init": 253, "inotify_init1": 294, "fanotify_init": 300, "utime": 132, "utimes": 235,
    "futimesat": 261, "utimensat": 280, "sync": 162, "syncfs": 306, "fsync": 74, "fdatasync": 75, "msync": 26,
    "sync_file_range": 277, "pwritev2": 328, "epoll_create": 213, "epoll_create1": 291, "io_setup": 206,
}  # fmt: skip
_AARCH64 = {
    "socket": 198, "socketpair": 199, "syslog": 116, "shmget": 194, "semget": 190, "msgget": 186, "mq_open": 180,
    "memfd_create": 279, "memfd_secret": 447,
    "ptrace": 117, "process_vm_readv": 270, "process_vm_writev": 271, "kcmp": 272,
    "pidfd_getfd": 438, "add_key": 217, "request_key": 218, "keyctl": 219, "bpf": 280, "perf_event_open": 241,
    "userfaultfd": 282, "io_uring_setup": 425, "open_by_handle_at": 265, "unshare": 97, "setns": 268, "mount": 40,
    "umount2": 39, "pivot_root": 41, "open_tree": 428, "move_mount": 429, "fsopen": 430,
    "flock": 32, "inotify_init1": 26, "fanotify_init": 262, "utimensat": 88, "sync": 81, "syncfs": 267,
    "fsync": 82, "fdatasync": 83, "msync": 227, "sync_file_range": 84, "pwritev2": 287, "epoll_create1": 20,
    "io_setup": 0,
}  # fmt: skip
_CLONE3, _OPENAT2 = 435, 437
# Of fcntl: copies of descriptors and their flags, and a copy that is closed on exec. Other commands lock a file, watch
# it, leave hints on it, or make whoever else opens it wait.
_SET_MODE, _FIRST_ON_FILES, _COPY_CLOSED_ON_EXEC = 4, 5, 1030
# Of ioctl: two ways to set a file's attributes, of which one makes each write wait for the disk.
_SET_ATTRIBUTES, _SET_MORE_ATTRIBUTES = 0x40086602, 0x401C5820
_KNOWN = {"x86_64": (0xC000003E, _X86_64, 56, 302, 72, 16), "aarch64": (0xC00000B7, _AARCH64, 220, 261, 25, 29)}
_OPENING = {"x86_64": ((2, _SECOND_ARGUMENT), (257, _THIRD_ARGUMENT)), "aarch64": ((56, _THIRD_ARGUMENT),)}
# Each write to such a file waits for the disk: O_SYNC and O_DSYNC; and O_DIRECT, which each machine has elsewhere.
_WAITING, _UNBUFFERED = 0x101000, {"x86_64": 0x4000, "aarch64": 0x10000}


def _step(code: int, value: int, if_true: int = 0, if_false: int = 0) -> bytes:
    return struct.pack("=HBBI", code, if_true, if_false, value)


def _by_argument(number: int, argument: int, *steps: bytes) -> list[bytes]:
    """What is asked of an argument of this call alone; for what follows, the call's number is at hand again."""
    then = [_step(_LOAD, argument), *steps, _step(_LOAD, _NUMBER)]
    return [_step(_EQUAL, number, 0, len(then)), *then]


def syscall_filter() -> bytes | None:
    """The instructions; none for a machine whose numbers are not known here."""
    machine = os.uname().machine if sys.platform == "linux" else ""
    if machine not in _KNOWN or sys.maxsize < 1 << 32:
        return None
    architecture, numbers, clone, prlimit, fcntl, ioctl = _KNOWN[machine]
    unbuffered = _UNBUFFERED[machine]
    refuse = _step(_RETURN, _ERRNO | errno.EPERM)
    steps = [_step(_LOAD, _ARCHITECTURE), _step(_EQUAL, architecture, 1, 0), _step(_RETURN, _KILL)]
    steps += [_step(_LOAD, _NUMBER), _step(_AT_LEAST, _X32, 0, 1), refuse]
    for number in numbers.values():
        steps += [_step(_EQUAL, number, 0, 1), refuse]
    # Only a process's own limits, which go by the number 0: a limit can end another process.
    steps += _by_argument(prlimit, _FIRST_ARGUMENT, _step(_EQUAL, 0, 1, 0), refuse)
    on_files = (_step(_AT_LEAST, _FIRST_ON_FILES, 0, 2), _step(_EQUAL, _COPY_CLOSED_ON_EXEC, 1, 0), refuse)
    steps += _by_argument(fcntl, _SECOND_ARGUMENT, *on_files)
    mode = (_step(_ANY_BIT, unbuffered, 0, 3), _step(_LOAD, _SECOND_ARGUMENT), _step(_EQUAL, _SET_MODE, 0, 1), refuse)
    steps += _by_argument(fcntl, _THIRD_ARGUMENT, *mode)
    attributes = (_step(_EQUAL, _SET_ATTRIBUTES, 1, 0), _step(_EQUAL, _SET_MORE_ATTRIBUTES, 0, 1), refuse)
    steps += _by_argument(ioctl, _SECOND_ARGUMENT, *attributes)
    # The C library falls back from clone3, whose flags a filter cannot see, to clone, and from openat2 to openat.
    for number in (_CLONE3, _OPENAT2):
        steps += [_step(_EQUAL, number, 0, 1), _step(_RETURN, _ERRNO | errno.ENOSYS)]
    steps += _by_argument(clone, _FIRST_ARGUMENT, _step(_ANY_BIT, _NEW_NAMESPACES, 0, 1), refuse)
    for number, flags in _OPENING[machine]:
        steps += _by_argument(number, flags, _step(_ANY_BIT, _WAITING | unbuffered, 0, 1), refuse)
    return b"".join([*steps, _step(_RETURN, _ALLOW)])
