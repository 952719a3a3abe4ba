"""Links of the kit's pages: pictures that they show come along, and what is not there is not linked."""

import posixpath
import re
from pathlib import Path

from raysteps.common.markdown import targets, unlinked

_PICTURES = (".png", ".svg", ".jpg", ".gif")


def _place(page: str, link: str) -> str | None:
    """The path from the root that a link leads to; none for other sites and places in the same page."""
    path = link.partition("#")[0]
    if not path or re.match(r"[a-z]+:", path):
        return None
    return posixpath.normpath(posixpath.join(posixpath.dirname(page), path))


def add_pictures(files: dict[str, bytes], root: Path) -> None:
    """Those that a page shows, wherever the whole kit keeps them."""
    for page in [name for name in files if name.endswith(".md")]:
        for _, link in targets(files[page].decode()):
            place = _place(page, link)
            if place is None or place in files or not place.endswith(_PICTURES) or place.startswith(".."):
                continue
            if (root / place).is_file():
                files[place] = (root / place).read_bytes()


def unlink_missing(files: dict[str, bytes]) -> None:
    """`[words](docs/elsewhere.md)` becomes `words` where students do not get that page."""
    folders = {parent for name in files for parent in _parents(name)}
    for page in [name for name in files if name.endswith(".md")]:

        def is_known(link: str, page: str = page) -> bool:
            place = _place(page, link)
            return place is None or place in files or place.rstrip("/") in folders

        files[page] = unlinked(files[page].decode(), is_known).encode()


def _parents(name: str) -> list[str]:
    parts = name.split("/")
    return ["/".join(parts[:at]) for at in range(1, len(parts))]
