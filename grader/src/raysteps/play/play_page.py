"""The page to work in as a folder of files: what any web space can hold, and what is served on this machine."""

import gzip
import io
import json
import posixpath
import re
import shutil
import tarfile
import tempfile
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from raysteps.common.errors import UsageError
from raysteps.common.files import OwnedFolder, file_lock, usable_folder, write_bytes
from raysteps.common.local_server import HTML, LocalHandler, LocalServer
from raysteps.common.markdown import mathml, unlinked, with_formulas, with_targets
from raysteps.course.manifest import ImageCase, Step, course_steps
from raysteps.course.project import Project
from raysteps.course.stubs import pristine_stub
from raysteps.grading.build_messages import (
    AS_IN_A_HEADER,
    IN_OTHER_WORDS,
    barred_message,
    missing_message,
    twice_message,
    undefined_message,
)
from raysteps.grading.images import NO_TESTS, TOO_MANY_TESTS
from raysteps.images.compare import parse_ppm, read_png, write_png
from raysteps.images.noise import read_estimates, with_samples
from raysteps.images.render import ENDLESS, reference_image_path, stored_parts
from raysteps.play.packages import CLANG, EDITOR, cache_of, clear, clear_by_age, fetch, written_once
from raysteps.play.web_clang import INPUT, OUTPUT, WebClang
from raysteps.play.web_kit import MAX_AT_ONCE, WebKit, headers_path
from raysteps.report.page import COMPARE_SCRIPTS, COMPARE_STYLES, SPACE_SCRIPTS, render_page
from raysteps.report.wording import inspect_options
from raysteps.results.statuses import NOT_BUILT
from raysteps.toolchain.kit_artifacts import ProgressCallback, rate_limited

_NAMES = (("{}",), ("{}", "{}"))  # one function that the linker misses, and several
_RAYTRACE = ["--threads", "1", "--quiet", "-o", "/out/picture.ppm", "--stats", "/out/stats.json"]


# The editor: packages of modules, which find each other by their names. In a page they do so by their places.

_IMPORT = re.compile(r"""(\bfrom\s*|\bimport\s*)(["'])([@\w][^"'.]*(?:\.[^"'/]+)*)\2""")


def _module(name: str) -> str:
    return f"{name.removeprefix('@').replace('/', '-')}.js"


def with_places(source: str, folder: str) -> str:
    """A module that asks for packages by their places; `folder` leads there."""
    return _IMPORT.sub(lambda found: f"{found[1]}{found[2]}{folder}{_module(found[3])}{found[2]}", source)


def _editor(cache: Path, registry: str, say: ProgressCallback) -> Iterator[tuple[str, bytes]]:
    for package in EDITOR:
        folder = fetch(package, cache, registry, say)
        described = json.loads((folder / "package.json").read_text("utf-8"))
        start = described["exports"]["import"]
        start = start if isinstance(start, str) else start["default"]
        yield f"editor/{_module(package.name)}", with_places((folder / start).read_text("utf-8"), "./").encode()


# Handouts.


_SOURCE = re.compile(r"<code>([\w./-]+\.(?:hpp|cpp|nff))</code>")
_TYPED = '<pre tabindex="0"><code>./raysteps '
_NOT_TYPED = (
    '<p class="play-note">Lines that begin with <code>./raysteps</code> are typed where the kit is installed. On this '
    "page <em>Run</em> checks and draws as <code>check</code> and <code>render</code> do, <em>Look inside pixel</em> "
    "is <code>inspect</code>, and <em>Hint</em> is <code>hint</code>. The tests take the same random inputs in each "
    "run here; <code>RAYSTEPS_SEED</code> is for the kit.</p>\n"
)


