"""What is left of a source, and which of its parts become fingerprints."""

import random

import numpy as np
import pytest

from raysteps.exports.similar_pairs import (
    GRAM,
    GUARANTEED_MATCH,
    MAX_TOKENS,
    WINDOW,
    ComparedSubmission,
    Token,
    TokenSequence,
    is_read_whole,
    kgram_hashes,
    passages,
    tokenize,
    winnowed,
)

pytestmark = pytest.mark.portable

_PUBLIC = {"normalize", "direction", "HitRecord", "dot", "normal", "distance"}
_SOURCE = """
#include <vector>
float brightness(const HitRecord& hit, const glm::vec3& to_light) {
    const float cosine = glm::dot(hit.normal, to_light);  // of the angle
    for (int i = 0; i < 3; ++i) {
        if (cosine < 0.5F) { return 2.0F * cosine; }
    }
    return this->shine + std::max(cosine, 0.0F);
}
"""


def _texts(source: str) -> list[str]:
    return [word.text for word in tokenize(source, _PUBLIC)]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("cosine", "helligkeit"),
        ("to_light", "l"),
        ("  // of the angle", "/* none */"),
        ("const float", "auto"),
        ("0.5F", "5e-1f"),
        ("glm::", ""),
        ("std::", ""),
        ("this->", ""),
        ("{ return 2.0F * cosine; }", "return 2.0F * cosine;"),
        (" ", "\n\t "),
        ("#include <vector>", "#include <map>\n#pragma once"),
        ("hit.normal", "hit->normal"),
        ("2.0F * cosine", "(2.0F * cosine)"),
        ("brightness(", "bright\\\nness("),
    ],
)
def test_what_costs_nothing_to_change_counts_for_nothing(old: str, new: str) -> None:
    assert old in _SOURCE
    changed = _SOURCE.replace(old, new) if old != " " else _SOURCE.replace("    ", new)
    assert changed != _SOURCE
    assert _texts(changed) == _texts(_SOURCE)


@pytest.mark.parametrize(
    ("old", "new"), [("hit.normal", "hit.distance"), ("dot(", "normalize("), ("<", ">"), (" + ", " - ")]
)
def test_what_changes_the_meaning_counts(old: str, new: str) -> None:
    assert _texts(_SOURCE.replace(old, new)) != _texts(_SOURCE)


def test_a_word_knows_where_it_stands() -> None:
    for word in tokenize(_SOURCE, _PUBLIC):
        if word.text in _PUBLIC:
            assert _SOURCE[word.start : word.end] == word.text


def _words(numbers: list[int]) -> list[Token]:
    return [Token(str(number), 0, 0) for number in numbers]


@pytest.mark.parametrize("seed", range(20))
def test_what_is_alike_for_long_enough_has_a_fingerprint_in_common(seed: int) -> None:
    draw = random.Random(seed)
    amount = draw.choice([2, 5, 1000])  # of different words; with few there are many equal hashes
    shared = draw.choices(range(amount), k=GUARANTEED_MATCH)
    found = []
    for _ in range(2):
        before, after = (draw.choices(range(amount), k=draw.randrange(60)) for _ in range(2))
        hashes = kgram_hashes(_words([*before, *shared, *after]))
        chosen = {
            int(hashes[at]) for at in winnowed(hashes) if len(before) <= at <= len(before) + GUARANTEED_MATCH - GRAM
        }
        found.append(chosen)
    assert found[0] & found[1], f"seed {seed}"


def test_fingerprints_are_few_and_never_far_apart() -> None:
    hashes = kgram_hashes(_words(random.Random(1).choices(range(1000), k=5000)))
    places = winnowed(hashes)
    assert np.diff(places).max() <= WINDOW
    assert 0.3 < len(places) / len(hashes) < 0.5  # 2 of WINDOW + 1


def test_the_same_word_all_over_makes_few_fingerprints_and_the_rest_of_a_huge_file_is_not_read() -> None:
    words = tokenize("a " * 500_000, _PUBLIC)
    assert len(words) == MAX_TOKENS
    assert not is_read_whole("a " * MAX_TOKENS, _PUBLIC)
    assert not is_read_whole(";" * 3 * MAX_TOKENS, _PUBLIC)
    assert is_read_whole("a " * (MAX_TOKENS - 1), _PUBLIC)
    hashes = kgram_hashes(words)
    assert len(set(hashes.tolist())) == 1
    assert len(winnowed(hashes)) <= len(hashes) / WINDOW + 1


def test_too_short_a_text_has_none() -> None:
    assert winnowed(kgram_hashes(_words(list(range(GRAM - 1))))) == []
    assert winnowed(kgram_hashes(_words(list(range(GRAM))))) == [0]


def test_no_passage_leaves_a_file_where_both_are_called_alike() -> None:
    """A submission may have any name, that of the kit's own solution among them."""
    source = "float f(float a) { return a * a + 2 - a / 3; }\n" * 3
    one, other = (TokenSequence(ComparedSubmission("ann", {"01": source, "02": source}), ()) for _ in range(2))
    assert [each.length for each in passages(one, other, ())] == [len(one.files["01"])] * 2
