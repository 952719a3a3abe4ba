"""Runs a command as an ordinary user who can read what it needs: python as_user.py UID PATH... -- COMMAND...

Started by root in a mount namespace of its own, where folders that only root can enter are replaced by ones in which
the paths are mounted, so that nothing changes for anybody else."""

import os
import stat
import subprocess
import sys
import tempfile
from pathlib import Path


def _closed_folder_above(path: Path) -> Path | None:
    """The highest folder on the way that other users cannot enter."""
    return next((folder for folder in reversed(path.parents) if not folder.stat().st_mode & stat.S_IXOTH), None)


def open_folder() -> Path:
    """One for temporary files that every user can enter."""
    folders = (Path(tempfile.gettempdir()).resolve(), Path("/tmp"), Path("/var/tmp"))
    return next(folder for folder in folders if _closed_folder_above(folder / "x") is None)


def _mount(*words: str | Path) -> None:
    subprocess.run(["mount", *words], check=True)


def open_ways(paths: list[Path]) -> None:
    closed: dict[Path, list[Path]] = {}
    for path in paths:
        folder = _closed_folder_above(path)
        if folder is not None:
            closed.setdefault(folder, []).append(path)
    staging = Path(tempfile.mkdtemp(prefix="as-user-"))
    _mount("-t", "tmpfs", "-o", "mode=755", "staging", staging)
    for folder, inner in closed.items():
        for number, path in enumerate(inner):
            (staging / str(number)).mkdir(exist_ok=True)
            _mount("--bind", path, staging / str(number))
        _mount("-t", "tmpfs", "-o", "mode=755", "opened", folder)
        for number, path in enumerate(inner):
            path.mkdir(parents=True, mode=0o755, exist_ok=True)
            _mount("--move", staging / str(number), path)
    subprocess.run(["umount", staging], check=True)
    staging.rmdir()


def main(words: list[str]) -> None:
    at = words.index("--")
    user = words[0]
    open_ways([Path(word).resolve() for word in words[1:at]])
    change = ["setpriv", f"--reuid={user}", f"--regid={user}", "--clear-groups", "--no-new-privs"]
    os.execvp("setpriv", [*change, "--", *words[at + 1 :]])


if __name__ == "__main__":
    main(sys.argv[1:])
