"""What the known mistakes of a step answer and draw, as it is kept in the built kit."""

import io
import json
import tempfile
import zipfile
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from raysteps.common.errors import GraderFault
from raysteps.common.files import file_lock, write_bytes
from raysteps.common.text import shorten
from raysteps.course.manifest import Step
from raysteps.course.mutants import Mutant, reference_source
from raysteps.diagnosis.evidence import WrongAnswer, WrongAnswers, collect_wrong_answers, questions_of
from raysteps.images.compare import Pixels
from raysteps.images.render import render
from raysteps.judge.plan import Plan
from raysteps.judge.worker import ask_student
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Sandbox
from raysteps.toolchain.compile import Program, StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit, Kind, ProgressCallback, rate_limited
from raysteps.toolchain.limits import limits_of, restart_clock

_FACTS = "answers"


@dataclass(frozen=True)
class MutantFingerprint:
    """Of one mistake: its wrong answers, and its pictures by name where it makes any."""

    answers: WrongAnswers
    pictures: Mapping[str, Pixels]


Fingerprints: TypeAlias = Mapping[str, MutantFingerprint]  # by the name of the form of a mistake


def write_fingerprints(path: Path, known: Fingerprints) -> None:
    """One file, complete or not there."""
    answers = {
        mistake: {
            function: {str(number): asdict(said) for number, said in wrong.items()}
            for function, wrong in fingerprint.answers.items()
        }
        for mistake, fingerprint in known.items()
    }
    arrays: dict[str, Any] = {_FACTS: np.frombuffer(json.dumps(answers).encode(), dtype=np.uint8)}
    for mistake, fingerprint in known.items():
        arrays |= {f"{mistake}/{name}": pixels for name, pixels in fingerprint.pictures.items()}
    data = io.BytesIO()
    np.savez_compressed(data, **arrays)
    write_bytes(path, data.getvalue())


def read_fingerprints(path: Path) -> Fingerprints | None:
    """None where there is no such file, or none that can be read."""
    try:
        with np.load(path, allow_pickle=False) as arrays:
            answers = json.loads(arrays[_FACTS].tobytes())
            pictures = {tuple(key.split("/", 1)): arrays[key] for key in arrays.files if key != _FACTS}
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None
    return {
        mistake: MutantFingerprint(
            {
                function: {
                    int(number): WrongAnswer(**said | {name: tuple(said[name]) for name in ("spread", "times")})
                    for number, said in wrong.items()
                }
                for function, wrong in functions.items()
            },
            {name: pixels for (owner, name), pixels in pictures.items() if owner == mistake},
        )
        for mistake, functions in answers.items()
    }


# Learns what the known mistakes of a step answer and draw: once for each built kit, by whoever needs it first.

_AT_A_TIME = 2
_SECONDS = 20.0  # for one program of a mistake, on the clock of a busy machine
_COMPILE_SECONDS = 300.0


class _Learner:
    """Builds the mistakes with the kit's own tools; their code is the kit's, so no sandbox is needed."""

    def __init__(self, kit: BuiltKit, step: Step, plan: Plan | None, folder: Path, sandbox: Sandbox) -> None:
        self._kit = kit
        self._step = step
        self._questions = {} if plan is None else questions_of(kit, step, plan, step.functions)
        self._folder = folder
        self._sandbox = sandbox
        self._limits = replace(limits_of(step, {}), seconds=_SECONDS, compile_seconds=_COMPILE_SECONDS)
        self._reference = reference_source(kit.project, step)

    def learn(self, name: str, mutant: Mutant) -> MutantFingerprint:
        build = StudentBuild(self._kit.in_one_process(), self._sandbox, self._folder / name)
        compiled = build.compile(self._step, mutant.applied(self._reference).encode(), self._limits)
        if compiled.binary is None:
            said = shorten(compiled.ran.outcome.stderr.strip(), 1000)
            raise GraderFault(f"{self._step.id}/mutants.toml: {mutant.id} does not build: {said}")

        def program(kind: Kind) -> Program:
            assert compiled.binary is not None
            found, _ = build.program(kind, self._step, {self._step.number: compiled.binary}, self._limits)
            if found is None:
                raise GraderFault(f"{self._step.id}/mutants.toml: {mutant.id} cannot be linked")
            return found

        answers = self._answers(program("worker")) if self._questions else {}
        return MutantFingerprint(answers, self._pictures(program("raytrace")))

    def _answers(self, worker: Program) -> WrongAnswers:
        return collect_wrong_answers(self._questions, ask_student(self._sandbox, worker, self._limits), _SECONDS)

    def _pictures(self, raytrace: Program) -> dict[str, Pixels]:
        """Those that it makes, asked for in the words of a grade: whoever keeps answers draws each once."""
        pictures = {}
        for case in self._step.images:
            scene = self._kit.project.root / case.scene
            limits = self._limits.of_program()
            rendered = render(self._sandbox, raytrace, scene, case.args, limits, estimates=case.is_noisy)
            if rendered.pixels is not None:
                pictures[case.name] = rendered.pixels
        return pictures


@lru_cache(maxsize=16)
def _read(path: Path, _changed: int) -> Fingerprints | None:
    return read_fingerprints(path)


def _found(path: Path) -> Fingerprints | None:
    try:
        return _read(path, path.stat().st_mtime_ns)
    except OSError:
        return None


def _place(kit: BuiltKit, step: Step) -> Path:
    return kit.folder / "mistakes" / f"{step.number}.npz"


def are_learned(kit: BuiltKit, step: Step) -> bool:
    """Whether nobody has to wait for the mistakes of the step."""
    return _place(kit, step).is_file()


def learned_fingerprints(kit: BuiltKit, step: Step) -> Fingerprints:
    """Those of the mistakes that were learned already."""
    return _found(_place(kit, step)) or {}


def mutant_fingerprints(
    kit: BuiltKit,
    step: Step,
    plan: Plan | None,
    mutants: Sequence[Mutant],
    say: ProgressCallback,
    sandbox: Sandbox | None = None,
) -> Fingerprints:
    """By the names of their forms. A mistake of the catalogue that does not build is the kit's fault."""
    path = _place(kit, step)
    known = _found(path)
    if known is None:
        what = f"learning the known mistakes of {step.number} (once)"
        with file_lock(path.with_suffix(".lock"), lambda: say(f"{what}: another command does it")):
            restart_clock()  # after waiting for another command
            known = _found(path)
            if known is None:
                say(what)
                far = rate_limited(lambda text: say(f"{what}: {text}"))
                known = _learn(kit, step, plan, mutants, sandbox or LimitsOnly(), far)
                write_fingerprints(path, known)
    return known


def _learn(
    kit: BuiltKit, step: Step, plan: Plan | None, mutants: Sequence[Mutant], sandbox: Sandbox, far: ProgressCallback
) -> Fingerprints:
    """`far` hears of each that is done."""
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder, ThreadPoolExecutor(_AT_A_TIME) as pool:
        learner = _Learner(kit, step, plan, Path(folder), sandbox)
        forms = {name: form for mutant in mutants for name, form in mutant.choices().items()}
        known: dict[str, MutantFingerprint] = {}
        for name, learned in zip(forms, pool.map(learner.learn, forms, forms.values()), strict=True):
            known[name] = learned
            restart_clock()
            far(f"{len(known)} of {len(forms)}")
    return known
