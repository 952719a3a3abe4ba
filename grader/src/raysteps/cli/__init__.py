"""What a person types: one module for each command, and how the words after it are read."""

import argparse
import math
import os
import re
from collections.abc import Iterable, Sequence
from itertools import takewhile
from typing import Any, NoReturn

from raysteps.common.platform import kit_command, own_command
from raysteps.common.text import did_you_mean, join_and

STUDENTS_KIT = "students_kit"  # a default of the parsers there: the project


def add_impl(parser: argparse.ArgumentParser) -> None:
    """`--impl`, where there is a reference to choose."""
    if parser.get_default(STUDENTS_KIT):
        parser.set_defaults(impl="mine")
    else:
        parser.add_argument("--impl", choices=["mine", "reference"], default="mine", help="whose steps (mine)")


# Types of argparse.


def picture_size(least: int, most: int, example: str, word: str) -> str:
    """Once the first three are given: WxH, each side within these limits."""
    found = re.fullmatch(r"([0-9]{1,5})x([0-9]{1,5})", word)
    if found is None or not all(least <= int(side) <= most for side in found.groups()):
        raise argparse.ArgumentTypeError(f"{word}: expected WxH in pixels, each from {least} to {most}, like {example}")
    return word


def square_number(most: int, word: str) -> int:
    """Likewise: how many samples a pixel takes."""
    if not re.fullmatch(r"[0-9]{1,6}", word) or not 1 <= int(word) <= most or math.isqrt(int(word)) ** 2 != int(word):
        raise argparse.ArgumentTypeError(f"{word}: expected a square number from 1 to {most}, like 16")
    return int(word)


def whole_number(least: int, most: float, word: str) -> int:
    """Likewise; `most` may be infinite."""
    if not re.fullmatch(r"[0-9]{1,9}", word) or not least <= int(word) <= most:
        range_ = f"{least} on" if most == math.inf else f"{least} to {most}"
        raise argparse.ArgumentTypeError(f"expected a whole number from {range_}, found '{word}'")
    return int(word)


def port(word: str) -> int:
    if not (word.isascii() and word.isdigit() and int(word) <= 65535):
        raise argparse.ArgumentTypeError(f"{word}: expected a port from 1 to 65535, or 0 for any that is free")
    return int(word)


def _whole_number(word: str) -> int:
    try:
        return int(word)
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"expected a whole number, found '{word}'") from error


def _number(word: str) -> float:
    try:
        return float(word)
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"expected a number such as 0.5, found '{word}'") from error


# The parser, and what it says of words that it cannot use.

_OF_THE_REFERENCE = ("--impl", "--against")
_MISSING = re.compile("the following arguments are required: (?P<all>.+)|one of the arguments (?P<any>.+) is required")
_NO_VALUE = re.compile(r"argument (?P<name>\S+): expected (?:at least )?one argument")


def _any_of(words: Sequence[str]) -> str:
    return " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))


class Parser(argparse.ArgumentParser):
    """Of one command: it refuses what it does not know itself, with its own usage. argparse hands that up to the
    parser of all commands, which knows nothing of it, and asks first for what is missing."""

    example = ""  # what may be typed after the command
    for_steps = ""  # which command is for a step, where this one takes none

    def __init__(self, *words: Any, **options: Any) -> None:
        super().__init__(*words, **options)
        self.register("type", int, _whole_number)
        self.register("type", float, _number)

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        words = args or ()
        if self._subparsers is not None:
            words = words[:1]  # what follows belongs to a command
        options = takewhile(lambda word: word != "--", words)  # what comes after it is none
        self._refuse_unknown(word for word in options if re.fullmatch("--[^ ]+", word))
        if self._subparsers is None:
            self._refuse_paths(takewhile(lambda word: word != "--", words))
        known, left = super().parse_known_args(args, namespace)
        self._refuse_unknown(word for word in left if word.startswith("-"))
        if left:
            self.error(f"'{left[0]}': expected nothing more{self._of_a_step(left)}")
        return known, left

    def _of_a_step(self, words: Sequence[str]) -> str:
        if not self.for_steps or not re.match(r"(?:steps[/\\])?\d", words[0]):
            return ""
        return f"; for a step of yours type: {kit_command(self.for_steps, words[0])}"

    def _get_option_tuples(self, option_string: str) -> Any:
        """What a beginning of an option may mean: two names of one option are no two options."""
        return list({id(found[0]): found for found in super()._get_option_tuples(option_string)}.values())

    def _refuse_unknown(self, words: Iterable[str]) -> None:
        names = self._option_string_actions
        for option in (word.partition("=")[0] for word in words):
            if not any(name.startswith(option) for name in names):  # argparse takes the beginning of one, too
                if option in _OF_THE_REFERENCE and self.get_default(STUDENTS_KIT):
                    self.error(f"{option}: a students' kit has no reference; pictures made with it lie in reference/")
                self.error(f"{option}: there is no such option{did_you_mean(option, names)}")

    def _refuse_paths(self, words: Iterable[str]) -> None:
        """Of what is there and begins as an option does."""
        for word in words:
            if re.match("-[^-]", word) and word[:2] not in self._option_string_actions and os.path.lexists(word):
                self.error(f"{word}: this would be an option; a path that begins with '-' is typed like ./{word}")

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is not None and value not in action.choices:
            known = list(map(str, action.choices))
            meant = did_you_mean(str(value), known)
            expected = "" if meant else f"; expected {_any_of(known)}"
            raise argparse.ArgumentError(action, f"'{value}' is none of its values{meant or expected}")

    def error(self, message: str) -> NoReturn:
        """In the words of the kit, where those of argparse name things only."""
        missing, no_value = _MISSING.fullmatch(message), _NO_VALUE.fullmatch(message)
        if missing is not None:
            shown = [self._shown(name) for name in re.split(", | ", missing["all"] or missing["any"])]
            message = f"expected {join_and(shown) if missing['all'] else _any_of(shown)}{self._such_as()}"
        elif no_value is not None:
            shows_it = not set(no_value["name"].split("/")).isdisjoint(self.example.split())
            message = f"expected {self._shown(no_value['name'])}{self._such_as() if shows_it else ''}"
        super().error(message)

    def _such_as(self) -> str:
        command = f"{own_command()}{self.prog.removeprefix('raysteps')}"
        return f"; such as: {command} {self.example}" if self.example else ""

    def _shown(self, name: str) -> str:
        """An argument as argparse names it in messages: how it is typed, and what it is."""
        for action in self._actions:
            options = "/".join(action.option_strings)
            if name == (options or action.metavar or action.dest):
                word = action.metavar or (action.dest.upper() if options else action.dest)
                typed = f"{action.option_strings[0]} {word}" if options else str(word)
                about = self._get_formatter()._expand_help(action) if action.help else ""
                if action.choices is not None:
                    about = _any_of(list(map(str, action.choices)))
                return f"{typed} ({about})" if about else typed
        return name
