"""Copies what the site shows to a folder of its own, with the few changes that the site needs and a forge does not."""

import os
import shutil
from pathlib import Path

from raysteps.common.markdown import Block, with_tags, with_targets
from raysteps.kit.project import Project
from raysteps.upkeep.site.documents import COMMANDS_PAGE, below, documents, front_page, sections
from raysteps.upkeep.site.links import is_elsewhere, split
from raysteps.upkeep.site.shell import is_shell

GALLERY = Path("gallery/index.html")
_OPEN_GALLERY = '\n\n## Open it\n\n<p><a href="../gallery/index.html">The gallery of this site</a></p>\n'


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


def stage(project: Project, folder: Path, commands: str, *, gallery: bool) -> None:
    """Fills the folder. `commands` is the text of the page of commands; `gallery` is whether the site has its page."""
    made = _Stage(project, folder)
    for document in documents(project):
        is_gallery = gallery and document == Path("docs/gallery.md")
        made.put(document, _OPEN_GALLERY if is_gallery else _menu(project, document))
    made.write(COMMANDS_PAGE, commands)
    static = folder / "_static"
    static.mkdir()
    shutil.copyfile(Path(__file__).parent / "static" / "site.css", static / "site.css")
