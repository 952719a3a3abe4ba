"""Benchmarks: scenes for POV-Ray, without POV-Ray."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from raysteps.common.errors import GraderFault, UsageError
from tools.bench.povray import brightness_difference, linear_picture, pov_text, read_flat, trace_seconds

pytestmark = pytest.mark.portable

_VIEW = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 90\nhither 1\nresolution 64 64\nb 0.1 0.2 0.3\n"
_SHAPES = """l 1 2 3 0.5 0.6 0.7
l 4 5 6
f 1 0 0 0.5 0 1 0 1
s 0 0 0 2
c 0 0 0 1
0 0 2 0.5
f 0 1 0 0.25 0.5 20 0.5 1.5
p 3
0 0 0
1 0 0
0 1 0
pp 3
0 0 0 0 0 1
1 0 0 0 0 1
0 1 0 0 0 1
f 1 0 0 0.5 0 1 0 1
s 1 1 1 0.5
"""


def test_every_surface_and_light_has_its_counterpart() -> None:
    lines = pov_text(read_flat(_VIEW + _SHAPES), 5).splitlines()
    counts = {word: len([line for line in lines if line.startswith(word + " ")]) for word in (
        "sphere", "cone", "triangle", "smooth_triangle", "light_source", "camera")}  # fmt: skip
    assert counts == {"sphere": 2, "cone": 1, "triangle": 1, "smooth_triangle": 1, "light_source": 2, "camera": 1}
    assert len([line for line in lines if line.startswith("#declare")]) == 2
    assert "global_settings { assumed_gamma 1.0 max_trace_level 5 adc_bailout 0 }" in lines


def test_numbers_arrive_where_they_belong() -> None:
    text = pov_text(read_flat(_VIEW + _SHAPES), 5)
    assert "sphere { <0,0,0>, 2 texture { Fill0 } }" in text
    assert "cone { <0,0,0>, 1, <0,0,2>, 0.5 open texture { Fill0 } }" in text
    assert "triangle { <0,0,0>, <1,0,0>, <0,1,0> texture { Fill1 } interior { ior 1.5 } }" in text
    assert "smooth_triangle { <0,0,0>, <0,0,1>, <1,0,0>, <0,0,1>, <0,1,0>, <0,0,1> texture { Fill1 }" in text
    assert "light_source { <4,5,6> rgb <1,1,1> }" in text
    assert "rgb <0,1,0> transmit 0.5" in text
    assert "diffuse 0.5 phong 0.5 phong_size 20 reflection 0.5" in text


def test_the_camera_spans_the_same_angle() -> None:
    (camera,) = [line for line in pov_text(read_flat(_VIEW), 5).splitlines() if line.startswith("camera")]
    assert "location <0,0,5> direction <0,0,-1> right <2,0,0> up <0,2,0>" in camera.replace("-0,", "0,").replace(
        ",-0>", ",0>"
    )


@pytest.mark.parametrize("shape", ["s 0 0 0 -1", "c 0 0 0 -1\n0 0 1 -1"])
def test_a_surface_seen_from_inside_only_is_turned_away(shape: str) -> None:
    with pytest.raises(UsageError, match="no counterpart in POV-Ray"):
        pov_text(read_flat(f"{_VIEW}f 1 1 1 1 0 1 0 1\n{shape}\n"), 5)


@pytest.mark.parametrize("text", ["p 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n", "torus 1 2\n"])
def test_only_flat_scenes_are_read(text: str) -> None:
    with pytest.raises(GraderFault, match="expected"):
        read_flat(_VIEW + text)


def test_the_trace_time_is_read_to_the_millisecond() -> None:
    report = "  Parse Time:  0 hours (0.5 seconds)\n  Trace Time:  0 hours  0 minutes  2 seconds (2.085 seconds)\n"
    assert trace_seconds(report) == 2.085
    with pytest.raises(GraderFault, match="did not tell its trace time"):
        trace_seconds("Parse Time: (0.5 seconds)")


def test_tone_mapping_is_undone(tmp_path: Path) -> None:
    Image.new("RGB", (32, 32), (51, 51, 51)).save(tmp_path / "linear.png")  # 0.2
    Image.new("RGB", (32, 32), (43, 43, 43)).save(tmp_path / "mapped.png")  # 0.2 / 1.2
    linear = linear_picture(tmp_path / "linear.png", tone_mapped=False)
    mapped = linear_picture(tmp_path / "mapped.png", tone_mapped=True)
    assert brightness_difference(linear, mapped) < 0.005


def test_a_mirrored_picture_is_another_one() -> None:
    picture = np.zeros((64, 64, 3))
    picture[:, :32] = 1.0
    assert brightness_difference(picture, picture) == 0.0
    assert brightness_difference(picture, picture[:, ::-1]) == pytest.approx(1.0)
