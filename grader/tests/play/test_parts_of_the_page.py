"""What the page is made of: handouts, modules, the words of reports. The whole page: test_play_page.py."""

import json
import shutil
from argparse import Namespace
from collections.abc import Iterator
from dataclasses import replace
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.error import HTTPError
from urllib.request import urlopen

import numpy as np
import pytest
from browser import Watched
from catch2_words import COMPARISONS
from estimate_files import bytes_of
from rich.console import Console

from raysteps.cli import play
from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.stubs import pristine_stub
from raysteps.grading.build_messages import AS_IN_A_HEADER, barred_message, twice_message, undefined_message
from raysteps.images.compare import compare, parse_ppm
from raysteps.images.noise import Estimates, compare_estimates
from raysteps.play.play_page import PlayServer, barred, first_includes, handout, publish, refuse_to_publish, with_places
from raysteps.results.statuses import NOT_BUILT
from raysteps.toolchain.catch2 import parse_report

if TYPE_CHECKING:
    from playwright.sync_api import Page


def test_modules_find_each_other_by_their_places() -> None:
    source = (
        "import { a } from '@codemirror/view';\nimport b from 'crelt';\nimport './own.js';\nexport * from './x.js';\n"
    )
    assert with_places(source, "./editor/") == (
        "import { a } from './editor/codemirror-view.js';\nimport b from './editor/crelt.js';\n"
        "import './own.js';\nexport * from './x.js';\n"
    )


def test_what_a_source_includes_first(project: Project, steps: list[Step]) -> None:
    text = '// mine\n#include "a.hpp"\n\n  #include <vector>  \nint x;\n#include <map>\n'
    assert first_includes(text) == '#include "a.hpp"\n#include <vector>\n'
    assert first_includes("int x;\n") == ""
    assert first_includes(text.replace("\n", "\r\n")) == first_includes(text)
    for step in steps:
        assert first_includes(pristine_stub(project, step)).startswith(f'#include "steps/{step.id}/')


def test_a_handout_leads_to_other_steps_and_to_its_figures(project: Project, steps: list[Step]) -> None:
    asked: list[str] = []

    def shown(path: str) -> str:
        asked.append(path)
        return f"figures/{Path(path).name}"

    numbers = {step.id: step.number for step in steps}
    for step in steps:
        text = handout((project.steps / step.id / "README.md").read_text("utf-8"), numbers, shown, lambda name: None)
        assert text.count("are typed where the kit is installed") == 1, "before the first command"
        assert "../" not in text, step.id
        assert "\ue000" not in text
        assert "<table " in text
    assert all((project.root / path).is_file() for path in asked)
    text = handout(
        "[next](../02-intersection/README.md) [x](../../docs/judge.md) $a^2$ `$b$`", numbers, shown, lambda name: None
    )
    assert '<a href="#02">next</a> x <math' in text
    assert "<code>$b$</code>" in text
    text = handout("$$a^2$$", numbers, shown, lambda name: None)
    assert '<p class="play-formula" tabindex="0"><math' in text, "a keyboard can scroll what is wider than a phone"
    text = handout("`a.hpp` `b.cpp` `./raysteps` `c::d`", numbers, shown, {"a.hpp": "texts/a.hpp.txt"}.get)
    assert '<a href="texts/a.hpp.txt" class="play-text"><code>a.hpp</code></a> <code>b.cpp</code> <code>./' in text
    assert "are typed" not in text


_PAGE = """<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">
<script type="module" src="check.js"></script>"""
_CHECK = """import { linkerWords, printedIn, readReport } from "./report.js";
import { compareEstimates, readEstimates } from "./noise.js";
import { compare, readPpm } from "./pictures.js";
import { firstIncludes } from "./includes.js";
import { borrowedWords } from "./borrowed.js";
import { Compiler, whyNothing } from "./programs.js";
const picture = (bytes) => readPpm(new Uint8Array(bytes));
const judge = (mine, reference, most) => compare(picture(mine), picture(reference), most);
const judgeNoise = (bytes, noise) => compareEstimates(readEstimates(new Uint8Array(bytes)), noise);
window.checks = { linkerWords, borrowedWords, printedIn, readReport, firstIncludes, judge, judgeNoise, readEstimates,
  Compiler, whyNothing };
"""