def handout(
    text: str, number_of: Mapping[str, str], shown: Callable[[str], str], source: Callable[[str], str | None]
) -> str:
    """HTML. `number_of` maps the folders of steps to their numbers; `shown` gives the place of a picture, `source` that
    of a file by the name that the text has for it."""
    from markdown_it import MarkdownIt

    def target(link: str) -> str:
        path = posixpath.normpath(posixpath.join("steps/any", link.partition("#")[0]))
        step = re.fullmatch(r"steps/([^/]+)/README\.md", path)
        if step and step[1] in number_of:
            return f"#{number_of[step[1]]}"
        return shown(path) if path.endswith((".png", ".svg")) else link

    def is_known(link: str) -> bool:
        return link.startswith(("#", "https:", "figures/"))

    made: list[str] = []

    def marked(formula: str, block: bool) -> str:
        made.append(mathml(formula, block=block))
        return f"\ue000{len(made) - 1}\ue001"

    plain = with_formulas(unlinked(with_targets(text, target), is_known), marked)
    html: str = MarkdownIt("commonmark", {"html": True}).enable("table").render(plain)
    html = re.sub(r"<(pre|table)>", r'<\1 tabindex="0">', html)  # which a keyboard can scroll then
    html = html.replace(_TYPED, _NOT_TYPED + _TYPED, 1)

    def linked(found: re.Match[str]) -> str:
        place = source(found[1])
        return found[0] if place is None else f'<a href="{place}" class="play-text">{found[0]}</a>'

    html = _SOURCE.sub(linked, html)
    html = re.sub("\ue000([0-9]+)\ue001", lambda found: made[int(found[1])], html)
    return re.sub(r'<p>(<math [^>]*display="block")', r'<p class="play-formula" tabindex="0">\1', html)


# Files in one.


def tar_of(content: Mapping[str, bytes]) -> bytes:
    """The same bytes for the same files."""
    data = io.BytesIO()
    with tarfile.open(fileobj=data, mode="w", format=tarfile.GNU_FORMAT) as archive:
        for name, file in sorted(content.items()):
            info = tarfile.TarInfo(name)
            info.size = len(file)
            archive.addfile(info, io.BytesIO(file))
    return data.getvalue()


def packed(content: Mapping[str, bytes]) -> bytes:
    """A tar, compressed."""
    return gzip.compress(tar_of(content), 6, mtime=0)


def _squeezed(path: Path) -> bytes:
    """A large file whose content never changes, compressed once."""
    target = path.with_name(f"{path.name}.gz")
    if not target.is_file():
        write_bytes(target, gzip.compress(path.read_bytes(), 6, mtime=0))
    return target.read_bytes()


_OF_COMPILER = re.compile(r"(float|inttypes|iso646|limits|stdalign|stdarg|stdatomic|stdbool|stdckdint|stddef|stdint|"
                          r"stdnoreturn|tgmath|unwind|__std\w+|__float\w+)\.h")  # fmt: skip
_LIBRARIES = ("crt1-command.o", "libc++.a", "libc++abi.a", "libc.a", "libclang_rt.builtins.a")


def _system(clang: WebClang, kit: WebKit, project: Project) -> dict[str, bytes]:
    """Headers and libraries, by the names that the compiler knows them by; without those for other processors."""
    found: dict[str, bytes] = {}
    for name in ("include/c++/v1", "include/wasm32-wasip1"):
        for path in (clang.system / name).rglob("*"):
            if path.is_file():
                found[f"usr/{path.relative_to(clang.system).as_posix()}"] = path.read_bytes()
    for path in (clang.system / "include").glob("*.h"):
        if _OF_COMPILER.fullmatch(path.name):
            found[f"usr/include/{path.name}"] = path.read_bytes()
    for path in (clang.system / "lib").rglob("*"):
        if path.name in _LIBRARIES:
            found[f"usr/{path.relative_to(clang.system).as_posix()}"] = path.read_bytes()
    for path in (kit.libraries / "glm").rglob("*"):
        if path.suffix in (".hpp", ".h", ".inl"):
            found[f"libraries/{path.relative_to(kit.libraries).as_posix()}"] = path.read_bytes()
    framework = project.root / "framework"
    own = [*framework.glob("core/*.hpp"), *framework.glob("web/ahead/*.hpp")]
    own += project.steps.glob("[0-9][0-9]-*/*.hpp")
    return found | {f"kit/{path.relative_to(project.root).as_posix()}": path.read_bytes() for path in own}


