"""What a student's program says of the picture that it made."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from estimate_files import bytes_of

from raysteps.common.errors import GraderFault
from raysteps.common.process import Outcome, run
from raysteps.course.manifest import Step
from raysteps.images.compare import read_ppm
from raysteps.images.noise import Estimates, read_estimates
from raysteps.images.render import (
    PictureCriteria,
    RenderResult,
    describe_exit,
    exit_words,
    judge_picture,
    pixel_credit,
    reference_parts,
    reference_picture,
    render,
    shown_reference,
)
from raysteps.sandbox.task import Isolation, Limits, Task, TaskResult
from raysteps.toolchain.compile import Program
from raysteps.toolchain.kit_artifacts import BuiltKit

_PICTURE = b"P6\n1 1\n255\n\1\2\3"


class _Says:
    """A sandbox whose program writes these statistics."""

    isolation = Isolation()

    def __init__(self, stats: bytes, estimates: bytes = b"") -> None:
        self._stats = stats
        self._estimates = estimates

    def run(self, task: Task) -> TaskResult:
        outputs = {"picture": _PICTURE, "stats": self._stats, "estimates": self._estimates}
        return TaskResult(Outcome(0, False, "", "", 0.1), outputs, 0.1, "")


@pytest.mark.parametrize(
    "stats",
    [
        b"",
        b"\xff",
        b"[1]",
        b"null",
        b'{"share_tested": "much"}',
        b'{"share_tested": null}',
        b'{"share_tested": NaN}',
        b'{"share_tested": -1}',
        b'{"share_tested": 1e999}',
        b'{"share_tested": ' + b"9" * 400 + b"}",
        b'{"share_tested": ' + b"9" * 5000 + b"}",
        b'{"share_tested": ' + b"[" * 100_000,
    ],
)
def test_statistics_that_cannot_be_read_are_none(stats: bytes, tmp_path: Path) -> None:
    scene = tmp_path / "a.nff"
    scene.touch()
    made = render(_Says(stats), Program(("program",)), scene, (), Limits())
    assert made.pixels is not None
    assert (made.share_tested, made.work) == (None, None)


def test_statistics_are_read(tmp_path: Path) -> None:
    made = render(_Says(b'{"share_tested": 0.25}'), Program(("program",)), tmp_path / "a.nff", (), Limits())
    assert made.share_tested == 0.25


def test_estimates_are_read_where_they_are_asked_for(tmp_path: Path) -> None:
    light = np.full((1, 1, 3), 0.5)
    program, scene = Program(("program",)), tmp_path / "a.nff"
    made = render(_Says(b"", bytes_of(Estimates(light, light))), program, scene, (), Limits(), estimates=True)
    assert made.estimates is not None
    assert made.estimates.mean.tolist() == [[[0.5, 0.5, 0.5]]]
    lost = render(_Says(b"", b"P6"), program, scene, (), Limits(), estimates=True)
    assert (lost.pixels, lost.problem) == (None, "no estimates were written")
    assert render(_Says(b""), program, scene, (), Limits()).estimates is None


def test_a_noisy_picture_is_judged_by_its_light(whole_kit: BuiltKit, tmp_path: Path) -> None:
    """The reference's own, drawn from other seeds, and what becomes of it when light is lost."""
    args = ("--step", "11", "--size", "40x30", "--samples", "16", "--sampler", "stratified", "--filter", "box")
    criteria = PictureCriteria(args, max_wrong=0.0, max_noise=2.0, more_samples=4)
    kit = whole_kit
    step = next(step for step in kit.steps if step.index == 11)
    scene = kit.project.root / step.images[0].scene

    def drawn(seed: int) -> RenderResult:
        picture, estimates = tmp_path / "picture.ppm", tmp_path / "estimates"
        words = (scene, *args, "--seed", str(seed), "-o", picture, "--estimates", estimates, "--quiet")
        assert run([kit.reference("raytrace"), *words], seconds=60, cwd=tmp_path).code == 0
        ran = TaskResult(Outcome(0, False, "", "", 0.1), {}, 0.1, "")
        return RenderResult(ran, read_ppm(picture), estimates=read_estimates(estimates.read_bytes()))

    for seed in (1, 2, 3):
        verdict = judge_picture(kit, scene, criteria, drawn(seed))
        assert verdict.passed, verdict.message
    dark = drawn(4)
    assert dark.estimates is not None
    dark.estimates.mean[:, :20] *= 0.6
    verdict = judge_picture(kit, scene, criteria, dark)
    assert "too dark" in verdict.message
    assert 0.3 < verdict.wrong_share <= 0.6
    assert 0.0 < _part(kit, step, scene, criteria, dark) < _part(kit, step, scene, criteria, drawn(4)) <= 0.6
    assert shown_reference(kit, scene, criteria).shape == (30, 40, 3)


