"""What a check of the kit reports, and the table of all of them."""

import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import groupby
from typing import Literal

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.common.platform import processor_count
from tools.selftest.stamps import FileFilter, Stamps

Verdict = Literal["passed", "failed", "skipped"]
UNCHANGED = "as before: nothing that it depends on has changed"
_COLORS = {"passed": "green", "failed": "red", "skipped": "yellow"}
_LAST_LINES = 30  # of what failed, said again at the end


@dataclass(frozen=True)
class Report:
    """One check: for a failure, what to read; for a skip, what to install; for a pass, what was not run again."""

    verdict: Verdict
    detail: str = ""


@dataclass(frozen=True)
class Check:
    """A named check. `inputs` are the files that it depends on; without them it is always run. One that keeps no more
    than one processor busy may run `beside` others of its kind."""

    name: str
    run: Callable[[], Report]
    inputs: FileFilter | None = None
    beside: bool = False


@dataclass(frozen=True)
class _Done:
    check: Check
    report: Report
    seconds: float


def _done(check: Check, stamps: Stamps) -> _Done:
    start = time.monotonic()
    inputs = {} if check.inputs is None else {check.name: check.inputs}
    digests = stamps.digests(inputs)
    if any(stamps.has_passed(name, digest) for name, digest in digests.items()):
        return _Done(check, Report("passed", UNCHANGED), 0.0)
    try:
        report = check.run()
    except Exception as error:
        report = Report("failed", f"{type(error).__name__}: {error}")
    if report.verdict == "passed":
        stamps.keep(inputs, digests)
    return _Done(check, report, time.monotonic() - start)


def _all_done(checks: Sequence[Check], console: Console, stamps: Stamps) -> Iterator[_Done]:
    """In their order."""
    for beside, group in groupby(checks, lambda check: check.beside):
        some = list(group)
        with ThreadPoolExecutor(processor_count() if beside else 1) as pool:
            waiting = [pool.submit(_done, check, stamps) for check in some]
            try:
                for check, future in zip(some, waiting, strict=True):
                    with console.status(escape(check.name)):
                        done = future.result()
                    yield done
            finally:
                pool.shutdown(cancel_futures=True)


def run_checks(checks: Sequence[Check], console: Console, stamps: Stamps) -> int:
    """Runs all checks whose inputs changed since they passed, prints each as it ends, then the table, the last lines of
    what failed once more, as they may stand far above, and the closing line."""
    done: list[_Done] = []
    for one in _all_done(checks, console, stamps):
        done.append(one)
        detail = f" ({one.report.detail})" if one.report.detail and one.report.verdict != "failed" else ""
        console.print(f"{one.report.verdict}: {one.check.name}{detail}", markup=False)
        if one.report.verdict == "failed":
            console.print(one.report.detail, markup=False, highlight=False)
    table = Table()
    table.add_column("check")
    table.add_column("result")
    table.add_column("seconds", justify="right")
    for one in done:
        verdict = one.report.verdict
        table.add_row(escape(one.check.name), f"[{_COLORS[verdict]}]{verdict}[/]", f"{one.seconds:.0f}")
    console.print(table)
    for one in done:
        if one.report.verdict == "failed":
            lines = "\n".join(one.report.detail.rstrip().splitlines()[-_LAST_LINES:])
            console.print(f"failed: {one.check.name}\n{lines}", markup=False, highlight=False)
    amount = {verdict: sum(one.report.verdict == verdict for one in done) for verdict in _COLORS}
    print(
        f"{len(done)} checks: {amount['passed']} passed, {amount['failed']} failed, {amount['skipped']} skipped",
        flush=True,
    )
    return 1 if amount["failed"] else 0