_NAME = re.compile(r"\b[A-Za-z_]\w{2,}\b")
_FIRST = re.compile(r"(?:[ \t]*(?:#[ \t]*include[^\n]*|//[^\n]*)?\r?\n)*")


def first_includes(source: str) -> str:
    """What a source includes before anything else stands in it; includes.js finds it in the same way."""
    found = _FIRST.match(source)
    assert found is not None  # it takes nothing, too
    lines = [line.lstrip(" \t").rstrip(" \t\r") for line in found[0].split("\n")]
    return "".join(f"{line}\n" for line in lines if line.startswith("#"))


def barred(step: Step) -> list[dict[str, Any]]:
    """What the step may not call: of each step, patterns for the linker's names of its functions by what C++ calls
    them, and what is said of one function, and of several."""

    def pattern(function: str) -> str:
        return "^_ZNK?8raysteps" + "".join(f"{len(part)}{part}" for part in function.split("::")) + "E"

    of: dict[str, dict[str, str]] = {}
    for other, function in step.barred:
        of.setdefault(other, {})[function] = pattern(function)
    return [
        {
            "symbols": symbols,
            "words": [barred_message(step, other, list(names)).removeprefix(NOT_BUILT) for names in _NAMES],
        }
        for other, symbols in of.items()
    ]


