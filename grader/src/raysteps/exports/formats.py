"""What other systems take: documents that fit their schemas, and pictures of a size that they can hold."""

import base64
import io
import json
import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any, Literal

import jsonschema
from PIL import Image, ImageDraw, ImageFont

from raysteps.common.errors import GraderFault, UsageError, reason
from raysteps.common.files import encoded, write_out
from raysteps.exports.items import Item

Format = Literal["gradescope", "classroom50", "github-legacy", "autolab", "prairielearn"]


@cache
def _validator(name: Format) -> Any:
    """Of a schema that is one itself: to see that costs more than to check a document."""
    text = files("raysteps.exports").joinpath("schemas", f"{name}.schema.json").read_text(encoding="utf-8")
    schema = json.loads(text)
    kind = jsonschema.validators.validator_for(schema)
    kind.check_schema(schema)
    return kind(schema)


def validate(document: object, name: Format) -> None:
    """A document against the schema is the kit's fault."""
    error = jsonschema.exceptions.best_match(_validator(name).iter_errors(document))
    if error is not None:
        problem = f"{error.json_path}: {error.message[:300]}"
        raise GraderFault(f"the {name} result would break its schema: {problem}")


def write(document: object, name: Format, path: Path) -> None:
    """Checks, then writes."""
    validate(document, name)
    write_out(path, encoded(document))


def remove(path: Path) -> None:
    """What lies where a result is to come, whoever put it there."""
    try:
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        else:
            path.unlink(missing_ok=True)
    except OSError as error:
        raise UsageError(f"{path}: cannot be replaced: {reason(error)}") from error


# The three pictures of a check side by side, so that one picture shows what is wrong.

SIDES = {"mine": "yours", "reference": "the reference's", "difference": "the difference, 8 times brighter"}
_MAX_PIXELS = 4096 * 4096
_GAP = 4
_SMALL = 60  # pixels high: a smaller picture is enlarged by a whole factor
_PAPER, _INK = (255, 255, 255), (32, 32, 32)


def _read(folder: Path, place: str, shrinking: int) -> Image.Image | None:
    """None when there is no such picture in the folder."""
    path = (folder / place).resolve()
    if not path.is_relative_to(folder.resolve()):
        return None
    try:
        with Image.open(path, formats=["PNG"]) as picture:
            if picture.width * picture.height > _MAX_PIXELS:
                return None
            width, height = (max(1, length // shrinking) for length in picture.size)
            pixels = picture.convert("RGB")
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError):
        return None
    if shrinking == 1 and height < _SMALL:
        factor = -(-_SMALL // height)
        return pixels.resize((width * factor, height * factor), Image.Resampling.NEAREST)
    return pixels if shrinking == 1 else pixels.resize((width, height))


def strip(folder: Path, item: Item, shrinking: int = 1) -> tuple[str, Image.Image] | None:
    """What it shows from left to right, and the picture; None where nothing of it is there."""
    places = dict(item.pictures)
    sides = [(said, _read(folder, places[kind], shrinking)) for kind, said in SIDES.items() if kind in places]
    shown = [(said, side) for said, side in sides if side is not None]
    if not shown:
        return None
    width = sum(side.width for _, side in shown) + _GAP * (len(shown) - 1)
    whole = Image.new("RGB", (width, max(side.height for _, side in shown)), _PAPER)
    left = 0
    for _, side in shown:
        whole.paste(side, (left, 0))
        left += side.width + _GAP
    return f"{item.name}: {', '.join(said for said, _ in shown)}", whole


def as_png(picture: Image.Image) -> bytes:
    data = io.BytesIO()
    picture.save(data, format="PNG", optimize=True)
    return data.getvalue()


def contact_sheet(folder: Path, items: Sequence[Item]) -> bytes | None:
    """All pictures of a step below each other, each below its name; None where there is none."""
    strips = [shown for item in items if (shown := strip(folder, item)) is not None]
    if not strips:
        return None
    font = ImageFont.load_default(size=14)
    line = 24
    width = max(int(max(picture.width, font.getlength(said))) for said, picture in strips) + 2 * _GAP
    whole = Image.new("RGB", (width, sum(picture.height + line + _GAP for _, picture in strips)), _PAPER)
    pen, top = ImageDraw.Draw(whole), 0
    for said, picture in strips:
        pen.text((_GAP, top + _GAP), said, font=font, fill=_INK)
        whole.paste(picture, (_GAP, top + line))
        top += line + picture.height + _GAP
    return as_png(whole)


# Pictures that travel inside of a document.

_SHRINKINGS = (1, 2, 4)

Paste = Callable[[str, str], None]  # what takes a picture: its label, and a data: URI


@dataclass
class ImageBudget:
    """Pictures that would like to come along; those of failed checks come first."""

    around: int  # bytes of the document around a picture and its label
    _offered: list[tuple[Item, Paste]] = field(default_factory=list)

    def offer(self, item: Item, paste: Paste) -> None:
        """Takes note of the pictures of a check."""
        if item.pictures:
            self._offered.append((item, paste))

    def fill(self, folder: Path, room: int) -> int:
        """Pastes what fits into so many bytes, all at one size; tells how many did not."""
        order = sorted(self._offered, key=lambda one: one[0].passed)
        for shrinking in _SHRINKINGS:
            made = [(self._labelled(folder, item, shrinking), paste) for item, paste in order]
            known = [(*pair, paste) for pair, paste in made if pair is not None]
            if sum(self._cost(label, uri) for label, uri, _ in known) <= room:
                break
        left_out = 0
        for label, uri, paste in known:
            if self._cost(label, uri) > room:
                left_out += 1
                continue
            room -= self._cost(label, uri)
            paste(label, uri)
        return left_out

    def _cost(self, label: str, uri: str) -> int:
        return len(label.encode()) + len(uri) + self.around

    @staticmethod
    def _labelled(folder: Path, item: Item, shrinking: int) -> tuple[str, str] | None:
        shown = strip(folder, item, shrinking)
        if shown is None:
            return None
        label, picture = shown
        return label, "data:image/png;base64," + base64.b64encode(as_png(picture)).decode("ascii")
