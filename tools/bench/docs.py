"""The command `bench docs`: tables and figures of docs/benchmarks.md, from what was measured last."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import write_if_changed
from raysteps.course.project import Project
from tools.bench import figures, page_tables
from tools.bench.records import NAMES, kept

_TABLES: dict[str, Callable[[dict[str, Any]], str]] = {
    "boxes": page_tables.boxes_tables,
    "grading": page_tables.grading_tables,
    "render": page_tables.render_tables,
    "scale": page_tables.scale_tables,
    "threads": page_tables.threads_tables,
    "parse": page_tables.parse_tables,
    "loop": page_tables.loop_tables,
}
FIGURES: dict[str, list[tuple[str, str, Callable[[dict[str, Any]], str]]]] = {
    "render": [("bench-rays.svg", "nanoseconds a ray for each scene and structure", figures.render_figure)],
    "scale": [
        (
            "bench-scale-tests.svg",
            "tests of surfaces and boxes a ray, over the number of surfaces",
            lambda document: figures.scale_figure(document, "tests", "tests a ray"),
        ),
        (
            "bench-scale-time.svg",
            "nanoseconds a ray, over the number of surfaces",
            lambda document: figures.scale_figure(document, "time", "nanoseconds a ray"),
        ),
    ],
    "threads": [("bench-threads.svg", "speed-up over the number of threads", figures.threads_figure)],
}


def replace_part(page: str, name: str, content: str) -> str:
    """The page with new content between its two marks."""
    begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if len(pattern.findall(page)) != 1:
        raise GraderFault(f"docs/benchmarks.md: expected one part between '{begin}' and '{end}'")
    return pattern.sub(lambda _: f"{begin}\n{content}\n{end}", page)


def _part(name: str, document: dict[str, Any], pictures: Path) -> str:
    parts = []
    for file, words, draw in FIGURES.get(name, []):
        write_if_changed(pictures / file, draw(document).encode())
        parts.append(f"![{words}](pictures/{file})")
    return "\n\n".join([*parts, _TABLES[name](document)])


def bench_docs(project: Project, console: Console) -> int:
    """Writes the parts that have been measured, and names the others."""
    path = project.root / "docs" / "benchmarks.md"
    page = path.read_text(encoding="utf-8")
    measured = {name: kept(project, name) for name in NAMES}
    if not any(measured.values()):
        raise UsageError("nothing has been measured yet; begin with: ./raysteps bench render")
    for name, document in measured.items():
        if document is None:
            console.print(f"not measured here, left as it is: {name}")
        else:
            page = replace_part(page, name, _part(name, document, project.root / "docs" / "pictures"))
    changed = write_if_changed(path, page.encode())
    console.print(escape(f"{path} {'written' if changed else 'is up to date'}"), soft_wrap=True)
    return 0
