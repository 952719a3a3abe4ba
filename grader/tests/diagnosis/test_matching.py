"""Matching on made-up answers: the same, different, ties and noise."""

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from judge_fakes import FakeWorker

from raysteps.course.manifest import ImageCase
from raysteps.course.mutants import Mutant
from raysteps.diagnosis.evidence import (
    Evidence,
    Picture,
    Questions,
    WrongAnswer,
    WrongAnswers,
    answer_similarity,
    collect_wrong_answers,
)
from raysteps.diagnosis.matching import Match, agreement, match, name_mistakes, pair_score
from raysteps.diagnosis.mutant_fingerprints import MutantFingerprint, read_fingerprints, write_fingerprints
from raysteps.images.compare import Pixels
from raysteps.judge.answers import plainly_wrong
from raysteps.judge.cases.octree_boxes import NO_PART
from raysteps.judge.functions import Case, functions_of
from raysteps.judge.hits import NOTHING_FOUND
from raysteps.judge.random_source import RandomSource
from raysteps.judge.statistics import ratio_problem

pytestmark = pytest.mark.portable

_AMOUNT = 40


def _mutant(name: str, function: str = "mirror") -> Mutant:
    return Mutant(name, "03-phong-shading", function, f"it is {name}", "sees", "cause", "hint", "a", "b")


def _questions(function: str = "mirror") -> Questions:
    known = functions_of("03")[function]
    draw = RandomSource(f"made-up/{function}")
    cases = [Case(function, "any", known.groups[0].make(draw)) for _ in range(_AMOUNT)]
    return Questions(known, cases, ["1 2 3"] * _AMOUNT)


_PLAIN = plainly_wrong("the direction")


def _wrong(line: str, *numbers: int, problem: str = _PLAIN) -> dict[int, WrongAnswer]:
    said = WrongAnswer(line, problem, plainly_wrong=problem == _PLAIN)
    return dict.fromkeys(numbers, said)


def _score(mistake: Mapping[int, WrongAnswer], mine: Mapping[int, WrongAnswer]) -> float:
    return agreement(_questions(), mistake, mine).score


def test_answers_by_chance_are_alike_where_they_are_wrong_in_the_same_way() -> None:
    """Whoever turns a frame otherwise has other numbers for one mistake."""
    function = functions_of("12")["unit_disk"]
    case = Case("unit_disk", "a few points", {})
    said = WrongAnswer("1 2 3", "a point lies outside of the disk")
    other = WrongAnswer("7 8 9", "a point lies outside of the disk")
    assert 0.7 < answer_similarity(function, case, "0 0 0", said, other) < 1
    another = WrongAnswer("7 8 9", "too many points lie near the rim")
    assert answer_similarity(function, case, "0 0 0", said, another) == 0


def test_answers_by_chance_that_are_spread_in_another_way_are_not_alike() -> None:
    """Nobody who has all points in the middle took a random number without its root."""
    function = functions_of("12")["unit_disk"]
    case = Case("unit_disk", "many points", {})

    def similarity(*mine: int, goes_round: bool = False) -> float:
        said, other = (
            WrongAnswer(line, "too many points lie near the middle", spread=spread, goes_round=goes_round)
            for line, spread in (("1 2", (1024, 512, 256, 256)), ("3 4", mine))
        )
        return answer_similarity(function, case, "0 0", said, other)

    assert similarity(1000, 530, 260, 258) > 0.7
    assert similarity(256, 256, 512, 1024) > 0.7, "the same, mirrored"
    assert similarity(256, 1024, 512, 256) == 0, "at another place"
    assert similarity(256, 1024, 512, 256, goes_round=True) > 0.7, "the same, turned"
    assert similarity(1024, 0, 768, 256, goes_round=True) == 0
    assert similarity(2048, 0, 0, 0, goes_round=True) == 0
    assert similarity() == 0


