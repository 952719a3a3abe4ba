"""Limits of pictures: the arithmetic, the manifests, the settings, and one picture from end to end."""

import math
from dataclasses import replace
from pathlib import Path

import pytest

from raysteps.common.errors import GraderFault
from raysteps.course.manifest import Step, read_step
from raysteps.course.mutants import read_alternatives
from raysteps.course.project import Project
from raysteps.toolchain.kit_artifacts import BuiltKit
from tools.calibration.calibrate import calibration_page, complaints, mark, page_with, with_limits
from tools.calibration.measure import (
    KIT,
    CalibratedPicture,
    LimitedPicture,
    LimitMargin,
    PictureShares,
    Share,
    View,
    all_settings,
    fused_flags,
    gate_between,
    limited_pictures,
    own_setting,
    plain,
)
from tools.test_submissions import Entrant, right_ones

_PIXELS = 20_000

pytestmark = pytest.mark.xdist_group("calibration")  # the alternatives are built once


def test_the_limit_is_midway_in_ratio() -> None:
    gate = gate_between({"a": 0.0, "b": 0.001}, {"mild": [0.2, 0.1], "bold": [0.9, 0.9]}, _PIXELS, 0.03)
    assert gate.worst == Share(0.001, "b")
    assert gate.mildest == Share(0.1, "mild"), "of the seeds, the one that shows the mistake least"
    assert gate.limit == 0.01
    assert gate.margin == pytest.approx(100)
    assert gate.is_clear
    assert not gate.is_written


def test_two_pixels_are_always_allowed_for() -> None:
    gate = gate_between({"a": 0.0}, {"mild": [0.01]}, _PIXELS, 0.001)
    assert gate.worst == Share(0.0001, "")
    assert gate.limit == 0.001
    assert gate.is_written


def test_a_mistake_of_few_pixels_is_not_what_the_picture_shows() -> None:
    correct = {"a": 0.0}
    mistakes = {"ten pixels": [10 / _PIXELS], "none": [0.0], "seen once": [0.5, 0.0], "seen": [0.01]}
    gate = gate_between(correct, mistakes, _PIXELS, 0.001)
    assert gate.unseen == ("ten pixels", "none", "seen once")
    assert gate.mildest == Share(0.01, "seen")
    alone = gate_between(correct, {"none": [0.0]}, _PIXELS, 0.004)
    assert (alone.mildest, alone.limit, alone.margin) == (None, 0.004, math.inf)


def test_a_margin_under_two_is_a_complaint() -> None:
    limited = LimitedPicture("02-intersection", "twins", "balls", 0.01, ())
    near = gate_between({"a": 0.004}, {"mild": [0.007]}, _PIXELS, 0.0053)
    assert not near.is_clear
    assert "change the scene" in complaints([CalibratedPicture(limited, near)], check=False)[0]
    stale = LimitMargin(Share(0.001, "a"), Share(0.1, "mild"), (), 0.01, 0.05)
    assert complaints([CalibratedPicture(limited, stale)], check=False) == []
    assert "max_wrong is 0.05, measured 0.01" in complaints([CalibratedPicture(limited, stale)], check=True)[0]
    fresh = replace(stale, written=0.012)
    assert complaints([CalibratedPicture(limited, fresh)], check=True) == []
    assert (stale.stands, fresh.stands) == (0.01, 0.012)
    narrow = LimitMargin(Share(0.008, "a"), Share(0.018, "mild"), (), 0.012, 0.008)
    assert not narrow.is_written, "near enough, and yet a correct solution would not pass"
    page = calibration_page([CalibratedPicture(limited, stale)], [], ["no FMA here"])
    assert "| 02-intersection | balls-twin | 0.1 % (a) | 10 % (mild) | 100 | 0.01 |  |" in page
    assert "- no FMA here" in page
    other = LimitedPicture("04-shadows", "images", "corner", 0.01, ())
    unseen = tuple(f"a-mistake-with-a-long-name-{number}" for number in range(9))
    fresh = replace(fresh, unseen=unseen)
    stale = replace(stale, unseen=unseen[:7])
    page = calibration_page([CalibratedPicture(limited, stale)], [], ["no FMA here"])
    both = calibration_page([CalibratedPicture(limited, fresh), CalibratedPicture(other, fresh)], [], ["no FMA here"])
    assert page_with(both, page) == calibration_page(
        [CalibratedPicture(limited, stale), CalibratedPicture(other, fresh)], [], ["no FMA here"]
    )
    new = CalibratedPicture(LimitedPicture("10-fog", "images", "mist", 0.01, ()), fresh)
    more = calibration_page(
        [CalibratedPicture(limited, fresh), CalibratedPicture(other, fresh), new], [], ["no FMA here"]
    )
    assert page_with(both, calibration_page([new], [], [])) == more


