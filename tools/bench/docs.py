"""The command `bench docs`: tables and figures of docs/benchmarks.md, from what was measured last."""

import re
from collections.abc import Callable
from typing import TypeVar

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import write_if_changed
from raysteps.course.project import Project
from tools.bench import figures, model, page_tables
from tools.bench.records import kept

T = TypeVar("T", bound=model.Numbers)
Figure = tuple[str, str, Callable[[T], str]]  # file, words and picture

_RAYS: Figure[model.RenderNumbers] = (
    "bench-rays.svg",
    "nanoseconds a ray for each scene and structure",
    figures.render_figure,
)
_SCALE_TESTS: Figure[model.ScaleNumbers] = (
    "bench-scale-tests.svg",
    "tests of surfaces and boxes a ray, over the number of surfaces",
    lambda document: figures.scale_figure(document, "tests", "tests a ray"),
)
_SCALE_TIME: Figure[model.ScaleNumbers] = (
    "bench-scale-time.svg",
    "nanoseconds a ray, over the number of surfaces",
    lambda document: figures.scale_figure(document, "time", "nanoseconds a ray"),
)
_THREADS: Figure[model.ThreadsNumbers] = (
    "bench-threads.svg",
    "speed-up over the number of threads",
    figures.threads_figure,
)
FIGURES = tuple(file for file, _, _ in (_RAYS, _SCALE_TESTS, _SCALE_TIME, _THREADS))


def _part(project: Project, kind: type[T], tables: Callable[[T], str], *drawn: Figure[T]) -> str | None:
    """Figures and tables; nothing where it was not measured."""
    document = kept(project, kind)
    if document is None:
        return None
    parts = []
    for file, words, draw in drawn:
        write_if_changed(project.root / "docs" / "pictures" / file, draw(document).encode())
        parts.append(f"![{words}](pictures/{file})")
    return "\n\n".join([*parts, tables(document)])


def parts_of(project: Project) -> dict[str, str | None]:
    """By the name of the benchmark."""
    return {
        "boxes": _part(project, model.BoxesNumbers, page_tables.boxes_tables),
        "grading": _part(project, model.GradingNumbers, page_tables.grading_tables),
        "render": _part(project, model.RenderNumbers, page_tables.render_tables, _RAYS),
        "scale": _part(project, model.ScaleNumbers, page_tables.scale_tables, _SCALE_TESTS, _SCALE_TIME),
        "threads": _part(project, model.ThreadsNumbers, page_tables.threads_tables, _THREADS),
        "parse": _part(project, model.ParseNumbers, page_tables.parse_tables),
        "loop": _part(project, model.LoopNumbers, page_tables.loop_tables),
    }


def replace_part(page: str, name: str, content: str) -> str:
    """The page with new content between its two marks."""
    begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if len(pattern.findall(page)) != 1:
        raise GraderFault(f"docs/benchmarks.md: expected one part between '{begin}' and '{end}'")
    return pattern.sub(lambda _: f"{begin}\n{content}\n{end}", page)


def bench_docs(project: Project, console: Console) -> int:
    """Writes the parts that have been measured, and names the others."""
    path = project.root / "docs" / "benchmarks.md"
    page = path.read_text(encoding="utf-8")
    measured = parts_of(project)
    if not any(measured.values()):
        raise UsageError("nothing has been measured yet; begin with: ./raysteps bench render")
    for name, content in measured.items():
        if content is None:
            console.print(f"not measured here, left as it is: {name}")
        else:
            page = replace_part(page, name, content)
    changed = write_if_changed(path, page.encode())
    console.print(escape(f"{path} {'written' if changed else 'is up to date'}"), soft_wrap=True)
    return 0
