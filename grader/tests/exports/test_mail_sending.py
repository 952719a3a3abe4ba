"""Reports are sent by SMTP, each once, whatever happens in between."""

import email
import email.policy
import io
import json
import socket
import ssl
import subprocess
from collections.abc import Callable
from email.message import EmailMessage
from pathlib import Path

import pytest
from give_back_class import export, grade
from smtp_server import FakeSmtp, Mischief

from raysteps.classroom.database import LOCK
from raysteps.cli.give_back import PASSWORD
from raysteps.common.errors import UsageError
from raysteps.common.files import try_lock
from raysteps.exports.smtp import LOG, parse_server, read_log

pytestmark = pytest.mark.usefixtures("fake_grader")

_ROSTER = "".join(f"{at},Student {at},s{at}@example.edu,s{at}\n" for at in range(1, 5))
_TEXTS = {f"s{at}": f"// points {at}\n" for at in range(1, 5)}
_ALL = [f"s{at}@example.edu" for at in range(1, 5)]


@pytest.fixture
def graded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr("sys.stdin", io.StringIO())  # nobody can be asked for a password
    return grade(tmp_path, _ROSTER, **_TEXTS)


def _send(graded: Path, server: FakeSmtp, *words: str) -> tuple[int, str]:
    return export(
        *("mail", "--results", graded, "--from", "Staff <staff@example.edu>", "--send", "--per-minute", 6000),
        *("--smtp", server.place, "--security", "none", *words),
    )


def _to(server: FakeSmtp) -> list[str]:
    return [one.to for one in server.taken]


def test_each_gets_one_and_nobody_gets_it_twice(graded: Path) -> None:
    with FakeSmtp() as server:
        code, text = _send(graded, server)
        assert (code, _to(server)) == (0, _ALL)
        assert "4 messages sent, 0 refused" in text
        assert {one.sender for one in server.taken} == {"staff@example.edu"}
        assert b"Hello Student 1," in server.taken[0].data
        code, text = _send(graded, server)
        assert (code, _to(server)) == (0, _ALL)
        assert "Had it already" in text
        assert "there is nobody to whom anything is to be sent" in text
        assert (server.connections, _send(graded, server, "--again")[0], _to(server)) == (1, 0, _ALL)


def test_a_changed_result_is_sent_when_that_is_asked_for(graded: Path, tmp_path: Path) -> None:
    with FakeSmtp() as server:
        _send(graded, server)
        grade(tmp_path, _ROSTER, **{**_TEXTS, "s2": "// points 9\n"})
        code, text = _send(graded, server)
        assert (code, _to(server)) == (0, _ALL)
        assert "s2 (Student 2, 2, s2@example.edu): was sent on " in text
        assert "the result has changed since: --again sends the new one" in text
        assert _send(graded, server, "--again")[0] == 0
        assert _to(server) == [*_ALL, "s2@example.edu"]
        assert b"9 of 100 points" in server.taken[-1].data


def test_one_that_is_refused_keeps_nobody_from_theirs(graded: Path) -> None:
    mischief = Mischief({"s2@example.edu": "550 5.1.1 no such\x1b[31m mailbox"}, texts={"s3@example.edu": "554 spam"})
    with FakeSmtp(mischief) as server:
        code, text = _send(graded, server)
        assert (code, _to(server)) == (1, ["s1@example.edu", "s4@example.edu"])
        assert "s2@example.edu (s2): 550 5.1.1 no such mailbox" in text
        assert "s3@example.edu (s3): 554 spam" in text
        mischief.recipients.clear()
        mischief.texts.clear()
        assert _send(graded, server)[0] == 0
        assert sorted(_to(server)) == _ALL


def test_a_connection_that_is_lost_is_made_again(graded: Path) -> None:
    with FakeSmtp(Mischief(cut_at={"RCPT": 2})) as server:
        assert _send(graded, server)[0] == 0
        assert _to(server) == _ALL
        assert server.connections == 3


