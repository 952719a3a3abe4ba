"""Serves pages to this machine's own browser, and to nobody else."""

import html
import os
import secrets
import signal
import socket
import sys
import tempfile
import threading
import webbrowser
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from types import FrameType
from urllib.parse import unquote, urlsplit

from raysteps.common.errors import UsageError, reason

_HOSTS = {"127.0.0.1", "localhost"}  # another name that leads here is an attack by DNS rebinding
_HEADERS = {
    "Cache-Control": "no-store",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
}
_TIMEOUT_SECONDS = 10.0
HTML = "text/html; charset=utf-8"
JSON = "application/json"


class LocalServer(ThreadingHTTPServer):
    """Its addresses begin with a word that nobody can guess."""

    daemon_threads = True
    allow_reuse_address = sys.platform != "win32"  # there it would let another program take the port as well

    def __init__(self, port: int, handler: type["LocalHandler"]) -> None:
        try:
            super().__init__(("127.0.0.1", port), handler)
        except (OSError, OverflowError) as error:
            raise UsageError(
                f"--port {port}: the page cannot be served there: {reason(error)}; choose another port"
            ) from error
        self.token = secrets.token_urlsafe(24)
        self._thread = threading.Thread(target=self.serve_forever, args=(0.1,), daemon=True)

    def start(self) -> None:
        """In a thread, until it is closed."""
        self._thread.start()

    @property
    def port(self) -> int:
        return int(self.server_address[1])

    @property
    def address(self) -> str:
        """Only who knows it can read the page."""
        return f"http://127.0.0.1:{self.port}/{self.token}/"

    def handle_error(self, request: object, client_address: object) -> None:
        """A browser that goes away in the middle is no news."""

    def close(self) -> None:
        self.shutdown()
        with suppress(OSError):
            self.socket.shutdown(socket.SHUT_RDWR)
        self.server_close()
        self._thread.join(2)


def end_as_interrupted() -> None:
    """From here on, whoever ends this process, or closes its terminal, ends it as Ctrl-C does."""

    def end(_number: int, _frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    for name in ("SIGTERM", "SIGHUP"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), end)


def on_a_desktop(environment: Mapping[str, str] = os.environ, platform: str = sys.platform) -> bool:
    """Whether a browser that is opened here is seen by whoever types here."""
    if "SSH_CONNECTION" in environment or "CI" in environment:
        return False
    return platform in ("darwin", "win32") or any(environment.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY"))


@contextmanager
def shown_in_browser(address: str) -> Iterator[None]:
    """Opens the page. Everybody on a machine can read with which words a program was started, so the browser is given
    the name of a file that leads there, which nobody else can read."""
    with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
        path = Path(folder) / "page.html"
        path.touch(mode=0o600)
        goal = html.escape(address)
        path.write_text(f'<!doctype html><meta http-equiv="refresh" content="0; url={goal}">\n', encoding="utf-8")
        with suppress(webbrowser.Error, OSError):
            webbrowser.open(path.as_uri())
        yield


class LocalHandler(BaseHTTPRequestHandler):
    """Answers to who knows the word, on this machine, by its own name. What is there, and whether anything can be
    written, says a class of it."""

    server: LocalServer
    timeout = _TIMEOUT_SECONDS
    server_version = "raysteps"
    sys_version = ""

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002  (the name that it has)
        """The terminal belongs to who typed the command."""

    def head(self, code: int, kind: str, length: int | None = None, policy: str | None = None) -> None:
        """`policy` is for what brings none with it: a page has its own."""
        self.send_response(code)
        self.send_header("Content-Type", kind)
        if length is not None:
            self.send_header("Content-Length", str(length))
        for name, value in _HEADERS.items():
            self.send_header(name, value)
        if policy is not None:
            self.send_header("Content-Security-Policy", policy)
        self.end_headers()

    def answer(self, code: int, text: str, kind: str = "text/plain; charset=utf-8") -> None:
        data = text.encode()
        self.head(code, kind, len(data))
        self.wfile.write(data)

    def _host(self) -> str:
        with suppress(ValueError):
            return urlsplit(f"//{self.headers.get('Host', '')}").hostname or ""
        return ""

    def place(self) -> list[str] | None:
        """The parts of the address after the word, decoded; None where the question was answered already, with a
        refusal."""
        if self._host() not in _HOSTS:
            self.answer(403, "This page is for the machine that it is made on.\n")
            return None
        _, token, *rest = (*self.path.split("/"), "")
        if not secrets.compare_digest(token.encode(), self.server.token.encode()):
            self.answer(404, "There is nothing here. The whole address stands in the terminal.\n")
            return None
        parts = [unquote(part) for part in rest[:-1]]
        if any("/" in part or part in (".", "..") for part in parts):
            self.nothing()
            return None
        return parts

    def is_from_here(self) -> bool:
        """Whether the page that asks is one of this server's: others must not write, whatever they know."""
        with suppress(ValueError):
            parts = urlsplit(self.headers.get("Origin", ""))
            same = parts.scheme == "http" and parts.hostname in _HOSTS and parts.netloc == self.headers.get("Host")
            return same and self.headers.get("Sec-Fetch-Site", "same-origin") == "same-origin"
        return False

    def nothing(self) -> None:
        self.answer(404, "There is nothing here.\n")

    def do_GET(self) -> None:
        rest = self.place()
        if rest is not None:
            self.get(rest)

    def get(self, rest: list[str]) -> None:
        """[""] is the page itself."""
        self.nothing()

    def do_POST(self) -> None:
        self.post()

    def post(self) -> None:
        """Nothing can be written, unless a class says how."""
        self.refuse()

    def refuse(self) -> None:
        self.close_connection = True
        self.answer(405, "This page can only be read.\n")

    do_HEAD = do_PUT = do_PATCH = do_DELETE = do_OPTIONS = do_TRACE = do_CONNECT = refuse  # noqa: N815