class PlayPage:
    """Puts the page together in a folder."""

    def __init__(
        self, project: Project, registry: str, say: ProgressCallback = lambda text: None, cache: Path | None = None
    ) -> None:
        self._project = project
        self._registry = registry
        self._say_once = say
        self._say = rate_limited(say)
        self._own = cache or project.build / "play"
        self._cache = cache_of(self._own)
        self._packages = self._cache / "packages"
        self._clang = WebClang(fetch(CLANG, self._packages, registry, self._say), self._cache, say)
        self._kit = WebKit(project, self._clang, self._say)
        self._content: dict[str, bytes] = {}

    def _add(self, name: str, data: bytes) -> str:
        self._content[name] = data
        return name

    def make(self) -> Path:
        """The folder, in which index.html is the page. A page that is served already keeps its own."""
        with file_lock(self._cache / ".lock", lambda: self._say_once("waiting for another command")):
            self._collect()
            folder = written_once(self._own, "site", self._content)
            if self._cache == self._own:
                packages = [self._packages / package.folder for package in (CLANG, *EDITOR)]
                clear(self._own, [folder, *packages, *self._clang.used, *self._kit.used])
            else:
                clear(self._own, [folder])
                clear_by_age(self._cache, self._kit.used)
        return folder

    def _collect(self) -> None:
        for name, data in _editor(self._packages, self._registry, self._say):
            self._add(name, data)
        for path in files("raysteps.play").joinpath("static").iterdir():
            self._add(path.name, with_places(path.read_text("utf-8"), "./editor/").encode())
        steps = course_steps(self._project)
        parts = self._kit.parts()
        self._say("packing the compiler and its headers")
        with ThreadPoolExecutor(MAX_AT_ONCE) as pool:
            clang = pool.submit(_squeezed, self._clang.wasm)
            compiled = {step.number: one for step, one in zip(steps, pool.map(self._compiled, steps), strict=True)}
        kit = {
            "clang": self._add("clang.wasm.gz", clang.result()),
            "system": self._add("system.tar.gz", packed(_system(self._clang, self._kit, self._project))),
            "parts": self._add("kit.tar.gz", packed(parts.files)),
            "objects": parts.objects,
            "input": INPUT,
            "output": OUTPUT,
            "compile": self._kit.step_command(),
            "headers": self._kit.headers_command(),
            "link": self._clang.link_command(),
            "steps": compiled,
        }
        words = {
            "endless": ENDLESS,
            "raytrace": _RAYTRACE,
            "noTests": NO_TESTS,
            "tooManyTests": TOO_MANY_TESTS,
            "missing": [missing_message(names) for names in _NAMES],
            "undefined": [undefined_message(names) for names in _NAMES],
            "twice": twice_message("{}"),
            "inOtherWords": IN_OTHER_WORDS,
            "asInAHeader": AS_IN_A_HEADER,
        }
        content = {
            "model": self._kit.model,
            "kit": kit,
            "steps": [self._described(step, steps) for step in steps],
            "words": words,
        }
        page = render_page(
            "play",
            "Raysteps",
            {},
            scripts=(*COMPARE_SCRIPTS, "watch-parts", *SPACE_SCRIPTS),
            styles=(*COMPARE_STYLES, "watch", "inspect", "play", "figures"),
            data=content,
            module="play.js",
        )
        self._add("index.html", page.encode())

    def _compiled(self, step: Step) -> dict[str, Any]:
        includes = first_includes(pristine_stub(self._project, step))
        text = self._kit.headers_text(step, includes)
        name = self._add(f"steps/{step.number}.pch.gz", _squeezed(self._kit.headers(step, text)))
        source = f"/kit/steps/{step.path.as_posix()}"
        return {
            "number": step.number,
            "source": source,
            "barred": barred(step),
            "headers": {"includes": includes, "text": text, "file": name, "path": headers_path(step)},
        }

    def _figure(self, path: str) -> str:
        found = self._project.root / path
        if not found.is_file():
            return path
        return self._add(f"figures/{found.name}", found.read_bytes())

    def _source(self, step: Step, name: str) -> str | None:
        """The place of a file to read, under a name that every web space takes for text; none of what is not there, and
        of the file that the student writes."""
        root = self._project.root
        folders = (self._project.steps / step.id, root, root / "framework", self._project.scenes / "lessons")
        paths = [folder / name for folder in folders if (folder / name).is_file()]
        if not paths or paths[0] == self._project.steps / step.path:
            return None
        return self._add(f"texts/{paths[0].relative_to(root).as_posix()}.txt", paths[0].read_bytes())

    def _described(self, step: Step, steps: list[Step]) -> dict[str, Any]:
        self._say(f"drawing the pictures of step {step.number} (once)")
        text = (self._project.steps / step.id / "README.md").read_text("utf-8")
        numbers = {other.id: other.number for other in steps}
        self._add(
            f"steps/{step.number}.html", handout(text, numbers, self._figure, partial(self._source, step)).encode()
        )
        folder = self._project.steps / step.id
        headers, tests = sorted(folder.glob("*.hpp")), sorted(folder.glob("*_test.cpp"))
        return {
            "number": step.number,
            "id": step.id,
            "title": step.title,
            "path": f"steps/{step.path.as_posix()}",
            "stub": pristine_stub(self._project, step),
            "texts": {path.name: self._source(step, path.name) for path in (*headers, *tests)},
            "names": sorted({name for path in headers for name in _NAME.findall(path.read_text("utf-8"))}),
            "hints": list(step.hints),
            "seconds": step.seconds,
            "tests": [{"name": name, "functions": list(of)} for name, of in self._kit.tests(step).items()],
            "pictures": [self._picture(step, case) for case in step.images],
        }

    def _picture(self, step: Step, case: ImageCase) -> dict[str, Any]:
        """In a students' kit without a tree where it does not ask for one: step 07 needs no step 06."""
        args = case.args if self._project.has_reference or case.has_tree else (*case.args, "--accel", "none")
        scene = self._project.root / case.scene
        name = f"pictures/{step.number}/{case.name}.png"
        if self._project.has_reference:
            made = self._noisy(case, scene)[0] if case.is_noisy else self._kit.picture(scene, args)
            picture = made.with_suffix(".png")
            if not picture.is_file():
                write_png(parse_ppm(made.read_bytes()), picture)
        else:
            picture = reference_image_path(self._project, step, case)
        self._add(name, picture.read_bytes())
        height, width, _ = read_png(picture).shape
        return {
            "name": case.name,
            "scene": self._add(f"scenes/{scene.name}", scene.read_bytes()),
            "args": list(args),
            "inspect": inspect_options(args),
            "reference": name,
            "width": width,
            "height": height,
            "maxWrong": case.max_wrong,
            "noise": self._noise(step, case, scene, (width, height)),
            "maxShare": case.max_share,
        }

    def _noisy(self, case: ImageCase, scene: Path) -> tuple[Path, Path]:
        return self._kit.noisy_picture(scene, with_samples(case.args, case.more_samples))

    def _noise(self, step: Step, case: ImageCase, scene: Path, size: tuple[int, int]) -> dict[str, Any] | None:
        """What noise.js compares a noisy picture with."""
        if not case.is_noisy:
            return None
        if self._project.has_reference:
            parts = read_estimates(self._noisy(case, scene)[1].read_bytes()).in_parts()
        else:
            parts = stored_parts(reference_image_path(self._project, step, case))
        rows = np.concatenate([parts.mean, parts.variance], axis=2).reshape(-1, 6)
        width, height = size
        numbers = [[float(f"{number:.7g}") for number in row] for row in rows]
        return {"width": width, "height": height, "most": case.max_noise, "factor": case.more_samples, "parts": numbers}


