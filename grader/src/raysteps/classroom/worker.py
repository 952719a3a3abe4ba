"""A process that grades: a job per line on stdin, an answer per line on stdout. It ends when stdin does."""

import contextlib
import os
import platform
import queue
import signal
import subprocess
import sys
import tempfile
import threading
import time
import traceback
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO, NoReturn

from raysteps.classroom.jobs import SAME_KIT, Grader, Job, JobResult, from_line, make_grader, to_line
from raysteps.common.errors import GraderFault, RaystepsError
from raysteps.results.model import Results
from raysteps.results.store import RESULTS, read_results
from raysteps.toolchain.kit_artifacts import ProgressCallback

# Grades jobs in this process, one after another, with a grader that is made once.

_MAX_DETAILS = 8000


def this_worker() -> str:
    """What this process is called in the database."""
    return f"{platform.node()}:{os.getpid()}"


def _named_files(results: Results) -> Iterator[str]:
    for step in results.steps:
        yield from (item.case for item in step.hidden if item.case)
        for image in step.images:
            yield from filter(None, (image.mine, image.reference, image.difference))


def _read_answer(job: Job, out: Path, seconds: float) -> JobResult:
    """Only pictures and cases that the results name: what they withhold stays here."""
    results = read_results(out / RESULTS)
    if results.submission != job.submission.name:
        raise GraderFault(f"these are the results of {results.submission}")
    pictures = {path: (out / path).read_bytes() for path in sorted(set(_named_files(results)))}
    return JobResult(job.submission.name, "graded", results, pictures, seconds=seconds, worker=this_worker())


class JobRunner:
    """One grader, made for the first job and kept while jobs ask for the same one."""

    def __init__(self, say: ProgressCallback) -> None:
        self._say = say
        self._made: tuple[str, bool] | None = None
        self._grader: Grader | None = None

    def _grader_for(self, job: Job) -> Grader:
        wanted = (job.grader, job.require_sandbox)
        if self._grader is None or self._made != wanted:
            self._grader = make_grader(job.grader, require_sandbox=job.require_sandbox, say=self._say)
            self._made = wanted
        if self._grader.fingerprint != job.kit:
            raise GraderFault(
                f"the kit on {platform.node()} is {self._grader.fingerprint}, but the class is graded with {job.kit}; "
                f"{SAME_KIT}"
            )
        return self._grader

    def grade(self, job: Job) -> JobResult:
        """Whatever goes wrong becomes a fault of this submission."""
        start = time.monotonic()
        try:
            grader = self._grader_for(job)
            with tempfile.TemporaryDirectory(prefix="raysteps-class-", ignore_cleanup_errors=True) as folder:
                grader.grade(job.submission, job.settings, Path(folder), self._say)
                return _read_answer(job, Path(folder), time.monotonic() - start)
        except Exception as error:
            text = str(error) if isinstance(error, RaystepsError) else f"{type(error).__name__}: {error}"
            return JobResult(
                job.submission.name,
                "fault",
                fault=text or type(error).__name__,
                details=traceback.format_exc()[-_MAX_DETAILS:],
                seconds=time.monotonic() - start,
                worker=this_worker(),
            )


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
        words = [sys.executable, "-P", "-m", "raysteps.classroom.process_tree", str(os.getpid()), str(self._scratch)]
        with contextlib.suppress(OSError):  # it kills this process, and all that came from it
            subprocess.Popen(words, stdin=subprocess.DEVNULL, start_new_session=True)
            time.sleep(_LONGEST_END)
        os._exit(1)

    def _answer_all(self, answers: BinaryIO) -> NoReturn:
        runner = JobRunner(_say)
        while True:
            answer = runner.grade(from_line(self._jobs.get(), Job))
            answers.write(to_line(answer))
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
