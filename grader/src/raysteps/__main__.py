"""Entry point of `python -m raysteps`: a students' kit has fewer commands."""

from importlib.util import find_spec

if find_spec("raysteps.cli") is not None:
    from raysteps.cli import main
else:
    from raysteps.students_cli import main

raise SystemExit(main())