def test_a_server_that_goes_away_ends_it_and_the_same_words_go_on(graded: Path) -> None:
    with FakeSmtp() as server:
        server.on_taken = lambda: server.mischief.cut_at.update({"MAIL": 99}) if len(server.taken) == 2 else None
        with pytest.raises(
            UsageError, match=r"the connection was lost 3 times in a row\. 2 messages sent; type the same"
        ):
            _send(graded, server)
        server.mischief.cut_at.clear()
        server.on_taken = None
        assert _send(graded, server)[0] == 0
        assert _to(server) == _ALL


def test_what_nobody_knows_is_said_and_not_sent_again_unasked(graded: Path) -> None:
    with FakeSmtp(Mischief(cut_at={"before answer": 1})) as server:
        code, text = _send(graded, server)
        assert (code, _to(server)) == (1, _ALL)
        assert "Nobody knows whether they have it\n  s1@example.edu (s1)" in text
        _, text = _send(graded, server)
        assert "s1 (Student 1, 1, s1@example.edu): may have been sent on " in text
        assert _to(server) == _ALL
        assert _send(graded, server, "--again")[0] == 0
        assert _to(server) == [*_ALL, "s1@example.edu"]


def test_ctrl_c_in_between(graded: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def interrupt(seconds: float) -> None:
        raise KeyboardInterrupt

    with FakeSmtp() as server:
        with monkeypatch.context() as patch:
            patch.setattr("raysteps.exports.smtp.time.sleep", interrupt)
            with pytest.raises(KeyboardInterrupt):
                _send(graded, server)
        assert _to(server) == ["s1@example.edu"]
        assert "1 message sent; type the same command again to go on" in capsys.readouterr().err
        assert _send(graded, server)[0] == 0
        assert _to(server) == _ALL


def test_a_line_that_was_being_written_when_the_power_went(graded: Path) -> None:
    with FakeSmtp() as server:
        _send(graded, server, "--only", "s1")
        log = graded / LOG
        whole = log.read_bytes()
        log.write_bytes(whole + b'{"at": "2026-')
        assert _send(graded, server)[0] == 0
        assert _to(server) == _ALL
        assert log.read_bytes().startswith(whole)
        assert [json.loads(line)["state"] for line in log.read_text().splitlines()] == ["sending", "sent"] * 4
        log.write_text("{}\n")
        with pytest.raises(UsageError, match=rf"{LOG}:1: .* expected what `export mail --send` wrote"):
            _send(graded, server)


def test_who_only_looks_leaves_a_line_that_is_being_written(graded: Path) -> None:
    log = graded / LOG
    with FakeSmtp() as server:
        _send(graded, server, "--only", "s1")
    text = log.read_bytes() + b'{"at": "2026-'
    log.write_bytes(text)
    _, shown = export("mail", "--results", graded, "--from", "Staff <staff@example.edu>")
    assert "s1 (Student 1, 1, s1@example.edu): was sent on " in shown
    assert "3 messages" in shown
    assert log.read_bytes() == text


def test_a_second_sending_at_the_same_time_is_refused(graded: Path) -> None:
    with FakeSmtp() as server:
        told: list[str] = []

        def again() -> None:
            if not told:
                try:
                    _send(graded, server)
                except UsageError as error:
                    told.append(str(error))

        server.on_taken = again
        assert _send(graded, server)[0] == 0
        assert told == [
            f"{graded}: this class is in use right now: grade-class or `nightly` grades it, another `export mail` "
            "sends it, or a desk writes its files; wait for the end of that"
        ]
        assert _to(server) == _ALL


def test_a_sender_that_the_server_does_not_want_ends_it(graded: Path) -> None:
    with FakeSmtp(Mischief(sender="553 not yours")) as server:
        with pytest.raises(
            UsageError, match=r"--from staff@example.edu: the server takes nothing from this sender: 553 no"
        ):
            _send(graded, server)
        assert not server.taken


def test_a_server_that_refuses_all(graded: Path, tmp_path: Path) -> None:
    roster = "".join(f"{at},S{at},a{at}@example.edu,s1\n" for at in range(20))
    graded = grade(tmp_path, roster, s1="// points 1\n")
    refused = {f"a{at}@example.edu": "450 too many today" for at in range(20)}
    with FakeSmtp(Mischief(refused)) as server:
        with pytest.raises(UsageError, match=r"refused 8 messages in a row\. 0 messages sent"):
            _send(graded, server)
        assert sum("RCPT" in line for line in server.heard) == 8


def test_a_message_that_the_server_finds_too_large(graded: Path) -> None:
    with FakeSmtp(size=20_000) as server:
        code, text = _send(graded, server)
        assert (code, _to(server)) == (1, [])
        assert "s1@example.edu (s1): the server takes 20.0 kB at most, and this has " in text
        assert not any("RCPT" in line for line in server.heard)


def test_lines_that_are_a_dot_and_large_reports_arrive_whole(graded: Path, tmp_path: Path) -> None:
    page = graded / "submissions" / "s1" / "report.html"
    page.write_bytes(page.read_bytes() + b"." * 3_000_000)
    template = tmp_path / "mail.txt"
    template.write_text("Subject: x\n\n.\n..\n.text\nFrom here on\n")
    with FakeSmtp() as server:
        assert _send(graded, server, "--only", "s1", "--template", str(template))[0] == 0
        message = email.message_from_bytes(server.taken[0].data, policy=email.policy.default)
    assert isinstance(message, EmailMessage)
    body = message.get_body(("plain",))
    assert body is not None
    assert body.get_content().splitlines() == [".", "..", ".text", "From here on"]
    [part] = message.iter_attachments()
    assert part.get_payload(decode=True) == page.read_bytes()


@pytest.mark.parametrize("by_desk", [False, True])
def test_a_class_that_is_being_graded_or_written_is_not_sent(graded: Path, by_desk: bool) -> None:
    with FakeSmtp() as server, (graded / LOCK).open("a") as file:
        assert try_lock(file.fileno(), shared=by_desk)
        with pytest.raises(UsageError, match=r"this class is in use right now: .*`nightly` .* desk writes its files"):
            _send(graded, server)
        assert server.connections == 0


def test_a_folder_that_is_no_class(tmp_path: Path) -> None:
    with FakeSmtp() as server:
        with pytest.raises(UsageError, match="is not there; --results wants the folder that grade-class wrote"):
            _send(tmp_path / "nowhere", server)
        with pytest.raises(UsageError, match=r"holds no results\.csv; --results wants the folder"):
            _send(tmp_path, server)


def test_the_rate(graded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    waited: list[float] = []
    monkeypatch.setattr("raysteps.exports.smtp.time.sleep", waited.append)
    with FakeSmtp() as server:
        _send(graded, server, "--per-minute", "120")
    assert waited == [0.5] * 3


# What keeps a message from being read on its way, and from going to somebody else's server.


@pytest.fixture(scope="module")
def certificate(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, ssl.SSLContext]:
    folder = tmp_path_factory.mktemp("tls")
    key, made = folder / "key.pem", folder / "cert.pem"
    words = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "36500", "-subj", "/CN=localhost"]
    names = ["-addext", "subjectAltName=DNS:localhost", "-keyout", str(key), "-out", str(made)]
    try:
        subprocess.run([*words, *names], check=True, capture_output=True)
    except FileNotFoundError:
        pytest.skip("openssl is not installed")
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(made, key)
    return made, context


def _send_secured(graded: Path, place: str, *words: str) -> int:
    start = ("mail", "--results", graded, "--from", "staff@example.edu", "--send", "--per-minute", 6000)
    return export(*start, "--smtp", place, *words)[0]


def test_starttls_comes_before_the_password(
    graded: Path, certificate: tuple[Path, ssl.SSLContext], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SSL_CERT_FILE", str(certificate[0]))
    monkeypatch.setenv(PASSWORD, "a secret")
    with FakeSmtp(context=certificate[1]) as server:
        assert _send_secured(graded, server.place.replace("127.0.0.1", "localhost"), "--user", "staff") == 0
        assert server.logins == [("staff", "a secret", True)]
        assert _to(server) == _ALL
    assert "a secret" not in (graded / LOG).read_text()


def test_a_certificate_of_nobody_is_not_trusted(
    graded: Path, certificate: tuple[Path, ssl.SSLContext], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(PASSWORD, "a secret")
    with FakeSmtp(context=certificate[1]) as server:
        with pytest.raises(UsageError, match=r"its certificate is not to be trusted: .*Nothing was sent"):
            _send_secured(graded, server.place.replace("127.0.0.1", "localhost"), "--user", "staff")
        monkeypatch.setenv("SSL_CERT_FILE", str(certificate[0]))
        with pytest.raises(UsageError, match=r"its certificate is not to be trusted: .*127"):
            _send_secured(graded, server.place, "--user", "staff")
        assert (server.taken, server.logins) == ([], [])


def test_a_wrong_password(graded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(PASSWORD, "a secret")
    with FakeSmtp(Mischief(password_answer="535 5.7.8 bad")) as server:
        with pytest.raises(UsageError, match=r"refuses the name staff with this password: 535 5.7.8 bad") as caught:
            _send(graded, server, "--user", "staff")
        assert "a secret" not in str(caught.value)
        assert not server.taken


def test_a_password_does_not_travel_in_the_clear(graded: Path) -> None:
    with pytest.raises(UsageError, match=r"the password would travel in the clear to mail.example.edu"):
        _send_secured(graded, "mail.example.edu:25", "--security", "none", "--user", "staff")
    with pytest.raises(UsageError, match=f"no password; set the variable {PASSWORD}"):
        _send_secured(graded, "mail.example.edu", "--user", "staff")


def _closed_port() -> int:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port: int = free.getsockname()[1]
        return port


@pytest.mark.parametrize(
    ("place", "told"),
    [
        (lambda: f"127.0.0.1:{_closed_port()}", "no server listens there; is the port right"),
        (lambda: "no-such-host.invalid:25", "there is no such server, or no network"),
        (lambda: "a b", "is no server; expected HOST or HOST:PORT"),
        (lambda: "host:99999", "is no server; expected HOST or HOST:PORT"),
    ],
)
def test_a_server_that_is_not_there(graded: Path, place: Callable[[], str], told: str) -> None:
    with pytest.raises(UsageError, match=f"--smtp .*: {told}"):
        _send_secured(graded, place(), "--security", "none")
    assert not read_log(graded / LOG).last


def test_a_server_that_speaks_otherwise(graded: Path) -> None:
    with FakeSmtp() as server:
        with pytest.raises(UsageError, match="offers no STARTTLS; try --security tls"):
            _send_secured(graded, server.place)
        with pytest.raises(UsageError, match=r"speaks no TLS as expected .*; try --security starttls"):
            _send_secured(graded, server.place, "--security", "tls")
    with (
        FakeSmtp(Mischief(greeting="554 go away")) as server,
        pytest.raises(UsageError, match="want to talk: 554 go away"),
    ):
        _send_secured(graded, server.place, "--security", "none")


def test_ports() -> None:
    assert parse_server("mail.example.edu", None) == ("mail.example.edu", 587, "starttls")
    assert parse_server("mail.example.edu:465", None) == ("mail.example.edu", 465, "tls")
    assert parse_server("mail.example.edu", "tls") == ("mail.example.edu", 465, "tls")
    assert parse_server("[::1]:2525", "none") == ("::1", 2525, "none")
