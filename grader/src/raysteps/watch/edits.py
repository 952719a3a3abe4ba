"""Which functions of a step an edit was about."""

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeVar

from raysteps.course.manifest import Step
from raysteps.course.stubs import tokens

_CLOSING = {"(": ")", "{": "}"}
_QUALIFIERS = {"const", "noexcept"}


def _closed(code: Sequence[str], start: int) -> int:
    """Behind the bracket that closes the one at `start`, or where the code ends."""
    opening, closing, depth = code[start], _CLOSING[code[start]], 0
    for at in range(start, len(code)):
        depth += (code[at] == opening) - (code[at] == closing)
        if depth == 0:
            return at + 1
    return len(code)


def _definitions(code: Sequence[str], name: str) -> Iterator[Sequence[str]]:
    """Parameters and bodies of all functions of that name, such as `Sphere::intersect`."""
    words = tokens(name)
    for at in range(len(code) - len(words)):
        if code[at : at + len(words)] == words and code[at + len(words)] == "(":
            end = _closed(code, at + len(words))
            while end < len(code) and code[end] in _QUALIFIERS:
                end += 1
            if end < len(code) and code[end] == "{":
                yield code[at : _closed(code, end)]


def edited_functions(before: str, after: str, step: Step) -> tuple[str, ...]:
    """The step's functions of which the code is no longer what it was."""
    old, new = tokens(before), tokens(after)
    return tuple(name for name in step.functions if [*_definitions(old, name)] != [*_definitions(new, name)])


Item = TypeVar("Item")


def _is_about(title: str, function: str) -> bool:
    """A function is named in full; a test begins with the function, or with its class."""
    names = (function, function.partition("::")[0])
    return any(title == name or title.startswith((f"{name}:", f"{name} ")) for name in names)


def edited_first(items: Iterable[tuple[str, Item]], functions: Sequence[str]) -> list[Item]:
    """The items with their titles: those about these functions before all others."""
    ordered = sorted(items, key=lambda pair: not any(_is_about(pair[0], name) for name in functions))
    return [item for _, item in ordered]
