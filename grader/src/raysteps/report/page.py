"""One HTML document with everything inside: its styles, its scripts, its data, a policy that allows nothing else."""

import base64
import hashlib
import io
import json
import re
import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from importlib import resources
from pathlib import Path

import numpy as np
import numpy.typing as npt
from jinja2 import Environment, FileSystemBytecodeCache, PackageLoader, StrictUndefined
from jinja2.bccache import Bucket
from markupsafe import Markup, escape
from PIL import Image

from raysteps import __version__
from raysteps.common.errors import reason
from raysteps.common.files import PNG_SIGNATURE

_UNSAFE = {ord(sign): f"\\u{ord(sign):04x}" for sign in "<>&\u2028\u2029"}
_ENDING = re.compile(r"</|<!--", re.IGNORECASE)


class _Compiled(FileSystemBytecodeCache):
    """Templates are kept as Python keeps its modules: compiled, beside them, where that can be written to."""

    def __init__(self) -> None:
        self._folder = Path(__file__).parent / "templates" / "__pycache__"
        super().__init__(str(self._folder), "%s.jinja")

    def dump_bytecode(self, bucket: Bucket) -> None:
        with suppress(OSError):
            if not sys.dont_write_bytecode:
                self._folder.mkdir(exist_ok=True)
                super().dump_bytecode(bucket)


_CODE = re.compile(r"`([^`\n]+)`")


def coded(text: str) -> Markup:
    """What stands between back-quotes in a message, as code; a filter of the templates. Scripts have one, too."""
    return Markup(_CODE.sub(r"<code>\1</code>", str(escape(text))))  # noqa: S704 - escaped before


@cache
def _environment() -> Environment:
    made = Environment(
        loader=PackageLoader("raysteps.report"),
        bytecode_cache=_Compiled(),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters["coded"] = coded
    return made


@cache
def _static(name: str) -> str:
    """A file that is put inline; what would end its element is a mistake in the file."""
    text = (resources.files("raysteps.report") / "static" / name).read_text(encoding="utf-8")
    found = _ENDING.search(text)
    if found:
        raise ValueError(f"{name} holds '{found[0]}', which ends its element; write it otherwise")
    return text


def _source(texts: Sequence[str]) -> str:
    """These texts and no others, for a directive of the policy."""
    digests = [hashlib.sha256(text.encode()).digest() for text in texts]
    return " ".join(f"'sha256-{base64.b64encode(digest).decode('ascii')}'" for digest in digests) or "'none'"


def _policy(styles: Sequence[str], scripts: Sequence[str], *, connect: bool, module: bool) -> str:
    beside = " 'self' 'wasm-unsafe-eval'" if module else ""
    return "; ".join(
        [
            "default-src 'none'",
            "img-src data: 'self'" if module else "img-src data:",
            f"style-src {_source(styles)}",
            f"script-src {_source(scripts)}{beside}",
            *(["connect-src 'self'"] if connect or module else []),
            *(["worker-src 'self'"] if module else []),
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
    module: str | None = None,
) -> str:
    """The document. `scripts` and `styles` are names in `static`, in their order; `data` is what the scripts find in
    the element `data`; with `connect` the page may ask the server that it came from. `module` is the file beside the
    page that begins its program: then workers, WebAssembly and pictures may come from there, too."""
    sheets = [_static(f"{name}.css") for name in ("base", *styles)]
    programs = [_static(f"{name}.js") for name in scripts]
    shell = {
        "page_title": title,
        "page_version": __version__,
        "page_policy": _policy(sheets, programs, connect=connect, module=module is not None),
        "page_module": module,
        "page_styles": [Markup(sheet) for sheet in sheets],  # noqa: S704 - files of this package
        "page_scripts": [Markup(program) for program in programs],  # noqa: S704
        "page_data": None if data is None else Markup(island(data)),  # noqa: S704 - signs of HTML are escaped
    }
    return _environment().get_template(f"{template}.html.j2").render({**context, **shell})


# Pictures that travel inside a page.

_HEADER = 33  # bytes: the signature and the chunk that holds the size


class NotAPicture(Exception):
    """A file that is no PNG, in words."""


@dataclass(frozen=True)
class PictureData:
    """A picture and its size in pixels."""

    src: str
    width: int
    height: int


def _uri(data: bytes) -> str:
    return "data:image/png;base64," + base64.b64encode(data).decode("ascii")


def picture_data(path: Path) -> PictureData:
    """Of a PNG file; nothing else is put into a page."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise NotAPicture(f"{path}: cannot be read: {reason(error)}") from error
    found = picture_of(data)
    if found is None:
        raise NotAPicture(f"{path}: is not a PNG")
    return found


def picture_of(data: bytes) -> PictureData | None:
    """None where the bytes are no PNG."""
    if not data.startswith(PNG_SIGNATURE) or len(data) < _HEADER or data[12:16] != b"IHDR":
        return None
    return PictureData(_uri(data), int.from_bytes(data[16:20]), int.from_bytes(data[20:24]))


def data_uri(path: Path) -> str:
    """A PNG file as `data:image/png;base64,...`."""
    return picture_data(path).src


def pixel_data(pixels: npt.NDArray[np.uint8]) -> PictureData:
    """Colours, or gray values such as FLIP's, as PNG."""
    data = io.BytesIO()
    Image.fromarray(pixels).save(data, format="PNG", optimize=True)
    return PictureData(_uri(data.getvalue()), pixels.shape[1], pixels.shape[0])


# What a page needs for `<compare-pictures>`; the macro `compare` in templates/compare.html.j2 writes the element.

COMPARE_STYLES = ("compare",)
COMPARE_SCRIPTS = (
    "copy",
    "compare-heat",
    "compare-pixels",
    "compare-camera",
    "compare-paint",
    "compare-tone",
    "compare-histogram",
    "compare-views",
    "compare-controls",
    "compare-words",
    "compare-marks",
    "compare-pointer",
    "compare-keyboard",
    "compare-desk",
    "compare",
)
# The inside of a pixel, in space.
SPACE_SCRIPTS = (
    "space-vectors",
    "space-shapes",
    "space-painter",
    "space-orbit",
    "inspect-record",
    "inspect-space",
    "inspect",
)


# FLIP: where, and how much, a person who switches between two pictures would see them differ.

Pixels = npt.NDArray[np.uint8]


def flip_map(reference: Pixels, mine: Pixels) -> Pixels | None:
    """For each pixel from 0, the same, to 255, as different as can be. None where the package is missing, as it is on
    some systems, or the sizes differ."""
    if reference.shape != mine.shape:
        return None
    try:
        from flip_evaluator import evaluate
    except ImportError:
        return None
    pair = [np.ascontiguousarray(pixels, dtype=np.float32) / 255 for pixels in (reference, mine)]
    errors, _, _ = evaluate(*pair, "LDR", inputsRGB=True, applyMagma=False, computeMeanError=False)
    gray: Pixels = np.rint(np.clip(errors[:, :, 0], 0, 1) * 255).astype(np.uint8)
    return gray
