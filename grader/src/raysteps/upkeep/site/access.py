"""What the theme leaves out for people who use a keyboard or a screen reader."""

from pathlib import Path

_CHANGES = (
    ('<p class="caption" role="heading">', '<p class="caption" role="heading" aria-level="2">'),
    ('<aside class="sidebar-drawer">', '<aside class="sidebar-drawer" aria-label="Menu">'),
    ('<aside class="toc-drawer">', '<aside class="toc-drawer" aria-label="On this page">'),
    ('<aside class="toc-drawer no-toc">', '<aside class="toc-drawer no-toc" aria-label="On this page">'),
    ('<div class="highlight"><pre>', '<div class="highlight"><pre tabindex="0">'),
    ('<div class="table-wrapper', '<div tabindex="0" class="table-wrapper'),
)


def make_accessible(site: Path) -> None:
    """Changes every page: names for landmarks, levels for headings, the keyboard for what can be scrolled."""
    for page in site.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        for old, new in _CHANGES:
            text = text.replace(old, new)
        page.write_text(text, encoding="utf-8")
