"""Programs with a mistake lose what it costs, and nothing else."""

from pathlib import Path

import pytest
from conftest import MakeSubmission, Sources

from raysteps.course.manifest import Step
from raysteps.grading.pipeline import grade_submission
from raysteps.judge.functions import AGAIN
from raysteps.results.model import Settings, StepResult
from raysteps.sandbox.detect import find_sandbox
from raysteps.submission.load import load_submission
from raysteps.toolchain.kit_artifacts import BuiltKit

# Six levels of boxes, whatever is in them: nothing is lost, and there are 37449 of them.
_FULL_TREE = """
#pragma GCC diagnostic ignored "-Wunused-function"
namespace {
void divide(Node& node, int level) {
    if (level == 0) {
        return;
    }
    for (const Box& part : split(node.box)) {
        Node child;
        child.box = part;
        for (const Surface* surface : node.surfaces) {
            if (surface->overlaps(part)) {
                child.surfaces.push_back(surface);
            }
        }
        divide(child, level - 1);
        node.children.push_back(std::move(child));
    }
    node.surfaces.clear();
}
}  // namespace

Node build_octree(const SurfaceList& surfaces) {
    if (surfaces.empty()) {
        return {};
    }
    Node root{bounds_of(surfaces), surfaces, {}};
    root.box.min -= 0.01F;
    root.box.max += 0.01F;
    divide(root, 5);
    return root;
}
"""


class _Honest:
    def __init__(self, kit: BuiltKit, make: MakeSubmission, solved: Sources, out: Path) -> None:
        self._kit = kit
        self._make = make
        self._solved = solved
        self._out = out

    def grade(self, step: Step, old: str, new: str) -> StepResult:
        """The step as it is solved, but for one change."""
        source = self._solved[step.id]
        assert source.count(old) == 1
        path = self._make("honest", {step.id: source.replace(old, new)})
        submission, settings = load_submission(path, self._kit.steps), Settings("diagnosis", only=(step.id,))
        return grade_submission(self._kit, submission, settings, find_sandbox(), self._out).steps[0]


@pytest.fixture
def honest(kit: BuiltKit, make_submission: MakeSubmission, solved: Sources, tmp_path: Path) -> _Honest:
    return _Honest(kit.in_one_process(), make_submission, solved, tmp_path / "out")


def test_a_transmitted_ray_on_the_wrong_side(honest: _Honest, steps: list[Step]) -> None:
    """Every transmitted ray is wrong by its origin alone: half of it, and tests of its light count in full."""
    result = honest.grade(steps[7], "hit.position - offset", "hit.position + offset")
    assert any(test.passed for test in result.tests if test.name.startswith("transmitted_ray"))
    assert all(test.passed for test in result.tests if test.name.startswith(("transmitted_light", "refract:")))
    shares = {item.name: item.share for item in result.hidden if item.kind == "function"}
    assert shares.pop("transmitted_ray") == pytest.approx(0.5, abs=0.1)
    assert shares == {"refract": 1.0, "transmitted_light": 1.0}


@pytest.mark.parametrize(
    ("wrong", "earned"),
    [
        ("Ray{hit.position + 0.2F * hit.normal, direction}", 0.5),
        ("Ray{hit.position + 0.001F * hit.normal, hit.normal}", 0),
    ],
)
def test_a_reflected_ray_that_alone_is_wrong(honest: _Honest, steps: list[Step], wrong: str, earned: float) -> None:
    """By its origin, or by its direction: what trace does with it still counts."""
    old = "return {hit.position + k_bounce_threshold * hit.normal, glm::normalize(direction)};"
    result = honest.grade(steps[4], old, f"return {wrong};")
    shares = {item.name: item.share for item in result.hidden if item.kind == "function"}
    assert shares["reflected_ray"] == pytest.approx(earned)
    assert shares["trace"] == 1


