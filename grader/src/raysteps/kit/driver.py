"""How compilers are spoken to: those that take the words of GCC, and Microsoft's."""

from collections.abc import Sequence
from typing import TypeVar

from raysteps.kit.description import Description

Word = TypeVar("Word")


def include_words(description: Description, own: Word, others: Sequence[Word]) -> list[str | Word]:
    """Where headers are looked for: the kit's, and those of libraries."""
    words: list[str | Word] = ["-I", own]
    for folder in others:
        words += ["-I" if description.is_msvc else "-isystem", folder]
    return words


def compile_words(description: Description, source: Word, target: Word) -> list[str | Word]:
    """The end of a command that makes an object."""
    return ["-c", source, "-Fo:" if description.is_msvc else "-o", target]


def link_words(description: Description, parts: Sequence[str | Word], target: Word) -> list[str | Word]:
    """A whole command that makes a program. Microsoft's compiler hands on to the linker what comes after -link."""
    if description.is_msvc:
        return [description.compiler, "-nologo", *parts, "-Fe:", target, "-link", *description.link_flags]
    return [description.compiler, *description.link_flags, *parts, "-o", target]
