"""Makes the files of a class anew after what people said and changed, one writer at a time, in a thread."""

import threading
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Literal

from raysteps.classroom.annotations import annotated, latest_serial, written_serial
from raysteps.classroom.class_document import CurrentResults, class_document, submissions_if_current
from raysteps.classroom.class_files import write_class, write_submission, write_tables
from raysteps.classroom.database import CLASS_JSON, FILE, LOCK, ClassDatabase, explained_sqlite_errors, open_database
from raysteps.common.errors import UsageError
from raysteps.common.files import file_lock, try_lock

_DESK_LOCK = "desk.lock"
_AGAIN_SECONDS = 2.0  # to ask whether that has ended

State = Literal["written", "writing", "waiting", "failed"]


@contextmanager
def may_write(out: Path) -> Iterator[bool]:
    """Whether nothing else is at work there, such as a grade-class or a sending of mail. While this lasts none begins,
    and no other desk writes."""
    with file_lock(out / _DESK_LOCK), (out / LOCK).open("a") as file:
        try:
            is_free = try_lock(file.fileno(), shared=True)
        except OSError:
            is_free = True  # a file system without locks
        yield is_free


def check_folder(out: Path) -> None:
    """A class must be there: none is begun here."""
    if not (out / FILE).is_file():
        raise UsageError(f"{out}: holds no {FILE}; expected the --out folder of grade-class")


def write_all(out: Path) -> bool:
    """Everything; False where something else is at work."""
    check_folder(out)
    with may_write(out) as is_free:
        if is_free:
            with explained_sqlite_errors(out / FILE, "used"), closing(ClassDatabase(out)) as database:
                write_class(database, out)
        return is_free


class FileWriter:
    """The files of a submission are made at once, the tables of the class as soon as nothing else is to be done. While
    something else is at work, all of it waits."""

    def __init__(self, out: Path) -> None:
        self._out = out
        self._changed = threading.Condition()
        self._is_due = True  # what was said earlier may not have been written then
        self._is_closed = False
        self.state: State = "writing"
        self.trouble = ""
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def call(self) -> None:
        """Something was said."""
        with self._changed:
            self._is_due, self.state = True, "writing"
            self._changed.notify_all()

    def wait(self, seconds: float | None = None) -> State:
        """Until all is written, or has to wait."""
        with self._changed:
            self._changed.wait_for(lambda: self.state != "writing", seconds)
            return self.state

    def close(self) -> None:
        """Writes what is left, unless something else is at work."""
        with self._changed:
            self._is_closed = True
            self._changed.notify_all()
        self._thread.join()

    def _run(self) -> None:
        is_last = False
        while not is_last:
            with self._changed:
                pause = _AGAIN_SECONDS if self.state == "waiting" else None
                self._changed.wait_for(lambda: self._is_due or self._is_closed, pause)
                is_last, self._is_due = self._is_closed, False
            state = self._write()
            with self._changed:
                self.state = "writing" if self._is_due else state
                self._changed.notify_all()

    def _write(self) -> State:
        try:
            with may_write(self._out) as is_free:
                if not is_free:
                    return "waiting"
                # Whoever made this writer has opened the database, and thereby looked for damage.
                with closing(ClassDatabase(self._out, open_database(self._out / FILE, check=False))) as database:
                    self._write_with(database)
        except Exception as error:  # the database has it; the next writing, or --write, tries again
            self.trouble = str(error)
            return "failed"
        self.trouble = ""
        return "written"

    def _write_with(self, database: ClassDatabase) -> None:
        serial, before = latest_serial(database.connection), written_serial(database.connection)
        if serial == before:
            return
        current_results = CurrentResults(database)
        changed = annotated(database, since=before)
        for name in sorted(changed):
            write_submission(
                database, self._out, current_results.named(name), current_results.course, current_results.manifests
            )
        with self._changed:
            is_busy = self._is_due  # then the tables would be old at once
        if not is_busy:
            kept = submissions_if_current(database, self._out / CLASS_JSON, current_results.last["number"])
            known = {name: one for name, one in kept.items() if name not in changed}
            write_tables(database, self._out, class_document(database, known), serial)
