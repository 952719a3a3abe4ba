"""Entry point of `python -m raysteps`."""

from raysteps.cli import main

raise SystemExit(main())
