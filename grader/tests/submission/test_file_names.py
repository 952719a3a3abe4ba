"""Names of files: wrong case, copies, wrong folders, separators of other systems, and names made to hurt."""

import io
import os
import tarfile
import zipfile
from pathlib import Path

import pytest

from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.submission.load import load_submission

GOOD = "steps/04-shadows/shadows.cpp"


def _folder(root: Path, *names: str) -> Path:
    for name in names:
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(f"// {name}\n")
    return root


@pytest.mark.parametrize("name", ["Steps/04-Shadows/Shadows.CPP", "SHADOWS.cpp", "Anna/STEPS/04-shadows/shadows.cpp"])
def test_other_case_is_taken_and_remarked(tmp_path: Path, steps: list[Step], name: str) -> None:
    submission = load_submission(_folder(tmp_path, name), steps)
    assert set(submission.sources) == {"04-shadows"}
    assert submission.remarks == {"04-shadows": f"{name} was taken for {GOOD}."}
    assert not submission.notes


def test_the_exact_name_wins_over_another_case(tmp_path: Path, steps: list[Step]) -> None:
    submission = load_submission(_folder(tmp_path, "steps/04-shadows/Shadows.cpp", GOOD), steps)
    assert submission.sources["04-shadows"] == f"// {GOOD}\n".encode()
    assert submission.remarks == {"04-shadows": f"steps/04-shadows/Shadows.cpp was left out beside {GOOD}."}
    assert not submission.notes


def test_two_of_another_case_are_one_too_many(tmp_path: Path, steps: list[Step]) -> None:
    submission = load_submission(_folder(tmp_path, "Shadows.cpp", "SHADOWS.cpp"), steps)
    assert not submission.sources
    assert "more than once" in submission.notes["04-shadows"]


def test_letters_of_other_alphabets_are_not_taken_for_ours(tmp_path: Path, steps: list[Step]) -> None:
    with pytest.raises(UsageError, match="holds no step"):  # a long s and a Kelvin sign
        load_submission(_folder(tmp_path, "\u017fhadows.cpp", "\u212aamera_rays.cpp"), steps)


@pytest.mark.parametrize(
    "name",
    [
        "shadows (1).cpp",
        "shadows.cc",
        "shadows.cpp.txt",
        "shadows - Copy.cpp",
        "Copy of shadows.cpp",
        "shadows_final_v2.cpp",
        "shadow.cpp",
        "steps/04-shadows/04_shadows.cxx",
        "steps/shadow/src/shadows.cpp",
        "steps/05-reflection/shadows.cpp",
    ],
)
def test_close_names_are_explained(tmp_path: Path, steps: list[Step], name: str) -> None:
    submission = load_submission(_folder(tmp_path, name, "octree.cpp"), steps)
    assert set(submission.sources) == {"06-octree"}
    assert submission.notes == {"04-shadows": f"{name} was not taken: it must be {GOOD}."}


@pytest.mark.parametrize("name", ["main.cpp", "my_light.cc", "notes (1).cxx"])
def test_a_source_of_any_name_in_the_folder_of_a_step_is_explained(
    tmp_path: Path, steps: list[Step], name: str
) -> None:
    place = f"steps/04-shadows/{name}"
    submission = load_submission(_folder(tmp_path, place, "steps/04-shadows/shadows_test.cpp"), steps)
    assert submission.notes == {"04-shadows": f"{place} was not taken: it must be {GOOD}."}
    assert load_submission(_folder(tmp_path, GOOD), steps).notes == {}
    (tmp_path / GOOD).rename(tmp_path / "shadow.cpp")
    named = load_submission(tmp_path, steps).notes
    assert named == {"04-shadows": f"shadow.cpp was not taken: it must be {GOOD}."}, "a name that is closer goes before"


@pytest.mark.parametrize("name", ["shadows (1).cpp", "steps/04-shadows/shadows_test.cpp", "shadows.cpp~"])
def test_close_names_do_not_matter_beside_the_right_one(tmp_path: Path, steps: list[Step], name: str) -> None:
    submission = load_submission(_folder(tmp_path, name, GOOD), steps)
    assert submission.sources == {"04-shadows": f"// {GOOD}\n".encode()}
    assert not submission.notes
    assert not submission.remarks


def test_the_files_of_the_kit_beside_a_step_are_no_close_names(tmp_path: Path, steps: list[Step]) -> None:
    names = ["shadows.hpp", "shadows_test.cpp", "README.md", "step.toml", "shadows.o", "shadows.png"]
    with pytest.raises(UsageError, match="holds no step"):
        load_submission(_folder(tmp_path, *(f"steps/04-shadows/{name}" for name in names)), steps)


