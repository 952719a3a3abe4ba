"""One step of a results.json, made ready for a page. Whatever a student's program may have said is cleaned."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from raysteps.common.text import clean, mean, number, size
from raysteps.kit.manifest import Step
from raysteps.reports.album import Place, Shown
from raysteps.reports.commands import check_command, inspect_command, replay_command
from raysteps.reports.points import parts_of, rest_of
from raysteps.reports.words import HOW_SURE, STATUS_WORDS, percent
from raysteps.results.work import Work

Document = Mapping[str, Any]

_LOG = 20_000  # characters of what the compiler said
_TEXT = 2_000  # of any other text
_HINTS = ("a question", "an idea", "pseudocode")


def diagnosis_view(diagnosis: Document) -> dict[str, Any]:
    """The word before it says how sure one can be."""
    finding = diagnosis["kind"] == "finding"
    lines = (("You see", diagnosis["sees"]), ("Cause", diagnosis["cause"]), ("Hint", diagnosis["hint"]))
    return {
        "sure": HOW_SURE[diagnosis["kind"]].capitalize() + ("" if diagnosis["kind"] == "transformation" else ":"),
        "title": clean(diagnosis["title"]),
        "alike": [clean(other) for other in diagnosis["alike"]],
        "seen_in": "" if finding else ", ".join(clean(name) for name in diagnosis["seen_in"]),
        "lines": [(label, clean(text)) for label, text in lines if text],
    }


def _test(test: Document) -> dict[str, Any]:
    texts = {key: clean(test[key], _TEXT) for key in ("name", "message", "expression", "expanded", "location")}
    return {**texts, "passed": test["passed"], "outcome": test["outcome"]}


def _hidden(item: Document) -> dict[str, Any]:
    groups = [
        {"name": clean(group["name"]), "right": group["right"], "cases": group["cases"]} for group in item["groups"]
    ]
    return {
        "name": clean(item["name"]),
        "passed": item["share"] >= 1,
        "percent": percent(item["share"]),
        "message": clean(item["message"]),
        "case": [
            (label, clean(text, _TEXT))
            for label, text in (("Given", item["given"]), ("Expected", item["expected"]), ("Actual", item["actual"]))
            if text
        ],
        "again": replay_command(clean(item["case"])) if item["case"] else "",
        "groups": [group for group in groups if group["right"] < group["cases"]],
    }


def _work(image: Document) -> list[tuple[str, str, str]]:
    """What the picture cost: what was counted, mine and the reference's."""
    if not image.get("work") or not image.get("reference_work"):
        return []
    mine, reference = Work(**image["work"]), Work(**image["reference_work"])
    return [
        ("surfaces tested per ray", mean(mine.surfaces_per_ray), mean(reference.surfaces_per_ray)),
        ("boxes tested per ray", mean(mine.boxes_per_ray), mean(reference.boxes_per_ray)),
        ("boxes", str(mine.boxes), str(reference.boxes)),
        ("entries in their lists", str(mine.references), str(reference.references)),
        ("memory", size(mine.bytes), size(reference.bytes)),
    ]


def _image(image: Document, step: Step | None, shown: Shown) -> dict[str, Any]:
    wrong, share = image["wrong_share"], image.get("share_tested")
    facts = []
    if wrong is not None:
        facts.append(f"{wrong:.2%} of the pixels are wrong; at most {image['max_wrong']:.2%} may be")
    if share is not None and image["max_share"] is not None:
        facts.append(f"a ray tests {share:.3g} of the objects; at most {image['max_share']:.3g} of them may be tested")
    return {
        "name": clean(image["name"]),
        "scene": clean(image["scene"]),
        "passed": image["passed"],
        "message": clean(image["message"]),
        "facts": facts,
        "shown": shown,
        "files": [clean(image[role]) for role in ("mine", "reference") if image[role]],
        "inspect": inspect_command(image, step),
        "work": _work(image),
    }


def hint_views(hints: Sequence[str]) -> list[dict[str, str]]:
    """Level by level. What is set in columns keeps them; other lines are one paragraph."""
    kinds = _HINTS if len(hints) == len(_HINTS) else [""] * len(hints)
    return [
        {"kind": kind, "text": text.strip("\n"), "form": "code" if re.search(r"\S {2,}\S", text) else "prose"}
        for kind, text in zip(kinds, hints, strict=True)
    ]


def step_view(result: Document, step: Step | None, album: Mapping[Place, Shown]) -> dict[str, Any]:
    """All that the page says of a step."""
    words, tone, sign = STATUS_WORDS[result["status"]]
    parts = parts_of(result, step)
    images = [_image(image, step, album[(result["id"], image["name"])]) for image in result["images"]]
    return {
        "id": result["id"],
        "number": result["id"][:2],
        "title": step.title if step is not None else result["id"][3:].replace("-", " "),
        "status": {"id": result["status"], "words": words, "tone": tone, "sign": sign},
        "points": number(result["points"]),
        "max": number(result["max"]),
        "share": result["points"] / result["max"] if result["max"] else 0.0,
        "bonus": result["bonus"],
        "parts": parts,
        "rest": rest_of(result, parts),
        "messages": [clean(message) for message in result["messages"]],
        "diagnoses": [diagnosis_view(diagnosis) for diagnosis in result.get("diagnoses", ())],
        "tests": [_test(test) for test in result["tests"]],
        "hidden": [_hidden(item) for item in result["hidden"]],
        "images": images,
        "inconsistent": [clean(claim) for claim in result["inconsistent"]],
        "build_log": clean(result["build_log"], _LOG),
        "together": {"passed": result["cumulative"]["passed"], "message": clean(result["cumulative"]["message"])},
        "hints": hint_views(step.hints) if step is not None else [],
        "check": check_command(result["id"]),
    }
