"""What the page's compiler makes runs as everywhere: exceptions above all, which its own library lacks."""

import subprocess
from pathlib import Path

import pytest
from play_pages import with_packages

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.images.compare import parse_ppm, pixel_differences
from raysteps.play.packages import CLANG, cache_of, fetch, registry_of
from raysteps.play.web_clang import INPUT, OUTPUT, WebClang
from raysteps.play.web_kit import ObjectRequest, WebKit
from raysteps.release.build_release import first_steps, write_release
from raysteps.toolchain.kit_artifacts import BuiltKit

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("play")]

_THROWING = r"""
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

struct Told {
    const char* name;
    ~Told() { std::printf("~%s ", name); }
};
struct Base { virtual ~Base() = default; int base = 7; };
struct Other { virtual ~Other() = default; int other = 8; };
struct Both : Other, Base {};

void deep(int what) {
    const Told told{"deep"};
    if (what == 0) throw std::out_of_range("range " + std::string(40, 'x'));
    if (what == 1) throw 5;
    if (what == 2) throw Both();
    if (what == 3) static_cast<void>(std::vector<int>(2).at(7));
}

void tried(int what) {
    try {
        const Told told{"tried"};
        deep(what);
        std::printf("returned");
    } catch (const std::logic_error& error) {
        std::printf("logic %.6s", error.what());
    } catch (const Base& base) {
        std::printf("base %d", base.base);
    } catch (...) {
        std::printf("any, %d in flight", std::uncaught_exceptions());
    }
    std::printf("\n");
}

std::exception_ptr kept() {
    try {
        deep(1);
    } catch (...) {
        return std::current_exception();
    }
    return nullptr;
}

int main() {
    for (int what = 0; what < 5; ++what) tried(what);
    try {
        try {
            deep(0);
        } catch (...) {
            const Told told{"again"};
            try { throw std::string("inner"); } catch (const std::string& text) { std::printf("%s ", text.c_str()); }
            throw;
        }
    } catch (const std::exception& error) {
        std::printf("%.5s\n", error.what());
    }
    const std::exception_ptr once = kept();
    for (int i = 0; i < 2; ++i) {
        try {
            try { throw 1L; } catch (long) { std::rethrow_exception(once); }
        } catch (int number) {
            std::printf("%d ", number);
        }
    }
    std::printf("%d\n", std::current_exception() == nullptr);
}
"""


@pytest.fixture(scope="module")
def clang(project: Project) -> WebClang:
    cache = cache_of(project.build / "play")
    with with_packages():
        return WebClang(fetch(CLANG, cache / "packages", registry_of(None)), cache)


def test_exceptions_are_those_of_the_machine(clang: WebClang, project: Project, tmp_path: Path) -> None:
    (tmp_path / "throwing.cpp").write_text(_THROWING)
    subprocess.run(["c++", "-std=c++20", tmp_path / "throwing.cpp", "-o", tmp_path / "throwing"], check=True)
    wanted = subprocess.run([tmp_path / "throwing"], check=True, capture_output=True, text=True).stdout
    places = {"/work": tmp_path, "/kit": project.root, "/usr": clang.system}
    for name in ("/work/throwing.cpp", "/kit/framework/web/exceptions.cpp"):
        named = {INPUT: name, OUTPUT: f"/work/{Path(name).stem}.o"}
        clang.make([named.get(word, word) for word in clang.compile_command("-O2", [])], places)
    words: list[str] = []
    for word in clang.link_command():
        words += ["/work/throwing.o", "/work/exceptions.o"] if word == INPUT else [word]
    clang.make(["/work/throwing.wasm" if word == OUTPUT else word for word in words], places)
    said = clang.program(tmp_path / "throwing.wasm", ["throwing"], {})
    assert (said.code, said.stdout) == (0, wanted)


def test_pictures_are_those_of_the_machine(clang: WebClang, project: Project, kit: BuiltKit, tmp_path: Path) -> None:
    """Nearly all to the byte: the C library of the page rounds some sines and tangents better than others do."""
    web = WebKit(project, clang)
    cases = [(case.scene, case.args) for step in kit.steps for case in step.images]
    same = 0
    for scene, args in cases:
        made = web.picture(project.root / scene, args).read_bytes()
        words: list[str | Path] = [
            kit.reference("raytrace"),
            project.root / scene,
            *args,
            "--quiet",
            "-o",
            tmp_path / "native.ppm",
        ]
        subprocess.run(words, check=True)
        native = (tmp_path / "native.ppm").read_bytes()
        same += made == native
        assert (pixel_differences(parse_ppm(made), parse_ppm(native)) > 0).mean() < 0.0015, (scene, args)
    assert same >= len(cases) * 0.7


def test_its_own_sources_compile_where_steps_are_missing(
    clang: WebClang, kit: BuiltKit, steps: list[Step], tmp_path: Path
) -> None:
    folder = tmp_path / "kit"
    write_release(kit, first_steps(["1-4"], steps), "Graphics 101", folder)
    page = WebKit(Project(folder), clang)
    wanted = [one for some in page._wanted.values() for one in some]
    own = [one for one in wanted if one.source.path.startswith("framework/web/")]
    sources = {path.relative_to(folder).as_posix() for path in (folder / "framework" / "web").glob("*.cpp")}
    assert {one.source.path for one in own} == sources
    assert all(page._made(one).stat().st_size > 0 for one in own)


def test_the_sites_program_takes_neither_tests_nor_other_programs(
    clang: WebClang, project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    compile_one, made, said = WebKit._made, list[str](), list[str]()

    def listed(kit: WebKit, wanted: ObjectRequest) -> Path:
        made.append(wanted.source.path)
        return compile_one(kit, wanted)

    monkeypatch.setattr(WebKit, "_made", listed)
    assert WebKit(project, clang, said.append).figures().is_file()
    folders = {path.rpartition("/")[0] for path in made}
    assert {"framework/core", "framework/render", "framework/web"} <= folders
    assert not folders & {"framework/apps", "framework/inspect", "framework/testing"}
    assert not [path for path in made if path.endswith("_test.cpp")]
    assert said == [f"compiling the kit for the page (once): {done + 1} of {len(made)}" for done in range(len(made))]


def test_it_tells_which_headers_it_has_read(clang: WebClang, project: Project) -> None:
    """Those of precompiled headers, too."""
    page = WebKit(project, clang)
    before = page.used
    (wanted,) = [one for one in page._wanted["kit"] if one.source.path == "framework/render/encode.cpp"]
    page._made(wanted)
    places = [place.with_suffix(".headers") for place in page.used if place not in before]
    read = [path.read_text("utf-8").splitlines() for path in places if path.is_file()]
    (own,) = [names for names in read if wanted.source.path in names]
    assert {"framework/render/encode.hpp", "framework/core/scene.hpp", "framework/core/ray.hpp"} <= set(own)
    assert "framework/io/nff_reader.hpp" not in own


def test_what_trees_do_with_lists_is_compiled_ahead(clang: WebClang, project: Project) -> None:
    """Where a contract has the boxes of a tree; all that lies ready is taken by some step."""
    page = WebKit(project, clang)
    texts = {step.number: page.headers_text(step, "#include <vector>\n") for step in page.steps}
    assert texts["01"] == "#include <vector>\n"
    assert texts["06"] == '#include <vector>\n#include "web/ahead/node.hpp"\n'
    every = "".join(texts.values())
    ready = {path.name for path in (project.root / "framework" / "web" / "ahead").iterdir()} - {"lists.hpp"}
    assert ready == {name for name in ready if f'"web/ahead/{name}"' in every}
