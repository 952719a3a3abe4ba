"""Sends messages by SMTP, each once: what was sent is kept beside the grades."""

import contextlib
import json
import os
import re
import smtplib
import socket
import ssl
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal

from raysteps.classroom.database import LOCK
from raysteps.common.documents import Malformed, parse, plain
from raysteps.common.errors import UsageError, reason
from raysteps.common.files import try_lock
from raysteps.common.text import clean, count, size
from raysteps.exports.mail import Message

# What was sent: a line for each thing that happened to a message, the last one counts.

LOG = "mail-sent.jsonl"
State = Literal["sending", "sent", "refused"]


@dataclass(frozen=True)
class LoggedMail:
    """`sending` stays where nobody knows: the text was handed over whole, but the server's answer did not come."""

    at: str
    submission: str
    to: str
    digest: str
    state: State
    answer: str = ""


@dataclass
class MailLog:
    """Of one class. Each line is on the disk before anything else happens."""

    path: Path
    last: dict[tuple[str, str], LoggedMail] = field(default_factory=dict)  # by submission and address

    def note(self, message: Message, state: State, answer: str = "") -> None:
        moment = datetime.now(UTC).isoformat(timespec="seconds")
        one = LoggedMail(moment, *message.key, message.digest, state, answer)
        line = json.dumps(plain(one), ensure_ascii=False) + "\n"
        try:
            with self.path.open("ab") as file:
                file.write(line.encode("utf-8", "replace"))
                file.flush()
                os.fsync(file.fileno())
        except OSError as error:
            raise UsageError(f"{self.path}: cannot be written: {reason(error)}; nothing more is sent") from error
        self.last[message.key] = one


def read_log(path: Path, *, is_ours: bool = False) -> MailLog:
    """A last line of which only a part is there was being written when the power went: nothing was sent before it was
    whole. It goes where the log `is_ours`; else somebody may be writing the rest of it right now."""
    log = MailLog(path)
    try:
        data = path.read_bytes() if path.exists() else b""
        whole = data[: data.rfind(b"\n") + 1]
        if is_ours and whole != data:
            os.truncate(path, len(whole))
    except OSError as error:
        raise UsageError(f"{path}: what was sent cannot be read: {reason(error)}") from error
    for at, line in enumerate(whole.splitlines(), start=1):
        try:
            one = parse(line, LoggedMail)
        except Malformed as error:
            raise UsageError(
                f"{path}:{at}: {error}; expected what `export mail --send` wrote. Mend the line, or move the file away "
                "if everybody may get a message again"
            ) from error
        log.last[one.submission, one.to] = one
    return log


@contextlib.contextmanager
def open_log(path: Path) -> Iterator[MailLog]:
    """Two sendings at a time would send twice, and a grading would change what is sent."""
    try:
        file = (path.parent / LOCK).open("a")
    except OSError as error:
        raise UsageError(f"{path}: cannot be written: {reason(error)}") from error
    with file:
        try:
            is_ours = try_lock(file.fileno())
        except OSError:
            is_ours = True  # a file system without locks
        if not is_ours:
            raise UsageError(
                f"{path.parent}: this class is in use right now: grade-class or `nightly` grades it, another `export "
                "mail` sends it, or a desk writes its files; wait for the end of that"
            )
        yield read_log(path, is_ours=True)


def why_not_again(log: MailLog, key: tuple[str, str], digest: str, *, again: bool) -> str:
    """Empty where the message is to be sent. `again`: also what has changed, and of what nobody knows."""
    one = log.last.get(key)
    if one is None or one.state == "refused":
        return ""
    when = one.at.replace("T", " ").replace("+00:00", " UTC")
    if one.state == "sent" and one.digest == digest:
        return f"was sent on {when}"
    if again:
        return ""
    if one.state == "sent":
        return f"was sent on {when}, and the result has changed since: --again sends the new one"
    return (
        f"may have been sent on {when}: the connection was lost before the server answered. Ask the student or look at "
        "the server; --again sends it once more"
    )


# The server.

Security = Literal["starttls", "tls", "none"]
_PORTS: dict[Security, int] = {"starttls": 587, "tls": 465, "none": 25}
_TIMEOUT = 60.0
_HOST = re.compile(r"(?P<host>\[[0-9A-Fa-f:.]+\]|[^:\s\[\]/@]+)(?::(?P<port>[0-9]{1,5}))?")


