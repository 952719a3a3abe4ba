"""Serves the page of `watch`, and tells it news."""

import threading
import time
from collections.abc import Callable

from raysteps.common.local_server import HTML, LocalHandler, LocalServer
from raysteps.watch.page_state import News, PageState

_SIGN_OF_LIFE_SECONDS = 5.0
_FAREWELL_SECONDS = 0.5
_MAX_LISTENERS = 16

MakePage = Callable[[str], str]  # from the state, as JSON, to HTML


class PageServer(LocalServer):
    """Runs in a thread until it is closed."""

    def __init__(self, board: PageState, make_page: MakePage, port: int = 0) -> None:
        super().__init__(port, _Handler)
        self.board = board
        self.make_page = make_page
        self.listeners = threading.BoundedSemaphore(_MAX_LISTENERS)
        self.start()

    def close(self) -> None:
        """Open pages hear of it first."""
        self.board.close()
        end = time.monotonic() + _FAREWELL_SECONDS
        for _ in range(_MAX_LISTENERS):
            self.listeners.acquire(timeout=max(0.0, end - time.monotonic()))
        super().close()


class _Handler(LocalHandler):
    server: PageServer

    def get(self, rest: list[str]) -> None:
        if rest == [""]:
            self.answer(200, self.server.make_page(self.server.board.now().text), HTML)
        elif rest == ["events"]:
            self._stream()
        else:
            self.nothing()

    def _stream(self) -> None:
        """Server-sent events: the state now, and whenever it changes."""
        if not self.server.listeners.acquire(blocking=False):
            self.answer(503, "Too many pages are open.\n")
            return
        try:
            self.head(200, "text/event-stream")
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
