"""The live figures of the handouts on the site: the drawings of the page to work in, in one script, and the kit's own
functions as WebAssembly. Browsers load no modules, workers or programs where pages are files, but they do load
scripts."""

import base64
import gzip
import json
import re
from collections.abc import Callable
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.common.files import file_lock
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.play.packages import CLANG, cache_of, fetch
from raysteps.play.web_clang import WebClang
from raysteps.play.web_kit import WebKit
from raysteps.release.leaks import LIVE_PROGRAM
from raysteps.toolchain.kit_artifacts import rate_limited

_IMPORT = re.compile(r'^import \{([^}]*)\} from "\./([\w-]+\.js)";\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:async function|function|class|const) (\w+))", re.MULTILINE)
_OTHER = re.compile(r"^(?:import|export)\b", re.MULTILINE)
_ROOT = re.compile(r":root (\{.*?\n\})", re.DOTALL)
_SCRIPT, _PROGRAM = "live.js", "live-program.js"


def _name(module: str) -> str:
    return f"of_{module.removesuffix('.js').replace('-', '_')}"


def in_one_script(first: str, read: Callable[[str], str]) -> str:
    """A module and all that it imports from beside it. `read` gives the text of a module."""
    parts: dict[str, str] = {}

    def add(module: str) -> None:
        text = read(module)
        for _, other in _IMPORT.findall(text):
            if other not in parts:
                add(other)
        names = _EXPORT.findall(text)
        body = _EXPORT.sub("", _IMPORT.sub(lambda found: f"const {{{found[1]}}} = {_name(found[2])};\n", text))
        if _OTHER.search(body):
            raise ValueError(f"{module}: expected imports and exports by their names alone")
        parts[module] = f"const {_name(module)} = (() => {{\n{body}return {{ {', '.join(names)} }};\n}})();\n"

    add(first)
    return "".join(parts.values())


def _of_page(name: str) -> str:
    return files("raysteps.play").joinpath("static", name).read_text("utf-8")


def _of_reports(name: str) -> str:
    return files("raysteps.report").joinpath("static", name).read_text("utf-8")


def _of_site(name: str) -> str:
    return (Path(__file__).parent / "static" / name).read_text("utf-8")


def _script() -> str:
    worker = json.dumps(in_one_script("runner.js", _of_page))
    given = f"globalThis.raystepsLive = {{ script: document.currentScript, worker: {worker} }};\n"
    modules = in_one_script(_SCRIPT, lambda name: _of_site(name) if name == _SCRIPT else _of_page(name))
    return f"(() => {{\n{_of_reports('compare-controls.js')}{given}{modules}}})();\n"


def _style() -> str:
    colors = _ROOT.search(_of_reports("base.css"))
    if colors is None:
        raise ValueError("base.css: expected the colours of the pages in :root { ... }")
    return f".live {colors[1]}\n{_of_reports('figures.css')}{_of_site('live.css')}"


@dataclass(frozen=True)
class LiveFigures:
    """What a site with such figures has beside its pages."""

    style: str
    scripts: dict[str, str]

    def in_handout(self, step: Step) -> str:
        """What follows the handout's text; it lies in a folder in a folder."""
        static = "../../_static"
        words = f'data-step="{step.number}" data-program="{static}/{_PROGRAM}"'
        return f'\n\n<script defer src="{static}/{_SCRIPT}" {words}></script>\n'


def check_live(project: Project) -> None:
    """A usage error where there can be none."""
    if not project.has_reference:
        raise UsageError("live figures of the site are the reference's functions, which this kit does not have")


def make_live_figures(project: Project, registry: str, say: Callable[[str], None]) -> LiveFigures:
    """With the compiler of the page to work in, which is made ready where it has never run."""
    cache, far = cache_of(project.build / "play"), rate_limited(say)
    with file_lock(cache / ".lock", lambda: say("waiting for another command")):
        clang = WebClang(fetch(CLANG, cache / "packages", registry, far), cache, say)
        program = WebKit(project, clang, far).figures().read_bytes()
    letters = base64.b64encode(gzip.compress(program, mtime=0)).decode("ascii")
    return LiveFigures(_style(), {_SCRIPT: _script(), _PROGRAM: f'{LIVE_PROGRAM.decode()}"{letters}";\n'})