_RAY = "    const Ray ray = shadow_ray(hit, light);\n"
_ONLY_ON_THE_EYES_SIDE = """    if (glm::dot(light.position - hit.position, hit.ray_direction) >= 0.0F) {
        return false;
    }
"""
_CLIP = "    return part_inside(*this, ray.origin, 1.0F / ray.direction, {});\n"
_CLIP_ROUNDED = """    glm::vec3 direction = ray.direction;
    for (int axis = 0; axis < 3; ++axis) {
        direction[axis] = std::abs(direction[axis]) < 0.01F ? 0.0F : direction[axis];
    }
    return part_inside(*this, ray.origin, 1.0F / direction, {});
"""


@pytest.mark.parametrize(
    ("step", "old", "new", "function", "kind"),
    [
        (3, _RAY, _ONLY_ON_THE_EYES_SIDE + _RAY, "is_lit", "nothing between"),
        (5, _CLIP, _CLIP_ROUNDED, "Box::clip", "almost along an axis"),
    ],
)
def test_what_few_pixels_show_is_asked(
    honest: _Honest, steps: list[Step], step: int, old: str, new: str, function: str, kind: str
) -> None:
    """A light that is seen, but not from where the eye is; a ray that is taken to run along an axis, and only nearly
    does."""
    result = honest.grade(steps[step], old, new)
    (groups,) = (item.groups for item in result.hidden if item.name == function)
    (group,) = (group for group in groups if group.name == kind)
    assert 0 < group.right < group.cases


def test_a_tree_that_spares_nothing(honest: _Honest, steps: list[Step]) -> None:
    """It costs the pictures; but where most of one is sky, rays test few objects all the same."""
    result = honest.grade(steps[5], "k_leaf_size = 8", "k_leaf_size = 100000")
    assert sum(image.passed for image in result.images) <= 1
    scenes = [item for item in result.hidden if item.kind == "picture"]
    assert all(item.share == 0 for item in scenes if not item.passed), "nor does it earn anything in part"


def test_a_tree_that_is_too_large_to_be_told(honest: _Honest, steps: list[Step], solved: Sources) -> None:
    """It costs the kinds in which it is, and no others."""
    step = steps[5]
    source = solved[step.id]
    start = source.index("Node build_octree(")
    body = source[start : source.index("\n}\n", start) + 3]
    result = honest.grade(step, body, _FULL_TREE.strip() + "\n")
    assert all(test.passed for test in result.tests), [test.message for test in result.tests]
    tree = next(item for item in result.hidden if item.name == "build_octree")
    assert "more than 5000 boxes for " in tree.message
    assert tree.groups[0].right == 0
    assert tree.groups[-2].right == tree.groups[-2].cases
    assert next(item for item in result.hidden if item.name == "closest_hit_in_octree").share == 1


_FRAME = "    ViewFrame frame;\n    frame.forward ="
_KEPT_BY_PLACE = """    static Camera last;
    static ViewFrame frame;
    if (camera.from == last.from && camera.at == last.at && camera.up == last.up) {
        return frame;  // and the angle? and the size?
    }
    last = camera;
    frame.forward ="""
_MIRROR = "    return direction - 2.0F * glm::dot(direction, normal) * normal;\n"
_KEPT_BY_DIRECTION = """    static glm::vec3 last(0.0F);
    static glm::vec3 kept(0.0F);
    if (direction != last) {
        last = direction;
        kept = direction - 2.0F * glm::dot(direction, normal) * normal;
    }
    return kept;
"""


@pytest.mark.parametrize(
    ("step", "old", "new", "function"),
    [(0, _FRAME, _KEPT_BY_PLACE, "view_frame"), (2, _MIRROR, _KEPT_BY_DIRECTION, "mirror")],
)
def test_what_is_kept_from_one_call_to_the_next(
    honest: _Honest, steps: list[Step], step: int, old: str, new: str, function: str
) -> None:
    """Other questions never differ so little: here every visible test and every picture is right."""
    result = honest.grade(steps[step], old, new)
    assert result.status == "partial"
    wrong = {item.name: [group.name for group in item.groups if group.right < group.cases] for item in result.hidden}
    assert wrong[function] == [AGAIN]
    assert "keep something from one call to the next" in next(i.message for i in result.hidden if i.name == function)
