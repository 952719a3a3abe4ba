"""What explains a step that is not right, in words."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass

from raysteps.diagnosis.answers import Answers, listen
from raysteps.diagnosis.evidence import Evidence, Picture
from raysteps.diagnosis.learning import known_mistakes
from raysteps.diagnosis.matching import match
from raysteps.diagnosis.naming import name_mistakes
from raysteps.judge.plan import Plan
from raysteps.judge.worker_client import Ask
from raysteps.kit.built_kit import BuiltKit, Say
from raysteps.kit.manifest import Step
from raysteps.mistakes.catalogue import read_mutants
from raysteps.programs.pictures import Pixels
from raysteps.programs.rendering import reference_picture
from raysteps.results.model import Diagnosis, StepResult

_MOST_SECONDS = 2.0  # of one run of a student's worker: it has answered as many cases before


@dataclass(frozen=True)
class Diagnostician:
    """Knows the kit and one step of it; `ask` is none where the kit has no judge."""

    kit: BuiltKit
    step: Step
    plan: Plan | None
    ask: Ask | None
    say: Say = lambda text: None

    def diagnose(self, result: StepResult, mine: Mapping[str, Pixels], unfinished: Collection[str]) -> list[Diagnosis]:
        """The likeliest first. `mine`: the visible pictures that came out; `unfinished`: functions that are stubs."""
        mutants = read_mutants(self.kit.project, self.step)
        pictures = self._pictures(mine) if not unfinished else {}
        if not mutants:
            return []
        known = known_mistakes(self.kit, self.step, self.plan, mutants, self.say)
        evidence = Evidence(self._answers(result, unfinished), pictures)
        matches = [match(mutant, known[mutant.id], evidence, self.step, self.plan) for mutant in mutants]
        named, _ = name_mistakes(matches)
        return [one.diagnosis() for one in named]

    def _pictures(self, mine: Mapping[str, Pixels]) -> dict[str, Picture]:
        found = {}
        for case in self.step.images:
            reference = reference_picture(self.kit, self.kit.project.root / case.scene, case.args)
            if case.name in mine and mine[case.name].shape == reference.shape:
                found[case.name] = Picture(case, mine[case.name], reference)
        return found

    def _answers(self, result: StepResult, unfinished: Collection[str]) -> Answers:
        """Of the functions that the judge found wrong; of all where it found none."""
        if self.plan is None or self.ask is None:
            return {}
        judged = [item for item in result.hidden if item.kind == "function"]
        hung = {item.name for item in judged if item.outcome == "timeout"}
        wrong = {item.name for item in judged if not item.passed} or {item.name for item in judged}
        return listen(self.kit, self.step, self.plan, wrong - hung - set(unfinished), self.ask, _MOST_SECONDS)