def test_limits_are_written_without_an_exponent() -> None:
    assert [plain(value) for value in (0.000026, 0.01, 0.5)] == ["0.000026", "0.01", "0.5"]


_MANIFEST = """# A comment with max_wrong = 7.
[limits]
seconds = 10  # wall time

[[images]]
name = "one"
args = ["--size", "[8x8]"]
max_wrong = 0.003  # kept
max_share = 0.5

[[twins]]
of = "one"
max_wrong=0.01
"""


def test_only_the_number_changes() -> None:
    written = with_limits(_MANIFEST, {("images", "one"): 0.00002, ("twins", "one"): 0.5})
    assert written == _MANIFEST.replace("= 0.003 ", "= 0.00002 ").replace("=0.01", "=0.5")
    with pytest.raises(GraderFault, match="random_scenes one"):
        with_limits(_MANIFEST, {("random_scenes", "one"): 0.1})


def test_every_manifest_can_be_written(project: Project, steps: list[Step], tmp_path: Path) -> None:
    for step in steps:
        limits = limited_pictures(project, step, range(1, 2), tmp_path)
        for path in dict.fromkeys(limited.path(project) for limited in limits):
            mine = {(one.table, one.name): one.max_wrong for one in limits if one.path(project) == path}
            assert with_limits(path.read_text(encoding="utf-8"), mine) == path.read_text(encoding="utf-8")


def test_settings(kit: BuiltKit) -> None:
    assert fused_flags("x86_64", "flags : sse avx fma") == ("-mfma", "-ffp-contract=fast")
    assert fused_flags("x86_64", "flags : sse avx") is None
    assert fused_flags("arm64", "") == ("-ffp-contract=fast",)
    assert own_setting(kit).name == KIT
    found, left_out = all_settings(kit, ["no-such-compiler"])
    assert found == []
    assert "no-such-compiler is not installed: its settings were left out" in left_out


def test_every_step_has_other_correct_solutions(project: Project, steps: list[Step]) -> None:
    for step in steps:
        found = read_alternatives(project, step)
        assert len(found) >= 3, step.id
        for other in found:
            assert other.source.startswith("// "), f"{other.name} does not say what is different"


def test_one_picture_from_end_to_end(kit: BuiltKit, project: Project, steps: list[Step]) -> None:
    step = steps[6]
    image = read_step(project.steps / step.id / "step.toml").images[0]
    measuring = PictureShares(kit, step, [View(project.root / image.scene, image.args)])
    own = own_setting(kit)
    reference, other = right_ones(project, step)[:2]
    assert measuring.shares(reference, own) == (0.0,)
    assert measuring.shares(other, own)[0] <= image.max_wrong
    flat = Entrant("mutant", step.id, "flat", reference.source.replace("c / (c + 1.0F)", "0.5F"))
    assert flat.source != reference.source
    assert measuring.shares(flat, own)[0] > image.max_wrong
    assert measuring.shares(reference, own) == (0.0,)
    assert measuring.binaries == 3, "a binary that was seen before is not rendered again"
    broken = Entrant("mutant", step.id, "broken", "no C++")
    with pytest.raises(GraderFault, match="broken, the kit's own setting: does not compile"):
        measuring.shares(broken, own)


def test_a_correct_solution_gets_full_marks(kit: BuiltKit, project: Project, steps: list[Step]) -> None:
    step = steps[6]
    other = right_ones(project, step)[1]
    assert mark(kit, step, other, own_setting(kit)).is_full
    wrong = replace(other, source=other.source.replace("255", "250"))
    found = mark(kit, step, wrong, own_setting(kit))
    assert not found.is_full
    assert "to_byte" in found.lost()
