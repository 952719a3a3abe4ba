"""Asks workers: a student's and the kit's own."""

import hashlib
from collections.abc import Callable
from dataclasses import replace

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_bytes
from raysteps.common.process import Outcome
from raysteps.kit.built_kit import BuiltKit
from raysteps.programs.limits import StepLimits
from raysteps.programs.student_build import Program
from raysteps.sandbox.open_air import OpenAir
from raysteps.sandbox.task import Input, Limits, Ran, Sandbox, Task

ANSWERS_KB = 8192  # a tree of many boxes is a long answer
_REFERENCE_LIMITS = Limits(wall_seconds=300, cpu_seconds=300, output_kb=ANSWERS_KB)


def ask_student(sandbox: Sandbox, worker: Program, limits: StepLimits) -> Callable[[bytes, float], Ran]:
    """The student's functions, asked in a process that knows no answer: cases, and how many seconds it may take."""

    def ask(cases: bytes, seconds: float) -> Ran:
        return sandbox.run(Task(worker.words, replace(limits.of_program(seconds), output_kb=ANSWERS_KB), stdin=cases))

    return ask


def reference_unkept(kit: BuiltKit, cases: bytes) -> Ran:
    """Its answers to questions that nobody asks twice."""
    return OpenAir().run(Task((Input(kit.reference("worker"), "worker"),), _REFERENCE_LIMITS, stdin=cases))


def reference_answers(kit: BuiltKit, cases: bytes) -> Ran:
    """The reference's answers, kept: a class is asked the same questions."""
    path = kit.answers / hashlib.sha256(cases).hexdigest()[:32]
    if path.is_file():
        return Ran(Outcome(0, False, path.read_text("utf-8"), "", 0.0), {}, 0.0, "")
    ran = reference_unkept(kit, cases)
    if ran.outcome.code != 0 or ran.outcome.timed_out:
        raise GraderFault(f"the reference did not answer the judge: {ran.outcome.stderr.strip()}")
    write_bytes(path, ran.outcome.stdout.encode())
    return ran
