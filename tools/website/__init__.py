"""The documents as a static site, and what checks them: links and formulas."""
