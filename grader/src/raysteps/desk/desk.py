"""What the desk shows of a class and of one submission, and what a person can do with it."""

import json
import sqlite3
import threading
import traceback
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from raysteps.classroom.annotations import (
    Annotation,
    AnnotationConflict,
    Thread,
    annotations_of,
    code_mark,
    latest_serial,
    threads,
    written_serial,
)
from raysteps.classroom.class_document import CurrentResults, submissions_if_current
from raysteps.classroom.database import CLASS_JSON, FILE, ClassDatabase, Source, explained_sqlite_errors
from raysteps.classroom.review import line_now, review_results
from raysteps.common.documents import Malformed, convert, plain
from raysteps.common.errors import RaystepsError, UsageError
from raysteps.common.local_server import HTML, JSON, LocalHandler, LocalServer
from raysteps.common.text import clean, number, plain_letters, printable
from raysteps.course.manifest import Step
from raysteps.desk.annotation_files import AnnotationDraft, AnnotationWriter
from raysteps.desk.file_writer import FileWriter, check_folder
from raysteps.report.class_overview import marks_of
from raysteps.report.class_page import STATUSES, found_by, step_cell, who_and_more
from raysteps.report.page import PictureData, picture_of, render_page
from raysteps.report.student import ShownImage, parts_of, parts_that_count, step_view
from raysteps.results.class_model import GradedSubmission
from raysteps.results.model import Results, StepResult
from raysteps.results.store import stored_results

_CODE_LINES = 20_000
_CODE_LINE = 2_000  # characters
_MAX_BODY = 1 << 20

Row = dict[str, Any]
View = dict[str, Any]


# The table.


def _row(one: GradedSubmission, steps: Sequence[str], mistakes: Mapping[tuple[str, str], int], has_roster: bool) -> Row:
    who, more = who_and_more(one)
    review = one.review
    found = [one.steps.get(step) for step in steps]
    cells = [step_cell(one, step) for step in steps]
    return {
        "name": one.name,
        "who": who,
        "more": more,
        "words": found_by(one),
        "status": one.status,
        "points": "" if one.points is None else number(one.points),
        "final": "" if one.final is None else number(one.final),
        "days": one.late.days if one.late is not None else 0,
        "keys": [*(step.points if step is not None else None for step in found), one.final],
        "statuses": [cell.status if cell is not None else "" for cell in cells],
        "mistakes": [
            mistakes[step, title] for step, titles in one.mistakes.items() for title in titles
            if (step, title) in mistakes
        ],
        "changed": review.changes,
        "look": marks_of(one, has_roster),
        "open": review.open_requests,
        "comments": review.comments,
        "read": review.read,
    }  # fmt: skip


# One submission.


def _history(thread: Thread) -> list[View]:
    return [
        {
            "author": clean(one.author, 200),
            "at": one.at[:16].replace("T", " "),
            "text": clean(one.text),
            "answer": clean(one.answer),
            "points": number(one.points) if one.kind == "points" else "",
            "withdrawn": one.withdrawn,
        }
        for one in thread.history
    ]


def _thread_view(thread: Thread) -> View:
    last = thread.last
    return {
        "subject": last.subject,
        "after": last.uid,
        "kind": last.kind,
        "step": last.step,
        "part": last.part,
        "text": clean(last.text),
        "answer": clean(last.answer),
        "points": last.points,
        "withdrawn": last.withdrawn,
        "history": _history(thread),
    }


def _code_lines(source: Source | None) -> list[str]:
    lines = source.lines if source is not None else []
    lines = lines[:-1] if lines and not lines[-1] else lines
    return [_visible(text[:_CODE_LINE]) for text in lines[:_CODE_LINES]]


def _visible(text: str) -> str:
    """Code may hold signs that turn the writing direction or take no room: who reads it must see them."""
    return "".join(sign if sign == "\t" or sign.isprintable() else f"⟨U+{ord(sign):04X}⟩" for sign in text)


def _picture(data: bytes | None) -> PictureData | None:
    return picture_of(data) if data else None


