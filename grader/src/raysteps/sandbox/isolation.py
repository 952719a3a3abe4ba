"""What keeps a student's code apart from the machine."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Isolation:
    """What kept the student's code apart from the machine."""

    name: str = "none"  # "bubblewrap", "other user", "landlock", "limits only", "none"
    strong: bool = False
    description: str = "The code ran without a sandbox."
