"""Names of submissions: what they tell, and how they become safe as names of files on any system."""

import hashlib
import re
import unicodedata
from collections import Counter
from collections.abc import Mapping, Sequence

from raysteps.submission.load import ARCHIVE_ENDINGS

_MAX_BYTES = 100
_DEVICES = re.compile(r"(?:con|prn|aux|nul|com\d|lpt\d)(?:\..*)?", re.IGNORECASE)
# Only the beginning is the platform's; what comes after it may be a file name that a student chose.
_CANVAS = re.compile(r"([^\W_]+)_(?:LATE_)?([0-9]+)_([0-9]+)_")  # leeann_4711_815_steps
_MOODLE = re.compile(r"(.+?)_([0-9]+)_assignsubmission_")  # Ann Lee_123_assignsubmission_file


def stem(entry: str) -> str:
    """Without the ending of an archive."""
    for ending in ARCHIVE_ENDINGS:
        if entry.lower().endswith(ending) and len(entry) > len(ending):
            return entry[: -len(ending)]
    return entry


def platform_identity(entry: str) -> tuple[str, str]:
    """The name and the number that Canvas or Moodle gave to a download: of the student, as the platform counts them.

    Empty where no platform named it."""
    found = _CANVAS.match(entry) or _MOODLE.match(entry)
    return (found[1], found[2]) if found else ("", "")


def moodle_identity(entry: str) -> tuple[str, str]:
    """The same where Moodle named it; a download of Canvas gives nothing."""
    found = None if _CANVAS.match(entry) else _MOODLE.match(entry)
    return (found[1], found[2]) if found else ("", "")


def canvas_numbers(entry: str) -> tuple[str, str] | None:
    """Of the student and the upload, in the name that Canvas gives to a download; None for any other name."""
    found = _CANVAS.match(entry)
    return (found[2], found[3]) if found else None


def folded(text: str) -> str:
    """For comparisons: without differences of case, spacing and encoding."""
    return " ".join(unicodedata.normalize("NFKC", text).casefold().split())


def safe_name(text: str) -> str:
    """Letters, digits, `.`, `_` and `-` only; never hidden, empty, too long, or a device of Windows."""
    plain = unicodedata.normalize("NFKC", text)
    name = "".join(letter if letter.isalnum() or letter in "._-" else "_" for letter in plain).strip("._-")
    name = name.encode()[:_MAX_BYTES].decode("utf-8", "ignore").rstrip(".")
    return f"_{name}" if not name or _DEVICES.fullmatch(name) else name


def name_entries(entries: Sequence[str], known: Mapping[str, str]) -> dict[str, str]:
    """Entry -> name, no two alike even where a file system ignores case. One that has a name (`known`) keeps it."""
    names = {entry: known[entry] for entry in entries if entry in known}
    taken = {folded(name) for name in known.values()}
    wanted = {entry: safe_name(stem(entry)) for entry in entries if entry not in known}
    often = Counter(folded(name) for name in wanted.values())
    for entry, name in wanted.items():
        mark = hashlib.sha256(entry.encode("utf-8", "surrogateescape")).hexdigest()
        unique, length = name, 6
        # The mark comes from the entry itself, so that an entry that is added later changes no name.
        while folded(unique) in taken or (unique == name and often[folded(name)] > 1):
            unique, length = f"{name}-{mark[:length]}", length + 2
        names[entry] = unique
        taken.add(folded(unique))
    return names
