"""A pixel as a page in three dimensions."""

from pathlib import Path

from raysteps.commands.inspect.pair import Difference
from raysteps.commands.inspect.values import Record


def write_page(record: Record, reference: Record | None, parting: Difference | None, target: Path) -> None:
    """Writes the page of one record, or of two beside each other with the first difference marked."""
    raise NotImplementedError
