"""Makes text that came from a student's program safe to show somewhere else."""

import html
import re

from raysteps.common.text import clean, shorten

_COMMAND = re.compile(r"^(\s*)::", re.MULTILINE)


def one_line(text: str, limit: int = 200) -> str:
    """For names and titles."""
    return shorten(" ".join(clean(text, limit * 4).split()), limit)


def as_html(text: str, limit: int = 4000) -> str:
    """For places that render HTML."""
    return html.escape(clean(text, limit)).replace("\n", "<br>")


def harmless_log(text: str) -> str:
    """The log of GitHub Actions takes a line that begins with two colons for a command, and `##[` anywhere in it."""
    return _COMMAND.sub(r"\1: :", text).replace("##[", "# #[")
