"""Runs Sphinx on what was staged."""

import io
import os
import re
import shutil
import sys
from collections.abc import Collection, Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from raysteps.common.errors import UsageError
from raysteps.common.files import OwnedFolder
from raysteps.common.markdown import Block, mathml, with_tags, with_targets
from raysteps.course.manifest import kit_steps
from raysteps.course.project import Project, here
from tools.website.documents import below, documents, front_page, is_elsewhere, is_shell, sections, split
from tools.website.live_figures import LiveFigures

# What the theme leaves out for people who use a keyboard or a screen reader.

_CHANGES = (
    ('<p class="caption" role="heading">', '<p class="caption" role="heading" aria-level="2">'),
    ('<aside class="sidebar-drawer">', '<aside class="sidebar-drawer" aria-label="Menu">'),
    ('<aside class="toc-drawer">', '<aside class="toc-drawer" aria-label="On this page">'),
    ('<aside class="toc-drawer no-toc">', '<aside class="toc-drawer no-toc" aria-label="On this page">'),
    ('<div class="highlight"><pre>', '<div class="highlight"><pre tabindex="0">'),
    ('<div class="table-wrapper', '<div tabindex="0" class="table-wrapper'),
)


_TO_THE_TOP = re.compile(r'<a href="#" class="back-to-top.*?</a>', re.DOTALL)


def make_accessible(site: Path) -> None:
    """Changes every page: names for landmarks, levels for headings, the keyboard for what can be scrolled."""
    for page in site.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        for old, new in _CHANGES:
            text = text.replace(old, new)
        text = _TO_THE_TOP.sub(lambda found: f'<nav aria-label="Within this page">{found[0]}</nav>', text)
        page.write_text(text, encoding="utf-8")


_LIGHT = dict.fromkeys(("color-brand-primary", "color-brand-content", "color-brand-visited"), "#9a4408")
_DARK = dict.fromkeys(_LIGHT, "#f5a65b")
SETTINGS: dict[str, Any] = {
    "extensions": ["myst_parser", "tools.website.build"],
    "project": "Raysteps",
    "html_title": "Raysteps",
    "html_theme": "furo",
    "html_static_path": ["_static"],
    "html_css_files": ["site.css"],
    "html_copy_source": False,
    "html_show_sourcelink": False,
    "html_show_copyright": False,
    "html_use_index": False,
    "html_domain_indices": False,
    "html_show_search_summary": False,  # would read other pages as files, which browsers forbid
    "html_permalinks_icon": "#",
    "html_theme_options": {
        "navigation_with_keys": False,
        "light_css_variables": {**_LIGHT, "color-code-background": "#f1efea"},
        "dark_css_variables": {**_DARK, "color-code-background": "#26292e"},
    },
    "highlight_language": "text",
    "pygments_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
    "myst_enable_extensions": ["dollarmath"],
    "myst_dmath_double_inline": True,
    "myst_heading_anchors": 6,
    "myst_url_schemes": ["http", "https", "mailto"],
    "smartquotes": False,
    "language": "en",
}
# The theme's own settings are known only to settings that come from a file.
_CONF = "from tools.website.build import SETTINGS\n\nglobals().update(SETTINGS)\n"


def check_tools() -> None:
    """Says what to install where Sphinx and its parts are not there, as in a students' kit."""
    for name in ("sphinx", "myst_parser", "furo"):
        if find_spec(name) is None:
            raise UsageError(
                f"the site is built with Sphinx, and the Python package {name} is not installed; install it with:\n"
                f'  "{sys.executable}" -m pip install -e "{here().root / "grader"}[docs]"'
            )


def _find_options(stage: Path) -> None:
    """Lets the search find the words of options, such as those of `--against`, which it leaves out in English."""
    from sphinx.search.en import SearchEnglish

    pages = (path.read_text(encoding="utf-8") for path in stage.rglob("*.md"))
    words = {word for page in pages for option in re.findall(r"--([a-z][a-z-]*)", page) for word in option.split("-")}
    SearchEnglish.stopwords = SearchEnglish.stopwords - words


def build_site(stage: Path, out: Path, work: Path) -> list[str]:
    """Writes the pages to `out` and returns what Sphinx complained about."""
    from sphinx.application import Sphinx  # only here: the other commands need not wait for it
    from sphinx.util.docutils import docutils_namespace

    (stage / "conf.py").write_text(_CONF, encoding="utf-8")
    _find_options(stage)
    said = io.StringIO()
    with docutils_namespace():
        sphinx = Sphinx(
            srcdir=stage,
            confdir=stage,
            outdir=out,
            doctreedir=work / "doctrees",
            buildername="html",
            status=None,
            warning=said,
            freshenv=True,
        )
        sphinx.build(force_all=True)
    make_accessible(out)
    (out / ".nojekyll").touch()
    (out / ".buildinfo").unlink(missing_ok=True)
    return [line.replace(f"{stage}{os.sep}", "") for line in said.getvalue().splitlines() if line.strip()]


