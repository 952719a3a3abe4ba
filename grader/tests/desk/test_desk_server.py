"""Who may read and write at the desk, and what it does beside others: a second desk, a grade-class."""

import errno
import http.client
import json
import threading
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pytest
from class_fakes import grade_class, write_entry

from raysteps.classroom.annotations import all_annotations
from raysteps.classroom.class_files import refuse_unwritten
from raysteps.classroom.database import LOCK, ClassDatabase
from raysteps.common.errors import UsageError
from raysteps.common.files import try_lock
from raysteps.desk.annotation_files import export_file, import_file
from raysteps.desk.desk import Desk, DeskServer
from raysteps.desk.file_writer import may_write, write_all

pytestmark = pytest.mark.usefixtures("fake_grader")

_STEP = "01-camera-rays"
_CODE = '// points 4\nint first = 1;\nconst char* page = "</script><script>alert(1)</script>\u202e";\n'
_COMMENT = {"kind": "comment", "author": "Ada", "step": _STEP, "line": 2, "text": "why?"}


@pytest.fixture
def grades(tmp_path: Path) -> Path:
    for name in ("ann", "bob"):
        write_entry(tmp_path / "in", name, _CODE)
    assert grade_class(tmp_path / "in", "--out", tmp_path / "out") == 0
    return tmp_path / "out"


@pytest.fixture
def desk(grades: Path) -> Iterator[Desk]:
    found = Desk(grades, "Ada")
    yield found
    found.close()


@pytest.fixture
def server(desk: Desk) -> Iterator[DeskServer]:
    found = DeskServer(desk)
    yield found
    found.close()


class Asked:
    """What came back."""

    def __init__(self, answer: http.client.HTTPResponse) -> None:
        self.status = answer.status
        self.headers = {name.lower(): value for name, value in answer.getheaders()}
        self.text = answer.read().decode()

    @property
    def json(self) -> dict[str, Any]:
        found: dict[str, Any] = json.loads(self.text)
        return found


def _ask(
    server: DeskServer, place: str, said: object = None, *, token: str | None = None, method: str = "", **headers: str
) -> Asked:
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=30)
    body = None if said is None else said if isinstance(said, (bytes, str)) else json.dumps(said)
    told = {"Origin": f"http://127.0.0.1:{server.port}", "Content-Type": "application/json"} if body is not None else {}
    told |= {name.replace("_", "-"): value for name, value in headers.items()}
    told = {name: value for name, value in told.items() if value}
    path = f"/{server.token if token is None else token}/{place}"
    connection.request(method or ("GET" if body is None else "POST"), path, body, told)
    return Asked(connection.getresponse())


def _amount(grades: Path) -> int:
    with closing(ClassDatabase(grades)) as database:
        return int(database.connection.execute("SELECT count(*) FROM annotations").fetchone()[0])


def _results(grades: Path, name: str = "ann") -> dict[str, Any]:
    found: dict[str, Any] = json.loads((grades / "submissions" / name / "results.json").read_text())
    return found


def test_what_is_said_is_kept_and_written_at_once(server: DeskServer, desk: Desk, grades: Path) -> None:
    page = _ask(server, "")
    assert page.status == 200
    assert "Content-Security-Policy" in page.text
    assert page.headers["x-frame-options"] == "DENY"
    rows = _ask(server, "class").json["rows"]
    assert [(row["name"], row["points"], row["read"]) for row in rows] == [("ann", "4", False), ("bob", "4", False)]
    told = _ask(server, "submission/ann", _COMMENT)
    assert told.status == 200
    assert [(one["line"], one["text"]) for one in told.json["threads"]] == [(2, "why?")]
    changed = _ask(server, "submission/ann", {"kind": "points", "author": "Ada", "points": 2, "text": "nice"}).json
    assert (changed["row"]["points"], changed["automatic"]) == ("6", "4")
    assert desk.writer.wait() == "written"
    assert _results(grades)["total"]["points"] == 6
    assert "ann,ann,,,,graded,6," in (grades / "results.csv").read_text("utf-8-sig")
    refuse_unwritten(grades)


