"""What there is in a Markdown text."""

import pytest

from raysteps.common.markdown import unlinked

pytestmark = pytest.mark.portable


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("see [words](gone.md) and [more](here.md)", "see words and [more](here.md)"),
        ("![a picture](gone.md) and ![another](here.md)", "a picture and ![another](here.md)"),
        ("[![a picture](here.md)](gone.md)", "![a picture](here.md)"),
        ("[![a picture](gone.md)](here.md)", "[a picture](here.md)"),
        ("[![a picture](gone.md)](gone.md)", "a picture"),
        ("[words](gone.md) are great!", "words are great!"),
        ("[`code`](gone.md): `[words](gone.md)`", "`code`: `[words](gone.md)`"),
        ("```\n[words](gone.md)\n```\n", "```\n[words](gone.md)\n```\n"),
    ],
)
def test_links_to_what_is_not_there_become_words(text: str, expected: str) -> None:
    assert unlinked(text, lambda target: target == "here.md") == expected
