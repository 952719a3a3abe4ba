"""A worker that builds nothing: it does what it reads in the student's file, and a command line that uses it.

`// broken` does not build, `// wrong` fails, `// endless` has a test that was stopped, `// wait 0.5` takes time,
`// wait check` as long as it may, `// crash` ends in the middle, `// program` starts one that never ends, `// hang`
never answers."""

import argparse
import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path

import numpy as np
from course_fakes import checked
from rich.console import Console

from raysteps.cli.watch import add_arguments, run
from raysteps.common.errors import RaystepsError
from raysteps.course.manifest import Step, choose, read_steps
from raysteps.course.project import Project
from raysteps.images.compare import write_png
from raysteps.progress.standing import save_progress
from raysteps.results.model import HiddenResult, ImageResult, StepResult, TestResult

WORKER = (sys.executable, str(Path(__file__)), "worker")
PROGRAM = (sys.executable, str(Path(__file__)), "raysteps")
_TIMEOUT = 90


def wait_for(what: Callable[[], object], why: str = "it took too long") -> None:
    end = time.monotonic() + _TIMEOUT
    while not what():
        assert time.monotonic() < end, why
        time.sleep(0.02)


def is_running(pid: int) -> bool:
    """Not one that only waits for its parent to ask how it ended."""
    try:
        os.kill(pid, 0)
        listed = Path("/proc/self/stat").exists()
        return not listed or Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except (ProcessLookupError, FileNotFoundError):  # it may end in between
        return False


def result_of(step: Step, source: str, out: Path, *, full: bool) -> StepResult:
    """As a worker would tell it, with pictures."""
    right = "// wrong" not in source
    result = StepResult(step.id, "passed" if right else "partial", 0.0, step.points, step.bonus)
    if "// broken" in source:
        result.status, result.messages = (
            "does-not-build",
            ["It does not build: own.cpp:1:1: no such thing\n  1 | // broken"],
        )
        result.build_log = "own.cpp:1:1: error: no such thing"
        return result
    result.tests = [
        TestResult("it is there", True),
        TestResult("it is <b>right</b>", right, "" if right else "a & b", "x == 1", "2 == 1", "own_test.cpp:7"),
    ]
    if "// endless" in source:
        result.tests.append(TestResult("it ends", False, "It was stopped.", outcome="timeout"))
    shade = 200 if right else 20
    image = ImageResult(step.images[0].name, step.images[0].scene, right, 0.01)
    image.message = "" if right else "50.00% of the pixels are wrong."
    for role, value in (("mine", shade), ("reference", 200)):
        pixels = np.full((6, 8, 3), 100, dtype=np.uint8)
        pixels[3, 5:] = value
        write_png(pixels, out / f"{role}.png")
    image.mine, image.reference = "mine.png", "reference.png"
    result.images = [image]
    if full:
        result.points = step.points if right else 2.5
        result.hidden = [HiddenResult("a function", "function", 1.0 if right else 0.5, message="half is wrong")]
        result.cumulative.passed = right
    return result


def _tell(**words: object) -> None:
    print(json.dumps(words), flush=True)


def _misbehave(source: str, kind: str) -> None:
    if kind == "check" and "// wait check" in source:
        time.sleep(1000)
    if found := re.search(r"// wait ([0-9.]+)", source):
        time.sleep(float(found[1]))
    if "// program" in source:
        process = subprocess.Popen(["sleep", "1000"])
        Path(os.environ["FAKE_LOG"]).write_text(f"{process.pid} {os.environ['TMPDIR']}")
        process.wait()
    if "// hang" in source:
        time.sleep(1000)


def work() -> None:
    """One job, as the real worker does it."""
    line = sys.stdin.readline()
    if not line:
        return
    job = json.loads(line)
    project = Project(Path(job["root"]))
    (step,) = choose(read_steps(project), [job["step"]])
    source = (project.steps / step.path).read_text(encoding="utf-8")
    _misbehave(source, job["kind"])
    full = job["kind"] == "check"
    out = project.build / job["kind"]
    result = result_of(step, source, out, full=full)
    words = {"result": asdict(result), "out": str(out)}
    if not full and result.tests:
        _tell(**(words | {"result": asdict(result) | {"images": []}}), complete=False)
    if "// crash" in source:
        print("it gets dark", file=sys.stderr, flush=True)
        os.kill(os.getpid(), signal.SIGKILL)
    if full:
        save_progress(project, checked(step, result.status, result.points), {step.id: source.encode()})
    _tell(**words, complete=True)


def look_into_a_pixel(words: list[str]) -> None:
    """As `./raysteps inspect` does while it builds its program: it speaks, and goes on until it is interrupted."""
    try:
        print(f"looking: {' '.join(words)}", flush=True)  # whoever reads this may interrupt at once
        time.sleep(1000)
    except KeyboardInterrupt:
        print("the build was ended", flush=True)


def main(words: list[str]) -> int:
    """`watch` in a project, with the fake worker."""
    parser = argparse.ArgumentParser()
    parser.add_argument("root", type=Path)
    add_arguments(parser)
    arguments = parser.parse_args(words)
    try:
        return run(Project(arguments.root), arguments, Console(), WORKER, PROGRAM)
    except RaystepsError as error:
        print(error, file=sys.stderr)
        return error.exit_code


if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parent))
    if sys.argv[1] == "worker":
        work()
    elif sys.argv[1] == "raysteps":
        look_into_a_pixel(sys.argv[2:])
    else:
        sys.exit(main(sys.argv[1:]))
