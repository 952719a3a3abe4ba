"""Learns what the known mistakes of a step answer and draw: once for each built kit, by whoever needs it first."""

import tempfile
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.files import one_at_a_time
from raysteps.common.text import shorten
from raysteps.diagnosis.answers import Answers, listen, questions_of
from raysteps.diagnosis.fingerprints import Fingerprint, Known, read_known, write_known
from raysteps.judge.plan import Plan
from raysteps.kit.built_kit import BuiltKit, Kind, Say
from raysteps.kit.manifest import Step
from raysteps.mistakes.catalogue import Mutant, reference_source
from raysteps.programs.asking import ask_student
from raysteps.programs.limits import limits_of
from raysteps.programs.pictures import Pixels
from raysteps.programs.rendering import render
from raysteps.programs.student_build import Program, StudentBuild
from raysteps.sandbox.open_air import OpenAir

_AT_A_TIME = 2
_SECONDS = 20.0  # for one program of a mistake, on the clock of a busy machine
_COMPILE_SECONDS = 300.0


class _Learner:
    """Builds the mistakes with the kit's own tools; their code is the kit's, so no sandbox is needed."""

    def __init__(self, kit: BuiltKit, step: Step, plan: Plan | None, folder: Path) -> None:
        self._kit = kit
        self._step = step
        self._questions = {} if plan is None else questions_of(kit, step, plan, step.functions)
        self._folder = folder
        self._air = OpenAir()
        self._limits = replace(limits_of(step, {}), seconds=_SECONDS, compile_seconds=_COMPILE_SECONDS)
        self._reference = reference_source(kit.project, step)

    def learn(self, name: str, mutant: Mutant) -> Fingerprint:
        build = StudentBuild(self._kit, self._air, self._folder / name)
        compiled = build.compile(self._step, mutant.applied(self._reference).encode(), self._limits)
        if compiled.binary is None:
            said = shorten(compiled.ran.outcome.stderr.strip(), 1000)
            raise GraderFault(f"{self._step.id}/mutants.toml: {mutant.id} does not build: {said}")

        def program(kind: Kind) -> Program:
            assert compiled.binary is not None
            found, _ = build.program(kind, self._step, [compiled.binary], self._limits)
            if found is None:
                raise GraderFault(f"{self._step.id}/mutants.toml: {mutant.id} cannot be linked")
            return found

        answers = self._answers(program("worker")) if self._questions else {}
        return Fingerprint(answers, self._pictures(program("raytrace")))

    def _answers(self, worker: Program) -> Answers:
        return listen(self._questions, ask_student(self._air, worker, self._limits), _SECONDS)

    def _pictures(self, raytrace: Program) -> dict[str, Pixels]:
        """Those that it makes."""
        pictures = {}
        for case in self._step.images:
            scene = self._kit.project.root / case.scene
            rendered = render(self._air, raytrace, scene, case.args, self._limits.of_program())
            if rendered.pixels is not None:
                pictures[case.name] = rendered.pixels
        return pictures


@lru_cache(maxsize=16)
def _read(path: Path, _changed: int) -> Known | None:
    return read_known(path)


def _found(path: Path) -> Known | None:
    try:
        return _read(path, path.stat().st_mtime_ns)
    except OSError:
        return None


def known_mistakes(kit: BuiltKit, step: Step, plan: Plan | None, mutants: Sequence[Mutant], say: Say) -> Known:
    """By the names of their forms. A mistake of the catalogue that does not build is the kit's fault."""
    path = kit.folder / "mistakes" / f"{step.number}.npz"
    known = _found(path)
    if known is None:
        with one_at_a_time(path.with_suffix(".lock")):
            known = _found(path)
            if known is None:
                say(f"learning the known mistakes of {step.number} (once)")
                known = _learn(kit, step, plan, mutants)
                write_known(path, known)
    return known


def _learn(kit: BuiltKit, step: Step, plan: Plan | None, mutants: Sequence[Mutant]) -> Known:
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder, ThreadPoolExecutor(_AT_A_TIME) as pool:
        learner = _Learner(kit, step, plan, Path(folder))
        forms = {name: form for mutant in mutants for name, form in mutant.choices().items()}
        learned = list(pool.map(learner.learn, forms, forms.values()))
    return dict(zip(forms, learned, strict=True))