def test_answers_by_chance_that_are_wrong_by_another_factor_are_not_alike() -> None:
    """The same words are said of light without its cosine and of light without its colour."""
    function = functions_of("14")["scatter_metal"]
    case = Case("scatter_metal", "any angle and roughness", {})

    def similarity(*mine: float, of: tuple[float, ...] = (0.5, 1.0, 2.0)) -> float:
        said = WrongAnswer("1 2", "the weight is wrong", times=of)
        return answer_similarity(function, case, "0 0", said, WrongAnswer("3 4", "the weight is wrong", times=mine))

    assert similarity(0.52, 0.98, 2.1) > 0.7
    assert similarity(0.52, 0.8, 2.1) == 0
    assert similarity(0.5, 1.0, 3.0) == 0
    assert similarity() == 0
    assert similarity(0.08, 0.03, of=(0.03, 0.1)) > 0.7, "of other points"
    assert similarity(0.001, 0.004, of=(0.03, 0.1)) == 0, "both are far too small, and not by one factor"


def test_how_many_times_too_large_numbers_are_does_not_hang_on_their_order() -> None:
    one = np.random.default_rng(1).uniform(0.5, 2, 256)
    found, other = ratio_problem("it is wrong", one), ratio_problem("it is wrong", one[::-1])
    assert found == "it is wrong"
    assert found.times == other.times
    assert found.times != ratio_problem("it is wrong", 2 * one).times
    assert all(map(math.isfinite, ratio_problem("it is wrong", np.array([np.nan, np.inf, 1.0])).times))


def test_the_same_numbers_are_the_same_answer() -> None:
    questions = _questions()
    function, case = questions.function, questions.cases[0]
    said, *others = (
        WrongAnswer(line, "it is wrong", plainly_wrong=True)
        for line in ("4 5 6", "4.0001 5 6", "4 5 -6", "-4 -5 -6", "7 8 9")
    )
    near, one_sign, all_signs, far = (answer_similarity(function, case, "1 2 3", said, other) for other in others)
    assert answer_similarity(function, case, "1 2 3", said, said) == 1
    assert near == 1
    assert 0.6 < one_sign < 0.7, "beside numbers with the same sign it counts nothing"
    assert all_signs == 0.25, "only signs agree"
    assert far == 0.25
    assert answer_similarity(function, case, "1 2 3", said, WrongAnswer("7 8 9", "it is too long")) == 0
    telling = [WrongAnswer(line, "it is too long") for line in ("4 5 6", "7 8 9")]
    assert 0.25 < answer_similarity(function, case, "1 2 3", *telling) < 0.5
    assert answer_similarity(function, case, "1 2 3", said, WrongAnswer("", "crashed")) == 0
    assert answer_similarity(function, case, "1 2 3", WrongAnswer("nan 1 1", "x"), WrongAnswer("nan 1 1", "x")) == 1


def test_a_turned_direction_is_worth_the_same_where_nothing_should_be_found() -> None:
    """The whole line is wrong then: a word and a flag in it have no sign, and what is the same beside a direction that
    is turned as a whole takes nothing from it."""
    function = functions_of("02")["Sphere::intersect"]
    case = Case(function.name, "any", {})
    rest = "0.5 0.25 0.125 0.5 0.5 10 0.5 1.5"

    def similarity(right: str, *mine: str) -> float:
        position, normal, distance = mine
        said, other = (
            WrongAnswer(f"hit {place} {rest} {up} 0 0 -1 {far} 1", "it is wrong", plainly_wrong=True)
            for place, up, far in (("3 4 5", "0.6 -0.64 0.48", "7"), (position, normal, distance))
        )
        return answer_similarity(function, case, right, said, other)

    right_hit = f"hit 1 2 3 {rest} 0.8 0.36 0.48 0 0 -1 5 1"
    for right in ("miss", right_hit):
        as_it_is = similarity(right, "3 4 5", "0.6 -0.64 0.48", "7")
        turned = similarity(right, "3 4 5", "-0.6 0.64 -0.48", "7")
        in_part = similarity(right, "3 4 5", "0.6 0.64 0.48", "7")
        lost = similarity(right, "3 4 5", "0.6 -0.1 0.48", "7")
        assert as_it_is == 1
        assert 0.85 < turned < 1, "the wrong end of a sphere, beside a distance that is the same"
        assert in_part == lost, right
    assert similarity("miss", "-3 -4 -5", "-0.6 0.64 -0.48", "-7") > 0.6


@pytest.mark.parametrize(
    "line", ["", "threw up", "4 5", "4 5 six", "1e999 -inf nan", "\x00", "#" + "0" * 32, "9" * 5000]
)
def test_whatever_is_said_is_compared(line: str) -> None:
    questions = _questions()
    for other in ("4 5 6", "threw it", "inf inf inf"):
        value = answer_similarity(
            questions.function, questions.cases[0], "1 2 3", WrongAnswer(other, "a"), WrongAnswer(line, "a")
        )
        assert 0 <= value <= 1


