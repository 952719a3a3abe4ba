"""Records that contradict themselves, told without the reference."""

from dataclasses import replace

import pytest
from inspect_records import ball_record

from raysteps.inspector.model import Hit
from raysteps.inspector.records import contradiction


@pytest.mark.parametrize("lit", [False, True])
def test_a_right_record_has_none(lit: bool) -> None:
    assert contradiction(ball_record(lit=lit)) is None


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"ray_direction": [0, 0, 1]}, "ray_direction is (0, 0, 1), but the ray goes towards (0, 0, -1)"),
        ({"ray_direction": [0, 0, 0]}, "ray_direction is (0, 0, 0), but"),
        ({"normal": [0, 0, -1]}, "normal points away from where the ray came from"),
        ({"normal": [0, 0, 3]}, "normal has length 3; it must be 1"),
        ({"normal": ["nan", 0, 1]}, "normal has length nan"),
        ({"position": [0, 0, 2]}, "position is (0, 0, 2), but distance 4 along the ray lies (0, 0, 1)"),
        ({"distance": 3.0}, "distance 3 along the ray lies (0, 0, 2)"),
    ],
)
def test_what_the_contract_promises(change: dict[str, object], says: str) -> None:
    record = ball_record()
    hit = record.ray.hit
    assert isinstance(hit, Hit)
    record.ray.hit = replace(hit, **change)  # type: ignore[arg-type]
    found = contradiction(record)
    assert found is not None
    assert says in found.words
    assert found.function == "Sphere::intersect"


def test_surfaces_of_the_framework_and_smooth_ones_are_left_alone() -> None:
    record = ball_record()
    hit = record.ray.hit
    assert isinstance(hit, Hit)
    for kind in ("cone", "smooth-triangle", "hollow-sphere"):
        record.ray.hit = replace(hit, kind=kind, normal=[0, 0, -1])
        assert contradiction(record) is None
