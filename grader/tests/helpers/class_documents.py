"""Class documents that nobody graded: what the page of a class is made from."""

import random
from typing import Any

from raysteps.common.documents import convert
from raysteps.results.class_model import ClassResults

Document = dict[str, Any]

STEPS: list[Document] = [
    {"id": "01-camera-rays", "title": "Camera rays", "points": 10, "bonus": False},
    {"id": "02-intersection", "title": "Intersection", "points": 20, "bonus": False},
    {"id": "03-phong-shading", "title": "Phong shading", "points": 15, "bonus": False},
    {"id": "04-shadows", "title": "Shadows", "points": 10, "bonus": False},
    {"id": "05-reflection", "title": "Reflection", "points": 15, "bonus": False},
    {"id": "06-octree", "title": "Octree", "points": 20, "bonus": False},
    {"id": "07-tone-mapping", "title": "Tone mapping", "points": 10, "bonus": False},
    {"id": "08-refraction", "title": "Refraction", "points": 10, "bonus": True},
    {"id": "09-bvh", "title": "Bounding volumes", "points": 10, "bonus": True},
]
_RUN = {
    "number": 1,
    "started_at": "2026-11-20T18:00:00+00:00",
    "ended_at": "2026-11-20T18:40:00+00:00",
    "state": "complete",
    "kit": "0123456789abcdef",
    "folder": "submissions",
    "shard": "1/1",
    "reused": 0,
    "settings": {"seed": 7, "only": [], "feedback": "full", "limits": {}},
    "results": {"graded": 0, "unreadable": 0, "fault": 0},
}


def result(points: float, most: float, status: str = "") -> Document:
    """Of one step."""
    usual = "passed" if points == most else "partial" if points else "failed"
    return {"points": points, "max": most, "status": status or usual}


def submission(name: str, steps: Document | None = None, **more: Any) -> Document:
    """Graded, unless something else is said."""
    steps = steps or {}
    points = sum(step["points"] for step in steps.values())
    one = {
        "name": name,
        "entry": f"{name}.zip",
        "students": [],
        "status": "graded",
        "points": points,
        "max": 100,
        "run": 1,
        "steps": steps,
        "mistakes": {},
        "seconds": 8.5,
        "final": points,
        "late": None,
        "submitted_at": "",
        "submitted_from": "",
        "outdated": False,
        "before": None,
        "isolation": "bubblewrap",
        "fault": "",
        "note": "",
        "results": f"submissions/{name}/results.json",
    }
    return {**one, **more}


def student(name: str, number: str = "", email: str = "") -> Document:
    return {"id": number, "name": name, "email": email}


def missing(name: str, status: str, **more: Any) -> Document:
    """Without points."""
    nothing = {"points": None, "max": None, "run": None, "final": None, "isolation": "", "results": None}
    return submission(name, status=status, **{**nothing, "seconds": None, **more})


def document(submissions: list[Document], **more: Any) -> ClassResults:
    """A class of these, checked as class.json is."""
    mistakes: dict[tuple[str, str], int] = {}
    for one in submissions:
        for step, titles in one["mistakes"].items():
            for title in titles:
                mistakes[step, title] = mistakes.get((step, title), 0) + 1
    in_order = sorted(mistakes.items(), key=lambda item: (-item[1], item[0]))
    finals = sorted(one["final"] for one in submissions if one["status"] == "graded")

    def named(status: str) -> list[str]:
        return [one["name"] for one in submissions if one["status"] == status]

    made = {
        "schema": "raysteps/class/v1",
        "run": _RUN,
        "runs": [_RUN],
        "steps": STEPS,
        "late_policy": None,
        "submissions": submissions,
        "students_without_submission": [],
        "students_with_several": [],
        "submissions_without_student": [],
        "not_graded": named("not-graded"),
        "faults": named("fault"),
        "unreadable": named("unreadable"),
        "changed": [],
        "outdated": [one["name"] for one in submissions if one["outdated"]],
        "mistakes": [{"step": step, "title": title, "submissions": amount} for (step, title), amount in in_order],
        "gone": [],
        "ignored": [],
        "unknown_extensions": [],
        "statistics": {
            "graded": len(finals),
            "mean": sum(finals) / len(finals) if finals else None,
            "median": finals[len(finals) // 2] if finals else None,
        },
        **more,
    }
    return convert(made, ClassResults, complete=True)


_TITLES = {
    "02-intersection": ["the root behind the eye is taken", "the normal is not of unit length"],
    "03-phong-shading": ["light from behind the surface is added", "the highlight is not limited to the lit side"],
    "04-shadows": ["the shadow ray starts at the surface itself"],
}


def many(amount: int, seed: int = 1) -> ClassResults:
    """A class of that size, in which the earlier steps went better than the later ones."""
    luck = random.Random(seed)
    submissions = []
    for number in range(amount):
        skill = luck.random()
        steps, mistakes = {}, {}
        for index, step in enumerate(STEPS):
            most = float(step["points"])
            ease = skill * 1.9 - index * 0.11 + luck.random() * 0.4
            if ease < 0.15:
                steps[str(step["id"])] = result(0, most, "not-started")
                continue
            share = 1.0 if ease > 0.75 else round(max(0.0, ease), 2) if ease > 0.3 else 0.0
            status = luck.choice(["does-not-build", "crashed", "timeout", "failed"]) if not share else ""
            steps[str(step["id"])] = result(round(share * most, 2), most, status)
            if share < 1 and step["id"] in _TITLES and luck.random() < 0.7:
                mistakes[str(step["id"])] = [luck.choice(_TITLES[str(step["id"])])]
        name = f"s{number:04d}"
        who = [student(f"Student {chr(65 + number % 26)}. Nr {number * 7919 % amount}", str(10000 + number))]
        seconds = round(luck.uniform(4, 30), 1)
        submissions.append(submission(name, steps, students=who, mistakes=mistakes, seconds=seconds))
    return document(submissions)


def without_times(document: Any) -> Any:
    """A copy of a results.json without what a clock said: the rest is the same whenever it is graded."""
    if isinstance(document, dict):
        return {key: without_times(value) for key, value in document.items() if key not in ("timing", "seconds")}
    return [without_times(value) for value in document] if isinstance(document, list) else document
