"""What can become of a step: as JSON has it, and the same in the words of pages, terminal and documents."""

from dataclasses import dataclass
from typing import Literal

Status = Literal["passed", "partial", "failed", "not-started", "does-not-build", "crashed", "timeout"]
Tone = Literal["good", "warn", "bad", "none"]


@dataclass(frozen=True)
class StatusWords:
    """How a status is said and shown."""

    words: str
    tone: Tone
    sign: str


STATUS_WORDS: dict[Status, StatusWords] = {
    "passed": StatusWords("passed", "good", "✓"),
    "partial": StatusWords("partly right", "warn", "◐"),
    "failed": StatusWords("failed", "bad", "✗"),
    "not-started": StatusWords("not started", "none", "○"),
    "does-not-build": StatusWords("does not build", "bad", "✗"),
    "crashed": StatusWords("crashed", "bad", "✗"),
    "timeout": StatusWords("took too long", "bad", "✗"),
}
NOT_TAKEN_STATUS = "not-taken"  # for the eye, and to filter by
NOT_BUILT = "It does not build: "  # so begins the message of a step that does not
NOT_TAKEN = StatusWords("not taken", "bad", "✗")  # nobody began it, as far as could be read


def in_words(status: str) -> str:
    """A status as people read it; one that this kit does not know is read without its hyphens."""
    known = {str(one): found.words for one, found in STATUS_WORDS.items()}
    return known.get(status, status.replace("-", " "))
