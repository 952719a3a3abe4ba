"""Runs the tests once more as a user who is nobody."""

import os
import pwd
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from hostile import as_user
from raysteps.toolchain.kit_artifacts import BuiltKit

KIT_VARIABLE = "RAYSTEPS_TEST_KIT"  # a built kit that this user can read


def _users_of_processes() -> Iterator[int]:
    for path in Path("/proc").iterdir():
        with suppress(OSError):  # it is gone
            if path.name.isdigit():
                yield path.stat().st_uid


def _free_user() -> int:
    """A number that nobody has and nobody uses, beside those that the sandbox lends."""
    used = set(_users_of_processes())
    known = {entry.pw_uid for entry in pwd.getpwall()}
    return next(user for user in range(61200, 61300) if user not in used | known)


@contextmanager
def same_tests_as_ordinary_user(kit: BuiltKit, tests: Path) -> Iterator["subprocess.Popen[str]"]:
    """Starts them with a copy of the kit and a folder of their own for everything."""
    user = _free_user()
    with tempfile.TemporaryDirectory(prefix="hostile-user-", dir=as_user.open_folder()) as name:
        copy = Path(name, kit.folder.name)
        shutil.copytree(kit.folder, copy)
        subprocess.run(["chown", "-R", f"{user}:{user}", name], check=True)
        root = kit.project.root
        command: list[str | Path] = ["unshare", "--mount", "--propagation", "private", sys.executable, as_user.__file__]
        command += [str(user), sys.base_prefix, sys.prefix, root, "--", sys.executable, "-m", "pytest", "-q", tests]
        command += ["-p", "no:cacheprovider", f"--basetemp={name}/pytest"]
        own = {KIT_VARIABLE: str(copy), "HOME": name, "TMPDIR": name, "CCACHE_DIR": f"{name}/ccache"}
        own |= {"PYTHONDONTWRITEBYTECODE": "1"}
        process = subprocess.Popen(
            command,
            cwd=root / "grader",
            env=os.environ | own,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        try:
            yield process
        finally:
            process.kill()
            process.wait()