def test_backslashes_part_folders(tmp_path: Path, steps: list[Step]) -> None:
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr("steps\\04-shadows\\shadows.cpp", "int x;")
        archive.writestr("..\\octree.cpp", "int x;")
    assert set(load_submission(tmp_path / "a.zip", steps).sources) == {"04-shadows"}
    unpacked = tmp_path / "unpacked"
    unpacked.mkdir()
    (unpacked / "steps\\04-shadows\\shadows.cpp").write_text("int x;")
    assert set(load_submission(unpacked, steps).sources) == {"04-shadows"}


def test_a_name_that_goes_on_after_a_nul_is_another_name(tmp_path: Path, steps: list[Step]) -> None:
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("shadows.cppX.txt", "int x;")
    path.write_bytes(path.read_bytes().replace(b"shadows.cppX", b"shadows.cpp\0"))
    with pytest.raises(UsageError, match="holds no step"):
        load_submission(path, steps)


def test_odd_names_do_no_harm(tmp_path: Path, steps: list[Step]) -> None:
    odd = ["<b>x</b>", "=cmd()", "\x1b[31mred", "a\nb", "-fplugin=x.so", "@file", "'; drop", "%s%n", "\u202egpj"]
    folder = _folder(tmp_path / "a", GOOD, *odd)
    (Path(os.fsdecode(os.fsencode(folder) + b"/\xff\xfe"))).write_text("x")
    submission = load_submission(folder, steps)
    assert set(submission.sources) == {"04-shadows"}
    assert not submission.notes
    assert not submission.remarks


def test_a_message_never_holds_control_characters(tmp_path: Path, steps: list[Step]) -> None:
    with tarfile.open(tmp_path / "a.tar", "w") as archive:
        info = tarfile.TarInfo("\x9b31m\x7fx/" + "y" * 300 + "/shadows (1).cpp")
        archive.addfile(info, io.BytesIO(b""))
    note = load_submission(tmp_path / "a.tar", steps).notes["04-shadows"]
    assert note.isprintable()
    assert len(note) < 250


def test_names_of_ten_megabytes_are_refused(tmp_path: Path, steps: list[Step]) -> None:
    for form in (tarfile.PAX_FORMAT, tarfile.GNU_FORMAT):
        path = tmp_path / f"{form}.tar.gz"
        with tarfile.open(path, "w:gz", format=form) as archive:
            archive.addfile(tarfile.TarInfo("a" * 10_000_000), io.BytesIO(b""))
            archive.addfile(tarfile.TarInfo("shadows.cpp"), io.BytesIO(b""))
        with pytest.raises(UsageError, match="impossible size"):
            load_submission(path, steps)


@pytest.mark.parametrize(
    ("names", "unusual"),
    [
        (["step4/shadows.cpp"], ["step4/shadows.cpp"]),
        (["step1/camera_rays.cpp", "step4/shadows.cpp"], ["step1/camera_rays.cpp", "step4/shadows.cpp"]),
        ([GOOD, "old/steps/06-octree/octree.cpp"], ["old/steps/06-octree/octree.cpp"]),
        ([GOOD, "octree.cpp"], ["octree.cpp"]),
        (["anna/shadows.cpp", "anna/octree.cpp"], []),  # all in a folder of its own
        (["anna/steps/04-shadows/shadows.cpp"], []),
        (["shadows.cpp"], []),
        (["04-shadows/shadows.cpp", "06-octree/octree.cpp"], []),
    ],
)
def test_unusual_places_are_named(tmp_path: Path, steps: list[Step], names: list[str], unusual: list[str]) -> None:
    submission = load_submission(_folder(tmp_path, *names), steps)
    assert len(submission.sources) == len(names)
    said = " ".join(submission.remarks.values())
    assert [name for name in names if f"It was found at {name}; it belongs at steps/" in said] == unusual
    assert len(submission.remarks) == len(unusual)


@pytest.mark.parametrize(
    "copies", [["shadows.cpp"], ["old/steps/04-shadows/shadows.cpp", "a/steps/04-shadows/shadows.cpp"]]
)
def test_copies_that_were_left_out_are_named(tmp_path: Path, steps: list[Step], copies: list[str]) -> None:
    for order in ([GOOD, *copies], [*copies, GOOD]):  # in an archive, either may come first
        path = tmp_path / "a.zip"
        with zipfile.ZipFile(path, "w") as archive:
            for name in order:
                archive.writestr(name, f"// {name}\n")
        submission = load_submission(path, steps)
        assert submission.sources == {"04-shadows": f"// {GOOD}\n".encode()}
        left_out = f"{' and '.join(sorted(copies))} {'were' if len(copies) > 1 else 'was'} left out beside {GOOD}."
        assert submission.remarks == {"04-shadows": left_out}


def test_a_crowd_of_copies_makes_no_long_remark(tmp_path: Path, steps: list[Step]) -> None:
    submission = load_submission(_folder(tmp_path, GOOD, *(f"{at}/shadows.cpp" for at in range(50))), steps)
    assert submission.remarks["04-shadows"].count("shadows.cpp") == 4
