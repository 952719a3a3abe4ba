"""The same question twice, and between them one that differs in a single input: whoever keeps something from call to
call, or knows a question again by a part of it, gives the answer of another question.
"""

from collections.abc import Sequence

from raysteps.common.errors import GraderFault
from raysteps.judge.choice_sequence import Choice, Chosen, InvalidChoice, Recorder, Replay
from raysteps.judge.functions import Case, Function, Group
from raysteps.judge.protocol import Inputs
from raysteps.judge.random_source import MOST_TRIES, RandomSource

_TRIES = 15  # to change one input and no other


def _redrawn(choice: Choice, draw: RandomSource) -> Chosen:
    """Another value, between the same bounds."""
    if isinstance(choice.value, bool):
        return not choice.value
    if isinstance(choice.value, int):
        return draw.whole(round(choice.low), round(choice.high))
    if isinstance(choice.value, tuple):
        return draw.direction()
    return draw.fine(choice.low, choice.high)


def _with_one_changed(kind: Group, choices: Sequence[Choice], draw: RandomSource) -> Inputs | None:
    """None where the kind has no such case."""
    values = [choice.value for choice in choices]
    place = draw.whole(0, len(values) - 1)
    values[place] = _redrawn(choices[place], draw)
    try:
        return kind.make(Replay(values))
    except (InvalidChoice, ArithmeticError, ValueError, LookupError):
        return None


def _neighbour(kind: Group, choices: Sequence[Choice], inputs: Inputs, name: str, draw: RandomSource) -> Inputs | None:
    """Differs in the input of that name and, where that can be, in no other."""
    best: tuple[int, Inputs] | None = None
    for _ in range(_TRIES):
        other = _with_one_changed(kind, choices, draw)
        if other is None or other.keys() != inputs.keys() or other[name] == inputs[name]:
            continue
        different = sum(other[one] != inputs[one] for one in inputs)
        if best is None or different < best[0]:
            best = different, other
        if different == 1:
            break
    return None if best is None else best[1]


def cases_asked_again(function: Function, kind: str, seed: str, amount: int) -> list[Case]:
    """Three by three: a question, its neighbour, and the question once more. Each input is changed in its turn."""
    ordinary = function.groups[0]
    draw, turn = Recorder(seed), RandomSource(f"{seed}/neighbours")
    found: list[Inputs] = []
    for asked in range(MOST_TRIES):
        draw.choices.clear()
        inputs = ordinary.make(draw)
        names = list(inputs)
        other = _neighbour(ordinary, draw.choices, inputs, names[asked % len(names)], turn)
        if other is not None:
            found += [inputs, other, inputs]
        if len(found) >= amount:
            return [Case(function.name, kind, one) for one in found[:amount]]
    raise GraderFault(f"{function.name}: the judge finds no questions that differ in one input")
