"""Keys on Windows, with a console that only says what it is told."""

import importlib
import sys
from queue import Queue
from types import ModuleType, SimpleNamespace

import pytest

from raysteps.watch.events import Event, Key
from raysteps.watch.keyboard import NoKeyboard, find_keyboard


@pytest.fixture
def typed(monkeypatch: pytest.MonkeyPatch) -> "Queue[str]":
    """What a Windows console gives; there is no termios."""
    waiting: Queue[str] = Queue()
    console = SimpleNamespace(kbhit=lambda: not waiting.empty(), getwch=waiting.get)
    monkeypatch.setitem(sys.modules, "msvcrt", console)
    monkeypatch.setitem(sys.modules, "termios", None)
    monkeypatch.setattr("sys.stdin.isatty", lambda: True)
    return waiting


def test_keys_of_a_console(typed: "Queue[str]") -> None:
    events: Queue[Event] = Queue()
    keyboard = find_keyboard(events.put)
    assert type(keyboard).__name__ == "WindowsKeyboard"
    keyboard.start()
    for letter in ("h", "\xe0", "K", "\r", "q"):  # an arrow between two keys
        typed.put(letter)
    assert [events.get(timeout=10) for _ in range(3)] == [Key("h"), Key(" "), Key("q")]
    typed.put("n")
    assert events.get(timeout=10) == Key("n")
    keyboard.close()
    assert events.empty()


def test_where_neither_is_there_are_no_keys(typed: "Queue[str]", monkeypatch: pytest.MonkeyPatch) -> None:
    real = importlib.import_module

    def nothing(name: str, package: str | None = None) -> ModuleType:
        if name == "msvcrt":
            raise ImportError(name)
        return real(name, package)

    monkeypatch.setattr(importlib, "import_module", nothing)
    assert isinstance(find_keyboard(lambda event: None), NoKeyboard)