@pytest.fixture
def server(tmp_path: Path) -> Iterator[PlayServer]:
    for name in ("report.js", "noise.js", "pictures.js", "includes.js", "borrowed.js", "programs.js"):
        (tmp_path / name).write_bytes(files("raysteps.play").joinpath("static", name).read_bytes())
    (tmp_path / "index.html").write_text(_PAGE)
    (tmp_path / "check.js").write_text(_CHECK)
    found = PlayServer(tmp_path)
    yield found
    found.close()


def test_nothing_is_served_from_beside_the_folder(server: PlayServer, tmp_path: Path) -> None:
    (tmp_path / "page").mkdir()
    server.folder = (tmp_path / "page").resolve()
    (tmp_path / "beside.html").touch()
    (tmp_path / "page" / "leads-there.html").symlink_to(tmp_path / "beside.html")
    (tmp_path / "page" / "index.html").touch()
    with urlopen(server.address) as answer:
        assert answer.status == 200
    for place in ("leads-there.html", "../beside.html", "%2e%2e/beside.html", "..%2fbeside.html", "..%5cbeside.html"):
        with pytest.raises(HTTPError, match="404"):
            urlopen(server.address + place)


def test_a_port_that_is_taken_is_told_before_a_page_is_made(
    server: PlayServer, project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(play, "PlayPage", lambda *_: pytest.fail("the page is made"))
    monkeypatch.setattr(play, "end_as_interrupted", lambda: None)
    options = Namespace(port=server.port, registry=None, no_open=True, out=None)
    with pytest.raises(UsageError, match=rf"--port {server.port}: .*What you write on the page is kept by its port"):
        play.run(project, options, Console(quiet=True))


def test_a_page_with_the_reference_is_not_published(
    project: Project, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(play, "PlayPage", lambda *_: pytest.fail("the page is made"))
    monkeypatch.setattr(play, "end_as_interrupted", lambda: None)
    options = Namespace(port=0, registry=None, no_open=True, out=tmp_path / "public")
    with pytest.raises(UsageError, match=r"reference's steps and must not be published; make a students' kit"):
        play.run(project, options, Console(quiet=True))
    assert not (tmp_path / "public").exists()


def test_a_page_is_published_where_nothing_else_is(tmp_path: Path) -> None:
    made = tmp_path / "site"
    (made / "steps").mkdir(parents=True)
    (made / "steps" / "01.html").write_text("one", "utf-8")
    (made / "index.html").write_text('<html lang="en">', "utf-8")
    (made / "offline.js").write_text('("@EDITION@", ["@FIRST@"])', "utf-8")
    (made / "play.js").write_text("play", "utf-8")
    kit = Project(tmp_path / "kit")  # without solutions
    (tmp_path / "empty").mkdir()
    for name in ("new/play", "empty"):
        refuse_to_publish(kit, tmp_path / name)
        publish(made, tmp_path / name)
        assert (tmp_path / name / "steps" / "01.html").read_text("utf-8") == "one"
        assert (tmp_path / name / "index.html").read_text("utf-8") == '<html data-published lang="en">'
        assert (tmp_path / name / "offline.js").read_text("utf-8") == '("site", ["./", "play.js"])'
    for place in (made, made / "steps" / "01.html"):
        with pytest.raises(
            UsageError, match="holds something else; expected a new or an empty folder, or an older page"
        ):
            refuse_to_publish(kit, place)
    assert {path.name for path in tmp_path.iterdir()} == {"site", "new", "empty"}


def test_a_page_takes_the_place_of_an_earlier_one(tmp_path: Path) -> None:
    made, out, kit = tmp_path / "site", tmp_path / "public", Project(tmp_path / "kit")

    def publish_with(pages: dict[str, str]) -> None:
        for name, text in {"index.html": "<html >", "offline.js": "", **pages}.items():
            (made / name).parent.mkdir(parents=True, exist_ok=True)
            (made / name).write_text(text, "utf-8")
        publish(made, out)
        shutil.rmtree(made)

    publish_with({"steps/01.html": "one", "steps/02.html": "two"})
    (out / ".git").mkdir()
    (out / "CNAME").write_text("course.example", "utf-8")
    refuse_to_publish(kit, out)
    publish_with({"steps/01.html": "other"})
    texts = {path.relative_to(out).as_posix(): path.read_text("utf-8") for path in out.rglob("*") if path.is_file()}
    assert texts.pop(".raysteps-page.json")
    assert texts == {
        "index.html": "<html data-published >",
        "offline.js": "",
        "steps/01.html": "other",
        "CNAME": "course.example",
    }
    (out / "steps" / "01.html").write_text("with words of my own", "utf-8")
    with pytest.raises(UsageError, match=r"01\.html: was changed since the page to work in was written"):
        refuse_to_publish(kit, out)
    with pytest.raises(UsageError, match=r"01\.html: was changed since the page to work in was written"):
        publish_with({"steps/01.html": "third"})
    assert (out / "steps" / "01.html").read_text("utf-8") == "with words of my own"
    (out / "steps" / "01.html").unlink()  # which is nothing to lose
    with pytest.raises(UsageError, match="CNAME: is not of an older page to work in"):
        publish_with({"CNAME": "mine"})
    assert (out / "CNAME").read_text("utf-8") == "course.example"
    assert {path.name for path in tmp_path.iterdir()} <= {"site", "public"}


def test_a_page_is_published_in_the_folder_where_one_stands_and_touches_nothing_else(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made, out, own = tmp_path / "site", tmp_path / "public", tmp_path / "own"
    for folder in (made / "steps", out, own):
        folder.mkdir(parents=True)
    for name, text in {"index.html": "<html >", "offline.js": "", "steps/01.html": "one"}.items():
        (made / name).write_text(text, "utf-8")
    monkeypatch.chdir(out)
    publish(made, Path())
    assert (out / "steps" / "01.html").read_text("utf-8") == "one"
    shutil.rmtree(out / "steps")
    (out / "steps").symlink_to(own, target_is_directory=True)
    (own / "01.html").write_text("of another folder", "utf-8")
    with pytest.raises(UsageError, match=r"01\.html: is not of an older page"):
        publish(made, out)
    assert (own / "01.html").read_text("utf-8") == "of another folder"
    (out / "steps").unlink()
    (out / "steps").write_text("a file where the page has a folder", "utf-8")
    with pytest.raises(UsageError, match="steps: is not of an older page"):
        publish(made, out)
    assert (out / "index.html").is_file()
    (out / ".raysteps-page.json").write_text('{"schema": "raysteps/page/v1", "files": 5}', "utf-8")
    with pytest.raises(UsageError, match="holds something else"):
        publish(made, out)


def test_before_there_is_a_page_there_is_nothing() -> None:
    found = PlayServer()
    with pytest.raises(HTTPError, match="404"):
        urlopen(found.address)
    found.close()


def _open(watched: Watched, server: PlayServer) -> "Page":
    watched.allowed.append(server.address)
    page = watched.open(server.address)
    page.wait_for_function("'checks' in window")
    return page


_WORKER = """import "./report.js";
fetch("report.js").then(() => postMessage("came"), () => postMessage("refused"));"""
_ASK = """name => new Promise(resolve => {
  const worker = new Worker(name, { type: "module" });
  worker.onmessage = ({ data }) => resolve(data);
})"""


@pytest.mark.parametrize(("name", "wanted"), [("compiler.js", "came"), ("runner.js", "refused")])
def test_a_worker_may_do_what_it_needs(
    watched: Watched, server: PlayServer, tmp_path: Path, name: str, wanted: str
) -> None:
    (tmp_path / name).write_text(_WORKER)
    page = _open(watched, server)
    assert page.evaluate(_ASK, name) == wanted
    with urlopen(server.address) as answer:
        assert answer.headers["Content-Security-Policy"] is None  # it stands in the page


def test_the_page_says_of_a_report_what_the_grader_says(watched: Watched, server: PlayServer) -> None:
    page = _open(watched, server)
    cases = "".join(
        f'<TestCase name="{at}" filename="/k/a_test.cpp" line="3"><Section name="part &amp; {at}">'
        "<Info>x := 2.5f</Info>"
        f'<Expression success="false" filename="/k/{"a_test.cpp" if at % 2 else "hits.hpp"}" line="{at}">'
        f"<Original>{original}</Original><Expanded>{expanded}</Expanded>"
        f"{'<Exception>bad &lt; worse</Exception>' if at % 5 == 4 else ''}</Expression></Section>"
        '<OverallResult success="false"/></TestCase>'
        for at, (original, expanded, _, _) in enumerate(COMPARISONS)
    )
    more = """<TestCase name="fails" filename="b_test.cpp" line="1"><Info>one</Info><Failure filename="b_test.cpp"
        line="5">plainly</Failure><OverallResult success="false"/></TestCase><TestCase name="throws"
        filename="b_test.cpp" line="1"><Exception filename="b_test.cpp" line="8">oh</Exception><OverallResult
        success="false"/></TestCase><TestCase name="good"><OverallResult success="true"/></TestCase>"""
    totals = f'<OverallResultsCases successes="1" failures="{len(COMPARISONS) + 2}"/>'
    for room in ("Catch2TestRun", "Catch"):
        inner = f"<Group>{cases}{more}</Group>" if room == "Catch" else cases + more
        report = f"<{room}>{inner}{totals}</{room}>"
        wanted = parse_report(report.encode())
        assert wanted is not None
        found = page.evaluate("text => checks.readReport(text)", report)
        assert [one["name"] for one in found] == [one.name for one in wanted]
        assert [one["passed"] for one in found] == [one.passed for one in wanted]
        for one, other in zip(found, wanted, strict=True):
            failure = other.failure and {
                "expected": other.failure.expected,
                "got": other.failure.got,
                "where": other.failure.location,
                "notes": other.failure.notes,
            }
            assert one["failure"] == failure
    assert page.evaluate("checks.readReport('<Catch2TestRun><TestCase/></Catch2TestRun>')") is None
    streams = "<StdOut>\nat 1 &lt; 2\n</StdOut><StdErr>x</StdErr>"
    printed = f"<Catch><TestCase><OverallResult>{streams}</OverallResult></TestCase></Catch>"
    assert page.evaluate("text => checks.printedIn(text)", printed) == "at 1 < 2\nx"
    assert page.evaluate("checks.readReport('<Catch2TestRun>')") is None


def test_what_the_linker_says_in_the_words_of_the_grader(watched: Watched, server: PlayServer) -> None:
    """Functions that a contract asks for: test_play_page.py."""
    page = _open(watched, server)
    words = {
        "twice": twice_message("{}"),
        "undefined": [undefined_message(names) for names in (("{}",), ("{}", "{}"))],
        "asInAHeader": AS_IN_A_HEADER,
    }
    said = "wasm-ld: error: duplicate symbol: raysteps::far(float)\n>>> defined in /work/own-01.o\n"
    helpers = "".join(f"wasm-ld: error: /work/own-02.o: undefined symbol: raysteps::f{one}()\n" for one in "12345612")
    vector = "far(glm::vec<3, float, (glm::qualifier)0> const&, std::span<Ray const, 4294967295ul>)"
    asked = f"wasm-ld: error: /work/own-02.o: undefined symbol: raysteps::{vector}\n"
    for text, wanted in (
        (asked, undefined_message(("far(const glm::vec3&, std::span<const Ray>)",))),
        (said, twice_message("raysteps::far(float)")),
        (helpers, undefined_message(tuple(f"f{one}()" for one in "123456"))),
        ("camera_rays.cpp:3:1: error: no such thing\n", None),
        ("", None),
    ):
        assert page.evaluate("([text, words]) => checks.linkerWords(text, words)", [text, words]) == wanted


def test_the_page_refuses_what_a_manifest_bars(watched: Watched, server: PlayServer, steps: list[Step]) -> None:
    """By the linker's names, in the words of the grader, at the first place that is no comment."""
    page = _open(watched, server)
    tree, search = "_ZN8raysteps12build_octreeERKSt6vectorE", "_ZN8raysteps21closest_hit_in_octreeERKNS_4NodeE"
    step = steps[8]
    described = {"barred": barred(step), "source": f"/kit/steps/{step.path.as_posix()}"}
    one = barred_message(step, "06-octree", ["closest_hit_in_octree"]).removeprefix(NOT_BUILT)
    both = barred_message(step, "06-octree", ["build_octree", "closest_hit_in_octree"]).removeprefix(NOT_BUILT)
    source = '// closest_hit_in_octree\nauto say = "build_octree";\nauto f() { return closest_hit_in_octree(a, b); }\n'
    for asked, text, wanted in (
        ([search], source, f"3:19: error: {one}"),
        ([tree, search], source, f"3:19: error: {both}"),
        ([search], "#define a closest ## _hit", f"1:1: error: {one}"),
        (["_ZN8raysteps22closest_hit_in_octree2E", "_ZN4mine21closest_hit_in_octreeE"], source, None),
    ):
        words = page.evaluate("words => checks.borrowedWords(...words)", [described, asked, text])
        assert words == ("" if wanted is None else f"{described['source']}:{wanted}\n")
    assert not [other.id for other in steps if other is not step and barred(other)]
    member = replace(step, barred=(("02-intersection", "Sphere::intersect"),))
    described |= {"barred": barred(member)}
    asked = ["_ZNK8raysteps6Sphere9intersectERKNS_3RayE"]
    assert page.evaluate("words => checks.borrowedWords(...words)", [described, asked, ""])


# With a worker that is ready at once, and can build nothing.
_FAILS = """async () => {
    const asked = [];
    window.Worker = class {
        terminate() {}
        postMessage(words) {
            asked.push(words);
            if ("kit" in words) this.onmessage({ data: { ready: true } });
            if ("job" in words) this.onmessage({ data: { job: words.job, failed: "no room" } });
        }
    };
    const compiler = new checks.Compiler({}, () => {});
    await compiler.prepare();
    const why = await compiler.build("01", {}, 60).catch((error) => error.message);
    compiler.lookAhead("02", "int x;");
    return [why, asked.at(-1).ahead];
}"""


def test_what_gives_nothing_is_told_and_is_over(watched: Watched, server: PlayServer) -> None:
    page = _open(watched, server)
    assert page.evaluate(_FAILS) == ["no room", "02"]
    assert page.evaluate("checks.readEstimates(undefined)") is None
    why = page.evaluate("checks.whyNothing({ code: 0, stderr: '' }, 'The picture', '')")
    assert why.endswith("the program gave up with exit code 0, as by a call of exit(0).")


def test_the_page_finds_the_same_first_includes(
    watched: Watched, server: PlayServer, project: Project, steps: list[Step]
) -> None:
    page = _open(watched, server)
    sources = [
        "",
        "int x;\n#include <map>\n",
        "#include <map>",
        '\t#  include "a.hpp" // mine \n\n \t\n// and\n#include <vector>\t \nint x;\n#include <map>\n',
        "#include <map>\n#if 1\n#include <set>\n#endif\n",
        "#include <map>\n#define A\n#include <set>\n",
        "#include <map>\n/* mine */\n#include <set>\n",
        "#include <map> /* one\n#include <set>\n*/\n",
        "#pragma once\n#include <map>\n",
        "#include <map>\r#include <set>\n\r\r\n#include <list>\n",
        "// \u2028#include <set>\n\u00a0\n#include <map>\n",
        "#include <map>\u00a0\x0b\n\x0c\n#include <set>\n",
        "\ufeff#include <map>\n",
        *(pristine_stub(project, step) for step in steps),
    ]
    for source in [*sources, *(source.replace("\n", "\r\n") for source in sources)]:
        assert page.evaluate("text => checks.firstIncludes(text)", source) == first_includes(source), source


@pytest.mark.parametrize(
    ("mine", "reference"),
    [
        (b"P6\n3 1\n255\n\1\2\3\4\5\6\7\10\11", b"P6\n3 1\n255\n\1\2\3\4\5\6\7\10\11"),
        (b"P6\n3 1\n255\n\1\2\3\4\5\7\7\10\11", b"P6\n3 1\n255\n\1\2\3\4\5\11\7\10\14"),
        (b"P6\n3 1\n255\n\1\2\3\1\2\3\1\2\3", b"P6\n3 1\n255\n\1\2\3\4\5\6\7\10\11"),
        (b"P6\n1 3\n255\n\1\2\3\4\5\6\7\10\11", b"P6\n3 1\n255\n\1\2\3\4\5\6\7\10\11"),
    ],
)
@pytest.mark.parametrize("most", [0.0, 0.4])
def test_the_page_judges_a_picture_as_the_grader_does(
    watched: Watched, server: PlayServer, mine: bytes, reference: bytes, most: float
) -> None:
    page = _open(watched, server)
    wanted = compare(parse_ppm(mine), parse_ppm(reference), most)
    found = page.evaluate(f"checks.judge({json.dumps(list(mine))}, {json.dumps(list(reference))}, {most})")
    assert found == {"passed": wanted.passed, "message": wanted.message}


@pytest.mark.parametrize(
    ("factor", "part", "shape", "lost"),
    [
        (1.0, 1.0, 1.0, False),
        (0.8, 1.0, 1.0, False),
        (1.25, 1.0, 1.0, False),
        (1.0, 0.5, 1.0, False),
        (1.0, 1.0, 0.2, False),
        (1.0, 1.0, 1.0, True),
    ],
)
def test_the_page_judges_a_noisy_picture_as_the_grader_does(
    watched: Watched, server: PlayServer, factor: float, part: float, shape: float, lost: bool
) -> None:
    rng = np.random.default_rng(7)
    light = np.full((20, 27, 3), (0.6, 0.4, 0.2))

    def drawn(scene: np.ndarray, samples: int, shape: float = 1.0) -> Estimates:
        found = rng.gamma(shape, scene / shape, (samples, *scene.shape))
        return Estimates(found.mean(axis=0), found.var(axis=0, ddof=1) / samples)

    parts = drawn(light, 64).in_parts()
    scene = factor * light
    scene[8:16, 16:24] *= part
    mine = drawn(scene, 16, shape)
    if lost:
        mine.mean[3, 4, 0] = np.nan
    wanted = compare_estimates(mine, parts, (27, 20), 4, 2.0)
    rows = np.concatenate([parts.mean, parts.variance], axis=2).reshape(-1, 6).tolist()
    noise = {"width": 27, "height": 20, "most": 2.0, "factor": 4, "parts": rows}
    page = _open(watched, server)
    found = page.evaluate(f"checks.judgeNoise({json.dumps(list(bytes_of(mine)))}, {json.dumps(noise)})")
    assert found == {"passed": wanted.passed, "message": wanted.message}
    assert wanted.passed == ((factor, part, shape, lost) == (1.0, 1.0, 1.0, False))
