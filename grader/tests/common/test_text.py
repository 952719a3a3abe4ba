"""Text of strangers, before it is shown."""

import unicodedata

import pytest
from rich.console import Console

from raysteps.common.text import clean, name_order, one_line, print_plain, printable, visible_text

_UNSEEN = [
    "\u00ad",
    "\u200b",
    "\u200d",
    "\u202e",
    "\u2028",
    "\u2066",
    "\u2069",
    "\u3164",
    "\ufeff",
    "\U000e0041",
    "\ud800",
]


@pytest.mark.parametrize("sign", _UNSEEN, ids=lambda sign: f"{ord(sign):04X}")
def test_signs_that_nobody_sees_are_named_or_left_out(sign: str) -> None:
    """Nobody's name turns the line that it stands in, or looks like another one's."""
    named = f"ann⟨U+{ord(sign):04X}⟩x"
    assert printable(f"ann{sign}x") == one_line(f"ann{sign}x") == named
    assert visible_text(f"ann{sign}x") == "annx"
    assert sign not in clean(f"ann{sign}x")
    named.encode()  # any file and any terminal takes it


def test_whatever_has_no_form_of_its_own_is_known() -> None:
    """Of the signs that this Unicode calls formats, all but those that are drawn."""
    drawn = ("ARABIC", "SYRIAC", "KAITHI", "EGYPTIAN")
    formats = [chr(code) for code in range(0x110000) if unicodedata.category(chr(code)) == "Cf"]
    left = [sign for sign in formats if sign in printable(sign) and not unicodedata.name(sign, "").startswith(drawn)]
    assert not left


def test_words_stay_as_they_are() -> None:
    text = "żółw 光線 مرحبا é e\u0301\n\tx = 1;"
    assert printable(text) == visible_text(text) == clean(text) == text
    assert one_line("a\nb\tc") == "a b c"


def test_names_stand_where_people_look_for_them() -> None:
    names = [
        "",
        "\ud800",
        "7",
        "007 b",
        "10",
        "Ann Lee",
        "ann_lee-2",
        "Anna",
        "bob",
        "Éva",
        "Evan",
        "Fay_Wu",
        "Łukasz",
        "Mia",
    ]
    names += ["s", "s 1", "s2", "s02b", "s10", f"s{'9' * 5000}"]
    names_in_disorder = [*names[7:], *names[:7]]
    assert sorted(names_in_disorder, key=name_order) == names
    assert sorted(["ann", "Ann"], key=name_order) == sorted(["Ann", "ann"], key=name_order)


def test_a_line_is_printed_as_it_is(capsys: pytest.CaptureFixture[str]) -> None:
    print_plain(Console(width=20), "course.toml:100: [bold] :x: of a folder")
    assert capsys.readouterr().out == "course.toml:100: [bold] :x: of a folder\n"
