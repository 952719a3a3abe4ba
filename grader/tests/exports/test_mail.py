"""Reports as e-mail: who gets what, what a message says, and what nobody can put into it."""

import email
import email.policy
import mailbox
import zipfile
from contextlib import closing
from email.message import EmailMessage
from io import BytesIO
from pathlib import Path

import pytest
from give_back_class import export, grade

from raysteps.classroom.class_files import write_class
from raysteps.classroom.database import ClassDatabase
from raysteps.common.errors import UsageError
from raysteps.desk.annotation_files import AnnotationDraft, AnnotationWriter
from raysteps.exports.mail import parse_template, plain_address

pytestmark = pytest.mark.usefixtures("fake_grader")

_STAFF = "Graphics 101 <staff@example.edu>"
_HEADERS = ["Auto-Submitted", "Content-Type", "Date", "From", "MIME-Version", "Message-ID", "Subject", "To"]


@pytest.fixture
def graded(tmp_path: Path) -> Path:
    """A student, a team, somebody without an address, a fault, and somebody who handed nothing in."""
    roster = (
        "1,Ann Lee,ann@example.edu,ann\n2,Bob Ray,bob@example.edu,team\n3,Cleo Fox,cleo@example.edu,team\n"
        "4,Dan Day,,dan\n5,Eve Noé,eve@example.edu,eve\n6,Fay Low,fay@example.edu,\n"
    )
    good = "// points 7\n"
    return grade(tmp_path, roster, ann=good, team="// points 4\n", dan=good, eve="// fault\n", stranger=good)


def _box(path: Path) -> list[EmailMessage]:
    """As a mail program reads it."""
    found = [email.message_from_bytes(one.as_bytes(), policy=email.policy.default) for one in mailbox.mbox(path)]
    assert all(isinstance(one, EmailMessage) for one in found)
    return [one for one in found if isinstance(one, EmailMessage)]


def _text(message: EmailMessage) -> str:
    body = message.get_body(("plain",))
    assert body is not None
    return str(body.get_content()).replace("\r\n", "\n")


def _written(graded: Path, *words: str | Path) -> list[EmailMessage]:
    out = graded.parent / "mail.mbox"
    assert export("mail", "--results", graded, "--from", _STAFF, "--out", out, *words)[0] == 0
    return _box(out)


def test_without_a_word_it_is_only_shown_who_would_get_what(graded: Path) -> None:
    code, text = export("mail", "--results", graded, "--from", _STAFF)
    assert code == 0
    for address, submission in (("ann", "ann"), ("bob", "team"), ("cleo", "team")):
        assert any(f"{address}@example.edu" in line and f" {submission} " in line for line in text.splitlines())
    assert "dan (Dan Day, 4): no e-mail address: expected the column email in a roster" in text
    assert "eve (Eve Noé, 5, eve@example.edu): the grader failed with it: look at fault.txt" in text
    assert "Fay Low, 6, fay@example.edu: handed nothing in" in text
    assert "stranger: no e-mail address" in text
    assert "Nothing was sent. 3 messages" in text
    assert not list(graded.glob("mail*"))


def test_each_member_of_a_team_gets_its_report(graded: Path) -> None:
    messages = _written(graded)
    assert [str(one["To"]) for one in messages] == [
        "Ann Lee <ann@example.edu>", "Bob Ray <bob@example.edu>", "Cleo Fox <cleo@example.edu>",
    ]  # fmt: skip
    assert sorted(messages[0].keys()) == _HEADERS
    for one, submission in zip(messages, ("ann", "team", "team"), strict=True):
        [part] = one.iter_attachments()
        assert (part.get_filename(), part.get_content_type()) == ("report.html", "text/html")
        assert part.get_payload(decode=True) == (graded / "submissions" / submission / "report.html").read_bytes()
    assert "Hello Ann Lee,\n\nyour work has been graded: 7 of 100 points.\n" in _text(messages[0])
    assert "\n01 Camera rays: 7 of 10, partly right\n" in _text(messages[0])
    assert "What to do next: 01 Camera rays, which is partly right." in _text(messages[0])


def test_lateness_is_told_with_the_points_that_count(tmp_path: Path) -> None:
    late = tmp_path / "late.toml"
    late.write_text("deadline = 2020-01-01T00:00:00+00:00\npercent_per_day = 1\n")
    graded = grade(tmp_path, "1,Ann,ann@example.edu,ann\n", "--late-policy", late, ann="// points 10\n")
    text = _text(_written(graded)[0])
    assert "Late: 0 of 10 points count.\nHanded in " in text


