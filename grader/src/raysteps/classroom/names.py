"""Names of submissions that are safe as names of files, on any system."""

import hashlib
import re
import unicodedata
from collections import Counter
from collections.abc import Mapping, Sequence

ARCHIVE_ENDINGS = (".tar.gz", ".tgz", ".tar.xz", ".txz", ".tar.bz2", ".tbz2", ".tar", ".zip")
_MOST_BYTES = 100
_DEVICES = re.compile(r"(?:con|prn|aux|nul|com\d|lpt\d)(?:\..*)?", re.IGNORECASE)


def stem(entry: str) -> str:
    """Without the ending of an archive."""
    for ending in ARCHIVE_ENDINGS:
        if entry.lower().endswith(ending) and len(entry) > len(ending):
            return entry[: -len(ending)]
    return entry


def safe_name(text: str) -> str:
    """Letters, digits, `.`, `_` and `-` only; never hidden, empty, too long, or a device of Windows."""
    plain = unicodedata.normalize("NFKC", text)
    name = "".join(letter if letter.isalnum() or letter in "._-" else "_" for letter in plain).strip("._-")
    name = name.encode()[:_MOST_BYTES].decode("utf-8", "ignore").rstrip(".")
    return f"_{name}" if not name or _DEVICES.fullmatch(name) else name


def _same(name: str) -> str:
    """What a file system that ignores case, or spells letters in its own way, takes for the same name."""
    return unicodedata.normalize("NFKC", name).casefold()


def name_entries(entries: Sequence[str], known: Mapping[str, str]) -> dict[str, str]:
    """Entry -> name, no two alike. An entry that has a name (`known`) keeps it."""
    names = {entry: known[entry] for entry in entries if entry in known}
    taken = {_same(name) for name in known.values()}
    wanted = {entry: safe_name(stem(entry)) for entry in entries if entry not in known}
    often = Counter(_same(name) for name in wanted.values())
    for entry, name in wanted.items():
        mark = hashlib.sha256(entry.encode("utf-8", "surrogateescape")).hexdigest()
        unique, length = name, 6
        # The mark comes from the entry itself, so that an entry that is added later changes no name.
        while _same(unique) in taken or (unique == name and often[_same(name)] > 1):
            unique, length = f"{name}-{mark[:length]}", length + 2
        names[entry] = unique
        taken.add(_same(unique))
    return names