def test_a_score_is_the_share_of_wrong_cases_that_agree() -> None:
    assert _score(_wrong("4 5 6", *range(10)), _wrong("4 5 6", *range(10))) == 1
    assert _score(_wrong("4 5 6", *range(10)), _wrong("4 5 6", *range(20))) == 0.5
    assert _score(_wrong("4 5 6", *range(20)), _wrong("4 5 6", *range(10))) == 0.5
    assert _score(_wrong("4 5 6", *range(10)), _wrong("4 5 6", *range(10, 20))) == 0
    assert _score(_wrong("4 5 6", 1), _wrong("4 5 6", 1)) == 0, "one case is no evidence"


def test_cases_that_were_never_asked_count_for_nothing() -> None:
    unasked = {number: WrongAnswer("", "", known=False) for number in range(10, 40)}
    assert _score(_wrong("4 5 6", *range(40)), _wrong("4 5 6", *range(10)) | unasked) == 1


def _evidence(mine: WrongAnswers) -> Evidence:
    return Evidence({name: _questions(name) for name in mine}, mine, {})


def _matched(
    mine: Mapping[str, Mapping[int, WrongAnswer]],
    known: Mapping[Mutant, Mapping[str, Mapping[int, WrongAnswer]]],
) -> list[Match]:
    return [match(mutant, MutantFingerprint(answers, {}), _evidence(mine)) for mutant, answers in known.items()]


def test_one_mistake_upstream_explains_what_it_spoils_further_down() -> None:
    spoilt = _wrong("4 5 6", *range(30))
    mine = {"mirror": spoilt, "specular": spoilt}
    known = {_mutant("down", "specular"): {"specular": spoilt}, _mutant("up"): mine}
    (named,) = name_mistakes(_matched(mine, known))
    assert named.mutant.id == "up"
    assert named.explains == ("mirror", "specular")
    assert not named.alike


def test_a_mistake_further_down_is_not_taken_for_one_upstream() -> None:
    spoilt = _wrong("4 5 6", *range(30))
    known = {_mutant("up"): {"mirror": spoilt, "specular": spoilt}, _mutant("down", "specular"): {"specular": spoilt}}
    (named,) = name_mistakes(_matched({"mirror": {}, "specular": spoilt}, known))
    assert named.mutant.id == "down"


def test_what_calls_a_function_that_is_wrong_in_another_way_names_no_mistake_of_it() -> None:
    """Of whatever spoils the caller the same words are said."""
    spoilt = _wrong("4 5 6", *range(30))
    known = {_mutant("up"): {"mirror": _wrong("6 6 6", *range(30)), "specular": spoilt}}
    for own, names in (("7 8 9", []), ("6 6 6", ["up"])):
        mine = {"mirror": _wrong(own, *range(30)), "specular": spoilt}
        assert [one.mutant.id for one in name_mistakes(_matched(mine, known))] == names


def test_who_always_gives_the_same_answer_has_not_made_a_mistake_that_does_not() -> None:
    spoilt = _wrong("4 5 6", *range(30))
    known = {_mutant("up"): {"mirror": _wrong("0 0 0", *range(30)), "specular": spoilt}}
    mine = {"mirror": _wrong("0 0 0", *range(_AMOUNT)), "specular": spoilt}
    assert not name_mistakes(_matched(mine, known))


def test_what_another_function_spoils_is_no_mistake_of_its_own() -> None:
    spoilt = _wrong("4 5 6", *range(30))
    known = MutantFingerprint({"specular": spoilt}, {})
    evidence = _evidence({"mirror": _wrong("7 8 9", *range(20)), "specular": spoilt})
    for right_apart, names in (((), ["down"]), (("specular",), [])):
        found = match(_mutant("down", "specular"), known, replace(evidence, right_apart=right_apart))
        assert [one.mutant.id for one in name_mistakes([found])] == names


