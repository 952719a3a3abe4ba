"""Formulas become MathML when the site is built, so a page needs no script and no network to show them."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from docutils import nodes

from raysteps.common.markdown import BadFormula, formulas, mathml


def bad_formulas(root: Path, documents: Iterable[Path]) -> list[str]:
    """One line for each that cannot be shown."""
    found = []
    for document in documents:
        for formula in formulas((root / document).read_text(encoding="utf-8")):
            try:
                mathml(formula, block=False)
            except BadFormula as error:
                found.append(f"{document}: the formula {error}")
    return found


def _inline(visitor: Any, node: nodes.math) -> None:
    visitor.body.append(mathml(node.astext(), block=False))
    raise nodes.SkipNode


def _block(visitor: Any, node: nodes.math_block) -> None:
    visitor.body.append(f'<div class="formula" tabindex="0">{mathml(node.astext(), block=True)}</div>')
    raise nodes.SkipNode


def setup(application: Any) -> dict[str, bool]:
    """Sphinx calls this."""
    application.add_html_math_renderer("mathml", inline_renderers=(_inline, None), block_renderers=(_block, None))
    application.config.html_math_renderer = "mathml"
    return {"parallel_read_safe": True, "parallel_write_safe": True}