def test_what_people_said_and_changed_is_told(tmp_path: Path) -> None:
    roster, code = "1,Ann,ann@example.edu,ann\n", "int secret_of_the_code = 1;\n"
    grade(tmp_path, roster, ann=f"// points 4\n{code}")
    graded = grade(tmp_path, roster, ann=f"// points 7\n{code}")
    with closing(ClassDatabase(graded)) as database:
        scribe = AnnotationWriter(database, "ann")
        scribe.write(AnnotationDraft("points", "Ada", text="half is right", step="01-camera-rays", points=9))
        scribe.write(AnnotationDraft("points", "Ada", text="a nice picture", points=2))
        scribe.write(AnnotationDraft("comment", "Ada", text="why\ntwo?", step="01-camera-rays", line=2))
        scribe.write(AnnotationDraft("request", "Ada", text="Was it?", step="01-camera-rays", answer="It was."))
        write_class(database, graded)
    text = _text(_written(graded)[0])
    assert "graded: 11 of 100 points.\n" in text
    assert "\n01 Camera rays: 9 of 10, partly right\n" in text
    assert (
        "\n\n+2 points for the submission as a whole, from your instructor: a nice picture (Ada)\n"
        "01 Camera rays: Your instructor changed the points from 7 to 9: half is right (Ada)\n"
        "01 Camera rays: Line 2: why\ntwo? (Ada)\n"
        "01 Camera rays: You asked: Was it? Answer (Ada): It was.\n\n"
    ) in text
    assert "secret_of_the_code" not in text
    assert "and 7 now.\nAll points here are by the grader, before your instructor changed some.\nBetter than" in text


def test_a_template_of_ones_own(graded: Path) -> None:
    template = graded.parent / "mail.txt"
    template.write_text("Subject: {submission}: {counts}\n\nDear {name}, {{points}}\n{history}\n{points}\n")
    message = _written(graded, "--template", template, "--only", "Ann Lee", "--reply-to", "help@example.edu")[0]
    assert message["Subject"] == "ann: 7"
    assert message["Reply-To"] == "help@example.edu"
    assert _text(message) == "Dear Ann Lee, {7 of 100 points.}\n7 of 100 points.\n"


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("Hello\n\nx\n", "t:1: expected a line such as 'Subject: {course}: your points'"),
        ("Subject: x\nHello\n", "t:2: expected an empty line after the subject"),
        ("Subject: x\n\nHi {nmae}\n", r"t:3: \{nmae\} is not known; known are \{course\}"),
        ("", "t:1: "),
    ],
)
def test_a_template_that_makes_no_sense(text: str, told: str) -> None:
    with pytest.raises(UsageError, match=told):
        parse_template(text, "t")


def test_a_report_that_is_too_large_comes_without_pictures_or_not_at_all(graded: Path) -> None:
    page = graded / "submissions" / "ann" / "report.html"
    page.write_bytes(page.read_bytes() + b"<!--" + b"x" * 3_000_000 + b"-->")
    words = ("mail", "--results", graded, "--from", _STAFF, "--only", "ann", "--max-size")
    _, text = export(*words, "1")
    assert "ann@example.edu: with fewer pictures, as it would have 4.3 MB" in text
    _, text = export(*words, "0.02")
    assert "too large: 4.3 MB, and " in text
    assert "Nothing was sent. 0 messages" in text


def test_a_zip_where_servers_let_no_html_through(graded: Path) -> None:
    [part] = _written(graded, "--zip", "--only", "ann")[0].iter_attachments()
    data = part.get_payload(decode=True)
    assert isinstance(data, bytes)
    assert part.get_filename() == "report.zip"
    assert zipfile.ZipFile(BytesIO(data)).namelist() == ["report.html"]


_NAMES = (
    "Ann\r\nBcc: x@evil.example",
    "=?utf-8?q?Ann=0d=0aBcc:_x@evil.example?=",
    "=?utf-8?b?QW5uDQpCY2M6IHhAZXZpbC5leGFtcGxl?=",
    'Lee, "Ann" <x@evil.example>, Bob',
    "Ann\u202eeel\u2028Bcc: x@evil.example",
    "Ann\\",
    '"',
    "=?utf-8?q?" + "=41" * 400 + "?=",
    "Ünïcödé " * 40,
    "Ann;:@()[]<>",
)


