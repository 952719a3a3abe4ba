"""Copies that were made with care are found in a class, and honest submissions are not taken for such."""

import itertools
import random
from collections.abc import Callable, Sequence

import pytest
from planted_copies import Plant, changed, heavy, honest_class, medium, plants, with_step_of

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.stubs import stub_for
from raysteps.exports.similar_pairs import REVIEW_THRESHOLD, ComparedSubmission, Comparison, all_hashes, compare, groups
from raysteps.exports.similarity import base_code, known_solutions
from raysteps.release.secrets import public_names

_ALL = 10_000


@pytest.fixture(scope="module")
def public(project: Project) -> frozenset[str]:
    return frozenset(public_names(project))


Compare = Callable[[Sequence[ComparedSubmission]], Comparison]


@pytest.fixture(scope="module")
def compared(project: Project, steps: list[Step], public: frozenset[str]) -> Compare:
    """As the command compares."""
    stubs = {step: stub_for(project, step) for step in steps}
    kit, given = known_solutions(project, steps, "background"), all_hashes(base_code(project, stubs), public)
    return lambda handed: compare([*handed, *kit], public, given, _ALL)


def _alike(compared: Comparison) -> set[tuple[int, int]]:
    return {(pair.first, pair.second) for pair in compared.pairs if pair.value >= REVIEW_THRESHOLD}


def test_copies_stand_above_honest_work(
    project: Project, steps: list[Step], public: frozenset[str], compared: Compare
) -> None:
    """Of three classes together: one in eight may be missed."""
    missed, amount = [], 0
    for seed in (11, 12, 13):
        draw = random.Random(seed)
        honest = honest_class(project, steps, ["corpus", "second_corpus"], draw)
        copies = plants(honest, public, draw)
        every = [*(Plant("", one, frozenset({at})) for at, one in enumerate(honest)), *copies]
        handed = [ComparedSubmission(f"{at} {one.kind}", one.sources) for at, one in enumerate(every)]
        pairs = itertools.combinations(range(len(every)), 2)
        true = {(a, b) for a, b in pairs if every[a].originals & every[b].originals}
        alike = _alike(compared(handed))
        assert alike - true == set(), f"seed {seed}: honest"
        missed += [(seed, handed[a].name, handed[b].name) for a, b in sorted(true - alike)]
        amount += len(true)
    assert len(missed) <= amount // 8, missed


@pytest.mark.parametrize("step", ["02-intersection", "06-octree", "09-bvh"])
def test_one_long_step_is_enough(
    project: Project, steps: list[Step], public: frozenset[str], compared: Compare, step: str
) -> None:
    draw = random.Random(21)
    honest = honest_class(project, steps, ["corpus"], draw)
    honest[0] = with_step_of(honest[0], honest[1], step, medium(public), draw)
    found = compared([ComparedSubmission(str(at), one) for at, one in enumerate(honest)])
    assert _alike(found) == {(0, 1)}
    assert found.pairs[0].most == step


def test_a_file_that_moved_to_another_step_is_found_however_both_are_padded(
    project: Project, steps: list[Step], public: frozenset[str], compared: Compare
) -> None:
    draw = random.Random(22)
    honest = honest_class(project, steps, ["corpus"], draw)
    moved = changed(honest[1]["06-octree"], medium(public), draw)
    honest[0] = {**honest[0], "09-bvh": moved + honest[0]["09-bvh"], "06-octree": ""}
    for one, step in ((honest[0], "09-bvh"), (honest[1], "06-octree")):
        one[step] += " ".join(draw.choices(["a", "1", "'b'", "if", "float", "+", "-", "<", "[", "?"], k=12_000))
    found = compared([ComparedSubmission(str(at), one) for at, one in enumerate(honest)])
    assert _alike(found) == {(0, 1)}


def test_who_carries_earlier_code_along_is_like_nobody(
    project: Project, steps: list[Step], public: frozenset[str], compared: Compare
) -> None:
    """Half of a class, into a step where little is to be written."""
    honest = honest_class(project, steps, ["corpus", "second_corpus"], random.Random(5))
    for one in honest[1::2]:
        one["07-tone-mapping"] = "".join(text for step, text in sorted(one.items()) if step <= "07-tone-mapping")
    assert _alike(compared([ComparedSubmission(str(at), one) for at, one in enumerate(honest)])) == set()


def test_half_of_a_class_may_copy_from_one_and_is_a_group(
    project: Project, steps: list[Step], public: frozenset[str], compared: Compare
) -> None:
    draw = random.Random(23)
    honest = honest_class(project, steps, ["corpus"], draw)
    copies = [{step: changed(text, heavy(public), draw) for step, text in honest[0].items()} for _ in honest]
    every = [*honest, *copies]
    found = compared([ComparedSubmission(str(at), one) for at, one in enumerate(every)])
    assert groups(found.pairs) == [[0, *range(len(honest), len(every))]]


def test_two_of_an_earlier_term_are_not_a_pair(
    project: Project, steps: list[Step], public: frozenset[str], compared: Compare
) -> None:
    draw = random.Random(24)
    honest = honest_class(project, steps, ["corpus"], draw)
    old = [ComparedSubmission("old", honest[0], "before"), ComparedSubmission("old twin", honest[0], "before")]
    ours = [ComparedSubmission("ann", {step: changed(text, medium(public), draw) for step, text in honest[0].items()})]
    ours += [ComparedSubmission("bob", honest[1])]
    found = compared([*old, *ours])
    assert _alike(found) == {(0, 2), (1, 2)}
    assert {(pair.first, pair.second) for pair in found.pairs} == {(0, 2), (0, 3), (1, 2), (1, 3), (2, 3)}
