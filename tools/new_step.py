"""The command `dev new`: a step of an instructor's own, as a small one that works."""

import argparse
import json
import math
import re
import shutil
from importlib.resources import files
from typing import Any

from raysteps.common.errors import GraderFault, UsageError, reason
from raysteps.common.files import write_bytes
from raysteps.common.platform import is_windows_device
from raysteps.common.text import count
from raysteps.course.manifest import Step, kit_steps, read_all_steps, read_step
from raysteps.course.project import Project
from raysteps.course.stubs import write_stubs
from tools.test_submissions import write_samples

# What a new step may be called.

_NAME = re.compile(r"([0-9]{2})-([a-z]+(?:-[a-z]+)*)")
_MAX_CHARACTERS = 40


# Those that new steps of a part may have: the framework draws pictures of steps 10 to 19 as part two does.
_NUMBERS = {1: range(20, 100), 2: range(10, 20)}


def check_name(project: Project, name: str, part: int) -> None:
    """Whether a step can be called so; else what to write instead."""
    found = _NAME.fullmatch(name)
    if found is None or len(name) > _MAX_CHARACTERS:
        raise UsageError(
            f"'{name}' is no name of a step; expected two digits and words of small letters, parted by '-', at most "
            f"{_MAX_CHARACTERS} characters, such as 20-fog"
        )
    number, words = found.groups()
    if is_windows_device(words):
        raise UsageError(f"'{name}': Windows has no files called {words}; choose another name")
    steps = read_all_steps(project)
    numbers = _NUMBERS[part]
    following = max([numbers.start, *(step.index + 1 for step in steps if step.index in numbers)])
    taken = next((step.id for step in steps if step.number == number), None)
    if taken is not None:
        raise UsageError(f"'{name}': {taken} has this number already; the next one is {following}-{words}")
    if following not in numbers:
        raise UsageError(f"'{name}': part {part} has no number left; its steps are {numbers[0]} to {numbers[-1]}")
    if int(number) != following:
        raise UsageError(
            f"'{name}': new steps of part {part} count on from {numbers.start}; expected {following}-{words}"
        )
    same = next((step.id for step in steps if step.id[3:] == words), None)
    if same is not None:
        raise UsageError(f"'{name}': {same} has this name already; its files would be mixed up with yours")
    for room in (project.steps, project.solutions):
        if (room / name).exists():
            raise UsageError(f"{room / name} is there already, without a step.toml; move it away first")


# Makes the files of a new step from the templates.

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


def _words(name: str, title: str, points: float, part: int, *, bonus: bool) -> dict[str, str]:
    number, rest = name[:2], name[3:]
    return {
        "ID": name,
        "NUMBER": number,
        "INDEX": str(int(number)),
        "FILE": rest.replace("-", "_"),
        "PICTURE": rest,
        "TITLE": title,
        "QUOTED": json.dumps(title, ensure_ascii=False),
        "PART": f"part = {part}\n" if part != 1 else "",
        "POINTS": f"{points:g}",
        "BONUS": "true" if bonus else "false",
        "KIND": " (bonus)" if bonus else "",
    }


def _from_template(template: str, file: str, words: dict[str, str]) -> tuple[str, str]:
    """The name of a file, and its text."""
    text = files("tools").joinpath("templates", template).read_text(encoding="utf-8")
    return _filled(file, words), _filled(text, words)


def make_step(project: Project, name: str, title: str, points: float, part: int, *, bonus: bool) -> list[str]:
    """Writes everything that belongs to the step; returns the paths in the kit."""
    check_name(project, name, part)
    words = _words(name, title, points, part, bonus=bonus)
    made = []
    try:
        for room, templates in ((project.solutions, _FOR_THE_GRADER), (project.steps, _FOR_STUDENTS)):
            for template, file in templates.items():
                filled, text = _from_template(template, file, words)
                path = room / name / filled
                write_bytes(path, text.encode())
                made.append(path)
        made += write_stubs(project, [read_step(project.steps / name / "step.toml")])
        made += write_samples(project, kit_steps(project))
    except (OSError, GraderFault) as error:
        for room in (project.steps, project.solutions):
            shutil.rmtree(room / name, ignore_errors=True)
        raise GraderFault(f"{name}: the step cannot be written, and nothing of it is left: {reason(error)}") from error
    return sorted(path.relative_to(project.root).as_posix() for path in made)


