"""Reads steps/NN-name/step.toml."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeGuard

from raysteps.common.errors import GraderFault, UsageError, reason
from raysteps.common.text import MAX_FOUND, belongs_above, clean, did_you_mean, join_and
from raysteps.course.project import Project

if TYPE_CHECKING:  # what checks the types of documents takes long to load
    from raysteps.course.settings import Course


@dataclass(frozen=True)
class ImageCase:
    """One picture: what to render, how many pixels may be wrong, how many of the objects a ray may be tested with. A
    noisy one is judged by its mean light, and may have a variance so many times the reference's."""

    name: str
    scene: str
    args: tuple[str, ...]
    max_wrong: float
    max_share: float | None = None
    paper_tests: float | None = None  # per ray, with the paper's 64 boxes; see results/work_ratio.py
    max_noise: float | None = None
    more_samples: int = 16  # times as many for each pixel of the reference's noisy picture

    @property
    def has_tree(self) -> bool:
        """Whether it asks for a tree by name."""
        return "--accel" in self.args

    @property
    def is_noisy(self) -> bool:
        return self.max_noise is not None


@dataclass(frozen=True)
class Step:
    """One step as its manifest describes it."""

    id: str
    title: str
    points: float
    bonus: bool
    files: tuple[str, ...]
    functions: tuple[str, ...]
    function_weights: tuple[float, ...]  # what each is worth beside the others
    hints: tuple[str, ...]
    weight_tests: float
    weight_images: float
    weight_hidden: float
    weight_together: float
    seconds: float
    images: tuple[ImageCase, ...]
    memory_mb: int = 4096
    more_limits: tuple[tuple[str, float], ...] = ()  # by name, see toolchain.limits
    about: str = ""  # one or two sentences for the gallery and the finale, the title where there are none
    part: int = 1  # of which course it is
    barred: tuple[tuple[str, str], ...] = ()  # earlier steps and their functions that it may not call: they do its work
    left_out: bool = False  # built, because the framework calls it, but no part of this course

    @property
    def number(self) -> str:
        return self.id[:2]

    @property
    def index(self) -> int:
        return int(self.number)

    def share_of(self, function: str) -> float:
        """Of what all functions are worth; 0 for a function that is none of them."""
        weights = dict(zip(self.functions, self.function_weights, strict=True))
        return weights.get(function, 0.0) / sum(self.function_weights)

    @property
    def barred_functions(self) -> set[str]:
        return {function for _, function in self.barred}

    @property
    def is_in_part_two(self) -> bool:
        """There a pixel is the mean of many samples, and lamps have a size."""
        return self.part > 1

    @property
    def is_about_a_tree(self) -> bool:
        """Whether it changes what a picture costs, and not what it shows."""
        return any(case.has_tree for case in self.images)

    @property
    def file(self) -> str:
        """The one source file that the student writes."""
        return self.files[0]

    @property
    def path(self) -> Path:
        """NN-name/name.cpp."""
        return Path(self.id) / self.file

    @property
    def limited_pictures(self) -> tuple[str, ...]:
        """Those in which a ray may be tested with few of the objects only."""
        return tuple(image.name for image in self.images if image.max_share is not None)


def with_option(args: tuple[str, ...], name: str, value: str) -> tuple[str, ...]:
    """The arguments of raytrace with that option, in the place of the one that stood there, or else at their end."""
    at = args.index(name) if name in args else len(args)
    return (*args[:at], name, value, *args[at + 2 :])


def _image(table: dict[str, Any]) -> ImageCase:
    return ImageCase(
        name=table["name"],
        scene=table["scene"],
        args=tuple(map(str, table.get("args", []))),
        max_wrong=0.0 if "max_noise" in table else float(table["max_wrong"]),
        max_share=float(table["max_share"]) if "max_share" in table else None,
        paper_tests=float(table["paper_tests"]) if "paper_tests" in table else None,
        max_noise=float(table["max_noise"]) if "max_noise" in table else None,
    )


