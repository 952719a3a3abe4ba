"""Runs Sphinx on what was staged."""

import io
import os
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from raysteps.common.errors import UsageError
from raysteps.kit.project import here
from raysteps.upkeep.site.access import make_accessible

_LIGHT = dict.fromkeys(("color-brand-primary", "color-brand-content", "color-brand-visited"), "#9a4408")
_DARK = dict.fromkeys(_LIGHT, "#f5a65b")
SETTINGS: dict[str, Any] = {
    "extensions": ["myst_parser", "raysteps.upkeep.site.formulas"],
    "project": "Raysteps",
    "html_title": "Raysteps",
    "html_theme": "furo",
    "html_static_path": ["_static"],
    "html_css_files": ["site.css"],
    "html_copy_source": False,
    "html_show_sourcelink": False,
    "html_show_copyright": False,
    "html_use_index": False,
    "html_domain_indices": False,
    "html_show_search_summary": False,  # would read other pages as files, which browsers forbid
    "html_permalinks_icon": "#",
    "html_theme_options": {
        "navigation_with_keys": False,
        "light_css_variables": {**_LIGHT, "color-code-background": "#f1efea"},
        "dark_css_variables": {**_DARK, "color-code-background": "#26292e"},
    },
    "highlight_language": "text",
    "pygments_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
    "myst_enable_extensions": ["dollarmath"],
    "myst_dmath_double_inline": True,
    "myst_heading_anchors": 6,
    "myst_url_schemes": ["http", "https", "mailto"],
    "smartquotes": False,
    "language": "en",
}
# The theme's own settings are known only to settings that come from a file.
_CONF = "from raysteps.upkeep.site.build import SETTINGS\n\nglobals().update(SETTINGS)\n"


def check_tools() -> None:
    """Says what to install where Sphinx and its parts are not there, as in a students' kit."""
    for name in ("sphinx", "myst_parser", "furo"):
        if find_spec(name) is None:
            raise UsageError(
                f"the site is built with Sphinx, and the Python package {name} is not installed; install it with:\n"
                f'  "{sys.executable}" -m pip install -e "{here().root / "grader"}[docs]"'
            )


def build_site(stage: Path, out: Path, work: Path) -> list[str]:
    """Writes the pages to `out` and returns what Sphinx complained about."""
    from sphinx.application import Sphinx  # only here: the other commands need not wait for it
    from sphinx.util.docutils import docutils_namespace

    (stage / "conf.py").write_text(_CONF, encoding="utf-8")
    said = io.StringIO()
    with docutils_namespace():
        sphinx = Sphinx(
            srcdir=stage,
            confdir=stage,
            outdir=out,
            doctreedir=work / "doctrees",
            buildername="html",
            status=None,
            warning=said,
            freshenv=True,
        )
        sphinx.build(force_all=True)
    make_accessible(out)
    (out / ".nojekyll").touch()
    (out / ".buildinfo").unlink(missing_ok=True)
    return [line.replace(f"{stage}{os.sep}", "") for line in said.getvalue().splitlines() if line.strip()]
