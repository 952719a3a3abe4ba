"""`export mail`, `export moodle-feedback` and `export canvas-feedback`: the reports of a class go back to students."""

import argparse
import getpass
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.common.errors import UsageError
from raysteps.common.files import write_out
from raysteps.common.text import clean, count, print_plain, size
from raysteps.exports.give_back import (
    Deliveries,
    Undelivered,
    canvas_zip,
    moodle_zip,
    read_deliveries,
    refuse_nobody,
)
from raysteps.exports.gradebook import MOODLE_COLUMNS, gathered, moodle, read_sheet
from raysteps.exports.mail import (
    MailOptions,
    Message,
    digest_of,
    mailbox_of,
    messages,
    plain_address,
    read_template,
    words_of_template,
    write_mbox,
)
from raysteps.exports.smtp import LOG, MailLog, Sender, Server, open_log, parse_server, read_log, why_not_again

SYSTEMS = ("mail", "moodle-feedback", "canvas-feedback")
PASSWORD = "RAYSTEPS_SMTP_PASSWORD"  # noqa: S105  # the name of a variable
_MB = 1_000_000
_MAX_RATE = 6000.0
_CHECKS_FAILED = 1

# The words after `export`.


def _renamed_column(text: str) -> tuple[str, str]:
    """A heading of a worksheet in another language."""
    kind, _, name = text.partition("=")
    if kind not in MOODLE_COLUMNS or not name.strip():
        raise argparse.ArgumentTypeError(
            f"'{text}': expected KIND=HEADING with KIND one of {', '.join(MOODLE_COLUMNS)}"
        )
    return kind, name.strip()


def add_renamed_columns(parser: argparse.ArgumentParser) -> None:
    """Of a worksheet in another language."""
    parser.add_argument(
        "--column",
        type=_renamed_column,
        action="append",
        default=[],
        metavar="KIND=HEADING",
        help=f"a heading in another language; KIND is one of {', '.join(MOODLE_COLUMNS)}",
    )


def _megabytes(text: str) -> int:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.01 <= value <= 1000:
        raise argparse.ArgumentTypeError(f"'{text}' is not a size; expected megabytes, such as 10")
    return round(value * _MB)


