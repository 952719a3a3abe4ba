"""What `raysteps` does first."""

import shutil
import sys
from pathlib import Path

from raysteps.setting_up.advice import advice
from raysteps.setting_up.debian import install
from raysteps.setting_up.needs import HIGHWAY, SANDBOX, is_installed, missing
from raysteps.setting_up.room import Room
from raysteps.setting_up.telling import CannotSetUp, say

_USAGE = 2


def _get_what_is_needed() -> None:
    needs = missing()
    if needs and install(needs):
        needs = missing()
    if needs:
        raise CannotSetUp(f"this is missing: {', '.join(need.what for need in needs)}\n{advice(needs)}")


def _get_what_is_useful() -> None:
    if not (sys.platform == "linux" and shutil.which("apt-get")):
        return
    if shutil.which("bwrap") is None and not install([SANDBOX]):
        line = "sudo apt-get install -y bubblewrap"
        say(f"without bubblewrap, other people's work is graded in a weaker sandbox: {line}")
    if not is_installed(HIGHWAY) and not install([HIGHWAY]):
        say("without Highway there is no --accel wide: sudo apt-get install -y libhwy-dev")


def main(root: str, words: list[str]) -> int:
    """Sets up what is missing, once, and runs the command."""
    room = Room(Path(root))
    try:
        if not room.is_ready():
            _get_what_is_needed()
            _get_what_is_useful()
            room.make()
        return room.run(words)
    except CannotSetUp as problem:
        say(str(problem))
        return _USAGE
    except KeyboardInterrupt:
        say("interrupted")
        return 130
