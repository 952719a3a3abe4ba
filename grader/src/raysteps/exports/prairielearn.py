"""results.json of a PrairieLearn external grader."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from raysteps.common.text import clean, count
from raysteps.exports.data_uris import Album
from raysteps.exports.formats import encoded
from raysteps.exports.points import entries_of
from raysteps.exports.summary import summary, title
from raysteps.exports.wording import one_line
from raysteps.kit.manifest import Step

MAX_BYTES = 1_000_000
_TEXT_LIMITS = (4000, 1000, 200, 60)
_ROOM_FOR_A_NOTE = 200


def score(document: Mapping[str, Any]) -> tuple[float, str]:
    """From 0 to 1, and a note where the bonus would lead above."""
    total = document["total"]
    most = total["max"] or total["bonus"]["max"]
    share = total["points"] / most if most else 0.0
    note = "The bonus leads above 100 %, which PrairieLearn cannot hold: the score is 100 %." if share > 1 else ""
    return min(1.0, round(share, 6)), note


def _tests(document: Mapping[str, Any], steps: Mapping[str, Step], album: Album, limit: int) -> list[dict[str, Any]]:
    tests = []
    for result in document["steps"]:
        for entry in entries_of(result, steps.get(result["id"])):
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


def _without_pictures(
    document: Mapping[str, Any], steps: Mapping[str, Step], limit: int
) -> tuple[dict[str, Any], Album]:
    share, note = score(document)
    album = Album()
    tests = _tests(document, steps, album, limit)
    text = summary(document, steps)
    results = {"gradable": True, "score": share, "message": clean("\n".join(filter(None, [note, text])), 8 * limit)}
    return {**results, "tests": tests}, album


def to_prairielearn(document: Mapping[str, Any], steps: Mapping[str, Step], folder: Path) -> dict[str, Any]:
    """Pictures are shrunk, then left out, until all is below the limit; the texts before that only if they must."""
    for limit in _TEXT_LIMITS:
        results, album = _without_pictures(document, steps, limit)
        room = MAX_BYTES - len(encoded(results)) - _ROOM_FOR_A_NOTE
        if room > 0:
            break
    left_out = album.paste(folder, room)
    if left_out:
        were = "was" if left_out == 1 else "were"
        results["message"] += f"\n{count(left_out, 'picture')} did not fit and {were} left out."
    return results


def not_gradable(why: str) -> dict[str, Any]:
    """No score, and no attempt used up."""
    text = clean(why)
    return {"gradable": False, "message": text, "format_errors": [text]}
