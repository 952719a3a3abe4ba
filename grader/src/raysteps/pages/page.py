"""One HTML document with everything inside: its styles, its scripts, its data, a policy that allows nothing else."""

import base64
import hashlib
import json
import re
from collections.abc import Mapping, Sequence
from functools import cache
from importlib import resources

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

_UNSAFE = {ord(sign): f"\\u{ord(sign):04x}" for sign in "<>&\u2028\u2029"}
_ENDING = re.compile(r"</|<!--", re.IGNORECASE)


@cache
def _environment() -> Environment:
    return Environment(
        loader=PackageLoader("raysteps.pages"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )


@cache
def _static(name: str) -> str:
    """A file that is put inline; what would end its element is a mistake in the file."""
    text = (resources.files("raysteps.pages") / "static" / name).read_text(encoding="utf-8")
    found = _ENDING.search(text)
    if found:
        raise ValueError(f"{name} holds '{found[0]}', which ends its element; write it otherwise")
    return text


def _source(texts: Sequence[str]) -> str:
    """These texts and no others, for a directive of the policy."""
    digests = [hashlib.sha256(text.encode()).digest() for text in texts]
    return " ".join(f"'sha256-{base64.b64encode(digest).decode('ascii')}'" for digest in digests) or "'none'"


def _policy(styles: Sequence[str], scripts: Sequence[str], *, connect: bool) -> str:
    return "; ".join(
        [
            "default-src 'none'",
            "img-src data:",
            f"style-src {_source(styles)}",
            f"script-src {_source(scripts)}",
            *(["connect-src 'self'"] if connect else []),
            "base-uri 'none'",
            "form-action 'none'",
        ]
    )


def island(data: object) -> str:
    """JSON that cannot end the element it stands in."""
    return json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":")).translate(_UNSAFE)


def render_page(
    template: str,
    title: str,
    context: Mapping[str, object],
    scripts: Sequence[str] = (),
    styles: Sequence[str] = (),
    data: object = None,
    connect: bool = False,
) -> str:
    """The document. `scripts` and `styles` are names in `static`, in their order; `data` is what the scripts find in
    the element `data`; with `connect` the page may ask the server that it came from."""
    sheets = [_static(f"{name}.css") for name in ("base", *styles)]
    programs = [_static(f"{name}.js") for name in scripts]
    shell = {
        "page_title": title,
        "page_policy": _policy(sheets, programs, connect=connect),
        "page_styles": [Markup(sheet) for sheet in sheets],  # noqa: S704 - files of this package
        "page_scripts": [Markup(program) for program in programs],  # noqa: S704
        "page_data": None if data is None else Markup(island(data)),  # noqa: S704 - signs of HTML are escaped
    }
    return _environment().get_template(f"{template}.html.j2").render({**context, **shell})
