"""Serves the page to this machine's own browser, and to nobody else."""

import secrets
import socket
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import urlsplit

from raysteps.common.errors import UsageError, reason
from raysteps.watch.page_state import News, PageState

_HOSTS = {"127.0.0.1", "localhost"}  # another name that leads here is an attack by DNS rebinding
_HEADERS = {
    "Cache-Control": "no-store",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
}
_SIGN_OF_LIFE_SECONDS = 5.0
_TIMEOUT_SECONDS = 10.0
_FAREWELL_SECONDS = 0.5
_MAX_LISTENERS = 16

MakePage = Callable[[str], str]  # from the state, as JSON, to HTML


class _Server(ThreadingHTTPServer):
    daemon_threads = True
    allow_reuse_address = sys.platform != "win32"  # there it would let another program take the port as well

    def __init__(self, port: int, board: PageState, make_page: MakePage) -> None:
        super().__init__(("127.0.0.1", port), _Handler)
        self.token = secrets.token_urlsafe(24)
        self.board = board
        self.make_page = make_page
        self.listeners = threading.BoundedSemaphore(_MAX_LISTENERS)

    def handle_error(self, request: object, client_address: object) -> None:
        """A browser that goes away in the middle is no news."""


class _Handler(BaseHTTPRequestHandler):
    server: _Server
    timeout = _TIMEOUT_SECONDS
    server_version = "raysteps"
    sys_version = ""

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002  (the name that it has)
        """The terminal belongs to the student."""

    def _head(self, code: int, kind: str, length: int | None = None) -> None:
        self.send_response(code)
        self.send_header("Content-Type", kind)
        if length is not None:
            self.send_header("Content-Length", str(length))
        for name, value in _HEADERS.items():
            self.send_header(name, value)
        self.end_headers()

    def _answer(self, code: int, text: str, kind: str = "text/plain; charset=utf-8") -> None:
        data = text.encode()
        self._head(code, kind, len(data))
        self.wfile.write(data)

    def _host(self) -> str:
        with suppress(ValueError):
            return urlsplit(f"//{self.headers.get('Host', '')}").hostname or ""
        return ""

    def do_GET(self) -> None:
        if self._host() not in _HOSTS:
            self._answer(403, "This page is for the machine that it is made on.\n")
            return
        _, token, *rest = (*self.path.split("/"), "")
        if not secrets.compare_digest(token.encode(), self.server.token.encode()):
            self._answer(404, "There is nothing here. The whole address stands in the terminal.\n")
        elif rest == ["", ""]:
            self._answer(200, self.server.make_page(self.server.board.now().text), "text/html; charset=utf-8")
        elif rest == ["events", ""]:
            self._stream()
        else:
            self._answer(404, "There is nothing here.\n")

    def _refuse(self) -> None:
        self.close_connection = True
        self._answer(405, "This page can only be read.\n")

    do_HEAD = do_POST = do_PUT = do_PATCH = do_DELETE = do_OPTIONS = do_TRACE = do_CONNECT = _refuse  # noqa: N815

    def _stream(self) -> None:
        """Server-sent events: the state now, and whenever it changes."""
        if not self.server.listeners.acquire(blocking=False):
            self._answer(503, "Too many pages are open.\n")
            return
        try:
            self._head(200, "text/event-stream")
            news = self.server.board.now()
            self._tell(news)
            while not news.is_last:
                news = self._wait_for_more(news.version)
                self._tell(news)
        except OSError:
            return  # the browser went away
        finally:
            self.server.listeners.release()

    def _tell(self, news: News) -> None:
        self.wfile.write(f"id: {news.version}\ndata: {news.text}\n\n".encode())
        self.wfile.flush()

    def _wait_for_more(self, version: int) -> News:
        while (found := self.server.board.wait(version, _SIGN_OF_LIFE_SECONDS)) is None:
            self.wfile.write(b": still watching\n\n")
            self.wfile.flush()
        return found


class PageServer:
    """Runs in a thread until it is closed."""

    def __init__(self, board: PageState, make_page: MakePage, port: int = 0) -> None:
        try:
            self._server = _Server(port, board, make_page)
        except (OSError, OverflowError) as error:
            raise UsageError(
                f"--port {port}: the page cannot be served there: {reason(error)}; choose another port"
            ) from error
        self._board = board
        self._thread = threading.Thread(target=self._server.serve_forever, args=(0.1,), daemon=True)
        self._thread.start()

    @property
    def port(self) -> int:
        return int(self._server.server_address[1])

    @property
    def address(self) -> str:
        """Only who knows it can read the page."""
        return f"http://127.0.0.1:{self.port}/{self._server.token}/"

    def close(self) -> None:
        """Open pages hear of it first."""
        self._board.close()
        end = time.monotonic() + _FAREWELL_SECONDS
        for _ in range(_MAX_LISTENERS):
            self._server.listeners.acquire(timeout=max(0.0, end - time.monotonic()))
        self._server.shutdown()
        with suppress(OSError):
            self._server.socket.shutdown(socket.SHUT_RDWR)
        self._server.server_close()
        self._thread.join(2)