class Desk:
    """One connection for all threads of the server, one at a time."""

    def __init__(self, out: Path, author: str) -> None:
        self._lock = threading.RLock()
        self._out = out
        self._author = author
        self._rows: dict[str, tuple[tuple[int, int], Row]] = {}
        self._mistakes: dict[tuple[str, str], int] = {}
        self._current_results: CurrentResults | None = None
        self._run: tuple[Any, ...] = ()
        check_folder(out)
        with explained_sqlite_errors(out / FILE, "used"):
            self._database = ClassDatabase(out)
        if self._database.connection.execute("SELECT 1 FROM runs").fetchone() is None:
            self._database.close()
            raise UsageError(f"{out / FILE}: nothing has been graded there")
        self.writer = FileWriter(out)
        self._read_class_json()

    def close(self) -> None:
        self.writer.close()
        with self._lock:
            self._database.close()

    # What has changed since the rows were made: by this desk, by another one, by grade-class.

    def _query(self, sql: str, *values: object) -> list[sqlite3.Row]:
        return self._database.connection.execute(sql, values).fetchall()

    def _stamps(self) -> dict[str, tuple[int, int]]:
        """Of each submission the last result and the last annotation."""
        rows = self._query(
            "SELECT name, coalesce((SELECT max(run) FROM results WHERE submission = id), 0) AS run, "
            "coalesce((SELECT max(serial) FROM annotations WHERE submission = id), 0) AS serial "
            "FROM submissions WHERE scope = 'here' ORDER BY name_order(name)"
        )
        return {row["name"]: (row["run"], row["serial"]) for row in rows}

    def _current(self) -> CurrentResults:
        """Made anew when a run has begun or ended: roster and late policy may be others."""
        run = tuple(self._query("SELECT number, state FROM runs ORDER BY number DESC LIMIT 1")[0])
        if self._current_results is None or run != self._run:
            self._current_results, self._run = CurrentResults(self._database), run
            self._rows.clear()
        return self._current_results

    def _read_class_json(self) -> None:
        """The rows of a class whose files are as new as its database: to read all results again takes longer."""
        current_results = self._current()
        stamps = self._stamps()
        connection = self._database.connection
        if written_serial(connection) != latest_serial(connection):
            return
        for name, one in submissions_if_current(
            self._database, self._out / CLASS_JSON, current_results.last["number"]
        ).items():
            if name in stamps and one.run == (stamps[name][0] or None):
                self._keep(one, stamps[name])

    def _keep(self, one: GradedSubmission, stamp: tuple[int, int]) -> Row:
        for step, titles in one.mistakes.items():
            for title in titles:
                self._mistakes.setdefault((step, title), len(self._mistakes))
        current_results = self._current()
        row = _row(one, [step.id for step in current_results.steps], self._mistakes, current_results.has_roster)
        self._rows[one.name] = (stamp, row)
        return row

    def _row_of(self, name: str, stamp: tuple[int, int]) -> Row:
        known = self._rows.get(name)
        if known is not None and known[0] == stamp:
            return known[1]
        return self._keep(self._current().named(name), stamp)

    # What the page asks.

    def overview(self) -> View:
        """The whole table."""
        with self._lock:
            current_results = self._current()
            rows = [self._row_of(name, stamp) for name, stamp in self._stamps().items()]
            return {
                "course": current_results.course,
                "out": str(self._out),
                "author": self._author,
                "steps": [
                    {"id": step.id, "number": step.id[:2], "title": step.title, "points": step.points}
                    for step in current_results.steps
                ],
                "statuses": STATUSES,
                "late": current_results.policy is not None,
                "mistakes": [{"step": step, "title": title} for step, title in self._mistakes],
                "letters": plain_letters(),
                "rows": rows,
                "files": self.files(),
            }

    def files(self) -> View:
        """Whether results.json, the reports and the tables hold all that was said."""
        return {"state": self.writer.state, "trouble": self.writer.trouble}

    def submission(self, name: str) -> View:
        """All that there is to be read of one."""
        with self._lock:
            stamp = self._stamps().get(name)
            if stamp is None:
                raise UsageError(f"{printable(name)}: there is no such submission here")
            row = self._row_of(name, stamp)
            (submission,) = self._query("SELECT id FROM submissions WHERE name = ?", name)[0]
            current = self._database.current(name)
            run = current["run"] if current is not None else None
            results = stored_results(current["document"]) if current is not None else None
            sources = self._database.sources(submission, run) if run is not None else {}
            pictures = self._database.pictures(submission, run) if run is not None else {}
            annotations = annotations_of(self._database, submission)
            one = self._current().named(name)
            mark = code_mark(self._database, sources, run)
            view: View = {
                "row": row,
                "late": one.late.words if one.late is not None else "",
                "submitted": one.submitted_at,
                "fault": clean(one.fault),
                "notes": [clean(words) for words in one.why_unread],
                "look_again": [clean(words) for words in one.review.look_again],
                "threads": [self._placed(thread, sources) for thread in threads(annotations)],
                "steps": [],
                "files": self.files(),
            }
            if results is not None:
                view["automatic"] = number(results.total.points)
                view["steps"] = self._steps(results, annotations, sources, pictures, mark)
            return view

    def _placed(self, thread: Thread, sources: Mapping[str, Source]) -> View:
        """With the line at which it is now; 0 where that is not there any more, or was never one."""
        last = thread.last
        view = _thread_view(thread)
        if last.kind != "comment" or not last.line:
            return {**view, "line": 0, "since": "", "was": ""}
        old = (self._database.blob(last.source) or b"").decode("utf-8", "replace")
        place = line_now(last, old.split("\n") if old else [], sources.get(last.step))
        line = 0 if place.since_then == "gone" else place.line
        return {**view, "line": line, "since": place.since_then, "was": clean(last.line_text, 300), "then": last.line}

    def _steps(
        self,
        results: Results,
        annotations: Sequence[Annotation],
        sources: Mapping[str, Source],
        pictures: Mapping[str, bytes],
        mark: str,
    ) -> list[View]:
        manifests = {step.id: step for step in self._current().manifests}
        made = review_results(results, list(manifests.values()), annotations, sources, mark, self._database).results
        return [
            self._step(automatic, step, manifests.get(step.id), sources.get(step.id), pictures)
            for automatic, step in zip(results.steps, made.steps, strict=True)
        ]

    def _step(
        self,
        automatic: StepResult,
        result: StepResult,
        step: Step | None,
        source: Source | None,
        pictures: Mapping[str, bytes],
    ) -> View:
        album = {
            (result.id, image.name): ShownImage(
                {"reference": _picture(pictures.get(image.reference or "")),
                 "mine": _picture(pictures.get(image.mine or ""))}
            )
            for image in result.images
        }  # fmt: skip
        view = step_view(result, step, album, has_reference=True)
        del view["hints"], view["review"]
        given = {part.name: part for part in parts_of(automatic, step)}
        parts = [
            {"name": part.name, "said": part.said, "points": part.earned, "most": part.most,
             "automatic": given[part.name].earned}
            for part in parts_that_count(result, step)
        ]  # fmt: skip
        shown: View = {
            **view,
            "parts": parts,
            "automatic": number(automatic.points),
            "points": number(result.points),
            "max": number(result.max),
            "file": f"steps/{step.path.as_posix()}" if step is not None else "",
            "code": _code_lines(source),
            "has_code": source is not None,
        }
        return plain(shown)  # type: ignore[return-value]

    # What a person does.

    def say(self, name: str, document: object) -> View:
        """Writes it, and gives the submission as it is then."""
        try:
            said = convert(document, AnnotationDraft)
        except Malformed as error:
            raise UsageError(str(error)) from error
        with self._lock:
            AnnotationWriter(self._database, name).write(said)
        self.writer.call()
        return self.submission(name)


