"""Links of the kit's pages: pictures that they show come along, and what is not there is not linked."""

import posixpath
import re
from pathlib import Path

_LINK = re.compile(r"(!?)\[([^\]\n]*)\]\(([^)\s]+)\)")
_PICTURES = (".png", ".svg", ".jpg", ".gif")


def _target(page: str, link: str) -> str | None:
    """The path from the root that a link leads to; none for other sites and places in the same page."""
    path = link.partition("#")[0]
    if not path or re.match(r"[a-z]+:", path):
        return None
    return posixpath.normpath(posixpath.join(posixpath.dirname(page), path))


def add_pictures(files: dict[str, bytes], root: Path) -> None:
    """Those that a page shows, wherever the whole kit keeps them."""
    for page in [name for name in files if name.endswith(".md")]:
        for _, _, link in _LINK.findall(files[page].decode()):
            target = _target(page, link)
            if target is None or target in files or not target.endswith(_PICTURES) or target.startswith(".."):
                continue
            if (root / target).is_file():
                files[target] = (root / target).read_bytes()


def unlink_missing(files: dict[str, bytes]) -> None:
    """`[words](docs/elsewhere.md)` becomes `words` where students do not get that page."""
    folders = {parent for name in files for parent in _parents(name)}
    for page in [name for name in files if name.endswith(".md")]:

        def shown(found: "re.Match[str]", page: str = page) -> str:
            target = _target(page, found[3])
            known = target is None or target in files or target.rstrip("/") in folders
            return found[0] if known else found[2]

        files[page] = _LINK.sub(shown, files[page].decode()).encode()


def _parents(name: str) -> list[str]:
    parts = name.split("/")
    return ["/".join(parts[:at]) for at in range(1, len(parts))]
