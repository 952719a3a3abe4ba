"""What attacks look for: a secret in several places, and sockets that somebody listens to."""

import os
import secrets
import socket
import sqlite3
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from raysteps.toolchain.kit_artifacts import BuiltKit

VARIABLE = "RAYSTEPS_PLANTED"


class Listener:
    """Sockets on this machine that nobody should reach."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / "socket"
        self.abstract = f"raysteps-{secrets.token_hex(8)}"
        self.heard: list[str] = []
        self._stop = threading.Event()
        self._tcp = socket.create_server(("127.0.0.1", 0))
        self.port = int(self._tcp.getsockname()[1])
        udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        udp.bind(("127.0.0.1", self.port))
        named, nameless = socket.socket(socket.AF_UNIX), socket.socket(socket.AF_UNIX)
        named.bind(str(self.path))
        nameless.bind(f"\0{self.abstract}\0")
        self.path.chmod(0o666)
        for listening in (named, nameless):
            listening.listen()
        self._sockets = {"tcp": self._tcp, "udp": udp, "named": named, "abstract": nameless}
        self._threads = [
            threading.Thread(target=self._listen, args=item, daemon=True) for item in self._sockets.items()
        ]
        for thread in self._threads:
            thread.start()

    def _listen(self, name: str, listening: socket.socket) -> None:
        listening.settimeout(0.2)
        while not self._stop.is_set():
            try:
                if name == "udp":
                    listening.recvfrom(100)
                else:
                    listening.accept()[0].close()
            except TimeoutError:
                continue
            except OSError:
                return
            self.heard.append(name)

    def close(self) -> None:
        self._stop.set()
        for thread in self._threads:
            thread.join()
        for listening in self._sockets.values():
            listening.close()


@dataclass(frozen=True)
class Planted:
    """A secret that lies about in files that all users can read, and in the grader's environment."""

    text: str
    path: Path
    database: Path


@contextmanager
def planted(kit: BuiltKit, folder: Path) -> Iterator[Planted]:
    """Also beside the references of the kit, which must be a copy."""
    text = f"raysteps-secret-{secrets.token_hex(16)}"
    path = folder / "planted-secret.txt"
    database = folder / "class.sqlite"
    for place in (path, kit.folder / path.name, kit.folder / "answers" / path.name, kit.folder / "steps" / path.name):
        place.parent.mkdir(exist_ok=True)
        place.write_text(f"{text}\n", encoding="ascii")
        place.chmod(0o644)
    with sqlite3.connect(database) as connection:
        connection.execute("CREATE TABLE grades (student TEXT, points REAL)")
        connection.execute("INSERT INTO grades VALUES (?, 110)", (text,))
    connection.close()
    os.environ[VARIABLE] = text
    try:
        yield Planted(text, path, database)
    finally:
        del os.environ[VARIABLE]
