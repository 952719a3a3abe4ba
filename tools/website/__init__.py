"""The documents as a static site, and what checks them: links, formulas, commands."""