@dataclass(frozen=True)
class Server:
    """Where messages go, and who says so."""

    host: str
    port: int
    security: Security
    user: str = ""
    password: str = field(default="", repr=False)
    timeout: float = _TIMEOUT

    @property
    def shown(self) -> str:
        return f"{self.host}:{self.port}"


def parse_server(text: str, security: Security | None) -> tuple[str, int, Security]:
    """`HOST` or `HOST:PORT`; port 465 speaks TLS from the start."""
    found = _HOST.fullmatch(text.strip())
    if found is None or not 0 < int(found["port"] or 1) < 1 << 16:
        raise UsageError(f"--smtp {text}: is no server; expected HOST or HOST:PORT, such as smtp.example.edu:587")
    port = int(found["port"]) if found["port"] else None
    secured: Security = security or ("tls" if port == _PORTS["tls"] else "starttls")
    return found["host"].strip("[]"), port or _PORTS[secured], secured


def _said(code: int, answer: bytes | str) -> str:
    """What a server answered, as one line."""
    text = answer.decode("utf-8", "replace") if isinstance(answer, bytes) else answer
    return f"{code} {' '.join(clean(text, 300).split())}"


class ConnectionLost(Exception):
    """In the middle. What was not handed over whole was not sent; else nobody knows."""

    def __init__(self, why: str, *, handed_over: bool = False) -> None:
        super().__init__(why)
        self.handed_over = handed_over


def _no_connection(server: Server, error: Exception) -> UsageError:
    where = f"--smtp {server.shown}"
    if isinstance(error, ssl.SSLCertVerificationError):
        return UsageError(
            f"{where}: its certificate is not to be trusted: {error.verify_message}. Nothing was sent. Name the server "
            "as its certificate does; the variable SSL_CERT_FILE names certificates that are to be trusted as well"
        )
    if isinstance(error, ssl.SSLError):
        other = "starttls" if server.security == "tls" else "tls"
        return UsageError(f"{where}: speaks no TLS as expected ({error.reason}); try --security {other}")
    if isinstance(error, socket.gaierror):
        return UsageError(f"{where}: there is no such server, or no network")
    if isinstance(error, TimeoutError):
        return UsageError(f"{where}: does not answer within {server.timeout:.0f} seconds; is the port right?")
    if isinstance(error, ConnectionRefusedError):
        return UsageError(f"{where}: no server listens there; is the port right?")
    if isinstance(error, smtplib.SMTPResponseException):
        return UsageError(f"{where}: does not want to talk: {_said(error.smtp_code, error.smtp_error)}")
    if isinstance(error, smtplib.SMTPNotSupportedError):
        return UsageError(f"{where}: offers no STARTTLS; try --security tls, with the port that speaks it")
    return UsageError(f"{where}: is no mail server that can be talked to: {error}")


def _log_in(server: Server, session: smtplib.SMTP) -> None:
    try:
        session.login(server.user, server.password)
    except smtplib.SMTPAuthenticationError as error:
        raise UsageError(
            f"--smtp {server.shown}: refuses the name {server.user} with this password: "
            f"{_said(error.smtp_code, error.smtp_error)}. Nothing was sent. Many providers want a password "
            "that is made for one program"
        ) from error
    except smtplib.SMTPNotSupportedError as error:
        raise UsageError(f"--smtp {server.shown}: asks for no name and password; leave --user out") from error
    except UnicodeError as error:
        raise UsageError("--user or the password holds letters that SMTP cannot carry; expected ASCII") from error


def connect(server: Server) -> smtplib.SMTP:
    """A session that is logged in. No password and no report travels in the clear, unless the user said so."""
    context = ssl.create_default_context()
    session: smtplib.SMTP | None = None
    try:
        if server.security == "tls":
            session = smtplib.SMTP_SSL(server.host, server.port, timeout=server.timeout, context=context)
        else:
            session = smtplib.SMTP(server.host, server.port, timeout=server.timeout)
        session.ehlo_or_helo_if_needed()
        if server.security == "starttls":
            session.starttls(context=context)
            session.ehlo_or_helo_if_needed()
        if server.user:
            _log_in(server, session)
    except (OSError, smtplib.SMTPException) as error:
        if session is not None:
            session.close()
        raise _no_connection(server, error) from error
    except UsageError:
        assert session is not None
        session.close()
        raise
    return session


# One message after the other.

_PIECE = 1 << 16  # bytes: the time limit is for each, not for a large message over a slow line


class _Refused(Exception):
    """By the server; the message was not taken."""