def test_what_a_wrong_function_spoils_is_no_mistake_of_a_right_one() -> None:
    spoilt, own = _wrong("4 5 6", *range(30)), _wrong("6 6 6", *range(20))
    known = MutantFingerprint({"specular": spoilt, "diffuse": own}, {})
    evidence = _evidence({"mirror": _wrong("7 8 9", *range(20)), "specular": spoilt})
    evidence = replace(evidence, right_apart=("specular",))
    for right, names in (((), ["elsewhere"]), (("diffuse",), [])):
        found = match(_mutant("elsewhere", "diffuse"), known, replace(evidence, right=right))
        assert [one.mutant.id for one in name_mistakes([found])] == names


def test_two_mistakes_in_two_functions_are_two() -> None:
    one, other = _wrong("4 5 6", *range(30)), _wrong("7 8 9", *range(20))
    known = {_mutant("first"): {"mirror": one}, _mutant("second", "diffuse"): {"diffuse": other}}
    named = name_mistakes(_matched({"mirror": one, "diffuse": other}, known))
    assert {found.mutant.id for found in named} == {"first", "second"}


def test_mistakes_that_cannot_be_told_apart_are_both_said() -> None:
    spoilt = _wrong("4 5 6", *range(30))
    known = {_mutant("one"): {"mirror": spoilt}, _mutant("other"): {"mirror": spoilt}}
    (named,) = name_mistakes(_matched({"mirror": spoilt}, known))
    assert named.diagnosis().alike == ["it is other"]


def test_noise_has_no_name() -> None:
    mine = {number: WrongAnswer(f"{number} {number + 1} 7", "it is wrong", plainly_wrong=True) for number in range(30)}
    known = {_mutant("one"): {"mirror": _wrong("4 5 6", *range(30))}}
    assert not name_mistakes(_matched({"mirror": mine}, known))


def test_two_mistakes_in_one_function() -> None:
    one, other = _wrong("4 5 6", *range(10)), _wrong("7 8 9", *range(10, 25), problem="it is too long")
    questions, mine = _questions(), one | other
    pair = agreement(questions, one, mine), agreement(questions, other, mine)
    assert max(found.score for found in pair) < 0.7
    assert pair_score(*pair) == 1
    assert pair_score(pair[0], pair[0]) == 0
    known = {_mutant("first"): {"mirror": one}, _mutant("second"): {"mirror": other}}
    named = name_mistakes(_matched({"mirror": mine}, known))
    assert [found.mutant.id for found in named] == ["first", "second"]


def test_two_mistakes_are_not_each_hidden_by_the_other() -> None:
    """What each of them explains, the other would have made wrong in its own way. One of them may be hidden so."""
    one, other = _wrong("4 5 6", *range(25)), _wrong("7 8 9", *range(25), problem="it is too long")
    seen_of_other = _wrong("7 8 9", *range(10, 25), problem="it is too long")
    questions = _questions()
    for first, mine, score in (
        (one, _wrong("4 5 6", *range(10)) | seen_of_other, 0),
        (_wrong("4 5 6", *range(10)), _wrong("4 5 6", *range(10)) | seen_of_other, 1),
    ):
        assert pair_score(agreement(questions, first, mine), agreement(questions, other, mine)) == score


def test_a_mistake_that_explains_more_at_a_second_look_is_said_once() -> None:
    """The picture that it spoils speaks against it only until it is named."""
    reference = np.random.default_rng(1).integers(0, 255, (30, 40, 3), dtype=np.uint8)
    mine, drawn = reference.copy(), reference.copy()
    mine[:15] //= 2
    drawn[15:] //= 2
    half = _wrong("4 5 6", *range(30))
    known = MutantFingerprint({"mirror": _wrong("4 5 6", *range(38)), "specular": half}, {"lit": drawn})
    evidence = replace(_evidence({"mirror": half, "specular": half}), pictures={"lit": _picture(mine, reference)})
    (named,) = name_mistakes([match(_mutant("up"), known, evidence)])
    assert set(named.explains) == {"mirror", "specular"}