# What may stand in a manifest: by key whether a value fits, and what is expected. This is read by every command, so it
# goes without what checks the forms of documents, which takes longer to load.

_Form = Mapping[str, tuple[Callable[[Any], bool], str]]
_MAX_PART = 9
LIMIT_NAMES = ("seconds", "memory_mb", "compile_seconds", "compile_memory_mb", "processes", "file_mb")


def _is_text(value: object) -> bool:
    return isinstance(value, str) and bool(value.strip())


def _are_texts(value: object) -> bool:
    return isinstance(value, list) and all(map(_is_text, value))


def _are_words(value: object) -> bool:
    return isinstance(value, list) and all(isinstance(word, str) or _is_positive(word) for word in value)


def _is_positive(value: object) -> TypeGuard[float]:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and 0 < value < math.inf


def _is_whole(value: object) -> bool:
    return _is_positive(value) and value == int(value)


def _is_share(value: object) -> bool:
    return (value == 0 and not isinstance(value, bool)) or (_is_positive(value) and value <= 1)


def _is_truth(value: object) -> bool:
    return isinstance(value, bool)


def _is_table(value: object) -> bool:
    return isinstance(value, dict)


def _are_barred(value: object) -> bool:
    return isinstance(value, dict) and all(map(_are_texts, value.values()))


_MANIFEST: _Form = {
    "id": (_is_text, "the name of the step's folder, in quotes"),
    "title": (_is_text, "text in quotes"),
    "points": (_is_positive, "a number above 0"),
    "bonus": (_is_truth, "true or false"),
    "about": (_is_text, "a sentence in quotes"),
    "files": (lambda value: _are_texts(value) and len(value) == 1, 'the name of one file, such as ["fog.cpp"]'),
    "tests": (_are_texts, 'a list of names, such as ["fog_test.cpp"]'),
    "hints": (_are_texts, "a list of texts"),
    "picture": (_is_text, "the name of a function, in quotes"),
    "part": (lambda value: type(value) is int and 1 <= value <= _MAX_PART, f"a whole number from 1 to {_MAX_PART}"),
    "barred": (_are_barred, "a list of names of functions for each step"),
    "left_out": (_is_truth, "true or false"),
    "functions": (lambda value: isinstance(value, dict) and bool(value), "a table of functions"),
    "weights": (_is_table, "a table of tests, images, hidden and together"),
    "limits": (_is_table, "a table of limits, such as seconds"),
    "images": (lambda value: isinstance(value, list) and all(map(_is_table, value)), "a table [[images]] per picture"),
}
_WEIGHTS: _Form = dict.fromkeys(("tests", "images", "hidden", "together"), (_is_share, "a share from 0 to 1"))
_LIMITS: _Form = dict.fromkeys(LIMIT_NAMES, (_is_whole, "a whole number above 0")) | dict.fromkeys(
    ("seconds", "compile_seconds"), (_is_positive, "a number above 0")
)
_IMAGE: _Form = {
    "name": (_is_text, "a name in quotes"),
    "scene": (_is_text, "a file in quotes, as seen from the kit's folder"),
    "args": (_are_words, 'a list of words, such as ["--step", "4", "--size", "160x120"]'),
    "max_wrong": (_is_share, "the share of pixels that may be wrong, from 0 to 1"),
    "max_share": (_is_share, "the share of objects that a ray may be tested with, from 0 to 1"),
    "paper_tests": (_is_positive, "a number of tests per ray"),
    "max_noise": (_is_positive, "a number above 0"),
}


class _Wrong(Exception):
    """What is wrong in a manifest, and the keys that lead there."""

    def __init__(self, keys: Sequence[str], words: str) -> None:
        super().__init__(words)
        self.keys = keys


def _known(key: str, form: _Form) -> str:
    """The end of a sentence about a key that does not belong there."""
    if key == "images":
        return "; pictures are tables of their own, [[images]]"
    if key in _MANIFEST:
        return f"; {belongs_above(key)}"
    return did_you_mean(key, form) or f"; known are {', '.join(form)}"


