"""report.html: the results of one submission as a page."""

import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from raysteps.common.files import write_if_changed
from raysteps.common.text import clean, number
from raysteps.kit.manifest import Step
from raysteps.pages.compare import COMPARE_SCRIPTS, COMPARE_STYLES
from raysteps.pages.page import render_page
from raysteps.reports.album import Place, Shown, make_album
from raysteps.reports.points import Part
from raysteps.reports.steps import step_view

REPORT = "report.html"
_MOST = 4_900_000  # bytes: a page that can be sent by mail
_ROOM = 4_300_000  # of them for pictures, unless there is more text than usual
_PARTS = ("tests", "pictures", "hidden", "together")


def _next(steps: Sequence[Mapping[str, Any]]) -> Mapping[str, Any] | None:
    """The first step that is not solved; a bonus only when nothing else is left."""
    unsolved = [step for step in steps if step["status"]["id"] != "passed"]
    return next((step for step in unsolved if not step["bonus"]), unsolved[0] if unsolved else None)


def _total(document: Mapping[str, Any]) -> dict[str, Any]:
    total, bonus = document["total"], document["total"]["bonus"]
    return {
        "points": number(total["points"]),
        "max": number(total["max"]),
        "share": min(1.0, total["points"] / total["max"]) if total["max"] else 0.0,
        "bonus": number(bonus["points"]) if bonus["points"] else "",
        "bonus_max": number(bonus["max"]) if bonus["max"] else "",
    }


def _sums(steps: Sequence[Mapping[str, Any]]) -> dict[str, float]:
    parts: list[Part] = [part for step in steps for part in step["parts"]]
    return {name: sum(part.earned for part in parts if part.name == name) for name in _PARTS}


def student_page(document: Mapping[str, Any], folder: Path, steps: Sequence[Step]) -> str:
    """The page of a results.json whose pictures lie in the folder. It shows what the document holds, and no more."""
    text = _page(document, make_album(document, folder, _ROOM), steps)
    excess = len(text.encode()) - _MOST
    return text if excess <= 0 else _page(document, make_album(document, folder, _ROOM - excess), steps)


def _page(document: Mapping[str, Any], album: Mapping[Place, Shown], steps: Sequence[Step]) -> str:
    known = {step.id: step for step in steps}
    views = [step_view(result, known.get(result["id"]), album) for result in document["steps"]]
    name = clean(document["submission"], 200)
    context = {
        "name": name,
        "steps": views,
        "next": _next(views),
        "total": _total(document),
        "columns": _PARTS,
        "sums": _sums(views),
        "number": number,
        "left_out": sum(shown.left_out for shown in album.values()),
        "facts": {
            "kit": clean(document["kit"], 200),
            "isolation": clean(document["isolation"]["name"], 200),
        },
    }
    styles, scripts = (*COMPARE_STYLES, "parts", "student"), (*COMPARE_SCRIPTS, "student")
    return render_page("student", f"Raysteps: {name}", context, scripts, styles)


def write_student_page(document: Mapping[str, Any], folder: Path, steps: Sequence[Step]) -> Path:
    """Writes FOLDER/report.html."""
    path = folder / REPORT
    write_if_changed(path, student_page(document, folder, steps).encode())
    return path


def try_student_page(folder: Path, steps: Sequence[Step], say: Callable[[str], None]) -> Path | None:
    """Of the results.json that was just written there: the results stand, whatever goes wrong with the page."""
    try:
        document = json.loads((folder / "results.json").read_text(encoding="utf-8"))
        return write_student_page(document, folder, steps)
    except Exception as error:  # a page is not worth a grade
        say(f"no {REPORT}: {error!r}")
        return None
