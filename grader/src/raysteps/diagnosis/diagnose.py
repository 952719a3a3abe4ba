"""What explains a step that is not right, in words."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass

from raysteps.course.manifest import Step
from raysteps.course.mutants import read_mutants
from raysteps.diagnosis.evidence import Evidence, Picture, Questions, listen, questions_of
from raysteps.diagnosis.findings import findings, transformations
from raysteps.diagnosis.matching import match, name_mistakes, spoils
from raysteps.diagnosis.mutant_fingerprints import mutant_fingerprints
from raysteps.images.compare import Pixels
from raysteps.images.render import reference_picture
from raysteps.judge.plan import Plan
from raysteps.judge.worker import Ask
from raysteps.results.model import Diagnosis, StepResult
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback

_MAX_SECONDS = 4.0  # of one run of a student's worker: it has answered as many cases before


@dataclass(frozen=True)
class Diagnostician:
    """Knows the kit and one step of it; `ask` is none where the kit has no judge."""

    kit: BuiltKit
    step: Step
    plan: Plan | None
    ask: Ask | None
    say: ProgressCallback = lambda text: None

    def diagnose(
        self,
        result: StepResult,
        mine: Mapping[str, Pixels],
        unfinished: Collection[str],
        spoilt_functions: Collection[str] = (),
    ) -> list[Diagnosis]:
        """The likeliest first. `mine`: the visible pictures that came out; `unfinished`: functions that are stubs;
        `spoilt_functions`: those that are better than they look, since they call one that is wrong."""
        pictures = self._pictures(mine) if not unfinished else {}
        questions = self._questions(result, unfinished, spoilt_functions)
        answers = listen(questions, self.ask, _MAX_SECONDS) if self.ask is not None else {}
        right = {item.name for item in result.hidden if item.kind == "function" and item.passed} - set(spoilt_functions)
        named, spoilt = self._mistakes(Evidence(questions, answers, pictures, right))
        open_ = {
            name: picture
            for name, picture in pictures.items()
            if picture.is_wrong and picture.says_something and name not in spoilt
        }
        found = list(transformations(self.kit, self.step, open_))
        told = {name for one in found for name in one.seen_in}
        rest = {name: picture for name, picture in open_.items() if name not in told}
        return [*named, *found, *findings(self.kit, self.step, rest)]

    def _mistakes(self, evidence: Evidence) -> tuple[list[Diagnosis], set[str]]:
        """Known mistakes, and the pictures that they spoil."""
        mutants = read_mutants(self.kit.project, self.step)
        if not mutants or not evidence.is_wrong:
            return [], set()
        known = mutant_fingerprints(self.kit, self.step, self.plan, mutants, self.say)
        forms = [(name, form) for mutant in mutants for name, form in mutant.choices().items()]
        matches = [match(form, known[name], evidence) for name, form in forms]
        named = name_mistakes(matches)
        spoilt = {
            name
            for one in named
            for name, picture in evidence.pictures.items()
            if name in one.explains or spoils(known[one.mutant.id].pictures.get(name), picture)
        }
        return [one.diagnosis() for one in named], spoilt

    def _pictures(self, mine: Mapping[str, Pixels]) -> dict[str, Picture]:
        found = {}
        for case in self.step.images:
            reference = reference_picture(self.kit, self.kit.project.root / case.scene, case.args)
            if case.name in mine and mine[case.name].shape == reference.shape:
                found[case.name] = Picture(case, mine[case.name], reference)
        return found

    def _questions(
        self, result: StepResult, unfinished: Collection[str], spoilt: Collection[str]
    ) -> dict[str, Questions]:
        """To the functions that the judge found wrong; to all where it found none. A function may call those before it:
        what comes after one that is a stub says nothing about itself."""
        if self.plan is None:
            return {}
        judged = [item for item in result.hidden if item.kind == "function"]
        hung = {item.name for item in judged if item.outcome == "timeout"}
        wrong = {item.name for item in judged if not item.passed or item.name in spoilt}
        wrong = wrong or {item.name for item in judged}
        names = self.step.functions
        first_stub = min((names.index(name) for name in unfinished), default=len(names))
        return questions_of(self.kit, self.step, self.plan, (wrong - hung) & set(names[:first_stub]))
