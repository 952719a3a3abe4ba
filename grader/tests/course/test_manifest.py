"""The manifests agree with each other, with the sources and with the design."""

import re
import shutil
from pathlib import Path

import pytest

from raysteps.common.errors import GraderFault, UsageError
from raysteps.course.manifest import Step, choose, choose_one, kit_steps, read_manifests, read_step, steps_words
from raysteps.course.project import Project

pytestmark = pytest.mark.portable


def test_points_sum_to_100_and_a_bonus_of_20(steps: list[Step]) -> None:
    assert [step.points for step in steps] == [10, 20, 15, 10, 15, 20, 10, 10, 10]
    assert [step.bonus for step in steps] == [False] * 7 + [True] * 2


def test_every_step_has_three_hints_and_pictures(project: Project) -> None:
    for step in kit_steps(project):
        assert len(step.hints) == 3, step.id
        assert step.images, step.id
        assert len({image.name for image in step.images}) == len(step.images)


def test_files_that_manifests_name_exist(project: Project) -> None:
    for step in kit_steps(project):
        assert (project.steps / step.path).is_file()
        for image in step.images:
            assert (project.root / image.scene).is_file(), image.scene
            assert re.fullmatch(r"[a-z0-9-]+", image.name)


_TYPED = ["02", "2", "02-intersection", "02-intersection/", "steps/02-intersection", "./steps/02-intersection/x.cpp"]


@pytest.mark.parametrize("name", [*_TYPED, ".\\steps\\02-intersection\\"])
def test_a_step_is_named_by_its_number_or_its_folder(steps: list[Step], name: str) -> None:
    assert [step.id for step in choose(steps, [name])] == ["02-intersection"]


def test_no_name_is_every_step_and_order_is_kept(steps: list[Step]) -> None:
    assert choose(steps, []) == steps
    assert [step.number for step in choose(steps, ["5", "01", "5"])] == ["01", "05"]


@pytest.mark.parametrize(
    ("names", "numbers"),
    [
        (["1-4"], "1234"),
        (["01", "02"], "12"),
        (["01 02"], "12"),
        (["1,3"], "13"),
        (["1-2,", "04-shadows", "7\u20138"], "12478"),
        (["3-3"], "3"),
    ],
)
def test_lists_and_ranges_have_one_syntax(steps: list[Step], names: list[str], numbers: str) -> None:
    assert "".join(str(step.index) for step in choose(steps, names)) == numbers


def test_a_range_steps_over_what_is_left_out(steps: list[Step]) -> None:
    assert [step.index for step in choose([*steps[:2], *steps[3:]], ["1-4"])] == [1, 2, 4]


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("4-1", "ends before it begins; expected 1-4"),
        ("1-19", "no step '19'"),
        (",", "expected steps, such as 1-4"),
        ("elsewhere/02-intersection/x.cpp", "no step 'elsewhere/02-intersection/x.cpp'"),
        ("02-intersection/../03-phong-shading", "no step '02-intersection/"),
    ],
)
def test_what_names_no_step_is_refused(steps: list[Step], name: str, words: str) -> None:
    with pytest.raises(UsageError, match=words):
        choose(steps, [name])


def test_one_step_is_one_step(steps: list[Step]) -> None:
    assert choose_one(steps, "2").number == "02"
    with pytest.raises(UsageError, match="'1-2': expected one step, such as 01"):
        choose_one(steps, "1-2")


def test_steps_are_named_as_they_are_typed(steps: list[Step]) -> None:
    assert steps_words(steps[:4]) == ["1-4"]
    assert steps_words([steps[0], steps[2]]) == ["1", "3"]
    assert steps_words(steps[4:5]) == ["5"]


@pytest.mark.parametrize("name", ["0", "10", "02-", "intersection", "²", "-1"])
def test_an_unknown_step_is_refused(steps: list[Step], name: str) -> None:
    with pytest.raises(UsageError, match="there is no step"):
        choose(steps, [name])


@pytest.mark.parametrize("name", ["all", "*", "6-", "\u20134", "1..4", "-"])
def test_who_writes_steps_as_elsewhere_is_told_how_they_are_written(steps: list[Step], name: str) -> None:
    with pytest.raises(UsageError, match=r"expected steps such as 1-4, 01 02 or 1,3$"):
        choose(steps, [name])


def test_only_functions_of_earlier_steps_are_barred(project: Project, tmp_path: Path) -> None:
    copy = Project(tmp_path)
    for step in ("06-octree", "09-bvh"):
        (copy.steps / step).mkdir(parents=True)
        shutil.copy(project.steps / step / "step.toml", copy.steps / step)
    assert read_manifests(copy)[1].barred_functions == {"build_octree", "closest_hit_in_octree", "occluded_in_octree"}
    path = copy.steps / "09-bvh" / "step.toml"
    good = path.read_text("utf-8")
    for said, why in {
        '{ "06-octree" = ["build_octre"] }': "'build_octre' is no function of 06-octree; did you mean build_octree",
        '{ "06-octre" = ["build_octree"] }': "'06-octre' is no step before it; did you mean 06-octree",
        '{ "09-bvh" = ["build_bvh"] }': "'09-bvh' is no step before it",
        '["split"]': r"expected a list of names of functions for each step; found \['split'\]",
        '{ "06-octree" = "split" }': "expected a list of names of functions for each step; found {'06-octree':",
    }.items():
        path.write_text(re.sub(r"^barred = .*", f"barred = {said}", good, flags=re.MULTILINE), "utf-8")
        with pytest.raises(GraderFault, match=rf"step.toml:13:1: barred: {why}"):
            read_manifests(copy)
    path.write_text(good, "utf-8")
    shutil.rmtree(copy.steps / "06-octree")
    (bvh,) = read_manifests(copy)
    assert bvh.barred_functions, "a course may have no octree"