def _refuse_misfits(table: Mapping[str, Any], form: _Form, needed: Sequence[str], *keys: str) -> None:
    for key in table:
        if key not in form:
            raise _Wrong((*keys, key), f"unknown key '{clean(key, MAX_FOUND)}'{_known(key, form)}")
    for key, value in table.items():
        fits, expected = form[key]
        if not fits(value):
            raise _Wrong((*keys, key), f"{key}: expected {expected}; found {clean(repr(value), MAX_FOUND)}")
    for key in needed:
        if key not in table:
            raise _Wrong(keys, f"{key} is missing; expected {form[key][1]}")


def _refuse_wrong(table: Mapping[str, Any], text: str) -> None:
    _refuse_misfits(table, _MANIFEST, ("id", "title", "points", "files", "functions", "weights", "limits"))
    functions = dict.fromkeys(  # one may be called as a key is; what has no weight is that key, below the wrong table
        (name for name, weight in table["functions"].items() if name not in _MANIFEST or _is_positive(weight)),
        (_is_positive, "a weight beside the others"),
    )
    _refuse_misfits(table["functions"], functions, (), "functions")
    _refuse_misfits(table["weights"], _WEIGHTS, tuple(_WEIGHTS), "weights")
    _refuse_misfits(table["limits"], _LIMITS, ("seconds",), "limits")
    names = list[str]()
    for at, image in enumerate(table.get("images", [])):
        limit = "max_noise" if "max_noise" in image else "max_wrong"
        _refuse_misfits(image, _IMAGE, ("name", "scene", limit), "images", str(at))
        if image["name"] in names:
            raise _Wrong(("images", str(at), "name"), f"two pictures are called {image['name']}; expected two names")
        names.append(image["name"])
    if "picture" in table and not re.search(r'^picture = "[A-Za-z0-9_]+"', text, re.MULTILINE):
        raise _Wrong(("picture",), 'CMake reads this, too; expected a line like `picture = "fog_picture"`')
    whole = sum(table["weights"].values())
    if abs(whole - 1) > _ROUNDING:
        raise _Wrong(("weights",), f"the weights must sum to 1; these sum to {round(whole, 6)}")
    if names and not table["weights"]["images"]:
        raise _Wrong(("weights", "images"), "images need a weight: there are [[images]]")
    if table["weights"]["images"] and not names:
        raise _Wrong(("weights", "images"), "images have a weight, but there are no [[images]]")


_ROUNDING = 1e-9


def _refuse_unknown(barred: Step, steps: Sequence[Step], path: Path) -> None:
    """A step that somebody took out has no functions to bar."""
    for place, name in barred.barred:
        other = next((step for step in steps if step.id == place), None)
        known = [step.id for step in steps if step.index < barred.index]
        if other is None and place[:2] not in (step.number for step in steps):
            continue
        if other is None or place not in known:
            meant = did_you_mean(place, known) or "."
            raise _fault(path, ["barred"], f"barred: '{place}' is no step before it{meant} Expected the folder of one")
        if name not in other.functions:
            meant = did_you_mean(name, other.functions) or "."
            words = f"barred: '{name}' is no function of {place}{meant} Expected one of its [functions]"
            raise _fault(path, ["barred"], words)


def _fault(path: Path, keys: Sequence[str], words: str) -> GraderFault:
    """What is wrong, behind FILE:LINE:COLUMN."""
    from raysteps.common.documents import place_in_toml  # it takes long to load

    return GraderFault(f"{path}:{place_in_toml(path.read_text('utf-8-sig'), keys)}: {words}")


def refuse_absent_scenes(step: Step, project: Project) -> None:
    """A scene that is not there is misspelled in the manifest: its line is the one to mend."""
    for at, image in enumerate(step.images):
        if not (project.root / image.scene).is_file():
            words = f"scene: {image.scene} is not there; expected a file, as seen from the kit's folder"
            raise _fault(project.steps / step.id / "step.toml", ["images", str(at), "scene"], words)