# Published, on any web space.

_PUBLISHED = OwnedFolder("page to work in", ".raysteps-page.json", "raysteps/page/v1", hashed=True)


def refuse_to_publish(project: Project, out: Path) -> None:
    """The whole kit's page holds the reference's steps as objects, which say how they are written."""
    if project.has_reference:
        raise UsageError(
            f"{out}: the page of this kit holds the reference's steps and must not be published; make a students' kit "
            "(./raysteps release --out ../course), and type ./raysteps play --out there"
        )
    check_published(out)


def check_published(out: Path) -> None:
    """A usage error unless a page can be written there: into a new or an empty folder, or over an earlier page."""
    _PUBLISHED.check(out)
    usable_folder(out)


def publish(made: Path, out: Path) -> None:
    """The page itself comes last: without it, what is there so far is none. It says that it is published: then a
    browser keeps its files."""
    page, worker = "index.html", "offline.js"
    out = out.resolve()
    check_published(out)
    with tempfile.TemporaryDirectory(prefix=f".{out.name}-new-", dir=out.parent, ignore_cleanup_errors=True) as name:
        new = Path(name) / out.name
        shutil.copytree(made, new)
        scripts = [path.relative_to(made).as_posix() for path in made.rglob("*.js") if path.name != worker]
        filled = {'"@EDITION@"': json.dumps(made.name), '["@FIRST@"]': json.dumps(["./", *sorted(scripts)])}
        text = (made / worker).read_text("utf-8")
        for mark, value in filled.items():
            text = text.replace(mark, value)
        write_bytes(new / worker, text.encode())
        write_bytes(new / page, (made / page).read_bytes().replace(b"<html ", b"<html data-published ", 1))
        _PUBLISHED.put(new, out, last=page)


# Served on this machine. Everything in the folder may be read, and nothing else.

_KINDS = {
    ".html": HTML,
    ".js": "text/javascript; charset=utf-8",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".nff": "text/plain; charset=utf-8",
    ".pbrt": "text/plain; charset=utf-8",
    ".txt": "text/plain; charset=utf-8",
    ".gz": "application/octet-stream",
}
# A worker has the policy that its script came with, not its page's. Only the one that compiles asks for more files.
_SCRIPT_POLICY = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'"
_COMPILER_POLICY = f"{_SCRIPT_POLICY}; connect-src 'self'"


class PlayServer(LocalServer):
    """Runs in a thread until it is closed. Without a folder it only keeps the port, until there is one."""

    def __init__(self, folder: Path | None = None, port: int = 0) -> None:
        super().__init__(port, _Handler)
        self.folder = folder
        self.start()


class _Handler(LocalHandler):
    server: PlayServer

    def get(self, rest: list[str]) -> None:
        if self.server.folder is None:
            self.nothing()
            return
        folder = self.server.folder.resolve()
        path = folder.joinpath(*(rest if rest != [""] else ["index.html"]))
        kind = _KINDS.get(path.suffix)
        is_inside = path.resolve().is_relative_to(folder)  # a part may hold a \\, a separator on Windows
        if kind is None or not is_inside or not path.is_file():
            self.nothing()
            return
        policy = (_COMPILER_POLICY if rest == ["compiler.js"] else _SCRIPT_POLICY) if path.suffix == ".js" else None
        self.head(200, kind, path.stat().st_size, policy)
        with path.open("rb") as file:
            shutil.copyfileobj(file, self.wfile)
