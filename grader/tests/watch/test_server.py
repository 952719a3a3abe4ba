"""Who may read the page, and how it hears of news."""

import http.client
import json
import socket
import threading
from collections.abc import Iterator

import pytest

from raysteps.common.errors import UsageError
from raysteps.watch.page_state import PageServer, PageState


@pytest.fixture
def board() -> PageState:
    return PageState({"number": 1, "over": False})


@pytest.fixture
def server(board: PageState) -> Iterator[PageServer]:
    found = PageServer(board, lambda text: f"<p>{text}</p>")
    yield found
    found.close()


def _path(server: PageServer) -> str:
    return "/" + server.address.split("/", 3)[3]


def _ask(server: PageServer, path: str, method: str = "GET", host: str | None = None) -> http.client.HTTPResponse:
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=10)
    connection.request(method, path, headers={} if host is None else {"Host": host})
    return connection.getresponse()


def test_the_page_as_it_is_now(server: PageServer, board: PageState) -> None:
    board.show({"number": 2, "over": False})
    answer = _ask(server, _path(server))
    assert answer.status == 200
    assert answer.read() == b'<p>{"number":2,"over":false}</p>'
    headers = {name.lower(): value for name, value in answer.getheaders()}
    assert headers["content-type"] == "text/html; charset=utf-8"
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["cache-control"] == "no-store"
    assert "python" not in headers["server"].lower()


def test_only_this_machine_can_reach_it(server: PageServer) -> None:
    assert server.address.startswith(f"http://127.0.0.1:{server.port}/")
    with socket.create_connection(("127.0.0.1", server.port)) as connection:
        assert connection.getpeername()[0] == "127.0.0.1"
    with pytest.raises(ConnectionRefusedError), socket.create_connection(("127.0.0.2", server.port), timeout=5):
        pass


def test_an_address_cannot_be_guessed(server: PageServer, board: PageState) -> None:
    token = _path(server).strip("/")
    assert len(token) >= 32
    other = PageServer(board, str)
    assert token not in other.address
    other.close()


_NOTHING = """/ /events /{wrong}/ /{wrong}/events /{token} /{token}/.. /{token}/../ /{token}/etc/passwd /{token}x/
/{token}/events/ /{token}/?a http://127.0.0.1/{token}/ /%2e%2e/ /\xe9/ ///{token}//"""


def test_other_addresses_hold_nothing(server: PageServer) -> None:
    token = _path(server).strip("/")
    for path in _NOTHING.split():
        asked = path.format(token=token, wrong="A" * len(token))
        with socket.create_connection(("127.0.0.1", server.port), timeout=10) as connection:
            connection.sendall(f"GET {asked} HTTP/1.0\r\nHost: localhost\r\n\r\n".encode("latin-1"))
            answer = connection.makefile("rb").read()
        assert answer.split()[1] == b"404", path
        assert b"number" not in answer


def test_other_names_for_this_machine_are_refused(server: PageServer) -> None:
    for host in ("evil.example", "evil.example:80", "127.0.0.1.evil.example", "", "[::1", "10.0.0.1", "0.0.0.0"):
        for path in (_path(server), _path(server) + "events", "/"):
            answer = _ask(server, path, host=host)
            assert answer.status == 403, host
            assert b"number" not in answer.read()


def test_a_forwarded_port_is_welcome(server: PageServer) -> None:
    assert _ask(server, _path(server), host="localhost:8000").status == 200


def test_it_can_only_be_read(server: PageServer) -> None:
    for method in ("POST", "PUT", "DELETE", "OPTIONS", "HEAD", "PATCH", "TRACE"):
        assert _ask(server, _path(server), method).status == 405, method


def test_nonsense_is_survived(server: PageServer) -> None:
    for data in (b"", b"\0\xff\r\n\r\n", b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"A" * 70_000):
        with socket.create_connection(("127.0.0.1", server.port), timeout=10) as connection:
            connection.sendall(data)
    assert _ask(server, _path(server)).status == 200


def _events(answer: http.client.HTTPResponse) -> Iterator[dict[str, object]]:
    for line in answer:
        if line.startswith(b"data: "):
            yield json.loads(line.removeprefix(b"data: "))


def test_news_come_by_themselves_and_the_end_too(server: PageServer, board: PageState) -> None:
    answer = _ask(server, _path(server) + "events")
    assert answer.getheader("Content-Type") == "text/event-stream"
    events = _events(answer)
    assert next(events) == {"number": 1, "over": False}
    board.show({"number": 2, "text": "a\nb", "over": False})
    assert next(events) == {"number": 2, "text": "a\nb", "over": False}
    threading.Thread(target=server.close).start()
    assert next(events) == {"number": 2, "text": "a\nb", "over": True}
    assert list(events) == []


def test_pages_that_were_closed_make_room(server: PageServer, board: PageState) -> None:
    for _ in range(40):
        answer = _ask(server, _path(server) + "events")
        assert answer.status in (200, 503)
        answer.close()
        for number in range(3):
            board.show({"number": number, "over": False})
    for _ in range(100):
        answer = _ask(server, _path(server) + "events")
        board.show({"number": 1, "over": False})
        if answer.status == 200:
            return
    raise AssertionError("there is no room any more")


def test_a_port_that_is_taken(board: PageState, server: PageServer) -> None:
    with pytest.raises(UsageError, match=f"--port {server.port}: the page cannot be served there"):
        PageServer(board, str, server.port)


def test_who_stops_and_begins_again_gets_the_same_port(board: PageState, server: PageServer) -> None:
    answer = _ask(server, _path(server) + "events")
    server.close()
    assert b'"over":true' in answer.read()
    again = PageServer(board, str, server.port)
    assert again.port == server.port
    again.close()