def _rate(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.1 <= value <= _MAX_RATE:
        raise argparse.ArgumentTypeError(f"'{text}' is not a rate; expected messages a minute, such as 30")
    return value


def _add_class(add: argparse.ArgumentParser) -> None:
    add.add_argument("--results", type=Path, required=True, metavar="DIR", help="the output of grade-class")
    add.add_argument(
        "--only", nargs="+", default=[], metavar="WHO", help="these submissions, ids, names or addresses only"
    )


def _add_mail(add: argparse.ArgumentParser) -> None:
    _add_class(add)
    add.add_argument("--from", dest="sender", required=True, metavar="WHO", help="as in 'Graphics 101 <staff@x.edu>'")
    add.add_argument("--reply-to", metavar="WHO", help="where answers go (to the sender)")
    add.add_argument(
        "--template", type=Path, metavar="FILE", help=f"subject and text, with the words {words_of_template()}"
    )
    add.add_argument("--zip", action="store_true", help="attach report.zip, where servers let no HTML through")
    add.add_argument(
        "--max-size", type=_megabytes, default=10 * _MB, metavar="MB", help="of a message (10); else fewer pictures"
    )
    where = add.add_mutually_exclusive_group()
    where.add_argument("--out", type=Path, metavar="FILE", help="write all messages to one mbox file")
    where.add_argument("--send", action="store_true", help="send them; else it is only shown who would get what")
    group = add.add_argument_group("sending")
    group.add_argument("--smtp", metavar="HOST[:PORT]", help="the server that takes mail")
    group.add_argument("--security", choices=["starttls", "tls", "none"], help="tls for port 465, else starttls")
    group.add_argument(
        "--user", default="", metavar="NAME", help=f"to log in with; the password is asked, or {PASSWORD}"
    )
    group.add_argument("--per-minute", type=_rate, default=30.0, metavar="N", help="messages at most (30)")
    group.add_argument("--again", action="store_true", help="also whose result has changed since, or who may have none")


def add_give_back_arguments(systems: "argparse._SubParsersAction[Any]") -> None:
    """The three ways back."""
    _add_mail(systems.add_parser("mail", help="each student's report by e-mail"))
    add = systems.add_parser("moodle-feedback", help="the reports as a zip of feedback files for Moodle")
    _add_class(add)
    add.add_argument("--out", type=Path, required=True, metavar="FILE", help="the zip")
    add.add_argument("--template", type=Path, metavar="FILE", help="the grading worksheet, for the participant numbers")
    add_renamed_columns(add)
    add = systems.add_parser("canvas-feedback", help="the reports as a zip that Canvas takes as comments")
    _add_class(add)
    add.add_argument("--out", type=Path, required=True, metavar="FILE", help="the zip")


# Zips.


def _lines(others: list[Undelivered]) -> list[str]:
    return [f"{who}: {clean(why)}" for who, why in gathered((other.label, other.why) for other in others)]


def _tell_others(others: list[Undelivered]) -> None:
    for line in _lines(others):
        print(f"raysteps: nothing for {line}", file=sys.stderr)


def _write_zip(arguments: argparse.Namespace, console: Console) -> int:
    deliveries = read_deliveries(arguments.results, arguments.only)
    if arguments.system == "moodle-feedback":
        people = None
        if arguments.template is not None:
            book = moodle(read_sheet(arguments.template), dict(arguments.column))
            people = [student.person for student in book.students]
        elif arguments.column:
            raise UsageError("--column names headings of the worksheet; expected --template, too")
        data = moodle_zip(deliveries, people)
    else:
        data = canvas_zip(deliveries)
    _tell_others(deliveries.others)
    refuse_nobody(deliveries, arguments.results)
    write_out(arguments.out, data)
    reports = count(len({one.student.submission for one in deliveries.given}), "report")
    whom = count(len(deliveries.given), "student")
    print_plain(console, f"{arguments.out}: {reports} for {whom}, {size(len(data))}")
    return 0


# Mail.


def _options(arguments: argparse.Namespace) -> MailOptions:
    reply_to = mailbox_of(arguments.reply_to, "--reply-to") if arguments.reply_to else None
    sender = mailbox_of(arguments.sender, "--from")
    return MailOptions(sender, reply_to, read_template(arguments.template), arguments.max_size, arguments.zip)


def _leave_out_sent(deliveries: Deliveries, log: MailLog, *, again: bool) -> list[Undelivered]:
    """Who has it already. Those of whom nobody knows, or whose result has changed, are told to the reader as well."""
    had, given = [], []
    for one in deliveries.given:
        address = plain_address(one.student.email)
        key = (one.student.submission, address or "")
        why = why_not_again(log, key, digest_of(one.results), again=again)
        if why:
            had.append(Undelivered(one.student.label, why))
        else:
            given.append(one)
    deliveries.given = given
    return had


def _print_others(console: Console, heading: str, others: list[Undelivered]) -> None:
    if others:
        console.print(f"\n[bold]{heading}[/bold]")
        for line in _lines(others):
            print_plain(console, f"  {line}")


def _dry_run(arguments: argparse.Namespace, console: Console, deliveries: Deliveries, options: MailOptions) -> int:
    had = _leave_out_sent(deliveries, read_log(arguments.results / LOG), again=arguments.again)
    table = Table()
    for heading in ("to", "submission", "subject", "attached"):
        table.add_column(heading, overflow="fold")
    table.add_column("size", justify="right")
    amount = total = 0
    notes = []
    for one in messages(deliveries, options):
        submission = one.delivery.student.submission
        table.add_row(*map(escape, (one.address, submission, one.subject, one.attachment)), size(len(one.data)))
        amount, total = amount + 1, total + len(one.data)
        notes += [Undelivered(one.address, one.note)] if one.note else []
    if amount:
        console.print(table)
    _print_others(console, "Without some pictures, to stay below --max-size", notes)
    _print_others(console, "Would get nothing", deliveries.others)
    _print_others(console, "Have it already", had)
    console.print(
        f"\nNothing was sent. {count(amount, 'message')}, {size(total)} in all: --send sends, --out FILE writes "
        "an mbox file",
        soft_wrap=True,
        highlight=False,
    )
    return 0


def _write_mbox(arguments: argparse.Namespace, console: Console, deliveries: Deliveries, options: MailOptions) -> int:
    amount = write_mbox(arguments.out, messages(deliveries, options))
    _tell_others(deliveries.others)
    if not amount:
        deliveries.given = []
        refuse_nobody(deliveries, arguments.results)
    print_plain(console, f"{arguments.out}: {count(amount, 'message')}")
    return 0


def _is_here(host: str) -> bool:
    return host in ("localhost", "127.0.0.1", "::1")


def _server(arguments: argparse.Namespace) -> Server:
    if not arguments.smtp:
        raise UsageError("--send: say which server takes the mail with --smtp HOST[:PORT]")
    host, port, security = parse_server(arguments.smtp, arguments.security)
    password = ""
    if arguments.user:
        if security == "none" and not _is_here(host):
            raise UsageError(
                f"--security none: the password would travel in the clear to {host}; expected starttls or tls"
            )
        password = os.environ.get(PASSWORD, "")
        if not password and not sys.stdin.isatty():
            raise UsageError(f"--user {arguments.user}: no password; set the variable {PASSWORD}, or use a terminal")
        password = password or getpass.getpass(f"Password of {arguments.user} at {host}: ")
    return Server(host, port, security, arguments.user, password)


def _say(words: str) -> None:
    print(f"raysteps: {clean(words)}", file=sys.stderr, flush=True)


def _counted(made: Iterator[Message], amount: int) -> Iterator[Message]:
    for at, one in enumerate(made, start=1):
        if one.note:
            _say(f"{one.address}: {one.note}")
        if at % 50 == 0:
            _say(f"{at} of {amount}")
        yield one


_GO_ON = "type the same command again to go on: nobody gets it twice"


def _send(arguments: argparse.Namespace, console: Console, options: MailOptions) -> int:
    if not arguments.results.is_dir():
        read_deliveries(arguments.results)  # which says what is expected there
    with open_log(arguments.results / LOG) as log:
        deliveries = read_deliveries(arguments.results, arguments.only)
        had = _leave_out_sent(deliveries, log, again=arguments.again)
        amount = len(deliveries.given)
        addressed = sum(plain_address(one.student.email) is not None for one in deliveries.given)
        sender = None
        if addressed:
            sender = Sender(_server(arguments), options.sender.addr_spec, log, _say, arguments.per_minute)
            try:
                sender.send(_counted(messages(deliveries, options), amount))
            except KeyboardInterrupt:
                _say(f"{count(sender.outcome.sent, 'message')} sent; {_GO_ON}")
                raise
    return _end(console, deliveries, had, sender)


def _end(console: Console, deliveries: Deliveries, had: list[Undelivered], sender: Sender | None) -> int:
    _print_others(console, "Get nothing", deliveries.others)
    _print_others(console, "Had it already", had)
    if sender is None:
        console.print("\nNothing was sent: there is nobody to whom anything is to be sent", soft_wrap=True)
        return 0
    outcome = sender.outcome
    for heading, lines in (
        ("Refused by the server", outcome.refused),
        ("Nobody knows whether they have it", outcome.unsure),
    ):
        if lines:
            console.print(f"\n[bold]{heading}[/bold]")
        for line in lines:
            print_plain(console, f"  {clean(line)}")
    console.print(f"\n{count(outcome.sent, 'message')} sent, {len(outcome.refused)} refused", highlight=False)
    if outcome.stopped:
        raise UsageError(f"{outcome.stopped}. {count(outcome.sent, 'message')} sent; {_GO_ON}")
    return _CHECKS_FAILED if outcome.refused or outcome.unsure else 0


def give_back(arguments: argparse.Namespace, console: Console) -> int:
    """0 when everything that can be given back was; 1 when the server refused some; 2 when it stopped."""
    if arguments.system != "mail":
        return _write_zip(arguments, console)
    if not arguments.send:
        for option, value in (("--smtp", arguments.smtp), ("--user", arguments.user)):
            if value and arguments.out is not None:
                raise UsageError(f"--out writes a file and sends nothing; leave {option} out")
    options = _options(arguments)
    if arguments.send:
        return _send(arguments, console, options)
    deliveries = read_deliveries(arguments.results, arguments.only)
    if arguments.out is not None:
        return _write_mbox(arguments, console, deliveries, options)
    return _dry_run(arguments, console, deliveries, options)
