"""A mail server for tests, on this machine: it keeps what it takes, and goes wrong as it is told."""

import base64
import socketserver
import ssl
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from types import TracebackType


@dataclass(frozen=True)
class Taken:
    """A message with its envelope."""

    sender: str
    to: str
    data: bytes


@dataclass
class Mischief:
    """What goes wrong: answers by recipient, and how often the connection is cut."""

    recipients: dict[str, str] = field(default_factory=dict)  # address -> answer to RCPT
    sender: str = ""  # the answer to MAIL
    texts: dict[str, str] = field(default_factory=dict)  # address -> answer to the text
    cut_at: dict[str, int] = field(default_factory=dict)  # word, or `before answer` -> how many times
    greeting: str = "220 here"
    password_answer: str = ""

    def cuts(self, word: str) -> bool:
        left = self.cut_at.get(word, 0)
        self.cut_at[word] = left - 1
        return left > 0


class _Cut(Exception):
    pass


class _Handler(socketserver.StreamRequestHandler):
    server: "FakeSmtp"

    def say(self, text: str) -> None:
        self.wfile.write(f"{text}\r\n".encode())
        self.wfile.flush()

    def handle(self) -> None:
        self.server.connections += 1
        try:
            self.say(self.server.mischief.greeting)
            self._talk()
        except (_Cut, OSError):
            pass

    def _talk(self) -> None:
        sender, to = "", ""
        while line := self.rfile.readline():
            words = line.decode("utf-8", "replace").strip()
            word = words.split(" ")[0].split(":")[0].upper()
            self.server.heard.append(words)
            if self.server.mischief.cuts(word):
                raise _Cut
            match word:
                case "EHLO":
                    self.say("\r\n".join([f"250-{one}" for one in self.server.offers()] + ["250 ok"]))
                case "STARTTLS":
                    self.say("220 go")
                    self._start_tls()
                case "AUTH":
                    self._authenticate(words)
                case "MAIL":
                    sender = words[words.index("<") + 1 : words.index(">")]
                    self.say(self.server.mischief.sender or "250 ok")
                case "RCPT":
                    to = words[words.index("<") + 1 : words.index(">")]
                    self.say(self.server.mischief.recipients.get(to, "250 ok"))
                case "DATA":
                    self.say("354 go")
                    self._take(sender, to)
                case "QUIT":
                    self.say("221 bye")
                    return
                case _:
                    self.say("250 ok")

    def _start_tls(self) -> None:
        assert self.server.context is not None
        self.request = self.server.context.wrap_socket(self.request, server_side=True)
        self.rfile, self.wfile = self.request.makefile("rb"), self.request.makefile("wb")
        self.server.is_secure = True

    def _authenticate(self, words: str) -> None:
        said = base64.b64decode(words.split(" ")[-1]).split(b"\0")
        self.server.logins.append((said[1].decode(), said[2].decode(), self.server.is_secure))
        self.say(self.server.mischief.password_answer or "235 ok")

    def _take(self, sender: str, to: str) -> None:
        lines = []
        while (line := self.rfile.readline()) and line != b".\r\n":
            lines.append(line[1:] if line.startswith(b".") else line)
        if not line:
            raise _Cut
        answer = self.server.mischief.texts.get(to, "250 taken")
        if answer.startswith("2"):
            self.server.taken.append(Taken(sender, to, b"".join(lines)))
        if self.server.on_taken is not None:
            self.server.on_taken()
        if self.server.mischief.cuts("before answer"):
            raise _Cut
        self.say(answer)


class FakeSmtp(socketserver.ThreadingTCPServer):
    """Used as a context manager, on a free port of 127.0.0.1."""

    allow_reuse_address = True
    daemon_threads = True

    def __init__(self, mischief: Mischief | None = None, context: ssl.SSLContext | None = None, size: int = 0) -> None:
        super().__init__(("127.0.0.1", 0), _Handler)
        self.mischief = mischief or Mischief()
        self.context = context
        self.size = size
        self.taken: list[Taken] = []
        self.heard: list[str] = []
        self.logins: list[tuple[str, str, bool]] = []
        self.connections = 0
        self.is_secure = False
        self.on_taken: Callable[[], None] | None = None

    def offers(self) -> list[str]:
        found = ["fake"]
        found += [f"SIZE {self.size}"] if self.size else []
        found += ["STARTTLS"] if self.context is not None and not self.is_secure else []
        found += ["AUTH PLAIN"] if self.context is None or self.is_secure else []
        return found

    @property
    def place(self) -> str:
        return f"127.0.0.1:{self.server_address[1]}"

    def __enter__(self) -> "FakeSmtp":
        self._thread = threading.Thread(target=self.serve_forever, kwargs={"poll_interval": 0.05}, daemon=True)
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.shutdown()
        self.server_close()
        self._thread.join()