def test_no_name_adds_a_header_or_a_recipient(tmp_path: Path) -> None:
    quoted = ['"' + name.replace('"', '""') + '"' for name in _NAMES]
    roster = "".join(f"{at},{name},a{at}@example.edu,ann\n" for at, name in enumerate(quoted))
    template = tmp_path / "mail.txt"
    template.write_text("Subject: for {name}\n\nHello {name}\n", encoding="utf-8")
    messages = _written(grade(tmp_path, roster, ann="// points 7\n"), "--template", template)
    assert len(messages) == len(_NAMES)
    for at, message in enumerate(messages):
        assert sorted(message.keys()) == _HEADERS
        assert [one.addr_spec for one in message["To"].addresses] == [f"a{at}@example.edu"]
        assert [one.addr_spec for one in message["From"].addresses] == ["staff@example.edu"]
        shown = f"{message['To']}{message['Subject']}{_text(message)[:-1]}"
        assert not set(shown) & set("\r\n\u202e\u2028")
        assert "=?" not in message["Subject"]


def test_headers_hold_lines_that_every_server_takes(tmp_path: Path) -> None:
    graded = grade(tmp_path, f"1,{'Ünïcödé' * 30},ann@example.edu,ann\n", ann="// points 7\n")
    out = tmp_path / "box"
    export("mail", "--results", graded, "--from", _STAFF, "--out", out)
    data = out.read_bytes()
    assert data.isascii()
    assert max(map(len, data.splitlines())) < 990


@pytest.mark.parametrize(
    ("text", "address"),
    [
        ("ann@example.edu", "ann@example.edu"),
        (" ann+steps@example.edu ", "ann+steps@example.edu"),
        ("ann@bücher.example", "ann@xn--bcher-kva.example"),
        ("ann", None),
        ("ann@", None),
        ("@example.edu", None),
        ("ann@example.edu, bob@example.edu", None),
        ("ann@example.edu\nBcc: bob@example.edu", None),
        ("Ann <ann@example.edu>", None),
        ("=?utf-8?q?ann?=@example.edu", None),
        ("ann..lee@example.edu", None),
        ("änn@example.edu", None),
        ("ann@-example.edu", None),
        ("ann@[127.0.0.1]", None),
        ('"ann lee"@example.edu', None),
        (f"{'a' * 65}@example.edu", None),
    ],
)
def test_what_is_one_address(text: str, address: str | None) -> None:
    assert plain_address(text) == address


def test_who_handed_in_twice_gets_nothing_before_the_roster_says_what_counts(tmp_path: Path) -> None:
    graded = grade(tmp_path, "1,Ann Lee,ann@example.edu,\n", **{"1": "// points 7\n", "ann lee": "// points 8\n"})
    with pytest.raises(UsageError, match="nothing can be given back: handed in more than once"):
        export("mail", "--results", graded, "--from", _STAFF, "--out", tmp_path / "box")
    assert not (tmp_path / "box").exists()


def test_a_report_of_another_run_is_refused(graded: Path) -> None:
    path = graded / "submissions" / "ann" / "results.json"
    path.write_text(path.read_text().replace('"points": 7', '"points": 8'))
    with pytest.raises(UsageError, match=r"results.json: is of another run than results\.csv"):
        export("mail", "--results", graded, "--from", _STAFF)


@pytest.mark.parametrize(("feedback", "travels"), [("full", True), ("diagnosis", False), ("score", False)])
def test_withheld_cases_do_not_travel(tmp_path: Path, feedback: str, travels: bool) -> None:
    """Neither with the report as it lies there, nor with the smaller one that is made for a message."""
    roster, code = "1,Ann,ann@example.edu,ann\n", "// points 7\n// hidden secretinput\n"
    graded = grade(tmp_path, roster, "--feedback", feedback, ann=code)
    page = graded / "submissions" / "ann" / "report.html"
    [whole] = _written(graded)
    page.write_bytes(page.read_bytes() + b"<!--" + b"x" * 3_000_000 + b"-->")
    [smaller] = _written(graded, "--max-size", "1")
    for message in (whole, smaller):
        [part] = message.iter_attachments()
        data = part.get_payload(decode=True)
        assert isinstance(data, bytes)
        assert len(data) < 1_000_000
        assert (b"secretinput" in data) == travels
        assert "secretinput" not in _text(message)


def test_words_that_make_no_sense(graded: Path) -> None:
    words = ("mail", "--results", graded)
    with pytest.raises(UsageError, match="--from staff: is no address; expected one such as"):
        export(*words, "--from", "staff")
    with pytest.raises(
        UsageError, match=r"--only dann: is no submission, id, name or email address .* did you mean dan"
    ):
        export(*words, "--from", _STAFF, "--only", "dann")
    with pytest.raises(UsageError, match="--send: say which server"):
        export(*words, "--from", _STAFF, "--send")
