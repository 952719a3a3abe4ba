"""A pixel as a page: its rays and boxes in three dimensions, and the tree of rays in words."""

from pathlib import Path

from raysteps.commands.inspect.page_rays import PageRay, page_ray, shown_color
from raysteps.commands.inspect.page_space import space_of
from raysteps.commands.inspect.pair import Difference
from raysteps.commands.inspect.values import Record
from raysteps.exports.formats import write_out
from raysteps.pages.page import render_page

_SCRIPTS = ("space-vectors", "space-shapes", "space-painter", "space-orbit", "inspect-space", "inspect")


def _parts_at(tree: PageRay, parting: Difference | None) -> str:
    """The ray of the difference: the deepest one whose key begins the difference's place."""
    if parting is None:
        return ""
    place = tuple(part.replace("shadow", "light").replace("terms", "light") for part in parting.place)
    holders = [ray for ray in tree.all_rays() if place[: len(ray.key)] == ray.key]
    return max(holders, key=lambda ray: len(ray.key)).id if holders else ""


def page_html(record: Record, reference: Record | None = None, parting: Difference | None = None) -> str:
    """The document; with a reference both trees stand side by side, and the first difference is marked."""
    records = {"mine": record} if reference is None else {"mine": record, "reference": reference}
    trees = {name: page_ray(one["ray"], one["surfaces"]) for name, one in records.items()}
    pixel = record["pixel"]
    context = {
        "record": record,
        "reference": reference,
        "trees": trees,
        "parting": parting,
        "parts_at": {name: _parts_at(tree, parting) for name, tree in trees.items()},
        "swatch": shown_color([byte / 255 for byte in record["bytes"]] if record["bytes"] else None),
    }
    spaces = {name: space_of(one, trees[name]) for name, one in records.items()}
    title = f"Inside pixel ({pixel['x']}, {pixel['y']})"
    return render_page("inspect", title, context, scripts=_SCRIPTS, styles=("inspect",), data=spaces)


def write_page(record: Record, reference: Record | None, parting: Difference | None, target: Path) -> None:
    """Writes the page of one record, or of two beside each other with the first difference marked."""
    write_out(target, page_html(record, reference, parting).encode("utf-8", "replace"))
