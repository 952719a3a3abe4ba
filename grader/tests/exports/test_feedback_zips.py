"""Reports as Moodle and Canvas take them, read by rules that were written anew from what these systems do."""

import io
import re
import tarfile
import zipfile
from pathlib import Path

import pytest
from give_back_class import export, grade

from raysteps.common.errors import UsageError
from raysteps.exports.autograders import Member
from raysteps.exports.give_back import moodle_folder, packed

pytestmark = pytest.mark.usefixtures("fake_grader")

_GOOD = "// points 7\n"
_WORKSHEET = (
    'Identifier,"Full name","ID number","Email address",Grade,"Maximum Grade"\n'
    '"Participant 501","Ann Lee",1,ann@example.edu,,100.00\n'
    '"Participant 502","Bob Ray",2,bob@example.edu,,100.00\n'
    '"Participant 503","Cleo Fox",3,cleo@example.edu,,100.00\n'
)


def moodle_reads(archive: bytes, participants: set[int], *, before_4_1: bool = False) -> dict[int, dict[str, bytes]]:
    """Who gets which files, after mod/assign/feedback/file/importziplib.php of Moodle, the method
    is_valid_filename_for_import: files whose own name begins with `.` or `~` are hidden. Of each part of the path, cut
    at the first four `_`, the second piece must be the number of a participant, the third and fourth a plugin of the
    assignment; what is left of the part and the parts below it is the file's path for the student. From 4.1 on a part
    may end after the fourth piece."""
    found: dict[int, dict[str, bytes]] = {}
    with zipfile.ZipFile(io.BytesIO(archive)) as members:
        for member in members.infolist():
            if member.is_dir() or member.filename.rsplit("/", 1)[-1].startswith((".", "~")):
                continue
            parts = ["", "import", *member.filename.split("/")]
            while parts:
                pieces = parts.pop(0).split("_", 4)
                if len(pieces) < (5 if before_4_1 else 4) or not re.fullmatch("[0-9]+", pieces[1]):
                    continue
                if int(pieces[1]) not in participants or pieces[2:4] != ["assignsubmission", "file"]:
                    continue
                name = "/".join([*pieces[4:], *parts]).lstrip("/")
                found.setdefault(int(pieces[1]), {})[name] = members.read(member)
                break
    return found


def canvas_reads(archive: bytes, submitted: dict[int, dict[int, str]]) -> tuple[dict[int, dict[str, bytes]], list[str]]:
    """Who gets which files as a comment, under which name, and what is ignored, after Canvas's
    app/models/abstract_assignment.rb, infer_comment_context_from_filename and generate_comments_from_files: cut at each
    `_`, the first piece of digits is the student, the second the file that was handed in, which gives its name to the
    comment's file.
    `submitted`: by student, the names of the files by their numbers."""
    found: dict[int, dict[str, bytes]] = {}
    ignored = []
    with zipfile.ZipFile(io.BytesIO(archive)) as members:
        for member in members.infolist():
            name = member.filename.rsplit("/", 1)[-1]
            pieces = [piece for piece in name.split("_") if piece != "LATE"]
            numbers = [int(piece) for piece in pieces if re.fullmatch("[0-9]+", piece)][:2]
            files = submitted.get(numbers[0], {}) if len(numbers) == 2 else {}
            if name.startswith("._") or pieces[-1].startswith("link") or len(numbers) < 2 or numbers[1] not in files:
                ignored.append(name)
            else:
                found.setdefault(numbers[0], {})[files[numbers[1]]] = members.read(member)
    return found, ignored


def _report(graded: Path, name: str) -> bytes:
    return (graded / "submissions" / name / "report.html").read_bytes()


@pytest.fixture
def of_moodle(tmp_path: Path) -> Path:
    roster = "1,Ann Lee,ann@example.edu,\n2,Bob Ray,,team\n3,Cleo Fox,,team\n4,Dan Day,,\n"
    downloads = {"Ann Lee_88_assignsubmission_file": _GOOD, "Dan Day_91_assignsubmission_file": "// fault\n"}
    return grade(tmp_path, roster.replace("team", "Group A-Cleo Fox_90_assignsubmission_file"), **downloads,
                 **{"Group A-Cleo Fox_90_assignsubmission_file": _GOOD})  # fmt: skip


@pytest.mark.parametrize("before_4_1", [False, True])
def test_moodle_by_the_names_of_the_download(
    of_moodle: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], before_4_1: bool
) -> None:
    out = tmp_path / "feedback.zip"
    code, text = export("moodle-feedback", "--results", of_moodle, "--out", out)
    assert code == 0
    assert "2 reports for 2 students" in text
    names = {88: "Ann_Lee_88_assignsubmission_file", 90: "Group_A-Cleo_Fox_90_assignsubmission_file"}
    assert moodle_reads(out.read_bytes(), {88, 90, 91}, before_4_1=before_4_1) == {
        number: {"report.html": _report(of_moodle, name)} for number, name in names.items()
    }
    told = capsys.readouterr().err
    assert "Bob Ray, 2): no participant number in the name of what was handed in" in told
    assert "Dan Day, 4): the grader failed with it" in told


