"""A process that grades: a job per line on stdin, an answer per line on stdout. It ends when stdin does."""

import contextlib
import json
import os
import queue
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import BinaryIO, NoReturn

from raysteps.classroom.desk import Desk
from raysteps.classroom.messages import Job

_LONGEST_END = 10


def _say(text: str) -> None:
    print(f"raysteps: {text}", file=sys.stderr, flush=True)


class _Worker:
    def __init__(self, scratch: Path) -> None:
        self._scratch = scratch
        self._jobs: queue.SimpleQueue[bytes] = queue.SimpleQueue()

    def _listen(self) -> None:
        """Reads even while a job is graded, to learn at once that nobody waits for its answer any more."""
        for line in sys.stdin.buffer:
            self._jobs.put(line)
        words = [sys.executable, "-P", "-m", "raysteps.classroom.ending", str(os.getpid()), str(self._scratch)]
        with contextlib.suppress(OSError):  # it kills this process, and all that came from it
            subprocess.Popen(words, stdin=subprocess.DEVNULL, start_new_session=True)
            time.sleep(_LONGEST_END)
        os._exit(1)

    def _answer_all(self, answers: BinaryIO) -> NoReturn:
        desk = Desk(_say)
        while True:
            answer = desk.grade(Job.from_json(json.loads(self._jobs.get())))
            answers.write(json.dumps(answer.to_json()).encode() + b"\n")
            answers.flush()

    def run(self, answers: BinaryIO) -> None:
        """An answer may be ready just when nobody waits for it any more; then, too, the listener ends it all."""
        listener = threading.Thread(target=self._listen, daemon=True)
        listener.start()
        with contextlib.suppress(BrokenPipeError):
            self._answer_all(answers)
        listener.join()


def main() -> None:
    """Whatever else is printed in this process goes to stderr: stdout is for answers."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with os.fdopen(os.dup(1), "wb") as answers:
        os.dup2(2, 1)
        _Worker(Path(sys.argv[1])).run(answers)


if __name__ == "__main__":
    main()
