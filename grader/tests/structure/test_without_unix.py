"""The package on a system that is not Unix: what Windows lacks is taken away before it is imported."""

import subprocess
import sys
from pathlib import Path

import pytest

SOURCES = Path(__file__).parents[2] / "src"
# Everything from elsewhere is imported first: it has ways of its own for each system.
PRELUDE = """
import asyncio, concurrent.futures, ctypes, importlib, json, logging, multiprocessing, os, pathlib, selectors, shutil
import signal, socket, sqlite3, subprocess, sys, tempfile, types, typing, zipfile, tarfile, getpass, xml.sax
import numpy, PIL.Image, PIL.PngImagePlugin, rich.console, rich.table, rich.live, rich.progress, jsonschema
import defusedxml.ElementTree, jinja2, watchfiles
sys.path.insert(0, SOURCES)
console = types.ModuleType("msvcrt")
console.LK_NBLCK = 2
held = set()
def locking(handle, mode, size):
    place = os.fstat(handle).st_ino
    if place in held:
        raise PermissionError(13, "locked")
    held.add(place)
console.locking = locking
sys.modules["msvcrt"] = console
for name in ("fcntl", "grp", "pty", "pwd", "resource", "spwd", "syslog", "termios", "tty"):
    sys.modules[name] = None
UNIX = '''fork forkpty getegid geteuid getgid getuid killpg mkfifo pidfd_open setsid sysconf uname wait4 waitid chown
memfd_create pread sched_getaffinity sched_setaffinity O_NOFOLLOW O_NONBLOCK O_CLOEXEC O_DIRECTORY O_NOCTTY O_PATH'''
for name in UNIX.split():
    if hasattr(os, name):
        delattr(os, name)
os.O_BINARY = 0
os.supports_dir_fd.clear()
for name in ("SIGKILL", "SIGSTOP", "SIGCHLD", "SIGPIPE", "SIGXFSZ", "pthread_sigmask", "sigwait"):
    delattr(signal, name)
import ctypes.wintypes, unittest.mock
ctypes.WinDLL = unittest.mock.MagicMock()
sys.platform = "win32"
"""


def as_on_windows(program: str) -> str:
    """What it prints."""
    words = [sys.executable, "-c", PRELUDE.replace("SOURCES", repr(str(SOURCES))) + program]
    done = subprocess.run(words, capture_output=True, check=False, text=True, encoding="utf-8", timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.strip()


def test_every_command_is_there() -> None:
    assert "check" in as_on_windows("from raysteps.cli.app import main\ntry: main(['--help'])\nexcept SystemExit: pass")


@pytest.mark.parametrize("words", [["grade-class", "x", "--out", "y"], ["bench", "grading"]])
def test_what_needs_unix_says_so(words: list[str]) -> None:
    said = as_on_windows(f"from raysteps.cli.app import main\nsys.stderr = sys.stdout\nprint(main({words}))")
    assert "WSL" in said
    assert said.endswith("2")


def test_a_folder_is_taken_in_and_links_are_not(tmp_path: Path) -> None:
    step, elsewhere = tmp_path / "mine" / "steps" / "01-camera-rays", tmp_path / "02-intersection"
    step.mkdir(parents=True)
    elsewhere.mkdir()
    (step / "camera_rays.cpp").write_bytes(b"int a;\r\nint b;\r\n")
    step.with_name("02-intersection").symlink_to(elsewhere)
    step.with_name("03-phong-shading").symlink_to(step)
    found = as_on_windows(f"""
from raysteps.course.manifest import read_steps
from raysteps.course.project import here
from raysteps.submission.load import load_submission
taken = load_submission(pathlib.Path({str(tmp_path / "mine")!r}), read_steps(here()))
print(taken.sources, taken.notes)
""")
    sources = {"01-camera-rays": b"int a;\nint b;\n"}
    notes = {"02-intersection": "The folder steps/02-intersection is a link and was not followed."}
    assert found == f"{sources} {notes}"


def test_a_lock_is_held_by_one(tmp_path: Path) -> None:
    told = as_on_windows(f"""
from raysteps.common.files import file_lock, try_lock
with file_lock(pathlib.Path({str(tmp_path / "lock")!r})), open({str(tmp_path / "lock")!r}, "a") as file:
    print(try_lock(file.fileno()))
""")
    assert told == "False"


def test_programs_have_their_ending_and_commands_their_python() -> None:
    told = as_on_windows("""
from raysteps.common.platform import executable, own_command, quote_command
from raysteps.toolchain.cmake import release_tree
from raysteps.course.project import here
print(release_tree(here()).program("raytrace-mine").name, own_command(), quote_command(["replay", "a b.json"]))
""")
    assert told == 'raytrace-mine.exe python raysteps replay "a b.json"'