def test_a_mistake_that_is_named_again_takes_no_place_of_another() -> None:
    """Three are said; its picture keeps the first from explaining everything at once. What cannot be told from it at
    the second look only is not said."""
    reference = np.random.default_rng(1).integers(0, 255, (30, 40, 3), dtype=np.uint8)
    mine, drawn = reference.copy(), reference.copy()
    mine[:15] //= 2
    drawn[15:] //= 2
    half, one, other = (_wrong(line, *range(30)) for line in ("4 5 6", "7 8 9", "9 9 9"))
    evidence = _evidence({"mirror": half, "specular": half, "diffuse": one, "shade": other})
    evidence = replace(evidence, pictures={"lit": _picture(mine, reference)})
    known = [
        (_mutant("up"), {"mirror": _wrong("4 5 6", *range(38)), "specular": half}, {"lit": drawn}),
        (_mutant("first", "diffuse"), {"diffuse": _wrong("7 8 9", *range(40))}, {"lit": drawn}),
        (_mutant("last", "shade"), {"shade": _wrong("9 9 9", *range(40))}, {"lit": drawn}),
        (_mutant("so too"), {"mirror": _wrong("4 5 6", *range(38))}, {"lit": drawn}),
    ]
    named = name_mistakes([match(mutant, MutantFingerprint(said, drew), evidence) for mutant, said, drew in known])
    assert {one.mutant.id: set(one.explains) for one in named} == {
        "up": {"mirror", "specular"},
        "first": {"diffuse"},
        "last": {"shade"},
    }
    assert all(not one.alike for one in named)


def test_the_same_answer_to_everything_is_not_two_mistakes() -> None:
    """A function that is not written yet, and not marked as a stub, answers like this."""
    known = {
        _mutant("first"): {"mirror": _wrong("0 0 0", *range(20))},
        _mutant("second"): {"mirror": _wrong("0 0 0", *range(20, _AMOUNT))},
    }
    everything = _wrong("0 0 0", *range(_AMOUNT))
    assert not name_mistakes(_matched({"mirror": everything}, known))
    nearly = {number: said for number, said in everything.items() if number}
    assert [found.mutant.id for found in name_mistakes(_matched({"mirror": nearly}, known))] == ["first", "second"]
    always = {_mutant("always"): {"mirror": everything}}
    (named,) = name_mistakes(_matched({"mirror": everything}, known | always))
    assert named.mutant.id == "always"


def _picture(mine: Pixels, reference: Pixels) -> Picture:
    return Picture(ImageCase("lit", "scenes/x.nff", (), 0.003), mine, reference)


def test_pictures_alone_name_a_mistake_where_there_is_no_judge() -> None:
    reference = np.random.default_rng(1).integers(0, 255, (30, 40, 3), dtype=np.uint8)
    wrong, other = reference.copy(), reference.copy()
    wrong[:15] //= 2
    other[15:] //= 2
    evidence = Evidence({}, {}, {"lit": _picture(wrong, reference)})
    matches = [
        match(_mutant(name), MutantFingerprint({}, {"lit": pixels}), evidence)
        for name, pixels in (("b", other), ("a", wrong))
    ]
    (named,) = name_mistakes(matches)
    assert (named.mutant.id, named.explains) == ("a", ("lit",))


def test_what_finds_nothing_may_have_any_cause_but_one_that_is_right() -> None:
    lost = _wrong("miss", *range(30), problem=NOTHING_FOUND)
    other = _wrong("4 5 6", *range(30))
    for spoilt, names in ((lost, []), (other, ["up"])):
        known = MutantFingerprint({"mirror": spoilt, "specular": spoilt}, {})
        evidence = replace(_evidence({"specular": spoilt}), right={"mirror"})
        assert [one.mutant.id for one in name_mistakes([match(_mutant("up"), known, evidence)])] == names


@pytest.mark.parametrize("problem", [NOTHING_FOUND, NO_PART])
def test_what_finds_nothing_is_not_two_mistakes(problem: str) -> None:
    """Half of it is alike by chance, whatever loses what is there."""
    one, other = _wrong("none", *range(10), problem=problem), _wrong("none", *range(10, 25), problem=problem)
    known = {_mutant("first"): {"mirror": one}, _mutant("second"): {"mirror": other}}
    assert not name_mistakes(_matched({"mirror": one | other}, known))


