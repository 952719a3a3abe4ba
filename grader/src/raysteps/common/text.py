"""Small helpers for text."""

import math
import re
import unicodedata
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console

# Signs that turn the writing direction, that take no room, or that are halves of surrogates.
_UNSEEN = re.compile(
    "[\u00ad\u034f\u061c\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b\u200e\u200f\u2028-\u202e\u2060-\u206f\u3164\ufe00-\ufe0f"
    "\ufeff\uffa0\ufff0-\ufffb\U0001bca0-\U0001bca3\U0001d173-\U0001d17a\U000e0000-\U000e0fff\ud800-\udfff]"
    "|(?<![\u0600-\u1fff])[\u200c\u200d]"  # which belong to the spelling in Persian and Hindi
)
_CONTROL = re.compile(r"\x1b\[[0-9;?]*[ -/]*[@-~]|[\x00-\x08\x0b-\x1f\x7f-\x9f]")
_BLANKS = str.maketrans("\n\t", "  ")


def _bare(text: str) -> str:
    return _CONTROL.sub("", text.replace("\r\n", "\n").replace("\r", "\n"))


def printable(text: str) -> str:
    """Without control characters, so that a program's output cannot steer a terminal. Signs that nobody sees are named:
    none of them makes another text of the same looks."""
    return _UNSEEN.sub(lambda found: f"⟨U+{ord(found[0]):04X}⟩", _bare(text))


def one_line(text: str) -> str:
    """The same in one line, for names."""
    return printable(text).translate(_BLANKS)


_COMMAND = re.compile(r"(^|[\r\n])([^\S\r\n]*)::")  # a lone \r ends a line there, too


def harmless_log(text: str) -> str:
    """The log of GitHub Actions takes a line that begins with two colons for a command, and `##[` anywhere in it."""
    return _COMMAND.sub(r"\1\2: :", text).replace("##[", "# #[")


def visible_text(text: str) -> str:
    """Without control characters, and without signs that nobody sees."""
    return _UNSEEN.sub("", _bare(text))


MAX_FOUND = 80  # characters that are told of a value that does not fit


def shorten(text: str, limit: int = 2000) -> str:
    """At most that many characters."""
    return text if len(text) <= limit else text[: limit - 4] + " ..."


def first_line(text: str) -> str:
    """Of a fault: the rest stands in fault.txt."""
    return shorten(printable(text).split("\n", 1)[0], 300)


def clean(text: str, limit: int = 4000) -> str:
    """Without control characters, signs that nobody sees, and halves of surrogates."""
    return shorten(visible_text(text.encode("utf-8", "replace").decode("utf-8")), limit)