def test_a_bad_manifest_is_the_kits_fault(project: Project) -> None:
    with pytest.raises(GraderFault, match=r"CMakeLists\.txt:\d+:\d+: is not TOML"):
        read_step(project.root / "CMakeLists.txt")
    with pytest.raises(GraderFault, match=r"nowhere\.toml: not a step manifest: it is not there"):
        read_step(project.root / "nowhere.toml")


_SLIPS = [
    ("points = 20", "pionts = 20", "{at}:1: unknown key 'pionts'; did you mean points?"),
    ("points = 20", 'points = "20"', "{at}:1: points: expected a number above 0; found '20'"),
    ("points = 20", "points = -2", "{at}:1: points: expected a number above 0; found -2"),
    ("points = 20", "points = 20\npoints = 25", "{after}:1: is not TOML: points stands there twice; keep one of them"),
    ("bonus = false", 'bonus = "no"', "{at}:1: bonus: expected true or false; found 'no'"),
    (
        "bonus = false",
        "bonus = False",
        "{at}:9: is not TOML: invalid value; true and false are written in small letters",
    ),
    ("tests = 0.45", "test = 0.45", "{at}:1: unknown key 'test'; did you mean tests?"),
    ("tests = 0.45", "tests = 45", "{at}:1: tests: expected a share from 0 to 1; found 45"),
    ("tests = 0.45", "tests = 0.55", "{weights}:1: the weights must sum to 1; these sum to 1.1"),
    ("tests = 0.45\n", "", "{weights}:1: tests is missing; expected a share from 0 to 1"),
    ("images = 0.15", "images = 0", "{weights}:1: the weights must sum to 1; these sum to 0.85"),
    (
        "[weights]",
        "left_out = true\n[weights]",
        "{at}:1: unknown key 'left_out'; `left_out = ...` belongs above the first",
    ),
    ("[weights]", "[weights]\n[weights]", "{after}:1: is not TOML: the table [weights] stands there twice; put all"),
    ("closest_hit = 2", "closest_hit = 0", "{at}:1: closest_hit: expected a weight beside the others; found 0"),
    ("seconds = 10", "secnds = 10", "{at}:1: unknown key 'secnds'; did you mean seconds?"),
    (
        "max_wrong = 0.0015",
        "max_wrong = 15",
        "{at}:1: max_wrong: expected the share of pixels that may be wrong, from 0",
    ),
    ("max_wrong = 0.0015", "", "{second}:1: max_wrong is missing; expected the share of pixels"),
    ('name = "slivers-color"', 'name = "balls-normals"', "{at}:1: two pictures are called balls-normals"),
    (
        "seconds = 10",
        "seconds = 10\nprocesses = 1.5",
        "{after}:1: processes: expected a whole number above 0; found 1.5",
    ),
    ("[[images]]", "[images]", "{second}:1: is not TOML: [images] and [[images]] both stand there"),
]


@pytest.mark.parametrize(("good", "slip", "told"), _SLIPS)
def test_a_slip_is_told_with_its_place(project: Project, tmp_path: Path, good: str, slip: str, told: str) -> None:
    path = tmp_path / "02-intersection" / "step.toml"
    path.parent.mkdir()
    text = (project.steps / "02-intersection" / "step.toml").read_text("utf-8")
    lines = text.splitlines()
    at = next(number for number, line in enumerate(lines, start=1) if good.strip() in line)
    weights, _, second = [n for n, line in enumerate(lines, start=1) if line in ("[weights]", "[[images]]")][:3]
    path.write_text(text.replace(good, slip, 1), "utf-8")
    place = told.format(at=at, after=at + 1, weights=weights, second=second)
    with pytest.raises(GraderFault, match=f"step.toml:{re.escape(place)}"):
        read_step(path)


def test_what_looks_like_a_slip_and_is_none(project: Project, tmp_path: Path) -> None:
    path = tmp_path / "02-intersection" / "step.toml"
    path.parent.mkdir()
    text = (project.steps / "02-intersection" / "step.toml").read_text("utf-8")
    path.write_text(text.replace("closest_hit = ", "picture = ", 1).replace('"--step", "2"', '"--step", 2'), "utf-8")
    step = read_step(path)
    assert step.functions[-1] == "picture"
    assert step.images[0].args[:2] == ("--step", "2")


def test_a_manifest_may_come_from_any_editor_that_writes_utf_8(project: Project, tmp_path: Path) -> None:
    path = tmp_path / "02-intersection" / "step.toml"
    path.parent.mkdir()
    data = (project.steps / "02-intersection" / "step.toml").read_bytes()
    path.write_bytes(b"\xef\xbb\xbf" + data.replace(b"\n", b"\r\n"))
    step = read_step(path)
    assert (step.points, step.functions[0], len(step.images)) == (20, "Triangle::intersect", 3)
    path.write_text(data.decode("utf-8"), "utf-16")
    with pytest.raises(GraderFault, match="it is text in UTF-16; save it in UTF-8"):
        read_step(path)
