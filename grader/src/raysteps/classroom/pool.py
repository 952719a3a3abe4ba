"""Grades on this machine, several submissions at a time."""

import queue
import threading
from collections.abc import Iterator

from raysteps.classroom.messages import Answer, Job
from raysteps.classroom.slot import Slot, Stopped

_END_SECONDS = 10


class LocalPool:
    """Each thread has one process grade. Processes of one's own, and not those of concurrent.futures: when one dies
    it is clear which submission it was grading, and the others go on."""

    def __init__(self, size: int) -> None:
        self._slots = [Slot() for _ in range(size)]
        self._jobs: queue.SimpleQueue[Job | None] = queue.SimpleQueue()
        self._answers: queue.SimpleQueue[Answer | BaseException] = queue.SimpleQueue()
        self._threads: list[threading.Thread] = []

    def _serve(self, slot: Slot) -> None:
        while (job := self._jobs.get()) is not None:
            try:
                self._answers.put(slot.grade(job))
            except Stopped:
                return
            except BaseException as error:
                self._answers.put(error)

    def _start_threads(self, wanted: int) -> None:
        while len(self._threads) < min(wanted, len(self._slots)):
            thread = threading.Thread(target=self._serve, args=(self._slots[len(self._threads)],), daemon=True)
            thread.start()
            self._threads.append(thread)

    def answers(self, jobs: Iterator[Job]) -> Iterator[Answer]:
        """Takes jobs as they are needed, and gives answers as they come."""
        waiting = 0
        left = True
        while left or waiting:
            while left and waiting <= len(self._slots):  # one more than there are slots, so that none is idle
                job = next(jobs, None)
                if job is None:
                    left = False
                    break
                self._jobs.put(job)
                waiting += 1
                self._start_threads(waiting)
            if waiting:
                answer = self._answers.get()
                waiting -= 1
                if isinstance(answer, BaseException):
                    raise answer
                yield answer

    def close(self) -> None:
        """Ends all processes and what they run, at once."""
        for slot in self._slots:
            slot.stop()
        for _ in self._threads:
            self._jobs.put(None)
        for thread in self._threads:
            thread.join(_END_SECONDS)
        for slot in self._slots:
            slot.close()
