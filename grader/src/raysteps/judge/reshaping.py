"""Other inputs made from given ones: with shorter lists, or with other numbers in the same places."""

import dataclasses
from collections.abc import Callable
from typing import Any

from raysteps.judge.bvh_searches import Reaches
from raysteps.judge.numbers import f32
from raysteps.judge.scripts import Script, ScriptedHit
from raysteps.judge.searches import Rays
from raysteps.judge.surfaces import Surfaces
from raysteps.judge.values import Inputs, Lights, Real, Value

Place = tuple[str, int]  # the name of an input that is a list, and which of its items

_ITEMS = {Surfaces: "surfaces", Lights: "lights", Rays: "rays", Reaches: "rays", Script: "hits"}
_NAMES = {(ScriptedHit, "distance")}  # by which a hit is known again
_JITTER = 1e-5  # of a vector's largest component, or of the number
_LARGEST = 1e38  # beyond it a little more may be infinite


def _items(value: Value) -> tuple[Any, ...]:
    attribute = _ITEMS.get(type(value))
    found: tuple[Any, ...] = getattr(value, attribute) if attribute else ()
    return found


def places(inputs: Inputs) -> list[Place]:
    """All items of all lists."""
    return [(name, i) for name, value in inputs.items() for i in range(len(_items(value)))]


def _shortened(value: Value, dropped: set[int]) -> Value:
    left = tuple(item for i, item in enumerate(_items(value)) if i not in dropped)
    shorter: Value = dataclasses.replace(value, **{_ITEMS[type(value)]: left})  # type: ignore[type-var]
    return shorter


def without(inputs: Inputs, dropped: frozenset[Place]) -> Inputs:
    """Without some items of the lists."""
    names = {name for name, _ in dropped}
    return {
        name: _shortened(value, {i for other, i in dropped if other == name}) if name in names else value
        for name, value in inputs.items()
    }


def _with_numbers(value: Any, change: Callable[[float, float], float], size: float = 0.0) -> Any:
    """Every float as `change` makes it from the number and the size of the vector that it belongs to."""
    if isinstance(value, float):
        return change(value, size)
    if isinstance(value, tuple):
        largest = max((abs(x) for x in value if isinstance(x, float)), default=0.0)
        return tuple(_with_numbers(item, change, largest) for item in value)
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        names = [part.name for part in dataclasses.fields(value) if (type(value), part.name) not in _NAMES]
        return dataclasses.replace(value, **{name: _with_numbers(getattr(value, name), change) for name in names})
    return value


def with_plain_zeros(inputs: Inputs) -> Inputs:
    """No zero has a sign."""
    return {name: _with_numbers(value, lambda x, _: x + 0.0) for name, value in inputs.items()}


def with_digits(inputs: Inputs, digits: int) -> Inputs:
    """Single numbers rounded; vectors stay, as they may be unit vectors."""
    return {
        name: Real(f32(float(f"{value.value:.{digits}g}"))) if isinstance(value, Real) else value
        for name, value in inputs.items()
    }


def jittered(inputs: Inputs, sign: Callable[[], float]) -> Inputs:
    """Every number a little off; of single numbers, 0 stays 0."""

    def off(number: float, size: float) -> float:
        if not abs(number) < _LARGEST:
            return number
        return f32(number + sign() * _JITTER * (max(1.0, size) if size else abs(number)))

    return {name: _with_numbers(value, off) for name, value in inputs.items()}
