"""The reports of a class as e-mail: addresses, texts, messages, and one file that holds them all."""

import base64
import email.policy
import hashlib
import json
import mailbox
import os
import re
import tempfile
import uuid
from collections.abc import Iterable, Iterator, Mapping
from contextlib import closing
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from email.headerregistry import Address
from email.message import EmailMessage
from email.utils import format_datetime
from pathlib import Path

from raysteps.common.documents import plain
from raysteps.common.errors import UsageError, reason
from raysteps.common.text import clean, number, size, tenths
from raysteps.exports.autograders import Member, as_zip
from raysteps.exports.give_back import Deliveries, Delivery
from raysteps.exports.items import one_line, title
from raysteps.report.attempts import history_words
from raysteps.report.student import next_step, student_page
from raysteps.report.wording import hand_in_words, review_lines, total_words
from raysteps.results.model import Results, StepResult
from raysteps.results.store import REPORT

# Addresses. A roster may hold anything: what is not one plain address is none.

_ATOM = r"[A-Za-z0-9!#$%&'*+/=?^_`{|}~-]+"
_LOCAL = re.compile(rf"{_ATOM}(?:\.{_ATOM})*")
_LABEL = r"[A-Za-z0-9](?:[A-Za-z0-9-]{0,61}[A-Za-z0-9])?"
_DOMAIN = re.compile(rf"{_LABEL}(?:\.{_LABEL})*")
_MAX_LOCAL, _MAX_ADDRESS = 64, 254
_ENCODED = "=?"  # begins a word that mail programs decode, perhaps into line breaks


def plain_address(text: str) -> str | None:
    """`ann@example.edu`, with the domain as the network has it; None where it is no single address that any server
    takes."""
    local, at, domain = text.strip().rpartition("@")
    try:
        host = domain.encode("idna").decode("ascii") if domain else ""
    except UnicodeError:
        return None
    is_one = bool(at) and _LOCAL.fullmatch(local) and _DOMAIN.fullmatch(host) and _ENCODED not in local
    if not is_one or len(local) > _MAX_LOCAL or len(local) + 1 + len(host) > _MAX_ADDRESS:
        return None
    return f"{local}@{host}"


def header_text(text: str) -> str:
    """One line that is what it looks like: no line break, no sign that turns the writing direction, nothing that a
    mail program would decode."""
    return one_line(text, 120).replace(_ENCODED, "= ?")


def mailbox_of(text: str, option: str) -> Address:
    """`Graphics 101 <graphics@example.edu>`, or the address alone."""
    name, bracket, rest = text.rpartition("<")
    address = plain_address(rest.removesuffix(">") if bracket and rest.endswith(">") else text)
    if address is None:
        raise UsageError(f"{option} {text}: is no address; expected one such as 'Graphics 101 <staff@example.edu>'")
    return Address(header_text(name.strip().strip('"')), addr_spec=address)


# What a message says.

DEFAULT_TEMPLATE = """Subject: {course}: {submission}, your points and the report

Hello {name},

your work has been graded: {points}
{lateness}

{steps}

{review}

{next}

{history}

The report is attached. Save {file} and open it in a browser; it needs no network.
"""
_WORD = re.compile(r"\{([a-z]+)\}")
_WORDS = ("course", "submission", "name", "points", "lateness", "counts", "steps", "review", "next", "history", "file")
_SUBJECT = "Subject:"
_MAX_TEMPLATE = 64 << 10
_MAX_REVIEW = 20_000  # characters: the rest of the message is to be read, too


@dataclass(frozen=True)
class Template:
    """Subject and body, with words in braces that are filled in for each student."""

    subject: str
    body: str


def parse_template(text: str, where: str) -> Template:
    """The first line is the subject; what follows the empty line below it, the body."""
    lines = text.replace("\r\n", "\n").splitlines()
    if not lines or not lines[0].startswith(_SUBJECT) or not lines[0].removeprefix(_SUBJECT).strip():
        raise UsageError(f"{where}:1: expected a line such as 'Subject: {{course}}: your points'")
    if len(lines) < 3 or lines[1].strip():
        raise UsageError(f"{where}:2: expected an empty line after the subject, and then the text")
    for at, line in enumerate(lines, start=1):
        for word in _WORD.findall(line):
            if word not in _WORDS:
                known = ", ".join(f"{{{one}}}" for one in _WORDS)
                raise UsageError(f"{where}:{at}: {{{word}}} is not known; known are {known}")
    return Template(lines[0].removeprefix(_SUBJECT).strip(), "\n".join(lines[2:]))


