"""Words that every view of a result shares, on pages and in the terminal."""

from raysteps.results.model import Status

STATUS_WORDS: dict[Status, tuple[str, str, str]] = {  # in words, its tone, its sign
    "passed": ("passed", "good", "✓"),
    "partial": ("partly right", "warn", "◐"),
    "failed": ("failed", "bad", "✗"),
    "not-started": ("not started", "none", "○"),
    "does-not-build": ("does not build", "bad", "✗"),
    "crashed": ("crashed", "bad", "✗"),
    "timeout": ("took too long", "bad", "✗"),
}
HOW_SURE = {"mistake": "most likely", "transformation": "it looks as if", "finding": "look here"}  # of a diagnosis


def percent(share: float) -> str:
    """100 % only where nothing is missing."""
    return f"{min(share * 100, 100 if share >= 1 else 99.9):.3g} %"