def read_step(path: Path) -> Step:
    """Reads one manifest; a bad one is the kit's fault."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as error:
        raise GraderFault(f"{path}: not a step manifest: {reason(error)}") from error
    return _parse(text, path)


def _table(text: str, path: Path) -> dict[str, Any]:
    try:
        table = tomllib.loads(text)
        _refuse_wrong(table, text)
    except tomllib.TOMLDecodeError:
        from raysteps.common.documents import table_of_kit

        return table_of_kit(text, path)  # refuses it, too, and says where
    except _Wrong as error:
        raise _fault(path, error.keys, str(error)) from error
    return table


@lru_cache(maxsize=64)
def _parse(text: str, path: Path) -> Step:
    """Once while it stays the same: a grade asks for all steps seven times."""
    table = _table(text, path)
    weights, limits = table["weights"], table["limits"]
    step = Step(
        id=table["id"],
        title=table["title"],
        points=float(table["points"]),
        bonus=table.get("bonus", False),
        files=tuple(table["files"]),
        functions=tuple(table["functions"]),
        function_weights=tuple(float(weight) for weight in table["functions"].values()),
        hints=tuple(table.get("hints", [])),
        weight_tests=float(weights["tests"]),
        weight_images=float(weights["images"]),
        weight_hidden=float(weights["hidden"]),
        weight_together=float(weights["together"]),
        seconds=float(limits["seconds"]),
        images=tuple(_image(image) for image in table.get("images", [])),
        memory_mb=int(limits.get("memory_mb", Step.memory_mb)),
        more_limits=tuple(
            (name, float(value)) for name, value in limits.items() if name not in ("seconds", "memory_mb")
        ),
        about=" ".join(table.get("about", table["title"]).split()),
        part=table.get("part", Step.part),
        barred=tuple((place, name) for place, names in table.get("barred", {}).items() for name in names),
        left_out=table.get("left_out", Step.left_out),
    )
    if step.id != path.parent.name:
        raise _fault(
            path,
            ["id"],
            f"its id is {step.id}, but its folder is called {path.parent.name}; expected the same name twice. "
            f"Was the folder renamed? Call it {step.id} again. Was it copied? Give the copy an id of its own",
        )
    return step


def read_manifests(project: Project) -> list[Step]:
    """All steps that are built, in order, as their own manifests say, whatever course.toml does."""
    paths = sorted(project.steps.glob("[0-9][0-9]-*/step.toml"))
    if not paths:
        raise GraderFault(f"{project.steps} holds no step.toml")
    steps = [read_step(path) for path in paths]
    numbers = [step.number for step in steps]
    twice = next((step for step in steps if numbers.count(step.number) > 1), None)
    if twice is not None:
        raise GraderFault(f"{project.steps}: two steps have the number {twice.number}; expected one folder for each")
    for step, path in zip(steps, paths, strict=True):
        _refuse_unknown(step, steps, path)
    return steps


def read_all_steps(project: Project) -> list[Step]:
    """All steps that are built, in order."""
    return _with_points(project, read_manifests(project))


def kit_steps(project: Project) -> list[Step]:
    """The steps of all parts, in order, for those who make the kit and check it: all but those that are left out."""
    steps = [step for step in read_all_steps(project) if not step.left_out]
    if not steps:
        raise GraderFault(f"{project.steps}: every step.toml says `left_out = true`; a course needs a step")
    return steps


def read_steps(project: Project) -> list[Step]:
    """The steps of the course, in order: those of the parts that course.toml chooses, of part 1 where it does not."""
    steps, course = kit_steps(project), _course(project)
    if course is None:
        return steps
    there = sorted({step.part for step in steps})
    for part in course.parts:
        if part not in there:
            raise UsageError(
                f"{course.place('parts')}: parts: the kit has no steps of part {part}; it has those of "
                f"{join_and([f'part {one}' for one in there])}"
            )
    return [step for step in steps if step.part in course.parts]


def taken_in(steps: Sequence[Step], part: int) -> str:
    """What makes a part belong to the course that has these steps."""
    return f"`parts = {sorted({part, *(step.part for step in steps)})}` in course.toml takes it in"


def why_outside(steps: Sequence[Step], other: Step) -> str:
    """Why nobody can ask for that one in a course that has these steps."""
    if other.left_out:
        return f"step {other.id} is left out: steps/{other.id}/step.toml says `left_out = true`"
    return f"step {other.id} belongs to part {other.part}; {taken_in(steps, other.part)}"


def of_other_parts(project: Project) -> list[Step]:
    """Steps of the kit that belong to no part of the course."""
    steps = read_steps(project)
    return [step for step in kit_steps(project) if step not in steps]


def outside_course(project: Project) -> list[Step]:
    """Steps of the kit that nobody can ask for: those of other parts, and those that are left out."""
    return [*of_other_parts(project), *(step for step in read_all_steps(project) if step.left_out)]


def up_to(step: Step, steps: Sequence[Step]) -> list[Step]:
    """This one of the steps and those before it that are handed in with it: a part is a course of its own, which begins
    with what the parts before it should have come to."""
    return [other for other in steps if other.part == step.part and other.index <= step.index]


def earlier(step: Step, steps: Sequence[Step]) -> list[Step]:
    """Those of the steps that its pictures are drawn with, trees or not: none of a part after its own."""
    return [other for other in steps if other.part <= step.part and other.index < step.index]


_RANGE = re.compile(r"([0-9]{1,2})[-\u2013]([0-9]{1,2})")
# A step's folder or what is in it, as a shell completes it in the kit's folder or in steps/.
_IN_STEPS = re.compile(r"(?!.*\.\.)(?:\.[/\\]+)?(?:steps[/\\]+)?([^/\\]+)(?:[/\\].*)?")
_OTHER_RANGE = re.compile(r"all|\*|[0-9]*(?:[-\u2010-\u2015]+|\.\.+)[0-9]*")  # as other programs have them
STEPS_HELP = "such as 1-4, 01 02 or 1,3"  # what `choose` takes


def _one(steps: list[Step], name: str, others: Sequence[Step]) -> Step:
    number = f"{int(name):02d}" if re.fullmatch(r"[0-9]{1,2}", name) else None
    path = _IN_STEPS.fullmatch(name)
    found = [step for step in (*steps, *others) if (path and step.id == path[1]) or number == step.number]
    if found and found[0] in others:
        raise UsageError(why_outside(steps, found[0]))
    if not found:
        meant = did_you_mean(name, [step.id for step in steps]) or "."
        others = [other for other in others if not other.left_out]
        parts = sorted({other.part for other in others})
        more = "".join(f"; part {part} has {_ids(others, part)}, and {taken_in(steps, part)}" for part in parts)
        raise UsageError(f"there is no step '{name}'{meant} The steps are {', '.join(step.id for step in steps)}{more}")
    return found[0]


def _ids(steps: Sequence[Step], part: int) -> str:
    return ", ".join(step.id for step in steps if step.part == part)


def _range(steps: list[Step], word: str, others: Sequence[Step]) -> list[Step]:
    ends = _RANGE.fullmatch(word)
    if ends is None and _OTHER_RANGE.fullmatch(word):
        raise UsageError(f"there is no step '{word}'; expected steps {STEPS_HELP}")
    if ends is None:
        return [_one(steps, word, others)]
    first, last = _one(steps, ends[1], others), _one(steps, ends[2], others)
    if last.index < first.index:
        raise UsageError(f"'{word}' ends before it begins; expected {last.index}-{first.index}")
    return [step for step in steps if first.index <= step.index <= last.index]


def choose(steps: list[Step], names: Sequence[str], others: Sequence[Step] = ()) -> list[Step]:
    """The steps with these names (`02`, `2`, `02-intersection`, its folder or a file there, `1-4` or `1,3`); all of
    them when there are no names. Of the `others` it is said how a course gets them."""
    if not names:
        return steps
    words = [word for name in names for word in re.split(r"[,\s]+", name) if word]
    if not words:
        raise UsageError(f"expected steps, {STEPS_HELP}")
    chosen = [step for word in words for step in _range(steps, word, others)]
    return [step for step in steps if step in chosen]


def choose_one(steps: list[Step], name: str, others: Sequence[Step] = ()) -> Step:
    """Where a single step is wanted."""
    found = choose(steps, [name], others)
    if len(found) > 1:
        raise UsageError(f"'{name}': expected one step, such as {found[0].number}")
    return found[0]


def steps_words(steps: Sequence[Step]) -> list[str]:
    """As they are typed: `1-4`, and what comes behind a gap by itself."""
    runs: list[list[int]] = []
    for step in steps:
        if not runs or step.index != runs[-1][-1] + 1:
            runs.append([])
        runs[-1].append(step.index)
    return [f"{run[0]}-{run[-1]}" if len(run) > 1 else str(run[0]) for run in runs]


# What course.toml says of the steps. A students' kit has none: its manifests were written from it.


def _course(project: Project) -> Course | None:
    if not project.has_reference:
        return None
    from raysteps.course.settings import read_course  # students do not have it

    return read_course(project)


def _by_course(steps: list[Step], course: Course, key: str, names: str, others: Sequence[Step] = ()) -> list[Step]:
    try:
        return choose(steps, [names], others)
    except UsageError as error:
        raise UsageError(f"{course.place(key, names)}: {key}: {error}") from error


def _each_once(course: Course, key: str, told: Sequence[tuple[str, Step]]) -> None:
    seen = set[str]()
    for names, step in told:
        if step.id in seen:
            where = course.place(key, names)
            raise UsageError(f"{where}: {key}: step {step.number} stands above already; expected each step once")
        seen.add(step.id)


def _with_points(project: Project, steps: list[Step]) -> list[Step]:
    course = _course(project)
    if course is None or not course.points:
        return steps
    told = [(names, step) for names in course.points for step in _by_course(steps, course, "points", names)]
    _each_once(course, "points", told)
    worth = {step.id: course.points[names] for names, step in told}
    return [replace(step, points=worth.get(step.id, step.points)) for step in steps]


def course_steps(project: Project) -> list[Step]:
    """Those that course.toml names, else all of its parts: what a command takes that is told none."""
    steps, course = read_steps(project), _course(project)
    if course is None or not course.steps:
        return steps
    others = outside_course(project)
    chosen = [step for names in course.steps for step in _by_course(steps, course, "steps", names, others)]
    return [step for step in steps if step in chosen]


def chosen_steps(project: Project, names: Sequence[str]) -> list[Step]:
    """Those that were named, else those of the course."""
    return choose(read_steps(project), names, outside_course(project)) if names else course_steps(project)


def chosen_step(project: Project, name: str) -> Step:
    """The one that was named."""
    return choose_one(read_steps(project), name, outside_course(project))


def dated_steps(project: Project) -> list[tuple[Step, date]]:
    """The days on which steps are given out, as far as course.toml tells."""
    steps, course = read_steps(project), _course(project)
    if course is None:
        return []
    others = outside_course(project)
    told = [(names, step) for names in course.dates for step in _by_course(steps, course, "steps", names, others)]
    _each_once(course, "steps", told)
    return [(step, course.dates[names]) for names, step in told]


def course_manifests(project: Project) -> dict[str, bytes]:
    """Those in which course.toml changes the points, by path: it does not go out itself."""
    course, made = _course(project), {}
    for step in read_all_steps(project) if course is not None and course.points else []:
        path = project.steps / step.id / "step.toml"
        if read_step(path).points != step.points:
            line = f"points = {step.points!r}".removesuffix(".0")  # reads back as the same number
            text, changed = re.subn(
                r"^[ \t]*[\"']?points[\"']?\s*=.*$", line, path.read_text("utf-8-sig"), count=1, flags=re.MULTILINE
            )
            if not changed:
                raise GraderFault(f"{path}: expected a line such as points = 10, to write the course's points there")
            made[path.relative_to(project.root).as_posix()] = text.encode()
    return made
