"""results.json of a PrairieLearn external grader."""

import base64
import io
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from PIL import Image

from raysteps.common.files import encoded
from raysteps.common.text import clean, count
from raysteps.course.manifest import Step
from raysteps.exports.items import Item, entries_of, one_line, summary, title
from raysteps.results.model import Results, Total

# Pictures that travel inside a JSON document.

_SHRINKINGS = (1, 2, 4)
_MAX_PIXELS = 4096 * 4096
_AROUND = 80  # bytes of JSON around a picture and its label
_ORDER = {"difference": 0, "mine": 1, "reference": 2}
_LABELS = {"difference": "difference, 8 times brighter", "mine": "yours", "reference": "reference"}


def data_uri(path: Path, shrinking: int) -> str | None:
    """The picture as PNG, each side divided by a number; None when there is no such picture."""
    try:
        with Image.open(path, formats=["PNG"]) as picture:
            if picture.width * picture.height > _MAX_PIXELS:
                return None
            size = (max(1, picture.width // shrinking), max(1, picture.height // shrinking))
            pixels = picture.convert("RGB")
    except (OSError, ValueError, Image.DecompressionBombError):
        return None
    data = io.BytesIO()
    (pixels if shrinking == 1 else pixels.resize(size)).save(data, format="PNG", optimize=True)
    return "data:image/png;base64," + base64.b64encode(data.getvalue()).decode("ascii")


@dataclass(frozen=True)
class _Candidate:
    test: dict[str, Any]
    kind: str
    path: str
    passed: bool


@dataclass
class Album:
    """Pictures that would like to come along; those of failed checks come first."""

    _candidates: list[_Candidate] = field(default_factory=list)

    def offer(self, test: dict[str, Any], item: Item) -> None:
        """Takes note of the pictures of a check."""
        self._candidates += [_Candidate(test, kind, path, item.passed) for kind, path in item.pictures]

    def paste(self, folder: Path, room: int) -> int:
        """Puts into the tests what fits into so many bytes, all at one size; tells how many pictures did not."""
        order = sorted(self._candidates, key=lambda one: (one.passed, _ORDER.get(one.kind, 9)))
        for shrinking in _SHRINKINGS:
            uris = [self._read(folder, candidate, shrinking) for candidate in order]
            if sum(len(uri) + _AROUND for uri in uris if uri is not None) <= room:
                break
        left_out = 0
        for candidate, uri in zip(order, uris, strict=True):
            if uri is None:
                continue
            if len(uri) + _AROUND > room:
                left_out += 1
                continue
            room -= len(uri) + _AROUND
            candidate.test.setdefault("images", []).append({"label": _LABELS[candidate.kind], "url": uri})
        return left_out

    @staticmethod
    def _read(folder: Path, candidate: _Candidate, shrinking: int) -> str | None:
        path = (folder / candidate.path).resolve()
        return data_uri(path, shrinking) if path.is_relative_to(folder.resolve()) else None


MAX_BYTES = 1_000_000
_TEXT_LIMITS = (4000, 1000, 200, 60)
_ROOM_FOR_A_NOTE = 200


def score(total: Total) -> tuple[float, str]:
    """From 0 to 1, and a note where the bonus would lead above."""
    most = total.max or total.bonus.max
    share = total.points / most if most else 0.0
    note = "The bonus leads above 100 %, which PrairieLearn cannot hold: the score is 100 %." if share > 1 else ""
    return min(1.0, round(share, 6)), note


def _tests(results: Results, steps: Mapping[str, Step], album: Album, limit: int) -> list[dict[str, Any]]:
    tests = []
    for result in results.steps:
        for entry in entries_of(result, steps.get(result.id)):
            item = entry.item
            test: dict[str, Any] = {
                "name": f"{one_line(title(result, steps))}: {item.name}",
                "points": entry.points,
                "max_points": entry.most,
                "message": clean(item.text, limit),
            }
            tests.append(test)
            album.offer(test, item)
    return tests


def _without_pictures(results: Results, steps: Mapping[str, Step], limit: int) -> tuple[dict[str, Any], Album]:
    share, note = score(results.total)
    album = Album()
    tests = _tests(results, steps, album, limit)
    text = summary(results, steps)
    made = {"gradable": True, "score": share, "message": clean("\n".join(filter(None, [note, text])), 8 * limit)}
    return {**made, "tests": tests}, album


def to_prairielearn(results: Results, steps: Mapping[str, Step], folder: Path) -> dict[str, Any]:
    """Pictures are shrunk, then left out, until all is below the limit; the texts before that only if they must."""
    for limit in _TEXT_LIMITS:
        made, album = _without_pictures(results, steps, limit)
        room = MAX_BYTES - len(encoded(made)) - _ROOM_FOR_A_NOTE
        if room > 0:
            break
    left_out = album.paste(folder, room)
    if left_out:
        were = "was" if left_out == 1 else "were"
        made["message"] += f"\n{count(left_out, 'picture')} did not fit and {were} left out."
    return made


def not_gradable(why: str) -> dict[str, Any]:
    """No score, and no attempt used up."""
    text = clean(why)
    return {"gradable": False, "message": text, "format_errors": [text]}