# What still stands in a step as the templates have it, though they tell of another one.

_OF_THE_SAMPLE = re.compile(r"\b(air|arrives|distance|far away|reach|scatters|in-doubles|double precision)\b")


def sample_leftovers(project: Project, step: Step) -> list[str]:
    """Of each file the lines about the sample's matter that nobody has changed."""
    words = _words(step.id, step.title, step.points, step.part, bonus=step.bonus)
    found = []
    for room, templates in ((project.steps, _FOR_STUDENTS), (project.solutions, _FOR_THE_GRADER)):
        for template, file in templates.items():
            name, text = _from_template(template, file, words)
            path = room / step.id / name
            if not path.is_file():
                continue
            sample = {line.strip() for line in text.splitlines() if _OF_THE_SAMPLE.search(line)}
            now = path.read_text(encoding="utf-8", errors="replace").splitlines()
            lines = [number for number, line in enumerate(now, start=1) if line.strip() in sample]
            if lines:
                where = path.relative_to(project.root).as_posix()
                found.append(f"{where}:{lines[0]}: {count(len(lines), 'line')} of the sample step about fog")
    return found


_MAX_POINTS = 1000


def _points(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not (math.isfinite(value) and 0 < value <= _MAX_POINTS):
        raise argparse.ArgumentTypeError(f"'{text}' are no points; expected a number above 0, such as 10")
    return value


def _title(text: str) -> str:
    if not text.strip() or not text.isprintable() or len(text) > 60:
        raise argparse.ArgumentTypeError("expected a title of one line and at most 60 characters, such as 'Fog'")
    return text.strip()


def add_arguments(commands: "argparse._SubParsersAction[Any]") -> None:
    """`dev new NN-name`."""
    add = commands.add_parser("new", help="begin a step of your own: a small one that works, to be filled")
    add.add_argument("name", metavar="NN-name", help="the next number and a name, such as 20-fog")
    add.add_argument("--title", type=_title, help="as students read it (from the name)")
    add.add_argument("--points", type=_points, default=10.0, metavar="P", help="what it is worth (10)")
    add.add_argument("--part", type=int, choices=_NUMBERS, default=1, help="of which part of the kit it is (1)")
    add.add_argument("--bonus", action="store_true", help="its points are not needed for full marks")


_HOW_TO_GO_ON = """
{name} works as it is, but it is about fog: the handout, hints, tests, mistakes, cases and alternatives/in-doubles.cpp
are those of a sample. Make them yours, the contract {file}.hpp first; docs/instructors.md tells what each file is for.
  Tests     TEST_CASE("what is promised", "[{name}][{file}_color]"): two tags in brackets, the step and the function
            that is tested. Each must fail with the stub.
  Pictures  in step.toml `scene` is a file, such as scenes/lessons/glass.nff, and `name` is what you call the picture,
            such as balls-{picture}. Each has a twin in cases.toml with `of` = that name.
Then:
  ./raysteps dev stubs && ./raysteps dev samples
  ./raysteps dev check --only {number}
The last one also tells which lines are still the sample's."""


def run(project: Project, arguments: argparse.Namespace) -> int:
    """Writes the step and says how to go on."""
    name = arguments.name
    title = arguments.title or name[3:].replace("-", " ").capitalize()
    for path in make_step(project, name, title, arguments.points, arguments.part, bonus=arguments.bonus):
        print(f"{path} written")
    print(_HOW_TO_GO_ON.format(name=name, number=name[:2], file=name[3:].replace("-", "_"), picture=name[3:]))
    return 0
