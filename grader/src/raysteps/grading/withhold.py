"""What of the results a student is told about the hidden part."""

from dataclasses import replace

from raysteps.results.model import Feedback, HiddenResult, Results, StepResult

_HIDDEN_ITEM = "hidden item"  # of the line that counts them


def _without_case(item: HiddenResult) -> HiddenResult:
    """A picture's message tells of single pixels."""
    message = "" if item.kind == "picture" and item.outcome == "wrong" else item.message
    return replace(item, message=message, given="", expected="", actual="", case="")


def _share_only(items: list[HiddenResult], kind: str, name: str) -> list[HiddenResult]:
    """All items of a kind as one, that says nothing but how much was earned."""
    mine = [item for item in items if item.kind == kind]
    weight = sum(item.weight for item in mine)
    if not mine or weight <= 0:
        return []
    share = sum(item.share * item.weight for item in mine) / weight
    whole = all(item.share >= 1 for item in mine)
    return [
        HiddenResult(
            name,
            mine[0].kind,
            share=1.0 if whole else min(round(share, 6), 0.999999),
            weight=round(weight, 6),
            seconds=round(sum(item.seconds for item in mine), 3),
            outcome="ok" if whole else "wrong",
        )
    ]


def _withheld_step(step: StepResult, feedback: Feedback) -> StepResult:
    hidden = step.hidden
    if feedback == "diagnosis":
        return replace(step, hidden=[_without_case(item) for item in hidden])
    texts = {item.message for item in hidden if item.message}
    return replace(
        step,
        diagnoses=[],
        hidden=_share_only(hidden, "function", "hidden cases") + _share_only(hidden, "picture", "hidden pictures"),
        messages=[line for line in step.messages if line not in texts and _HIDDEN_ITEM not in line],
    )


def withhold(results: Results, feedback: Feedback) -> Results:
    """Results for the student: `full` as they are; `diagnosis` without the cases themselves; `score` with nothing of
    the hidden part but its shares. The points stay the same."""
    if feedback == "full":
        return results
    return replace(results, steps=[_withheld_step(step, feedback) for step in results.steps])
