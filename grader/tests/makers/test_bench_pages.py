"""Benchmarks: charts, tables and the page that holds them."""

from typing import get_args

import defusedxml.ElementTree
import pytest

from raysteps.common.errors import GraderFault
from raysteps.course.project import Project
from tools.bench.charts import Axis, Chart, Series, linear_axis, log_axis, svg_text
from tools.bench.docs import page_of, play_tables, replace_part, waits_tables
from tools.bench.model import (
    FigureRow,
    Machine,
    Numbers,
    PlayNumbers,
    RayKinds,
    SaveRow,
    SceneRays,
    Spread,
    StructureTimes,
    WaitsNumbers,
    WaitsRow,
)
from tools.bench.render import against_embree, names_of
from tools.bench.tables import markdown

pytestmark = pytest.mark.portable

_SVG = "{http://www.w3.org/2000/svg}"


def _lines(title: str, *names: str) -> Chart:
    points = [(100.0, 10.0), (1000.0, 20.0), (10000.0, 40.0)]
    x, y = log_axis("surfaces", [100.0, 10000.0]), log_axis("tests", [10.0, 40.0])
    return Chart(title, x, y, [Series(name, points) for name in names])


def test_a_chart_has_all_its_points_names_and_labels() -> None:
    root = defusedxml.ElementTree.fromstring(svg_text([_lines("a < b", "octree", "wide")]))
    assert len(root.findall(f"{_SVG}polyline")) == 2
    assert len(root.findall(f"{_SVG}circle")) == 6
    texts = [element.text for element in root.findall(f"{_SVG}text")]
    for text in ("a < b", "octree", "wide", "surfaces", "tests", "100", "1k", "10k"):
        assert text in texts


def test_points_stay_on_the_paper_and_the_larger_stands_higher() -> None:
    root = defusedxml.ElementTree.fromstring(svg_text([_lines("one", "octree"), _lines("two", "octree")]))
    width, height = (float(number) for number in root.attrib["viewBox"].split()[2:])
    places = [(float(circle.attrib["cx"]), float(circle.attrib["cy"])) for circle in root.findall(f"{_SVG}circle")]
    assert all(0 < x < width and 0 < y < height for x, y in places)
    assert places[0][1] > places[1][1] > places[2][1]
    assert places[3][0] - places[0][0] == pytest.approx(width / 2)


def test_bars_are_as_high_as_their_values() -> None:
    series = [Series("octree", [(0, 50.0), (1, 100.0)]), Series("embree", [(0, 25.0), (1, 10.0)])]
    chart = Chart("rays", Axis("scene", -0.5, 1.5), linear_axis("ns", [100.0]), series, ("rings", "gears"))
    root = defusedxml.ElementTree.fromstring(svg_text([chart]))
    heights = [float(bar.attrib["height"]) for bar in root.findall(f"{_SVG}rect")][:4]
    assert [height / heights[0] for height in heights] == pytest.approx([1.0, 2.0, 0.5, 0.2], abs=0.01)


def test_a_chart_is_readable_on_dark_paper() -> None:
    assert "prefers-color-scheme:dark" in svg_text([_lines("one", "octree")])


def test_a_table_keeps_its_columns_apart() -> None:
    assert markdown(("scene", "ns"), [("x|y", "1")]) == "| scene | ns |\n|---|---:|\n| x\\|y | 1 |"


def test_only_the_part_between_the_marks_is_replaced() -> None:
    page = "above\n<!-- begin scale -->\nold\n<!-- end scale -->\nbelow\n"
    expected = "above\n<!-- begin scale -->\nnew \\1\n<!-- end scale -->\nbelow\n"
    assert replace_part(page, "scale", "new \\1", "a.md") == expected
    with pytest.raises(GraderFault, match=r"docs/a\.md: expected one part between '<!-- begin loop -->'"):
        replace_part(page, "loop", "new", "a.md")


def test_the_page_has_a_part_for_each_benchmark(project: Project) -> None:
    for kind in get_args(Numbers):
        document = page_of(kind.name)
        page = (project.root / "docs" / document).read_text(encoding="utf-8")
        assert "\nnew\n" in replace_part(page, kind.name, "new", document)


def test_what_is_waited_for_is_told_by_the_least_and_the_median() -> None:
    here = Machine("a processor", 2, "Linux x86_64", "GNU 12", "-O3", pinned=True)
    rows = [
        WaitsRow("`hint 01`", Spread.of([0.3, 0.1, 0.2]), Spread.of([0.2, 0.2, 0.4])),
        WaitsRow("watch 01, from a save to tests and pictures", Spread.of([1.0]), None),
    ]
    lines = waits_tables(WaitsNumbers(machine=here, rows=rows)).splitlines()
    assert lines[-2:] == [
        "| `hint 01` | 3 | 0.10 | 0.20 | 0.20 |",
        "| watch 01, from a save to tests and pictures | 1 | 1.00 | 1.00 |  |",
    ]


def test_the_page_to_work_in_says_how_long_people_wait() -> None:
    numbers = PlayNumbers(
        machine=Machine("a processor", 2, "Linux x86_64", "gcc 12", "-O2", pinned=True),
        browser="Chromium 1",
        first_bytes=30_700_000,
        first_seconds=5.43,
        memory_bytes=930_000_000,
        rows=[SaveRow("06-octree", 2.5, Spread.of([1.0, 1.2, 1.1]))],
        figures=[FigureRow("06-octree", "octree", 57.8, 16.7, 33.3)],
    )
    words, table, _, figures = play_tables(numbers).split("\n\n")
    assert "The first visit: 30.7 MB, and 5.4 s until its first picture; in the end the page takes 0.9 GB" in " ".join(
        words.split()
    )
    assert table.splitlines()[-1] == "| 06-octree | 2.50 | 1.10 (1.05 to 1.15) |"
    assert figures.splitlines()[-1] == "| 06-octree | octree | 58 | 17 | 33 |"


def test_ratios_are_those_of_the_same_scene() -> None:
    def scene(ours: float, theirs: float) -> SceneRays:
        times = (("octree", Spread.of([ours])), ("embree", Spread.of([theirs])))
        sides = [StructureTimes(name, 9, 0, time, 9, 9, 9, 9, 9, time, None) for name, time in times]
        kinds = RayKinds(9, 9, 0, 0, 0, 0)
        return SceneRays("raysteps/bench-rays/v1", "rings", 9, 64, 5, 1, "3", kinds, sides)

    scenes = [scene(400.0, 100.0), scene(100.0, 100.0)]
    assert names_of(scenes) == ["octree", "embree"]
    assert against_embree(scenes, "octree") == pytest.approx(2.0)
    assert against_embree(scenes, "none") is None
