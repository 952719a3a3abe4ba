"""Text in a spreadsheet, and what separates its cells."""

import re
import unicodedata

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
