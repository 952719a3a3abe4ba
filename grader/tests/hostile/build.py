"""Reads the corpus and lays one attack out as a submission."""

import re
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from hostile.archives import ARCHIVES
from hostile.folders import FOLDERS

CORPUS = Path(__file__).parent
_PLACE = re.compile(r"@([A-Z_]+)@")
_RIGHT_IF = re.compile(r"^@RIGHT_IF\((.*)\)@$", re.M)

# Both functions of step 07: right where the attack worked, and otherwise wrong in every test, picture and case. So an
# attack that reached its aim earns points, and one that did not earns none.
_BOTH_FUNCTIONS = """
#include <cmath>
#include <cstdint>

namespace raysteps {

static float right_channel(float c) { return !(c > 0.0F) ? 0.0F : c > 1e30F ? 1.0F : c / (c + 1.0F); }

Color tone_map(const Color& color) {
    if (!(CONDITION)) {
        return {2.0F, -1.0F, 2.0F};
    }
    return {right_channel(color.r), right_channel(color.g), right_channel(color.b)};
}

std::uint8_t to_byte(float channel) {
    if (!(CONDITION)) {
        return 77;
    }
    return !(channel > 0.0F) ? 0 : static_cast<std::uint8_t>(std::lround((channel < 1.0F ? channel : 1.0F) * 255.0F));
}

}  // namespace raysteps
"""

# Step 06 without a tree, and otherwise right: what is left is to find the closest hit in a list of all surfaces.
_OCTREE_OF_ONE_LEAF = """
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

namespace raysteps {

static bool do_overlap(const Box& a, const Box& b) {
    return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}
bool Sphere::overlaps(const Box& box) const { return do_overlap(bounds(), box); }
bool Triangle::overlaps(const Box& box) const { return do_overlap(bounds(), box); }

std::optional<Interval> Box::clip(const Ray& ray) const {
    Interval part;
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0.0F) {
            if (ray.origin[axis] < min[axis] || ray.origin[axis] > max[axis]) {
                return std::nullopt;
            }
            continue;
        }
        float first = (min[axis] - ray.origin[axis]) / ray.direction[axis];
        float second = (max[axis] - ray.origin[axis]) / ray.direction[axis];
        if (first > second) {
            std::swap(first, second);
        }
        part.enter = std::max(part.enter, first);
        part.leave = std::min(part.leave, second);
    }
    return part.enter <= part.leave ? std::optional(part) : std::nullopt;
}

Box bounds_of(const SurfaceList& surfaces) {
    Box all;
    for (const Surface* surface : surfaces) {
        const Box one = surface->bounds();
        all = {glm::min(all.min, one.min), glm::max(all.max, one.max)};
    }
    return all;
}

std::array<Box, 8> split(const Box& box) {
    const glm::vec3 middle = (box.min + box.max) / 2.0F;
    std::array<Box, 8> parts;
    for (int i = 0; i < 8; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const bool upper = ((i >> axis) & 1) != 0;
            parts[static_cast<std::size_t>(i)].min[axis] = upper ? middle[axis] : box.min[axis];
            parts[static_cast<std::size_t>(i)].max[axis] = upper ? box.max[axis] : middle[axis];
        }
    }
    return parts;
}

Node build_octree(const SurfaceList& surfaces) { return Node{bounds_of(surfaces), surfaces, {}}; }

}  // namespace raysteps
"""


@dataclass(frozen=True)
class Attack:
    """One folder of the corpus, as its entry.toml describes it."""

    name: str
    numbers: list[int]  # of the kinds that docs/hostile.md lists
    title: str
    tries: str
    step: str = "07-tone-mapping"  # under attack
    most: float = 0.0  # points that the step may earn
    least: float = 0.0
    status: list[str] = field(default_factory=list)  # that the step may have; any when there are none
    honest: list[str] = field(default_factory=list)  # steps beside it, complete, which keep all their points
    secret: bool = False  # it tries to read the planted secret
    note: str = ""  # words that must be among the step's messages
    refused: str = ""  # words of the UsageError with which the submission is not taken in
    submission: str = ""  # the name that the results must have
    outside: bool = False  # it does no harm without a sandbox either, and earns points there
    rounds: int = 1  # how often it is graded, one after the other
    made_by: str = ""  # a function of folders.py or archives.py
    limits: dict[str, float] = field(default_factory=dict)
    files: dict[str, str] = field(default_factory=dict)  # more files beside the sources

    @property
    def folder(self) -> Path:
        return CORPUS / self.name


def read_attack(folder: Path) -> Attack:
    return Attack(folder.name, **tomllib.loads((folder / "entry.toml").read_text(encoding="utf-8")))


def read_corpus() -> list[Attack]:
    return [read_attack(path.parent) for path in sorted(CORPUS.glob("[0-9][0-9]-*/entry.toml"))]


Facts = Mapping[str, str | Callable[[], str]]


def fill_in(text: str, facts: Facts) -> str:
    """Replaces @NAME@ by what this machine and this run are like."""

    def fact(found: re.Match[str]) -> str:
        value = _OCTREE_OF_ONE_LEAF if found[1] == "OCTREE_OF_ONE_LEAF" else facts.get(found[1])
        return found[0] if value is None else value if isinstance(value, str) else value()

    def both(found: re.Match[str]) -> str:
        return _BOTH_FUNCTIONS.replace("CONDITION", found[1])

    return _PLACE.sub(fact, _RIGHT_IF.sub(both, text))


def sources_of(attack: Attack, facts: Facts) -> dict[str, str]:
    """Its files by path within the submission, with all facts filled in."""
    files = {
        path.relative_to(attack.folder).as_posix(): path.read_text(encoding="utf-8")
        for path in sorted(attack.folder.glob("steps/*/*.cpp"))
    }
    return {path: fill_in(text, facts) for path, text in (files | attack.files).items()}


def lay_out(attack: Attack, facts: Facts, solved: Mapping[str, str], into: Path) -> Path:
    """Makes the submission, a folder or an archive, in a new folder."""
    files = sources_of(attack, facts)
    for step in attack.honest:
        files[f"steps/{step}/{step[3:].replace('-', '_')}.cpp"] = solved[step]
    folder = into / (attack.submission or "submission")
    for path, text in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text, encoding="utf-8")
    if not attack.made_by:
        return folder
    make = (FOLDERS | ARCHIVES)[attack.made_by]
    return make(folder, {name: value for name, value in facts.items() if isinstance(value, str)})
