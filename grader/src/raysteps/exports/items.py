"""The checks of a step as a list: what each was, how much of it was right, and what to say about it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from raysteps.common.text import clean, count
from raysteps.exports.wording import one_line
from raysteps.kit.manifest import Step

Kind = Literal["test", "picture", "hidden", "together", "step"]


@dataclass(frozen=True)
class Item:
    """One check. `inputs` is what a hidden check must not show."""

    kind: Kind
    name: str
    weight: float
    share: float
    text: str
    inputs: str = ""
    pictures: tuple[tuple[str, str], ...] = ()  # label, path beside results.json

    @property
    def passed(self) -> bool:
        return self.share >= 1


def _lines(*pairs: tuple[str, Any]) -> str:
    return "\n".join(f"{label}{clean(str(value))}" for label, value in pairs if value)


def _test(test: Mapping[str, Any], weight: float) -> Item:
    text = _lines(
        ("", test["message"]),
        ("expected: ", test["expression"]),
        ("actual: ", test["expanded"]),
        ("see ", test["location"]),
    )
    name = one_line(test["name"])
    return Item("test", name, weight, float(test["passed"]), "passed" if test["passed"] else text or "failed")


def _picture(image: Mapping[str, Any], weight: float) -> Item:
    wrong = image["wrong_share"]
    seen = "" if wrong is None else f"{wrong:.2%} of the pixels are wrong; at most {image['max_wrong']:.2%} may be."
    text = _lines(("", image["message"] or seen), ("scene: ", image["scene"]))
    shown = tuple((kind, image[kind]) for kind in ("mine", "reference", "difference") if image[kind])
    return Item("picture", one_line(image["name"]), weight, float(image["passed"]), text, pictures=shown)


def _hidden(hidden: Mapping[str, Any], weight: float) -> Item:
    groups = [
        f"{one_line(group['name'])}: {group['right']} of {count(group['cases'], 'case')} right"
        for group in hidden["groups"]
    ]
    text = "\n".join([*filter(None, [clean(hidden["message"])]), *groups])
    inputs = _lines(("input: ", hidden["given"]), ("expected: ", hidden["expected"]), ("actual: ", hidden["actual"]))
    share = float(hidden["share"])
    return Item(
        "hidden", one_line(hidden["name"]), weight, share, text or ("passed" if share >= 1 else "wrong"), inputs
    )


def _together(cumulative: Mapping[str, Any], weight: float) -> Item:
    passed = bool(cumulative["passed"])
    text = clean(cumulative["message"]) or ("passed" if passed else "wrong")
    return Item("together", "with the steps before it", weight, float(passed), text)


def _each(group: float, weights: Sequence[float]) -> list[float]:
    whole = sum(weights)
    return [group * weight / whole if whole else 0.0 for weight in weights]


def items_of(result: Mapping[str, Any], step: Step | None) -> list[Item]:
    """The checks of one step of a results.json, weighted as the manifest weights them."""
    tests, images, hidden = result["tests"], result["images"], result["hidden"]
    weights = (1.0, 1.0, 1.0, 0.0)
    if step is not None:
        weights = (step.weight_tests, step.weight_images, step.weight_hidden, step.weight_together)
    items = [_test(*pair) for pair in zip(tests, _each(weights[0], [1.0] * len(tests)), strict=True)]
    items += [_picture(*pair) for pair in zip(images, _each(weights[1], [1.0] * len(images)), strict=True)]
    own = [float(item.get("weight", 1.0)) for item in hidden]
    items += [_hidden(*pair) for pair in zip(hidden, _each(weights[2], own), strict=True)]
    return [*items, _together(result["cumulative"], weights[3])] if items and weights[3] else items


def _diagnosis(diagnosis: Mapping[str, Any]) -> str:
    """What explains a wrong step, in a line."""
    title = one_line(diagnosis["title"], 600)
    if diagnosis["kind"] == "finding":
        said = title
    else:
        others = "".join(f", or when {one_line(other, 600)}" for other in diagnosis["alike"])
        said = f"This is what you get when {title}{others}. {one_line(diagnosis['cause'], 600)}".rstrip()
    seen = ", ".join(one_line(name) for name in diagnosis["seen_in"])
    where = f"Seen in {seen}. " if seen and diagnosis["kind"] != "finding" else ""
    hint = f"Hint: {one_line(diagnosis['hint'], 600)}" if diagnosis["hint"] else ""
    return f"{said} {where}{hint}".rstrip()


def step_text(result: Mapping[str, Any]) -> str:
    """What there is to say about a step as a whole."""
    said = [clean(message) for message in result["messages"]]
    said += [_diagnosis(diagnosis) for diagnosis in result.get("diagnoses", ())]
    if result["status"] == "does-not-build" and result["build_log"]:
        said.append(clean(result["build_log"]))
    return "\n".join(said)
