"""Dead links: to files that are not there, and to headings that nobody wrote."""

from collections.abc import Iterable
from pathlib import Path
from urllib.parse import unquote

from raysteps.common.markdown import anchors, targets


def is_elsewhere(target: str) -> bool:
    """Whether a link leaves the repository."""
    return "://" in target or target.startswith("mailto:")


def split(document: Path, target: str) -> tuple[Path, str]:
    """The file that a link leads to, and the anchor in it."""
    path, _, anchor = target.partition("#")
    return (document.parent / unquote(path)).resolve() if path else document.resolve(), anchor


def dead_links(root: Path, documents: Iterable[Path]) -> list[str]:
    """One line for each, with its place."""
    found = []
    known: dict[Path, set[str]] = {}
    for name in documents:
        document = root / name
        for line, target in targets(document.read_text(encoding="utf-8")):
            if is_elsewhere(target):
                continue
            path, anchor = split(document, target)
            if not path.exists():
                found.append(f"{name}:{line}: {target}: expected a file of the repository, found nothing of that name")
            elif not path.is_relative_to(root.resolve()):
                found.append(f"{name}:{line}: {target}: leaves the repository")
            elif anchor and path.suffix == ".md":
                if path not in known:
                    known[path] = anchors(path.read_text(encoding="utf-8"))
                if anchor not in known[path]:
                    near = ", ".join(sorted(known[path]))
                    found.append(f"{name}:{line}: {target}: no heading makes that anchor; there are: {near}")
    return found