def join_and(words: Sequence[str]) -> str:
    """`a`, `a and b` or `a, b and c`."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def join_some(words: Sequence[str], most: int) -> str:
    """The same of the first `most`, and how many more there are: `a, b and 3 more`."""
    more = len(words) - most
    return join_and([*words[:most], *([f"{more} more"] if more > 0 else [])])


_LETTER = re.compile(r"LATIN SMALL LETTER ([A-Z]) WITH ")


@cache
def plain_letters() -> dict[str, str]:
    """What people without such keys type for letters that do not decompose: `ł` is `l`, `ß` is `ss`."""
    found = {"ß": "ss", "æ": "ae", "œ": "oe", "þ": "th", "ð": "d", "\u0131": "i", "ŋ": "n", "ə": "e"}
    for letter in map(chr, range(0xC0, 0x250)):
        named = _LETTER.match(unicodedata.name(letter, ""))
        if named is not None and len(unicodedata.normalize("NFKD", letter)) == 1:
            found[letter] = named[1].lower()
    return found


def searchable(text: str) -> str:
    """As the script `class-filter` makes what is searched for: no capitals, no accents, no letters that only some
    keyboards have."""
    letters = unicodedata.normalize("NFKD", text.lower())
    bare = (letter for letter in letters if unicodedata.category(letter) != "Mn")
    return "".join(plain_letters().get(letter, letter) for letter in bare)


_BETWEEN_WORDS = re.compile(r"[\W_]+")
_NUMBER = re.compile("0*([0-9]+)")


def name_order(text: str) -> str:
    """By this people look for names in a list: `bob` before `Fay_Wu`, `s2` before `s10`, `Éva` beside `Eva`."""
    words = _BETWEEN_WORDS.sub(" ", searchable(text)).strip()
    return _NUMBER.sub(lambda found: f"{len(found[1]):03}{found[1]}", words) + f"\n{text}"


_ALIKE = 0.65  # of three letters two in their order are enough, of five not three


def nearest(word: str, known: Iterable[str]) -> str | None:
    """What may have been meant. Dashes, which all options share, liken none."""
    from difflib import get_close_matches  # rarely

    names = {name.lstrip("-"): name for name in known}
    return next((names[one] for one in get_close_matches(word.lstrip("-"), names, 1, _ALIKE)), None)


def belongs_above(key: str) -> str:
    """Of a key that stands in a table and is none of its own, as TOML takes what comes after a line in brackets."""
    return f"`{key} = ...` belongs above the first line in brackets"


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """`nearest` as the end of a sentence, or nothing."""
    name = nearest(word, known)
    return "" if name is None else f"; did you mean {name}?"


def number(value: float) -> str:
    """12 rather than 12.0, 12.5 rather than 12.50."""
    return f"{value:.2f}".rstrip("0").rstrip(".")


def tenths(value: float) -> str:
    """Whole, or with one decimal, and never more than there are: `10`, `7.5`."""
    return number(math.floor(value * 10 + 1e-6) / 10)


def signed(change: float, told: Callable[[float], str] = number) -> str:
    """`+2`, `0`, or 2 after a minus sign that is as wide as the plus. `told`: how its size is written."""
    sign = "+" if change > 0 else "\N{MINUS SIGN}" if change < 0 else ""
    return f"{sign}{told(abs(change))}"


def apportion(total: int, weights: Sequence[float]) -> list[int]:
    """Whole numbers that sum to the total, as near to the weights as can be: the largest remainders are rounded up."""
    whole = sum(weights)
    exact = [round(total * weight / whole, 9) if whole else 0.0 for weight in weights]  # ties are ties
    parts = [int(value) for value in exact]
    order = sorted(range(len(parts)), key=lambda index: parts[index] - exact[index])
    for index in order[: total - sum(parts)]:
        parts[index] += 1
    return parts


def in_seconds(amount: float) -> str:
    """`1 second`, `2.5 seconds`."""
    return f"{number(amount)} second" if amount == 1 else f"{number(amount)} seconds"


def count(amount: int, noun: str) -> str:
    """`1 test`, `2 tests`."""
    return f"{amount} {noun}" if amount == 1 else f"{amount} {noun}s"


def size(amount: int) -> str:
    """Of memory: `12.3 kB`, `420 kB`, `7.5 MB`, `137 MB`."""
    value, unit = (amount / 1e3, "kB") if amount < 1_000_000 else (amount / 1e6, "MB")
    return f"{value:.1f} {unit}" if value < 100 else f"{value:.0f} {unit}"


def mean(value: float) -> str:
    """Of counts: `0.25`, `8.3`, `1234`."""
    return f"{value:.2f}" if value < 1 else f"{value:.1f}" if value < 100 else f"{value:.0f}"


# Text in a spreadsheet, and what separates its cells.

DELIMITERS = ",;\t"
FORMULA_SIGNS = "=+-@＝＋－＠﹦﹢﹣﹫⁼⁺⁻₌₊₋﬩⩵⩶"  # noqa: RUF001  # some take the wide forms of these signs, too
_AFTER_SEPARATOR = re.compile(rf"([;\t][^\S\t]*)(?=[{re.escape(FORMULA_SIGNS)}])")


def escape_formula(text: str) -> str:
    """Text that a spreadsheet would take for a formula, or that begins with a control character, gets a `'`.

    So does what follows a semicolon or a tab: where these separate cells, another cell begins there."""
    text = _AFTER_SEPARATOR.sub(r"\1'", text.replace("\0", ""))
    first = text.lstrip()[:1]
    controlled = bool(text) and unicodedata.category(text[0]) in ("Cc", "Cf")
    return f"'{text}" if controlled or (first and first in FORMULA_SIGNS) else text


def unescape_formula(text: str) -> str:
    """Without the `'` at its beginning that keeps a spreadsheet from taking it for a formula."""
    return text[1:] if text.startswith("'") and escape_formula(text[1:]) == text else text


def delimiter_of(text: str) -> str:
    """The one that the first record has most of, outside of quotes."""
    quoted = False
    seen = dict.fromkeys(DELIMITERS, 0)
    for letter in text:
        if letter == '"':
            quoted = not quoted
        elif not quoted and letter in "\r\n":
            break
        elif not quoted and letter in seen:
            seen[letter] += 1
    return max(DELIMITERS, key=lambda one: seen[one])


def print_plain(console: "Console", text: str) -> None:
    """As it is: nothing in it is markup, and only the terminal breaks its lines."""
    console.print(text, markup=False, emoji=False, highlight=False, soft_wrap=True)