# Copies what the site shows to a folder of its own, with the few changes that the site needs and a forge does not.

GALLERY, PLAY = Path("gallery/index.html"), Path("play/index.html")
# Pages that were made before, by the documents that tell of them.
_MADE_BEFORE = {
    Path("docs/gallery.md"): (GALLERY, "The gallery of this site"),
    Path("docs/play.md"): (PLAY, "The page to work in"),
}


def _open(page: Path, name: str) -> str:
    return f'\n\n## Open it\n\n<p><a href="../{page.as_posix()}">{name}</a></p>\n'


def _tag(block: Block) -> str:
    """What an untagged block is, for colours."""
    return "sh" if is_shell(block) else block.tag or "text"


def _tree(options: str, pages: tuple[Path, ...]) -> str:
    lines = "\n".join(f"/{page.with_suffix('').as_posix()}" for page in pages)
    return f"\n\n```{{toctree}}\n:hidden:\n{options}\n{lines}\n```\n"


def _menu(project: Project, document: Path) -> str:
    """What Sphinx learns the menu from."""
    if document == front_page():
        return "".join(_tree(f":caption: {part.title}\n", part.pages) for part in sections(project))
    children = below(project, document)
    return _tree("", children) if children else ""


class _Stage:
    def __init__(self, project: Project, folder: Path) -> None:
        self._root = project.root.resolve()
        self._folder = folder
        self._pages = {front_page(): Path("index.md")} | {page: page for page in documents(project)[1:]}

    def _target(self, document: Path, target: str) -> str:
        """Where a link leads on the site. Files beside the documents come along; folders have no page."""
        if is_elsewhere(target) or target.startswith("#"):
            return target
        path, anchor = split(self._root / document, target)
        name = path.relative_to(self._root)
        if path.is_dir():
            return "#"
        if name not in self._pages and path.is_file():
            self._bring(name)
        there = os.path.relpath(self._pages.get(name, name), self._pages[document].parent)
        return Path(there).as_posix() + (f"#{anchor}" if anchor else "")

    def _bring(self, name: Path) -> None:
        copy = self._folder / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(self._root / name, copy)

    def put(self, document: Path, more: str = "") -> None:
        text = (self._root / document).read_text(encoding="utf-8") + more
        text = with_tags(with_targets(text, lambda target: self._target(document, target)), _tag)
        self.write(self._pages[document], text)

    def write(self, name: Path, text: str) -> None:
        path = self._folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def stage(
    project: Project,
    folder: Path,
    made_pages: Mapping[Path, str],
    made_before: Collection[Path],
    live: LiveFigures | None = None,
) -> None:
    """Fills the folder. `made_pages` are the texts of pages that nobody wrote; `made_before` is which of GALLERY and
    PLAY the site has."""
    made = _Stage(project, folder)
    steps = {Path("steps") / step.id / "README.md": step for step in kit_steps(project)}
    for document in documents(project):
        known = _MADE_BEFORE.get(document)
        more = _open(*known) if known and known[0] in made_before else _menu(project, document)
        made.put(document, more + live.in_handout(steps[document]) if live and document in steps else more)
    for page, text in made_pages.items():
        made.write(page, text)
    style = (Path(__file__).parent / "static" / "site.css").read_text(encoding="utf-8")
    static = {"site.css": style} if live is None else {"site.css": style + live.style, **live.scripts}
    for name, text in static.items():
        made.write(Path("_static") / name, text)


SITE = OwnedFolder("site", ".raysteps-site.json", "raysteps/site/v1")


# Formulas become MathML when the site is built, so a page needs no script and no network to show them.


def setup(application: Any) -> dict[str, bool]:
    """Sphinx calls this."""
    from docutils import nodes  # which the other commands do not need

    def inline(visitor: Any, node: Any) -> None:
        visitor.body.append(mathml(node.astext(), block=False))
        raise nodes.SkipNode

    def block(visitor: Any, node: Any) -> None:
        visitor.body.append(f'<div class="formula" tabindex="0">{mathml(node.astext(), block=True)}</div>')
        raise nodes.SkipNode

    application.add_html_math_renderer("mathml", inline_renderers=(inline, None), block_renderers=(block, None))
    application.config.html_math_renderer = "mathml"
    return {"parallel_read_safe": True, "parallel_write_safe": True}
