"""Makes text that came from a student's program safe to show somewhere else."""

import html
import re

from raysteps.common.text import printable, shorten

_UNSEEN = re.compile("[\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff]")
_COMMAND = re.compile(r"^(\s*)::", re.MULTILINE)


def clean(text: str, limit: int = 4000) -> str:
    """Without control characters, signs that turn the writing direction, and halves of surrogates."""
    whole = text.encode("utf-8", "replace").decode("utf-8")
    return shorten(_UNSEEN.sub("", printable(whole)), limit)


def one_line(text: str, limit: int = 200) -> str:
    """For names and titles."""
    return shorten(" ".join(clean(text, limit * 4).split()), limit)


def as_html(text: str, limit: int = 4000) -> str:
    """For places that render HTML."""
    return html.escape(clean(text, limit)).replace("\n", "<br>")


def harmless_log(text: str) -> str:
    """The log of GitHub Actions takes a line that begins with two colons for a command, and `##[` anywhere in it."""
    return _COMMAND.sub(r"\1: :", text).replace("##[", "# #[")