def test_moodle_by_the_worksheet_reaches_a_whole_team(of_moodle: Path, tmp_path: Path) -> None:
    out, sheet = tmp_path / "feedback.zip", tmp_path / "worksheet.csv"
    sheet.write_text(_WORKSHEET)
    assert export("moodle-feedback", "--results", of_moodle, "--template", sheet, "--out", out)[0] == 0
    found = moodle_reads(out.read_bytes(), {501, 502, 503})
    team = {"report.html": _report(of_moodle, "Group_A-Cleo_Fox_90_assignsubmission_file")}
    assert found == {501: {"report.html": _report(of_moodle, "Ann_Lee_88_assignsubmission_file")}, 502: team, 503: team}


@pytest.mark.parametrize(
    "name",
    ["", "Ann_Lee", "Ann_7_assignsubmission_file_", "../../etc", "..", "~a", "a/b\\c", "x" * 500, "\u202eA", "\0"],
)
def test_no_name_leads_elsewhere_in_moodle(name: str) -> None:
    folder = moodle_folder(name, "88")
    assert re.fullmatch(r"[^_/\\\x00]*_88_assignsubmission_file_", folder)
    assert len(folder) < 120
    assert not folder.startswith((".", "~", " "))


@pytest.mark.parametrize(
    ("system", "first", "second", "place"),
    [
        ("moodle", "Ann_88_assignsubmission_file", "Ann Lee_88_assignsubmission_file", "participant 88 of Moodle"),
        ("canvas", "leeann_4711_815_steps", "leeann_LATE_4711_815_my", "upload 815 of student 4711"),
    ],
)
def test_two_for_one_place_are_told_and_left_out(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], system: str, first: str, second: str, place: str
) -> None:
    other = {"moodle": "Bob_89_assignsubmission_file", "canvas": "leeann_4711_816_steps"}[system]
    (tmp_path / "made").mkdir()
    graded = grade(tmp_path / "made", "9,Zed,,\n", **{first: _GOOD, second: "// points 4\n", other: _GOOD})
    out = tmp_path / "feedback.zip"
    capsys.readouterr()
    code, text = export(f"{system}-feedback", "--results", graded, "--out", out)
    assert code == 0
    assert "1 report for 1 student" in text
    with zipfile.ZipFile(out) as members:
        assert [name.split("_")[1:3] for name in members.namelist()] == [other.split("_")[1:3]]
    told = capsys.readouterr().err
    for name in (first, second):
        assert f"nothing for {name.replace(' ', '_')}: " in told
    assert told.count(f"would go to one place, {place}: take what does not count out of the folder") == 2


def test_headings_of_another_language_are_for_a_worksheet(of_moodle: Path, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="expected --template, too"):
        export("moodle-feedback", "--results", of_moodle, "--out", tmp_path / "z", "--column", "email=E-Mail")


def test_canvas_gets_the_names_that_it_gave(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "made").mkdir()
    graded = grade(tmp_path / "made", "4711,Ann Lee,,\n,Bob Ray,,\n", leeann_4711_815_steps=_GOOD,
                   raybob_LATE_4712_816_my_work_7=_GOOD, stranger=_GOOD)  # fmt: skip
    out = tmp_path / "feedback.zip"
    assert export("canvas-feedback", "--results", graded, "--out", out)[0] == 0
    found, ignored = canvas_reads(out.read_bytes(), {4711: {815: "steps.zip"}, 4712: {816: "my_work_7.zip"}})
    assert ignored == []
    assert {student: list(files) for student, files in found.items()} == {4711: ["steps.zip"], 4712: ["my_work_7.zip"]}
    with zipfile.ZipFile(io.BytesIO(found[4711]["steps.zip"])) as inner:
        assert inner.namelist() == ["report.html"]
        assert inner.read("report.html") == _report(graded, "leeann_4711_815_steps")
    assert "nothing for stranger: what was handed in is not named as in a download of Canvas" in capsys.readouterr().err


@pytest.mark.parametrize("ending", [".tar.gz", ".tgz", ".tar.bz2", ".txz", ".tar"])
def test_canvas_shows_an_archive_of_the_kind_that_was_handed_in(tmp_path: Path, ending: str) -> None:
    data = packed(f"leeann_4711_815_steps{ending}", [Member("report.html", b"<p>")])
    with tarfile.open(fileobj=io.BytesIO(data)) as archive:
        assert archive.getnames() == ["report.html"]
    assert not zipfile.is_zipfile(io.BytesIO(data))


def test_a_class_that_no_platform_named(tmp_path: Path) -> None:
    graded = grade(tmp_path, "1,Ann,,ann\n", ann=_GOOD)
    for system in ("moodle-feedback", "canvas-feedback"):
        with pytest.raises(UsageError, match="nothing can be given back: "):
            export(system, "--results", graded, "--out", tmp_path / "z")
    assert not (tmp_path / "z").exists()
