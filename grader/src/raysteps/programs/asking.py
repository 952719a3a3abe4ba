"""Asks the kit's own worker."""

import hashlib

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_bytes
from raysteps.common.process import Outcome
from raysteps.kit.built_kit import BuiltKit
from raysteps.sandbox.open_air import OpenAir
from raysteps.sandbox.task import Input, Limits, Ran, Task

ANSWERS_KB = 8192  # a tree of many boxes is a long answer
_REFERENCE_LIMITS = Limits(wall_seconds=300, cpu_seconds=300, output_kb=ANSWERS_KB)


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