def test_estimates_of_which_only_half_was_kept_are_drawn_again(whole_kit: BuiltKit, tmp_path: Path) -> None:
    (tmp_path / "bin").symlink_to(whole_kit.folder / "bin")
    (tmp_path / "pictures").mkdir()
    kit = replace(whole_kit, folder=tmp_path)
    criteria = PictureCriteria(("--step", "11", "--size", "12x9"), max_wrong=0.0, max_noise=2.0, more_samples=4)
    scene = kit.project.root / next(step for step in kit.steps if step.index == 11).images[0].scene
    parts = reference_parts(kit, scene, criteria)
    (kept,) = tmp_path.rglob("*.estimates")
    whole = kept.read_bytes()
    kept.write_bytes(whole[:99])
    assert (reference_parts(kit, scene, criteria).mean == parts.mean).all()
    assert kept.read_bytes() == whole


def _part(kit: BuiltKit, step: Step, scene: Path, criteria: PictureCriteria, made: RenderResult) -> float:
    return pixel_credit(kit, step, scene, criteria, made)


def test_a_graded_scene_stands_alone(whole_kit: BuiltKit, tmp_path: Path) -> None:
    """A student's program gets nothing that lies beside it, and must not lose by that."""
    scene = tmp_path / "scene.pbrt"
    scene.write_text('WorldBegin\nInclude "more.pbrt"\n', encoding="utf-8")
    (tmp_path / "more.pbrt").write_text('Shape "sphere"\n', encoding="utf-8")
    with pytest.raises(GraderFault, match=r"scene\.pbrt .* no other file beside it: .*more\.pbrt: expected a file"):
        reference_picture(whole_kit, scene, ("--step", "11", "--size", "8x6"))


@pytest.mark.parametrize(
    ("symbol", "name"),
    [("helper", "helper"), ("_ZN8raysteps7to_byteEf", "to_byte"), ("pow, version GLIBC_9.9", "pow")],
)
@pytest.mark.parametrize("folder", ["/in/0", "/home/ann lee/kit"])
def test_what_the_loader_does_not_find_is_told_in_words(folder: str, symbol: str, name: str) -> None:
    said = f"hello\n/in/1/box: symbol lookup error: {folder}/steps/libstep-07.so: undefined symbol: {symbol}\n"
    words = exit_words(Outcome(127, False, "", said, 0.1))
    assert words == (f"exit code 127: the program asks for {name}, which is defined nowhere that it could see")
    assert exit_words(Outcome(2, False, "", "raytrace: no such scene\n", 0.1)) == "exit code 2: raytrace: no such scene"


def test_a_program_that_ends_itself_with_0_is_told_so() -> None:
    """Nobody finds a call of exit(0) by hearing that there is no picture."""
    ended = TaskResult(Outcome(0, False, "", "", 0.1), {"picture": b"", "stats": b""}, 0.1, "")
    words = "The picture was not made: the program gave up with exit code 0, as by a call of exit(0)."
    assert describe_exit(ended, "The picture") == ("crashed", words)
    odd = replace(ended, outputs={"picture": b"P3"})
    assert describe_exit(odd, "The picture") == ("wrong", "")
