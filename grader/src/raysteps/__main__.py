"""Entry point of `python -m raysteps`."""

from raysteps.cli.app import main

raise SystemExit(main())