def read_template(path: Path | None) -> Template:
    """That of a file; the kit's own where none is named."""
    if path is None:
        return parse_template(DEFAULT_TEMPLATE, "the template")
    try:
        data = path.read_bytes()
        if len(data) > _MAX_TEMPLATE:
            raise UsageError(f"{path}: is larger than {_MAX_TEMPLATE >> 10} KB; expected the text of a message")
        return parse_template(data.decode("utf-8-sig"), str(path))
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"{path}: the template cannot be read: {reason(error)}") from error


def _step_line(result: StepResult, known: Mapping[str, str]) -> str:
    return f"{known[result.id]}: {tenths(result.points)} of {tenths(result.max)}, {result.shown.words}"


def _review_words(results: Results, known: Mapping[str, str]) -> str:
    """What people said, of the submission and then of each step; the report shows the code beside it."""
    lines = review_lines(results.review, whole=True, code=False)
    for step in results.steps:
        lines += [f"{known[step.id]}: {line}" for line in review_lines(step.review, code=False)]
    return clean("\n".join(lines), _MAX_REVIEW)


def _next_words(results: Results, known: Mapping[str, str]) -> str:
    """What to do first, and what is known to be wrong there."""
    following = next_step(results.steps)
    if following is None:
        return "All of it is right. There is nothing left to do." if results.steps else ""
    said = f"What to do next: {known[following.id]}, which is {following.shown.words}."
    if following.status == "not-started" and not following.not_taken:
        said = f"What to do next: begin {known[following.id]}."
    found = following.diagnoses[0] if following.diagnoses else None
    if found is None:
        return said
    text = one_line(found.title, 400)
    return f"{said} {text}" if found.kind == "finding" else f"{said} This is what one gets when {text}."


def template_values(delivery: Delivery, deliveries: Deliveries, file: str) -> dict[str, str]:
    """What the words of a template stand for. Text that came from elsewhere is only text."""
    student, results = delivery.student, delivery.results
    steps = {step.id: step for step in deliveries.steps}
    known = {result.id: one_line(title(result, steps)) for result in results.steps}
    late = hand_in_words(replace(results, course=""))
    return {
        "course": one_line(results.course or deliveries.course or "Raysteps"),
        "submission": one_line(student.submission),
        "name": one_line(student.name or student.id or student.email),
        "points": f"{total_words(results.total)}.",
        "lateness": "\n".join(clean(line, 1000) for line in late),
        "counts": number(student.points) if student.points is not None else "",
        "steps": "\n".join(_step_line(result, known) for result in results.steps),
        "review": _review_words(results, known),
        "next": _next_words(results, known),
        "history": "\n".join(history_words(results, known)),
        "file": file,
    }


def fill_template(text: str, found: Mapping[str, str]) -> str:
    """A line that holds nothing but words for which there is nothing to say goes away. What is put in is not read
    again."""
    lines = []
    for line in text.splitlines():
        words = _WORD.findall(line)
        if words and not any(found[word] for word in words) and not _WORD.sub("", line).strip():
            continue
        lines.append(_WORD.sub(lambda word: found[word[1]], line))
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines)).strip() + "\n"


# Messages.

_POLICY = email.policy.SMTP.clone(cte_type="7bit")  # any server takes it
_BASE64 = 4 / 3 * 78 / 76  # base64, in lines
_SPARE = 2000  # bytes of headers that belong to an attachment


@dataclass(frozen=True)
class MailOptions:
    """How messages are made."""

    sender: Address
    reply_to: Address | None
    template: Template
    max_bytes: int
    zipped: bool = False


@dataclass(frozen=True)
class Message:
    """One that is ready to be sent."""

    delivery: Delivery
    address: str
    subject: str
    data: bytes  # as it travels
    attachment: str
    digest: str  # of what it tells; another one when the result has changed
    note: str = ""  # what was done to make it fit

    @property
    def key(self) -> tuple[str, str]:
        return self.delivery.student.submission, self.address


# What another download and another grading of the same may change. Of lateness the points that are left stay.
_PASSING = {"seconds", "timing", "kit", "version", "isolation", "submitted_at", "by_file", "deadline", "words"}


def _lasting(document: object) -> object:
    """Without what another grading of the same would write otherwise."""
    if isinstance(document, dict):
        return {key: _lasting(value) for key, value in document.items() if key not in _PASSING}
    return [_lasting(value) for value in document] if isinstance(document, list) else document


