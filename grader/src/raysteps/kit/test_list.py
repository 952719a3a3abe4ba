"""The visible test cases of a step, as the reference runs them."""

import tempfile
from pathlib import Path

from raysteps.common.catch_report import parse_report
from raysteps.common.errors import GraderFault
from raysteps.common.process import run

_SECONDS = 600


def list_tests(program: Path) -> dict[str, frozenset[str]]:
    """The names with their tags; the reference must pass every one."""
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        report = Path(folder) / "report.xml"
        run([program, "-r", "xml", "-o", report], seconds=_SECONDS, cwd=Path(folder))
        cases = parse_report(report.read_bytes() if report.is_file() else b"")
    if not cases:
        raise GraderFault(f"{program.name} gave no complete report")
    failed = [case.name for case in cases if not case.passed]
    if failed:
        raise GraderFault(f"the reference fails its own tests: {failed[0]}")
    return {case.name: case.tags for case in cases}
