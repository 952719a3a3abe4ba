"""Makes a class of submissions from the solutions: for tests, never for grading anybody."""

import gzip
import io
import random
import tarfile
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_bytes
from raysteps.course.manifest import Step, read_steps
from raysteps.course.project import Project
from raysteps.course.stubs import stub_for, without_markers

# The forms in which generated submissions are handed in.

FORMS = ("folder", "flat folder", "zip", "zip with a folder", "tar.gz", "tar")


def _zip(files: dict[str, bytes]) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(zipfile.ZipInfo(name), data)  # always of 1980, so that the bytes are always the same
    return out.getvalue()


def _tar(files: dict[str, bytes]) -> bytes:
    out = io.BytesIO()
    with tarfile.open(fileobj=out, mode="w") as archive:
        for name, data in files.items():
            info = tarfile.TarInfo(name)
            info.size = len(data)
            archive.addfile(info, io.BytesIO(data))
    return out.getvalue()


def write_sample(base: Path, form: str, sources: Mapping[str, str], steps: list[Step]) -> Path:
    paths = {step.id: step.file if form == "flat folder" else f"steps/{step.path.as_posix()}" for step in steps}
    top = "work/" if form == "zip with a folder" else ""
    files = {top + paths[step]: text.encode() for step, text in sources.items()}
    if form in ("folder", "flat folder"):
        for name, data in files.items():
            write_bytes(base / name, data)
        return base
    ending, data = {
        "tar": (".tar", _tar(files)),
        "tar.gz": (".tar.gz", gzip.compress(_tar(files), mtime=0)),
    }.get(form, (".zip", _zip(files)))
    path = base.with_name(base.name + ending)
    write_bytes(path, data)
    return path


Sources = dict[str, str]

# Number of the step, what to find in its solution, and what a student might have written there.
MISTAKES = (
    ("01", "static_cast<float>(x) + 0.5F", "static_cast<float>(x)"),
    ("01", "glm::radians(camera.angle) / 2.0F", "glm::radians(camera.angle)"),
    ("02", "nearer > 0.0F ? nearer : to_closest + half_chord", "nearer"),
    ("02", "hit->distance < closest->distance", "hit->distance > closest->distance"),
    ("03", "return direction - 2.0F * glm::dot(direction, normal) * normal;", "return -direction;"),
    ("03", "fill.kd * cosine * fill.color * light.color", "fill.kd * cosine * light.color"),
    ("04", "hit.position + k_shadow_threshold * hit.normal", "hit.position"),
    ("04", "!scene.occluded(ray, glm::distance(ray.origin, light.position))", "!scene.closest_hit(ray)"),
    ("05", "depth == 1 ? tracer.background() : k_black", "tracer.background()"),
    ("05", "color += hit->fill.ks * tracer.trace(", "color += tracer.trace("),
)

# Number of the step and a line of its solution before which a statement can stand.
_PLACES = (
    ("01", "    ViewFrame frame;\n"),
    ("03", "    Color sum = k_black;\n"),
    ("05", "    const glm::vec3 direction = mirror(hit.ray_direction, hit.normal);\n"),
)
_HOSTILE = {
    "endless loop": ("", "for (volatile bool on = true; on;) {}"),
    "crash": ("#include <cstdlib>\n", "std::abort();"),
    "exit": ("#include <cstdlib>\n", "std::exit(0);"),
    # Once per process, and the child ends at once: it shows what becomes of the attempt and harms nobody.
    "fork": (
        "#include <unistd.h>\n",
        "static const bool once = [] { if (fork() == 0) { _exit(0); } return true; }(); (void)once;",
    ),
}
KINDS = ("complete", "mistakes", "stubs", "half", "does not compile", "missing files", *_HOSTILE)
_NAMES = ("ada", "barbara", "donald", "edsger", "frances", "grace", "john", "katherine", "niklaus", "radia")


@dataclass(frozen=True)
class SampleClass:
    """One generated submission."""

    path: Path
    kind: str
    form: str


def _replace(source: str, find: str, replacement: str, where: str) -> str:
    if source.count(find) != 1:
        raise GraderFault(f"the sample class needs {find!r} exactly once in {where}")
    return source.replace(find, replacement)


def _with_mistakes(solved: Sources, steps: list[Step], dice: random.Random) -> Sources:
    sources = dict(solved)
    ids = {step.number: step.id for step in steps}
    chosen = dice.sample(MISTAKES, dice.randint(1, 3))
    for number, find, replacement in {mistake[0]: mistake for mistake in chosen}.values():
        sources[ids[number]] = _replace(sources[ids[number]], find, replacement, ids[number])
    return sources


def _with_statement(solved: Sources, steps: list[Step], kind: str, dice: random.Random) -> Sources:
    number, line = dice.choice(_PLACES)
    step = next(step.id for step in steps if step.number == number)
    include, statement = _HOSTILE[kind]
    source = include + _replace(solved[step], line, f"    {statement}\n{line}", step)
    return {**solved, step: source}


def _with_error(solved: Sources, dice: random.Random) -> Sources:
    step = dice.choice(sorted(solved))
    return {
        **solved,
        step: solved[step].replace("}  // namespace raysteps", "int missing( {\n}  // namespace raysteps"),
    }


def _sources(kind: str, solved: Sources, stubs: Sources, steps: list[Step], dice: random.Random) -> Sources:
    done = dice.randint(2, len(steps) - 2)
    half = {step.id: (solved if at < done else stubs)[step.id] for at, step in enumerate(steps)}
    makers: dict[str, Callable[[], Sources]] = {
        "complete": lambda: solved,
        "mistakes": lambda: _with_mistakes(solved, steps, dice),
        "stubs": lambda: stubs,
        "half": lambda: half,
        "does not compile": lambda: _with_error(solved, dice),
        "missing files": lambda: {step.id: solved[step.id] for step in steps[:done]},
    }
    return makers[kind]() if kind in makers else _with_statement(solved, steps, kind, dice)


def make_class(project: Project, folder: Path, count: int, seed: int) -> list[SampleClass]:
    """Writes that many submissions, the same for the same seed. Every kind is there before one comes again."""
    steps = read_steps(project)
    solved = {step.id: without_markers((project.solutions / step.path).read_text(encoding="utf-8")) for step in steps}
    stubs = {step.id: stub_for(project, step) for step in steps}
    dice = random.Random(seed)
    made: list[SampleClass] = []
    kinds: list[str] = []
    for at in range(count):
        kinds = kinds or dice.sample(KINDS, len(KINDS))
        kind, form = kinds.pop(), FORMS[(at + at // len(FORMS)) % len(FORMS)]
        base = folder / f"{_NAMES[at % len(_NAMES)]}-{at + 1:03d}"
        sources = _sources(kind, solved, stubs, steps, dice)
        made.append(SampleClass(write_sample(base, form, sources, steps), kind, form))
    return made