def test_pictures_deny_what_a_yes_or_no_says_and_what_is_seen() -> None:
    reference = np.random.default_rng(1).integers(0, 255, (30, 40, 3), dtype=np.uint8)
    mine, drawn = reference.copy(), reference.copy()
    mine[:15] //= 2
    drawn[15:] //= 2
    for name, weak in (("is_lit", True), ("shadow_ray", False)):
        known = functions_of("04")[name]
        questions = Questions(known, [Case(name, "any", {})] * 30, ["1"] * 30)
        said = _wrong("0", *range(30))
        for picture, sees in ((drawn, ""), (mine, "sees")):
            evidence = Evidence({name: questions}, {name: said}, {"lit": _picture(mine, reference)})
            fingerprint = MutantFingerprint({name: said}, {"lit": picture})
            named = name_mistakes([match(_mutant("is_it", name), fingerprint, evidence)])
            assert bool(named) == (bool(sees) or not weak)
            assert all(bool(one.diagnosis().sees) == bool(sees) for one in named)


def test_a_right_picture_refutes_what_would_spoil_it_where_answers_are_yes_or_no() -> None:
    """Not where it hangs on a tree, and not where the numbers of an answer say more."""
    reference = np.random.default_rng(1).integers(0, 255, (30, 40, 3), dtype=np.uint8)
    spoilt = reference.copy()
    spoilt[:15] //= 2
    said = _wrong("0", *range(30))
    for name, drawn, args, is_named in (
        ("is_lit", spoilt, (), False),
        ("is_lit", reference, (), True),
        ("is_lit", spoilt, ("--accel", "octree"), True),
        ("is_lit", None, (), True),
        ("shadow_ray", spoilt, (), True),
    ):
        questions = Questions(functions_of("04")[name], [Case(name, "any", {})] * 30, ["1"] * 30)
        case = ImageCase("lit", "scenes/x.nff", args, 0.003)
        evidence = Evidence({name: questions}, {name: said}, {"lit": Picture(case, reference, reference)})
        fingerprint = MutantFingerprint({name: said}, {} if drawn is None else {"lit": drawn})
        named = name_mistakes([match(_mutant("one", name), fingerprint, evidence)])
        assert bool(named) == is_named


def test_a_picture_of_one_colour_has_no_name() -> None:
    reference = np.random.default_rng(1).integers(0, 255, (30, 40, 3), dtype=np.uint8)
    black = np.zeros_like(reference)
    evidence = Evidence({}, {}, {"lit": _picture(black, reference)})
    assert not name_mistakes([match(_mutant("dark"), MutantFingerprint({}, {"lit": black}), evidence)])


def test_fingerprints_come_back_from_their_file(tmp_path: Path) -> None:
    answers = {
        "mirror": {
            3: WrongAnswer("1 2 3", "it is wrong", spread=(3, 1), times=(0.5,), plainly_wrong=True),
            4: WrongAnswer("", "", known=False),
        }
    }
    known = {
        "one": MutantFingerprint(answers, {"lit": np.ones((2, 3, 3), dtype=np.uint8)}),
        "two": MutantFingerprint({}, {}),
    }
    write_fingerprints(tmp_path / "03.npz", known)
    found = read_fingerprints(tmp_path / "03.npz")
    assert found is not None
    assert found["one"].answers == answers
    assert (found["one"].pictures["lit"] == 1).all()
    assert found["two"] == MutantFingerprint({}, {})
    (tmp_path / "03.npz").write_bytes(b"half of a file")
    assert read_fingerprints(tmp_path / "03.npz") is None
    assert read_fingerprints(tmp_path / "04.npz") is None


@pytest.mark.parametrize("line", ["4 5 6", " ".join(["4"] * 5000)])
def test_who_answers_as_a_known_mistake_has_its_problem(line: str) -> None:
    """So it is judged once: long answers, too, of which only a hash is kept."""
    questions = {"mirror": _questions()}
    judged = collect_wrong_answers(questions, FakeWorker(lambda *_: line), 1.0)
    assert len(judged["mirror"]) == _AMOUNT
    told = {number: replace(one, problem="as the mistake") for number, one in judged["mirror"].items() if number < 9}
    heard = collect_wrong_answers(questions, FakeWorker(lambda *_: line), 1.0, [{"mirror": told}])["mirror"]
    assert heard == {**judged["mirror"], **told}
    others = collect_wrong_answers(questions, FakeWorker(lambda *_: "7 8 9"), 1.0, [{"mirror": told}])["mirror"]
    assert {one.problem for one in others.values()}.isdisjoint({"as the mistake"})
    assert all(one.plainly_wrong for one in others.values())
    assert not collect_wrong_answers(questions, FakeWorker(lambda *_: "1 2 3"), 1.0, [{"mirror": told}])["mirror"]
