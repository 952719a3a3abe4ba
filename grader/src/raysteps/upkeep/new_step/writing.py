"""Makes the files of a new step from the templates."""

import json
import shutil
from importlib.resources import files

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_bytes
from raysteps.kit.manifest import read_step, read_steps
from raysteps.kit.project import Project
from raysteps.kit.stubs import write_stubs
from raysteps.upkeep.new_step.names import check_name
from raysteps.upkeep.samples import write_samples

# Template and file, first of steps/NN-name/, then of solutions/NN-name/.
_FOR_STUDENTS = {
    "step.toml": "step.toml",
    "README.md": "README.md",
    "contract.hpp": "@FILE@.hpp",
    "test.cpp": "@FILE@_test.cpp",
}
_FOR_THE_GRADER = {
    "solution.cpp": "@FILE@.cpp",
    "mutants.toml": "mutants.toml",
    "cases.toml": "cases.toml",
    "judge.py.txt": "judge.py",
    "worker.cpp": "worker.cpp",
    "alternative.cpp": "alternatives/in-doubles.cpp",
}


def _filled(text: str, words: dict[str, str]) -> str:
    for mark, word in words.items():
        text = text.replace(f"@{mark}@", word)
    return text


def _words(name: str, title: str, points: float, *, bonus: bool) -> dict[str, str]:
    number, rest = name[:2], name[3:]
    return {
        "ID": name,
        "NUMBER": number,
        "INDEX": str(int(number)),
        "FILE": rest.replace("-", "_"),
        "PICTURE": rest,
        "TITLE": title,
        "QUOTED": json.dumps(title, ensure_ascii=False),
        "POINTS": f"{points:g}",
        "BONUS": "true" if bonus else "false",
        "KIND": " (bonus)" if bonus else "",
    }


def make_step(project: Project, name: str, title: str, points: float, *, bonus: bool) -> list[str]:
    """Writes everything that belongs to the step; returns the paths in the kit."""
    check_name(project, name)
    words = _words(name, title, points, bonus=bonus)
    made = []
    try:
        for room, templates in ((project.solutions, _FOR_THE_GRADER), (project.steps, _FOR_STUDENTS)):
            for template, file in templates.items():
                text = files("raysteps.upkeep.new_step").joinpath("templates", template).read_text(encoding="utf-8")
                path = room / name / _filled(file, words)
                write_bytes(path, _filled(text, words).encode())
                made.append(path)
        made += write_stubs(project, [read_step(project.steps / name / "step.toml")])
        made += write_samples(project, read_steps(project))
    except (OSError, GraderFault) as error:
        for room in (project.steps, project.solutions):
            shutil.rmtree(room / name, ignore_errors=True)
        raise GraderFault(f"{name}: the step cannot be written, and nothing of it is left: {error}") from error
    return sorted(path.relative_to(project.root).as_posix() for path in made)
