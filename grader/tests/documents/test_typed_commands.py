"""The commands of the documents do what the documents say: nearly all are typed, and what they print is compared."""

import time
from pathlib import Path

import doc_only_read
import pytest
from doc_commands import Shown, blocks_of, missing, outputs_of
from doc_only_read import may_be_typed, why_not
from doc_terminal import Ending, Keys, typed_at
from doc_typing import Typist
from doc_workshop import make_workshop
from typed_commands import Typed, typed

from raysteps.course.project import Project
from raysteps.toolchain.kit_artifacts import BuiltKit

# In this order, in one workshop: each family's documents are read from the first to the last.
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


def test_shown_output_is_compared() -> None:
    assert missing(("one", "...", "three is ...", "four"), "one\ntwo\nthree is 3\nfour\n") == ""
    assert missing(("one", "three", "two"), "one\ntwo\nthree\n") == "two"
    assert missing(("on",), "one\n") == "on"


def test_what_is_only_read_is_in_the_documents(project: Project) -> None:
    there = [one for block in blocks_of(project) for one in block]
    assert set(doc_only_read.COMMANDS) <= {" ".join(one.words) for one in there}
    assert set(doc_only_read.SOMEBODY_ELSES) <= {one.words[0] for one in there}
    to_type = [one for one in there if not why_not(one)]
    assert [str(one) for one in to_type if not may_be_typed(one)] == [], "say in doc_only_read.py why it is not typed"
    assert len(to_type) > 120
    assert {_family(one) for one in to_type} == {*_FAMILIES, _OTHERS}
    assert len([shown for shown in outputs_of(project) if shown.command in to_type]) > 18


@pytest.mark.parametrize("text", ["sudo apt-get install zip", "git push", "code .", "ssh me@host", "python -m pip"])
def test_what_may_do_anything_is_not_typed(text: str) -> None:
    [[one]] = typed(Path("README.md"), f"```sh\n{text}\n```\n")
    assert not may_be_typed(one)


def test_a_program_that_does_not_end_is_stopped(tmp_path: Path) -> None:
    """Even when another session holds on to what it prints to."""
    command = ["sh", "-c", "setsid sleep 20 & echo begun; sleep 20"]
    start = time.monotonic()
    with pytest.raises(AssertionError, match=r"stopped after 0\.5 s\nbegun"):
        typed_at(command, tmp_path, Ending(), seconds=0.5)
    with pytest.raises(AssertionError, match=r"waited for 0\.5 s, and no 'done' in:\s*begun"):
        typed_at(command, tmp_path, Ending(Keys("done", "q", "bye")), seconds=0.5)
    with pytest.raises(AssertionError, match="exit code 3, and no 'done'"):
        typed_at(["sh", "-c", "exit 3"], tmp_path, Ending(Keys("done", "q", "bye")))
    assert time.monotonic() - start < 15


@pytest.fixture(scope="module")
def typist(kit: BuiltKit, tmp_path_factory: pytest.TempPathFactory) -> Typist:
    return Typist(make_workshop(kit, tmp_path_factory.mktemp("workshop")), kit)


@pytest.mark.slow
@pytest.mark.xdist_group("documents")  # one after the other: they share the workshop
@pytest.mark.parametrize("family", [*_FAMILIES, _OTHERS])
def test_the_commands_do_what_the_documents_say(project: Project, typist: Typist, family: str) -> None:
    count = 0
    shown = {output.command: output for output in outputs_of(project)}
    for block in blocks_of(project):
        if _family(block[0]) == family:
            answers = typist.block(block)
            count += len(answers)
            for one, printed in answers.items():
                wrong = missing(shown.get(one, Shown(one, ())).lines, printed)
                assert wrong == "", f"{one}: this line was not printed, or not in its place\n{printed}"
    assert count > 5
