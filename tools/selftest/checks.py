"""What a check of the kit reports, and the table of all of them."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from rich.console import Console
from rich.markup import escape
from rich.table import Table

Verdict = Literal["passed", "failed", "skipped"]
_COLORS = {"passed": "green", "failed": "red", "skipped": "yellow"}


@dataclass(frozen=True)
class Report:
    """One check: for a failure, what to read; for a skip, what to install."""

    verdict: Verdict
    detail: str = ""


@dataclass(frozen=True)
class Check:
    """A named check."""

    name: str
    run: Callable[[], Report]


def run_checks(checks: list[Check], console: Console) -> int:
    """Runs all checks, prints each as it ends, then the table and the closing line."""
    done: list[tuple[Check, Report, float]] = []
    for check in checks:
        start = time.monotonic()
        with console.status(escape(check.name)):
            try:
                report = check.run()
            except Exception as error:
                report = Report("failed", f"{type(error).__name__}: {error}")
        done.append((check, report, time.monotonic() - start))
        if report.verdict == "skipped":
            console.print(f"skipped: {check.name} ({report.detail})", markup=False)
        else:
            console.print(f"{report.verdict}: {check.name}", markup=False)
        if report.verdict == "failed":
            console.print(report.detail, markup=False, highlight=False)
    table = Table()
    table.add_column("check")
    table.add_column("result")
    table.add_column("seconds", justify="right")
    for check, report, seconds in done:
        table.add_row(escape(check.name), f"[{_COLORS[report.verdict]}]{report.verdict}[/]", f"{seconds:.0f}")
    console.print(table)
    amount = {verdict: sum(report.verdict == verdict for _, report, _ in done) for verdict in _COLORS}
    print(f"{amount['passed']} passed, {amount['failed']} failed, {amount['skipped']} skipped", flush=True)
    return 1 if amount["failed"] else 0
