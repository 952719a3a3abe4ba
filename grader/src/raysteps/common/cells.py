"""Text in a spreadsheet."""

import unicodedata

_FORMULA = "=+-@"


def harmless_cell(text: str) -> str:
    """Text that a spreadsheet would take for a formula, or that begins with a control character, gets a `'`."""
    text = text.replace("\0", "")
    first = unicodedata.normalize("NFKC", text.lstrip())[:1]  # some take the wide forms of these signs, too
    controlled = bool(text) and unicodedata.category(text[0]) in ("Cc", "Cf")
    return f"'{text}" if controlled or (first and first in _FORMULA) else text