def digest_of(results: Results) -> str:
    """Tells whether a student would read something new."""
    text = json.dumps(_lasting(plain(results)), sort_keys=True)
    return hashlib.sha256(text.encode("utf-8", "replace")).hexdigest()


def _attached(message: EmailMessage, page: bytes, *, zipped: bool) -> bytes:
    """The whole message as it travels. The library takes a second for an attachment of some megabytes, so it gets a
    mark in its place."""
    data = as_zip([Member(REPORT, page)]) if zipped else page
    kind = ("application", "zip") if zipped else ("text", "html")
    message.add_attachment(b"", maintype=kind[0], subtype=kind[1], filename=_file(zipped=zipped))
    part = next(iter(message.iter_attachments()))
    mark = f"@@{uuid.uuid4().hex}@@"
    part.set_payload(f"{mark}\n")
    if not zipped:
        part.set_param("charset", "utf-8")
    before, after = message.as_bytes().split(f"{mark}\r\n".encode())
    return before + base64.encodebytes(data).replace(b"\n", b"\r\n") + after


def _file(*, zipped: bool) -> str:
    return "report.zip" if zipped else REPORT


def _text_message(delivery: Delivery, deliveries: Deliveries, options: MailOptions, address: str) -> EmailMessage:
    found = template_values(delivery, deliveries, _file(zipped=options.zipped))
    message = EmailMessage(_POLICY)
    message["Subject"] = header_text(fill_template(options.template.subject, found))
    message["From"] = options.sender
    message["To"] = Address(header_text(delivery.student.name), addr_spec=address)
    if options.reply_to is not None:
        message["Reply-To"] = options.reply_to
    message["Date"] = format_datetime(datetime.now(UTC))
    named = f"{delivery.student.submission}\0{address}\0{digest_of(delivery.results)}"
    own = hashlib.sha256(named.encode("utf-8", "replace")).hexdigest()[:40]
    message["Message-ID"] = f"<{own}@{options.sender.domain}>"  # whoever gets it twice, sees it once
    message["Auto-Submitted"] = "auto-generated"  # nobody's holiday answers it
    message.set_content(clean(fill_template(options.template.body, found), 40_000), cte="quoted-printable")
    return message


def compose(delivery: Delivery, deliveries: Deliveries, options: MailOptions) -> Message | str:
    """The message, or why there is none. A report that is too large comes without some of its pictures."""
    address = plain_address(delivery.student.email)
    if address is None:
        shown = one_line(delivery.student.email)
        return (
            f"'{shown}' is no e-mail address" if shown else "no e-mail address: expected the column email in a roster"
        )
    page, note = delivery.report_bytes(), ""
    message = _text_message(delivery, deliveries, options, address)
    bare = len(message.as_bytes())
    data = _attached(message, page, zipped=options.zipped)
    if len(data) > options.max_bytes:
        was = size(len(data))
        most = int((options.max_bytes - bare - _SPARE) / _BASE64)
        page = student_page(delivery.results, delivery.folder, deliveries.steps, most=most).encode()
        message = _text_message(delivery, deliveries, options, address)
        data = _attached(message, page, zipped=options.zipped)
        if len(data) > options.max_bytes:
            least = size(len(data))
            return f"too large: {was}, and {least} without pictures, of {size(options.max_bytes)}; say --max-size"
        note = f"with fewer pictures, as it would have {was}"
    subject, digest = str(message["Subject"]), digest_of(delivery.results)
    return Message(delivery, address, subject, data, _file(zipped=options.zipped), digest, note)


def messages(deliveries: Deliveries, options: MailOptions) -> Iterator[Message]:
    """One after the other, as a whole class need not fit into memory. Whom no message can be made for goes over to the
    others."""
    for one in deliveries.given:
        made = compose(one, deliveries, options)
        if isinstance(made, str):
            deliveries.leave_out(one, made)
        else:
            yield made


def write_mbox(path: Path, made: Iterable[Message]) -> int:
    """One file that mail programs open as a folder. Says how many messages it holds."""
    amount = 0
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
        os.close(handle)
        temporary = Path(name)
        try:
            with closing(mailbox.mbox(temporary)) as box:
                for message in made:
                    box.add(message.data.replace(b"\r\n", b"\n"))
                    amount += 1
            if amount:
                temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        raise UsageError(f"{path}: cannot be written: {reason(error)}") from error
    return amount


def words_of_template() -> str:
    """For the help."""
    return ", ".join(f"{{{word}}}" for word in _WORDS)
