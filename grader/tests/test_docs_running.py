"""The commands of the documents do what the documents say: nearly all are typed, and what they print is compared."""

from pathlib import Path

import doc_only_read
import pytest
from doc_commands import Shown, blocks_of, outputs_of
from doc_only_read import why_not
from doc_typing import Typist
from doc_workshop import make_workshop

from raysteps.kit.built_kit import BuiltKit
from raysteps.kit.project import Project
from raysteps.upkeep.site.shell import Typed

# Each family has a workshop, in which its documents are read from the first to the last.
_FAMILIES = {
    "instructors": ("README", "docs/instructors", "docs/class", "docs/exports"),
    "handouts": ("steps/",),
    "students": tuple(
        f"docs/{name}" for name in ("students", "where-students-work", "watch", "inspect", "view", "maps", "pages")
    ),
}
_OTHERS = "others"


def _family(one: Typed) -> str:
    path = one.document.as_posix()
    return next((family for family, starts in _FAMILIES.items() if path.startswith(starts)), _OTHERS)


def _missing(shown: tuple[str, ...], printed: str) -> str:
    """The first line that the program did not print, or not in its place. A line of dots stands for some lines, dots at
    an end for a rest."""
    lines = iter(line.rstrip() for line in printed.splitlines())
    for line in (one.rstrip() for one in shown):
        head = line.removesuffix("...")
        if head.strip() and not any(there == line or (head != line and there.startswith(head)) for there in lines):
            return line
    return ""


def test_shown_output_is_compared() -> None:
    assert _missing(("one", "...", "three is ...", "four"), "one\ntwo\nthree is 3\nfour\n") == ""
    assert _missing(("one", "three", "two"), "one\ntwo\nthree\n") == "two"
    assert _missing(("on",), "one\n") == "on"


def test_what_is_only_read_is_in_the_documents(project: Project) -> None:
    there = [one for block in blocks_of(project) for one in block]
    assert set(doc_only_read.COMMANDS) <= {" ".join(one.words) for one in there}
    assert set(doc_only_read.SOMEBODY_ELSES) <= {one.words[0] for one in there}
    typed = [one for one in there if not why_not(one)]
    assert len(typed) > 120
    assert {_family(one) for one in typed} == {*_FAMILIES, _OTHERS}
    assert len([shown for shown in outputs_of(project) if shown.command in typed]) > 18


@pytest.mark.slow
@pytest.mark.parametrize("family", [*_FAMILIES, _OTHERS])
def test_the_commands_do_what_the_documents_say(project: Project, kit: BuiltKit, tmp_path: Path, family: str) -> None:
    typist = Typist(make_workshop(kit, tmp_path), kit)
    shown = {output.command: output for output in outputs_of(project)}
    for block in blocks_of(project):
        if _family(block[0]) == family:
            for one, printed in typist.block(block).items():
                wrong = _missing(shown.get(one, Shown(one, ())).lines, printed)
                assert wrong == "", f"{one}: this line was not printed, or not in its place\n{printed}"
    assert len(typist.printed) > 5
