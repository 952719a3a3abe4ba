"""Text files that a students' kit has of its own: README.md, the package's pyproject.toml, what an editor offers."""

import json
import tomllib
from importlib.resources import files

from raysteps.common.text import number
from raysteps.kit.manifest import Step

_DATA = ["py.typed", "*/*.schema.json", "*/*/*.schema.json", "pages/static/*", "pages/templates/*"]


def _picture(steps: list[Step]) -> str:
    """What draws the first picture of the course; a first step may have none."""
    index, scene = next(
        ((step.index, case.scene) for step in steps for case in step.images),
        (steps[0].index, "scenes/lessons/three-spheres.nff"),
    )
    return f"./raysteps render {scene} -o first.png --step {index}"


def readme(course: str, steps: list[Step]) -> bytes:
    """Short: the steps, and what to type first."""
    rows = [
        f"| [{step.number} {step.title}](steps/{step.id}/README.md){' (bonus)' if step.bonus else ''} "
        f"| `steps/{step.path.as_posix()}` | {number(step.points)} |"
        for step in steps
    ]
    template = files("raysteps.release").joinpath("templates/README.md").read_text(encoding="utf-8")
    words = {
        "COURSE": course,
        "STEPS": "\n".join(rows),
        "FIRST": steps[0].number,
        "FIRST_FILE": steps[0].path.as_posix(),
        "FIRST_ID": steps[0].id,
        "PICTURE": _picture(steps),
    }
    for name, text in words.items():
        template = template.replace(f"@{name}@", text)
    return template.encode()


def for_editor(text: bytes, steps: list[Step]) -> bytes:
    """Tasks and programs to debug, for these steps only, and without the task that tests the whole kit."""
    table = json.loads(text)
    if "tasks" in table:
        table["tasks"] = [task for task in table["tasks"] if task.get("args") != ["test"]]
    for asked in (one for one in table.get("inputs", []) if one["id"] == "step"):
        asked["options"], asked["default"] = [step.number for step in steps], steps[0].number
    return (json.dumps(table, indent=2, ensure_ascii=False) + "\n").encode()


def pyproject(text: str) -> bytes:
    """What the package needs to run, without what it takes to work on it."""
    table = tomllib.loads(text)
    project = table["project"]
    lines = [
        "[build-system]",
        f"requires = {json.dumps(table['build-system']['requires'])}",
        f"build-backend = {json.dumps(table['build-system']['build-backend'])}",
        "",
        "[project]",
        *(f"{key} = {json.dumps(project[key])}" for key in ("name", "version", "requires-python", "license")),
        'description = "Checks the steps of a ray tracing course"',
        "dependencies = [",
        *(f"    {json.dumps(name)}," for name in project["dependencies"]),
        "]",
        "",
        "[tool.setuptools.packages.find]",
        'where = ["src"]',
        "",
        "[tool.setuptools.package-data]",
        f"raysteps = {json.dumps(_DATA)}",
    ]
    return ("\n".join(lines) + "\n").encode()