class DeskServer(LocalServer):
    """The page, and what it asks and says."""

    def __init__(self, desk: Desk, port: int = 0) -> None:
        super().__init__(port, _Handler)
        self.desk = desk
        self.page = desk_page()
        self.start()


class _Handler(LocalHandler):
    server: DeskServer

    def get(self, rest: list[str]) -> None:
        match rest:
            case [""]:
                self.answer(200, self.server.page, HTML)
            case ["class"]:
                self._tell(self.server.desk.overview)
            case ["files"]:
                self._tell(self.server.desk.files)
            case ["submission", name]:
                self._tell(lambda: self.server.desk.submission(name))
            case _:
                self.nothing()

    def post(self) -> None:
        """Only JSON, only from the page of this server."""
        rest = self.place()
        if rest is None:
            return
        if not self.is_from_here():
            self.close_connection = True
            self.answer(403, "Only the page of this server may write.\n")
            return
        if self.headers.get_content_type() != JSON:
            self.answer(415, f"Expected {JSON}.\n")
            return
        length = self.headers.get("Content-Length", "")
        if not (length.isascii() and length.isdecimal() and len(length) < 10) or int(length) > _MAX_BODY:
            self.close_connection = True
            self.answer(413, f"Expected at most {_MAX_BODY} bytes.\n")
            return
        try:
            said = json.loads(self.rfile.read(int(length)))
            json.dumps(said, ensure_ascii=False).encode()  # half a character can be written nowhere
        except (ValueError, RecursionError):
            self.answer(400, "Expected JSON.\n")
            return
        match rest:
            case ["submission", name]:
                self._tell(lambda: self.server.desk.say(name, said))
            case _:
                self.nothing()

    def _tell(self, ask: Callable[[], View]) -> None:
        try:
            code, view = 200, ask()
        except AnnotationConflict as error:
            code, view = 409, {"error": str(error)}
        except RaystepsError as error:
            code, view = 400, {"error": str(error)}
        except sqlite3.Error as error:
            code, view = 500, {"error": f"the database of the class: {error}"}
        except Exception:
            traceback.print_exc()
            code, view = 500, {"error": "The desk has a fault: its terminal says which."}
        self.answer(code, json.dumps(view, ensure_ascii=False), f"{JSON}; charset=utf-8")


def desk_page() -> str:
    """The HTML; it asks for everything else."""
    scripts = ("compare-controls", "class-rows", "class-filter", "desk-parts", "desk-code", "desk-submission", "desk")
    return render_page("desk", "Desk", {}, scripts, ("class", "class-table", "desk"), connect=True)