def _command(session: smtplib.SMTP, words: str, wanted: int) -> None:
    code, answer = session.docmd(words)
    if code == 421:  # it closes the connection
        raise ConnectionLost(_said(code, answer))
    if code // 100 != wanted:
        raise _Refused(_said(code, answer))


def _envelope(session: smtplib.SMTP, sender: str, message: Message) -> None:
    most = session.esmtp_features.get("size", "").split(" ")[0]
    if most.isdecimal() and 0 < int(most) < len(message.data):
        raise _Refused(f"the server takes {size(int(most))} at most, and this has {size(len(message.data))}")
    try:
        _command(session, f"MAIL FROM:<{sender}>", 2)
    except _Refused as error:
        raise UsageError(f"--from {sender}: the server takes nothing from this sender: {error}") from error
    _command(session, f"RCPT TO:<{message.address}>", 2)
    _command(session, "DATA", 3)


def _send(session: smtplib.SMTP, sender: str, message: Message, log: MailLog) -> None:
    """The server takes a message when it has read the dot at its end: only from there on is it perhaps sent."""
    try:
        _envelope(session, sender, message)
        text = re.sub(rb"(?m)^\.", b"..", message.data)
        for at in range(0, len(text), _PIECE):
            session.send(text[at : at + _PIECE])
    except (OSError, smtplib.SMTPServerDisconnected) as error:
        raise ConnectionLost(str(error)) from error
    log.note(message, "sending")
    try:
        session.send(b".\r\n")
        code, answer = session.getreply()
    except (OSError, smtplib.SMTPServerDisconnected) as error:
        raise ConnectionLost(str(error), handed_over=True) from error
    said = _said(code, answer)
    if code // 100 != 2:
        log.note(message, "refused", said)
        raise _Refused(said)
    log.note(message, "sent", said)


@dataclass
class SendResult:
    """What became of it."""

    sent: int = 0
    refused: list[str] = field(default_factory=list)
    stopped: str = ""  # why it ended before its end
    unsure: list[str] = field(default_factory=list)


_MAX_LOST, _MAX_REFUSED = 3, 8  # in a row: then the trouble is not that of one message


def _end(session: smtplib.SMTP | None) -> None:
    if session is not None:
        with contextlib.suppress(OSError, smtplib.SMTPException):
            session.quit()


@dataclass
class Sender:
    """Sends at most so many messages a minute, and goes on after a lost connection."""

    server: Server
    address: str
    log: MailLog
    say: Callable[[str], None]
    per_minute: float
    outcome: SendResult = field(default_factory=SendResult)
    _session: smtplib.SMTP | None = None

    def send(self, messages: Iterable[Message]) -> SendResult:
        """Until the end, or until the server takes no more."""
        in_a_row, is_first = 0, True
        try:
            self._session = connect(self.server)
            for message in messages:
                if not is_first:
                    time.sleep(60 / self.per_minute)
                is_first = False
                done = self._one(message)
                in_a_row = 0 if done else in_a_row + 1
                if not self.outcome.stopped and in_a_row >= _MAX_REFUSED:
                    self.outcome.stopped = f"{self.server.shown} refused {in_a_row} messages in a row"
                if self.outcome.stopped:
                    break
        finally:
            _end(self._session)
        return self.outcome

    def _reset(self) -> None:
        if self._session is not None:
            with contextlib.suppress(OSError, smtplib.SMTPException):  # a lost connection shows with the next message
                self._session.rset()

    def _close(self) -> None:
        if self._session is not None:
            self._session.close()
        self._session = None

    def _one(self, message: Message) -> bool:
        """Whether it was sent. One that was not handed over whole when the connection was lost is tried again."""
        label = f"{message.address} ({message.delivery.student.submission})"
        for _ in range(_MAX_LOST):
            try:
                if self._session is None:
                    self._session = connect(self.server)
                _send(self._session, self.address, message, self.log)
            except _Refused as error:
                self.outcome.refused.append(f"{label}: {error}")
                self.say(f"{label}: refused: {error}")
                self._reset()
                return False
            except ConnectionLost as error:
                self._close()
                if error.handed_over:
                    self.outcome.unsure.append(label)
                    self.say(f"{label}: may have been sent; the connection was lost before the server answered")
                    return False
                self.say(f"{label}: the connection was lost; trying again")
            except UsageError as error:
                self.outcome.stopped = str(error)
                return False
            else:
                self.outcome.sent += 1
                self.say(f"{label}: sent")
                return True
        self.outcome.stopped = f"{self.server.shown}: the connection was lost {count(_MAX_LOST, 'time')} in a row"
        return False
