"""Submissions that do harm, one folder each; docs/hostile.md tells what they try."""
