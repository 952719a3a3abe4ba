"""Entry point of `python -m raysteps`."""

from raysteps.cli.app import run_process

raise SystemExit(run_process())