def test_code_is_sent_as_it_is_and_hidden_signs_are_seen(server: DeskServer) -> None:
    step = _ask(server, "submission/ann").json["steps"][0]
    assert step["code"][2] == 'const char* page = "</script><script>alert(1)</script>⟨U+202E⟩";'
    assert step["file"] == "steps/01-camera-rays/camera_rays.cpp"


def test_who_does_not_know_the_word_gets_nothing(server: DeskServer, grades: Path) -> None:
    for token in ("", "A" * len(server.token), server.token[:-1], f"{server.token}x"):
        for place, said in (("", None), ("class", None), ("submission/ann", None), ("submission/ann", _COMMENT)):
            told = _ask(server, place, said, token=token)
            assert told.status == 404
            assert "ann" not in told.text
    assert _amount(grades) == 0


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1.evil.example", "0.0.0.0", "[::1"])
def test_another_name_for_this_machine_is_refused(server: DeskServer, grades: Path, host: str) -> None:
    for place, said in (("class", None), ("submission/ann", _COMMENT)):
        assert _ask(server, place, said, Host=host).status == 403
        assert _ask(server, place, said, Host=f"{host}:{server.port}").status == 403
    assert _amount(grades) == 0


@pytest.mark.parametrize(
    "headers",
    [
        {"Origin": "http://evil.example"},
        {"Origin": "null"},
        {"Origin": ""},
        {"Origin": "http://127.0.0.1:1"},
        {"Origin": "https://127.0.0.1:{port}"},
        {"Origin": "http://localhost:{port}"},
        {"Origin": "http://[::1"},
        {"Sec_Fetch_Site": "cross-site"},
        {"Sec_Fetch_Site": "same-site"},
    ],
)
def test_another_page_must_not_write(server: DeskServer, grades: Path, headers: dict[str, str]) -> None:
    told = {name: value.replace("{port}", str(server.port)) for name, value in headers.items()}
    assert _ask(server, "submission/ann", _COMMENT, **told).status == 403
    assert _amount(grades) == 0


def test_only_json_of_a_size_is_read(server: DeskServer, grades: Path) -> None:
    assert _ask(server, "submission/ann", _COMMENT, Content_Type="text/plain").status == 415
    assert _ask(server, "submission/ann", "{").status == 400
    assert _ask(server, "submission/ann", "[" * 100_000).status == 400
    for key in ("text", "step", "author"):
        assert _ask(server, "submission/ann", {**_COMMENT, key: "half a smile: \ud83d"}).status == 400
    assert _ask(server, "submission/ann", _COMMENT, Content_Length=str(2 << 20)).status == 413
    assert _ask(server, "submission/ann", _COMMENT, Content_Length="-1").status == 413
    assert _ask(server, "submission/ann", _COMMENT, Content_Length="9" * 5000).status == 413
    for method in ("PUT", "DELETE", "PATCH", "OPTIONS", "HEAD"):
        assert _ask(server, "submission/ann", method=method).status == 405
    assert _amount(grades) == 0


@pytest.mark.parametrize("place", ["submission/../class.sqlite", "submission/eve", "class.sqlite", "submission/ann/x",
                                   "submission/%2e%2e", "submission/ann?x", "/etc/passwd", "submission/",
                                   "submission%2Fann", "submission/..%2Fann", "submission/%ff"])  # fmt: skip
def test_there_is_nothing_else(server: DeskServer, place: str) -> None:
    assert _ask(server, place).status in (400, 404)
    assert _ask(server, place, _COMMENT).status in (400, 404)


def test_a_name_may_have_any_letters(tmp_path: Path) -> None:
    write_entry(tmp_path / "in", "Jörg_Müller_88_李", _CODE)
    assert grade_class(tmp_path / "in", "--out", tmp_path / "out") == 0
    with closing(Desk(tmp_path / "out", "Ada")) as desk, closing(DeskServer(desk)) as server:
        name = server.desk.overview()["rows"][0]["name"]
        assert name == "Jörg_Müller_88_李"
        assert _ask(server, f"submission/{quote(name)}").json["row"]["name"] == name
        assert _ask(server, f"submission/{quote(name)}", _COMMENT).status == 200


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ({"kind": "delete", "author": "Ada"}, "kind: invalid enum"),
        ({"kind": "comment"}, "missing required field author"),
        ({**_COMMENT, "author": " "}, "author: expected"),
        ({**_COMMENT, "line": 99}, "line 99: the code of step 01 has"),
        ({**_COMMENT, "step": "02-intersection"}, "line 2: the code of step 02 has 0 lines"),
        ({**_COMMENT, "text": ""}, "expected a comment"),
        ({"kind": "points", "author": "Ada", "text": "x", "step": _STEP, "points": 11}, "at most 10"),
        ({"kind": "points", "author": "Ada", "text": "x", "step": _STEP, "points": -3}, "01 has 0 to 10, found -3"),
        ({**_COMMENT, "kind": "points", "line": 0, "part": "hidden", "points": 9}, "hidden has at"),
        ({"kind": "points", "author": "Ada", "text": "x", "step": "10-fog", "points": 1}, "10-fog was not graded"),
        ({"kind": "points", "author": "Ada", "text": "", "step": _STEP, "points": 1}, "expected a reason"),
        ({**_COMMENT, "more": 1}, "unknown key"),
        ({**_COMMENT, "points": float("nan")}, "points: expected a number, found nan"),
        ({**_COMMENT, "kind": "read", "points": float("-inf")}, "points: expected a number, found -inf"),
        ([], "expected object"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said(server: DeskServer, grades: Path, said: object, words: str) -> None:
    told = _ask(server, "submission/ann", said)
    assert told.status == 400
    assert words in told.json["error"].lower().replace("`", "") or words in told.json["error"]
    assert _amount(grades) == 0


def test_a_fault_of_the_desk_is_told_on_the_page_and_on_the_terminal(
    server: DeskServer, desk: Desk, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def overview() -> None:
        raise KeyError("no such key")

    monkeypatch.setattr(desk, "overview", overview)
    told = _ask(server, "class")
    assert (told.status, told.json["error"]) == (500, "The desk has a fault: its terminal says which.")
    assert "KeyError: 'no such key'" in capfd.readouterr().err


def test_two_at_once_hear_of_each_other(server: DeskServer, grades: Path) -> None:
    first = {"kind": "points", "author": "Ada", "text": "x", "step": _STEP, "points": 5}
    with closing(Desk(grades, "Bob")) as other:
        assert other.submission("ann")["row"]["points"] == "4"
        assert _ask(server, "submission/ann", first).status == 200
        assert [row["points"] for row in other.overview()["rows"]] == ["5", "4"]  # the other one sees it
        late = _ask(server, "submission/ann", {**first, "author": "Bob", "points": 9})
        assert late.status == 409
        assert "Ada has changed this meanwhile" in late.json["error"]
        assert other.submission("ann")["row"]["points"] == "5"


def test_many_at_once_lose_nothing(grades: Path) -> None:
    desks = [Desk(grades, f"P{number}") for number in range(3)]
    said = [{**_COMMENT, "text": f"{at}"} for at in range(10)]

    def work(desk: Desk) -> None:
        for one in said:
            desk.say("ann", one)

    threads = [threading.Thread(target=work, args=(desk,)) for desk in desks]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for desk in desks:
        desk.close()
    assert _amount(grades) == 30
    assert len(_results(grades)["steps"][0]["review"]["comments"]) == 30
    refuse_unwritten(grades)


def test_while_a_class_is_graded_words_are_kept_and_files_wait(tmp_path: Path, grades: Path, desk: Desk) -> None:
    assert desk.writer.wait() == "written"  # of what may have been said before
    with (grades / LOCK).open("a") as file:
        assert try_lock(file.fileno())  # as a grade-class has it
        desk.say("ann", _COMMENT)
        assert desk.writer.wait() == "waiting"
        assert _results(grades)["steps"][0]["review"] is None
        with pytest.raises(UsageError, match="changed after its files were made"):
            refuse_unwritten(grades)
        assert not write_all(grades)
    desk.writer.call()
    assert desk.writer.wait() == "written"
    assert _results(grades)["steps"][0]["review"]["comments"][0]["text"] == "why?"


def test_a_grade_class_waits_for_a_desk_that_writes_and_writes_what_was_said(tmp_path: Path, grades: Path) -> None:
    with closing(Desk(grades, "Ada")) as desk:
        assert desk.writer.wait() == "written"
        with may_write(grades) as is_free:
            assert is_free
            desk.say("ann", {"kind": "points", "author": "Ada", "points": 3, "text": "x"})
            codes: list[int] = []
            begun = threading.Thread(
                target=lambda: codes.append(grade_class(tmp_path / "in", "--out", grades, "--resume"))
            )
            begun.start()
        begun.join()
        assert codes == [0]
    assert _results(grades)["total"]["points"] == 7
    refuse_unwritten(grades)


def test_a_file_system_without_locks(grades: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_args: object) -> None:
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr("fcntl.flock", refuse)
    with closing(Desk(grades, "Ada")) as desk:
        desk.say("ann", _COMMENT)
        assert desk.writer.wait(60) == "written"
    assert _results(grades)["steps"][0]["review"]["comments"][0]["text"] == "why?"


def test_what_keeps_files_from_being_written_is_said_and_tried_again(grades: Path) -> None:
    (grades / "desk.lock").unlink(missing_ok=True)
    (grades / "desk.lock").mkdir()
    with closing(Desk(grades, "Ada")) as desk:
        desk.say("ann", _COMMENT)
        assert desk.writer.wait(60) == "failed"
        assert "desk.lock" in desk.files()["trouble"]
        (grades / "desk.lock").rmdir()
        desk.say("ann", {**_COMMENT, "text": "and then"})
        assert desk.writer.wait(60) == "written"
    assert len(_results(grades)["steps"][0]["review"]["comments"]) == 2


def test_a_new_run_is_seen(tmp_path: Path, grades: Path, desk: Desk) -> None:
    assert [row["points"] for row in desk.overview()["rows"]] == ["4", "4"]
    write_entry(tmp_path / "in", "bob", "// points 9\n")
    write_entry(tmp_path / "in", "eve", "// points 2\n")
    assert grade_class(tmp_path / "in", "--out", grades, "--resume") == 0
    assert [row["points"] for row in desk.overview()["rows"]] == ["4", "9", "2"]
    assert desk.submission("bob")["steps"][0]["code"] == ["// points 9"]


def test_a_file_carries_all_of_it_to_another_copy(tmp_path: Path, grades: Path) -> None:
    with closing(Desk(grades, "Ada")) as desk:
        desk.say("ann", _COMMENT)
        desk.say("bob", {"kind": "points", "author": "Ada", "points": 3, "text": "=1+1"})
        desk.say("bob", {"kind": "read", "author": "Ada"})
    other = tmp_path / "other"
    assert grade_class(tmp_path / "in", "--out", other) == 0
    with closing(ClassDatabase(grades)) as ours, closing(ClassDatabase(other)) as theirs:
        assert export_file(ours, tmp_path / "said.json") == 3
        assert import_file(theirs, tmp_path / "said.json", "Bob") == 3
        assert import_file(theirs, tmp_path / "said.json", "Bob") == 0
        assert export_file(theirs, tmp_path / "again.json") == 3
        assert export_file(ours, tmp_path / "said.csv") == 2
    assert (tmp_path / "again.json").read_bytes() == (tmp_path / "said.json").read_bytes()
    assert ",'=1+1," in (tmp_path / "said.csv").read_text("utf-8-sig")
    assert write_all(other)
    assert _results(other, "bob")["total"]["points"] == 7
    third = tmp_path / "third"
    assert grade_class(tmp_path / "in", "--out", third) == 0
    with closing(ClassDatabase(third)) as database:
        assert import_file(database, tmp_path / "said.csv", "Bob") == 2
        assert import_file(database, tmp_path / "said.csv", "Bob") == 0
    assert write_all(third)
    assert _results(third)["steps"][0]["review"]["comments"][0]["excerpt"][1] == "int first = 1;"
    assert _results(third, "bob")["review"]["overrides"][0]["reason"] == "=1+1"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("kind,text\ncomment,x\n", "2: expected a submission"),
        ("submission,kind,text\neve,comment,x\n", "2: no submission is of submission eve"),
        ("submission,kind,text\nann,praise,x\n", "2: kind is 'praise'"),
        ("submission,kind,text\nann,comment,x\nbob,comment,\n", "3: text: expected a comment"),
        ("submission,kind,text,step\nann,comment,x,77\n", "2: step is '77'"),
        ("submission,kind,text,points\nann,points,x,many\n", "2: points is 'many'"),
        *((f"submission,kind,text,points\nann,{kind},x,{found}\n", f"2: points is '{found}', expected a number")
          for kind in ("points", "comment", "request") for found in ("nan", "-inf", "1e999")),
        *((f"submission,kind,text,step,line\nann,comment,x,1,{found}\n", f"2: line is '{found}', expected a whole")
          for found in ("nan", "inf", "2.5")),
        ("submission,kind,text,step,line\nann,comment,x,1,77\n", "2: line 77"),
        ("Name , Text\nann,x\n", "author, at, found 'Name' and 'Text'"),
        ("name,text\nann,x\n", "has no column kind"),
        ("\xff", "has no column kind and text"),
        ("", "found none"),
    ],
)  # fmt: skip
def test_a_table_that_is_wrong_is_refused_as_a_whole(tmp_path: Path, grades: Path, text: str, words: str) -> None:
    path = tmp_path / "said.csv"
    path.write_text(text, encoding="utf-8")
    with closing(ClassDatabase(grades)) as database, pytest.raises(UsageError) as told:
        import_file(database, path, "Ada")
    assert words in str(told.value)
    assert _amount(grades) == 0


def test_a_table_that_two_people_take_in_is_taken_in_once(tmp_path: Path, grades: Path) -> None:
    path = tmp_path / "asked.csv"
    path.write_text("submission,kind,text,author\nann,request,why?,\nann,request,why?,Eve\n")
    with closing(ClassDatabase(grades)) as database:
        assert import_file(database, path, "Ada") == 2
        assert import_file(database, path, "Bob") == 0
        assert {one.author for _, one in all_annotations(database)} == {"Ada", "Eve"}


@pytest.mark.parametrize(
    "table",
    [
        "Submission ,KIND, Step,Text\nann,Request,1,why?\n",
        "entry;type;exercise;Your name;question\nann;request;1;Ann;why?\n",
        "kind,text,submission,step\nrequest,why?,ann,1,more,cells\n",
    ],
)
def test_columns_of_a_table_may_be_called_as_people_do(tmp_path: Path, grades: Path, table: str) -> None:
    path = tmp_path / "asked.csv"
    path.write_text(table)
    with closing(ClassDatabase(grades)) as database:
        assert import_file(database, path, "Ada") == 1
        ((entry, one),) = all_annotations(database)
    assert (entry, one.kind, one.step, one.text) == ("ann", "request", "01-camera-rays", "why?")


def test_a_folder_without_a_class(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="holds no class"):
        Desk(tmp_path, "Ada")
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(UsageError, match="holds no class"):
        write_all(tmp_path)


def test_the_table_is_sorted_as_people_read_it(tmp_path: Path) -> None:
    names = ["ann", "Bea", "cid", "s2", "s10"]
    for name in names:
        write_entry(tmp_path / "in", name, _CODE)
    assert grade_class(tmp_path / "in", "--out", tmp_path / "out") == 0
    desk = Desk(tmp_path / "out", "Ada")
    try:
        assert [row["name"] for row in desk.overview()["rows"]] == names
    finally:
        desk.close()
