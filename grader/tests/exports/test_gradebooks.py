"""Gradebooks of Canvas and Moodle, filled from the output of grade-class."""

import argparse
import csv
import io
from pathlib import Path

import pytest
from export_documents import HOSTILE, mixed
from rich.console import Console

from raysteps.cli.export import add_arguments, run
from raysteps.common.documents import as_text
from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.exports.gradebook import gathered
from raysteps.results.model import HandIn, Lateness, Results, StepResult

CANVAS = (
    "Student,ID,SIS User ID,SIS Login ID,Section,Essay (11),Raysteps (12),Final Score\r\n"
    ",,,,,Manual Posting,,\r\n"
    "    Points Possible,,,,,5.00,100.00,(read only)\r\n"
    '"Lee, Ann",101,S1,ann,A,4,,91\r\n'
    '"de la Cruz, José",102,S2,jose,"A, B",,55,\r\n'
    '"Excused, Eve",103,S3,eve,A,,EX,\r\n'
    '"=HYPERLINK(""x""), Bob",104,S4,bob@uni.edu,A,,,\r\n'
    '"Student, Test",105,,abcdef0123,A,,,\r\n'
)
MOODLE = (
    '\ufeffIdentifier,"Full name","ID number","Email address",Status,Grade,"Maximum Grade","Grade can be changed",'
    '"Last modified (submission)","Last modified (grade)","Feedback comments"\n'
    '"Participant 101","Ann Lee",S1,ann@uni.edu,"Submitted for grading",,100.00,Yes,"1 June 2026, 10:00 AM",-,\n'
    '"Participant 102","José de la Cruz",S2,jose@uni.edu,,55.00,100.00,Yes,-,-,"<p>old</p>"\n'
    '"Participant 103","Eve Locked",S3,eve@uni.edu,,,100.00,No,-,-,\n'
    "\n"
)
HEADING = "submission,id,name,email,points,max,late_points,extra\n"


def _run(project: Project, *words: str | Path) -> int:
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    return run(project, parser.parse_args([str(word) for word in words]), Console(file=io.StringIO()))


class Case:
    """A template, the output of grade-class, and the command on them."""

    def __init__(self, project: Project, folder: Path) -> None:
        self._project = project
        self.template = folder / "template.csv"
        self.graded = folder / "graded"
        self.out = folder / "filled.csv"
        self.graded.mkdir()

    def results(self, rows: str) -> None:
        (self.graded / "results.csv").write_bytes(("\ufeff" + HEADING + rows).replace("\n", "\r\n").encode())

    def run(self, system: str, text: str, *words: str) -> str:
        self.template.write_bytes(text.encode())
        words = ("--template", str(self.template), "--results", str(self.graded), "--out", str(self.out), *words)
        assert _run(self._project, system, *words) == 0
        return self.out.read_bytes().decode()


@pytest.fixture
def case(project: Project, tmp_path: Path) -> Case:
    return Case(project, tmp_path)


def test_canvas_changes_grades_only(case: Case, capsys: pytest.CaptureFixture[str]) -> None:
    case.results(
        "one,S1,Ann,,87.5,100,,\ntwo,,Jose,jose@x,90,100,81,\nthree,103,,,10,100,,\nfour,,,bob@uni.edu,0,100,,\n"
    )
    with pytest.raises(UsageError, match="--assignment"):
        case.run("canvas", CANVAS)
    assert not case.out.exists()
    filled = case.run("canvas", CANVAS, "--assignment", "Raysteps")
    expected = CANVAS.replace("ann,A,4,,91", "ann,A,4,87.5,91").replace("bob@uni.edu,A,,,", "bob@uni.edu,A,,0,")
    assert filled == expected
    said = capsys.readouterr().err
    assert "no row for two (Jose, jose@x)" in said
    assert "left as it is: Excused, Eve 103 (line 6) is excused" in said
    assert "no submission for Student, Test 105 (line 8)" in said
    assert "Ann" not in said


def test_a_table_that_is_no_gradebook_is_told_as_such(case: Case) -> None:
    for named in ((), ("--assignment", "12")):
        with pytest.raises(UsageError, match=r"has no column of an assignment, .*; expected a gradebook as Canvas"):
            case.run("canvas", "Student,ID\nAnn,1\n", *named)


@pytest.mark.parametrize("wanted", ["12", "Raysteps", "Raysteps (12)"])
def test_an_assignment_has_three_names(case: Case, wanted: str) -> None:
    case.results("one,101,,,50,100,,\n")
    assert "ann,A,4,50,91" in case.run("canvas", CANVAS, "--assignment", wanted)
    with pytest.raises(UsageError, match=r"Essay \(11\); Raysteps \(12\)"):
        case.run("canvas", CANVAS, "--assignment", "Ray")


@pytest.mark.parametrize(
    "row", ["x,101,,,7,100,,", "x,s1,,,7,100,,", "x,ANN,,,7,100,,", "x,,Ann Lee,,7,100,,", 'x,,"lee,  ann",,7,100,,']
)
def test_canvas_identities(case: Case, row: str) -> None:
    case.results(row + "\n")
    filled = case.run("canvas", CANVAS, "--assignment", "12")
    assert filled == CANVAS.replace("ann,A,4,,91", "ann,A,4,7,91")


def test_the_files_names_tell_where_there_was_no_roster(case: Case) -> None:
    case.results("leeann_LATE_101_5599_steps,,,,7,100,,\ndelacruzjose_102_5600_steps-1,,,,8,100,,\n")
    filled = case.run("canvas", CANVAS, "--assignment", "12")
    assert "ann,A,4,7,91" in filled
    assert '"A, B",,8,' in filled
    case.results("Ann_Lee_101_assignsubmission_file,,,,7,100,,\n")
    assert ',"Submitted for grading",7,100.00' in case.run("moodle", MOODLE)


def test_the_sign_against_formulas_is_no_part_of_a_name(case: Case) -> None:
    case.results("x,'@101,,,7,100,,\n")
    assert "ann,A,4,7,91" in case.run("canvas", CANVAS.replace(",101,", ",@101,"), "--assignment", "12")


def test_nobody_is_invented(case: Case) -> None:
    case.results("x,999,Ann Leeds,,7,100,,\n")
    with pytest.raises(UsageError, match="no student in it"):
        case.run("canvas", CANVAS, "--assignment", "12")
    assert not case.out.exists()


@pytest.mark.parametrize(
    ("rows", "text", "both"),
    [
        # an id and an email that belong to two people
        ("x,S1,,bob@uni.edu,7,100,,\n", CANVAS, r"Lee, Ann 101 \(line 4\) and =HYPERLINK.*104 \(line 7\)"),
        # two people of one name
        ("x,,Ann Lee,,7,100,,\n", CANVAS + '"Lee, Ann",199,S99,ann2,A,,,\r\n', r"101 \(line 4\) and Lee, Ann 199"),
        # two submissions of one person
        ("x,S1,,,7,100,,\ny,101,,,8,100,,\n", CANVAS, r"x \(S1\) and y \(101\) both fit Lee, Ann 101"),
        # one person's number is another one's id
        ("x,102,,,7,100,,\n", CANVAS.replace("S1", "102"), "Lee, Ann 101 .* and de la Cruz, José 102"),
    ],
)
def test_ambiguity_names_both(case: Case, rows: str, text: str, both: str) -> None:
    case.results(rows)
    with pytest.raises(UsageError, match=both):
        case.run("canvas", text, "--assignment", "12")
    assert not case.out.exists()


def test_moodle_tells_how_late_it_was(case: Case, steps: list[Step]) -> None:
    folder = case.graded / "submissions" / "one"
    folder.mkdir(parents=True)
    document = mixed(steps, "is wrong")
    document.total.points, document.course = 90.0, "Graphics 101"
    words = "Handed in 1 day after the deadline: 1 day begun, 20 % each, takes 20 % off 90 points: 90 - 18 = 72 points."
    document.handed_in = HandIn(["Ann"], "2026-11-21T12:00:00+01:00", False, Lateness(1, 20, 72.0, "2026-11-20", words))
    (folder / "results.json").write_text(as_text(document))
    case.results("one,S1,Ann,,90,100,72,\n")
    feedback = list(csv.reader(io.StringIO(case.run("moodle", MOODLE), newline="")))[1][10]
    assert f"Graphics 101.<br>Late: 72 of 90 points count.<br>{words}<br>" in feedback
    assert feedback.count("72 of 90") == 1


def test_moodle_changes_grades_and_feedback_only(
    case: Case, steps: list[Step], capsys: pytest.CaptureFixture[str]
) -> None:
    folder = case.graded / "submissions" / "one"
    folder.mkdir(parents=True)
    document = mixed(steps, HOSTILE)
    document.total.points = 87.5
    (folder / "results.json").write_text(as_text(document))
    case.results("one,S1,Ann,,87.5,100,70,\ntwo,,,jose@uni.edu,110,100,,\nthree,103,,,10,100,,\n")
    filled = case.run("moodle", MOODLE)
    before, after = (list(csv.reader(io.StringIO(text, newline=""))) for text in (MOODLE, filled))
    assert [row[:5] + row[6:10] for row in after] == [row[:5] + row[6:10] for row in before]
    assert [row[5] for row in after[1:4]] == ["70", "100", ""]
    feedback = after[1][10]
    assert feedback.startswith("87.5 points, 70 after lateness.<br>")
    assert "&lt;script&gt;alert(1)&lt;/script&gt;" in feedback
    assert "<script" not in feedback
    assert "<br>  - hidden function 0: " in feedback
    assert "secret" not in feedback
    assert not any(ord(letter) < 32 for letter in feedback)
    assert filled.endswith('Yes,-,-,"<p>old</p>"\n' + '"Participant 103"' + MOODLE.split('"Participant 103"')[1])
    said = capsys.readouterr().err
    assert "two (jose@uni.edu): has no results.json; the comment on José de la Cruz Participant 102 (line 3)" in said
    assert "two (jose@uni.edu): 110 points are above the maximum; 100 entered" in said
    assert "Eve Locked Participant 103 (line 4) has a locked grade" in said


@pytest.mark.parametrize("who", ["101", "Participant 101", "S1", "ANN@uni.edu"])
def test_moodle_identities(case: Case, who: str) -> None:
    case.results(f"x,{who},,,7,100,,\n")
    assert ',"Submitted for grading",7,100.00' in case.run("moodle", MOODLE)


def test_moodle_in_another_language(case: Case) -> None:
    heading = 'ID;"Vollständiger Name";Bewertung;"Beste Bewertung";"Feedback als Kommentar"'
    text = f'{heading}\r\nTeilnehmer/in101;Ann;;"100,00";\r\n'
    case.results("x,101,,,7.25,100,,\n")
    with pytest.raises(UsageError, match="--column"):
        case.run("moodle", text)
    words = ["identifier=ID", "grade=Bewertung", "max=Beste Bewertung"]
    filled = case.run("moodle", text, *(part for word in words for part in ("--column", word)))
    assert filled == text.replace("Ann;;", "Ann;7,25;")
    with pytest.raises(UsageError, match="Note"):
        case.run("moodle", text, "--column", "grade=Note", "--column", "identifier=ID")
    with pytest.raises(SystemExit):
        case.run("moodle", text, "--column", "points=Note")


def test_another_maximum_needs_a_word(case: Case) -> None:
    text = CANVAS.replace("100.00", "20.00")
    case.results("x,101,,,87.5,100,,\n")
    with pytest.raises(UsageError, match=r"maximum is 20, but x .* out of 100"):
        case.run("canvas", text, "--assignment", "12")
    assert "ann,A,4,17.5,91" in case.run("canvas", text, "--assignment", "12", "--points", "scale")
    assert "ann,A,4,87.5,91" in case.run("canvas", text, "--assignment", "12", "--points", "as-is")


def test_who_has_no_points_keeps_the_cell(case: Case, capsys: pytest.CaptureFixture[str]) -> None:
    case.results("x,102,,,,100,,\ny,101,,,5,100,,\n,104,Bob,,,,,\n")
    assert 'jose,"A, B",,55,' in case.run("canvas", CANVAS, "--assignment", "12")
    said = capsys.readouterr().err
    assert "José 102 (line 5) has no points in results.csv" in said
    assert "Bob 104 (line 7) handed nothing in" in said


def test_many_with_one_reason_fill_one_line() -> None:
    absent = [(f"student {at}", "handed nothing in") for at in range(4)]
    few = [("Ann", "is excused"), ("Bob", "is excused")]
    together = "4 people: student 0; student 1; student 2; student 3"
    assert gathered([*absent[:2], *few, *absent[2:]]) == [(together, "handed nothing in"), *few]


@pytest.mark.parametrize("points", ["nan", "-1", "inf", "many"])
def test_odd_points_are_refused(case: Case, points: str) -> None:
    case.results(f"x,101,,,{points},100,,\n")
    with pytest.raises(UsageError, match=r"results.csv:2: points"):
        case.run("canvas", CANVAS, "--assignment", "12")


def test_a_submission_cannot_point_out_of_the_folder(case: Case, steps: list[Step], tmp_path: Path) -> None:
    (tmp_path / "results.json").write_text(as_text(mixed(steps)))
    case.results("../..,101,,,5,100,,\n")
    filled = case.run("moodle", MOODLE)
    assert list(csv.reader(io.StringIO(filled)))[1][10] == ""


def test_names_in_two_columns(case: Case) -> None:
    text = "LastName,FirstName,ID,SIS Login ID,Section,Raysteps (12)\r\nLee,Ann,101,x,A,\r\n"
    case.results("s,,Ann Lee,,7,100,,\n")
    with pytest.raises(
        UsageError, match=r"no maximum for s \(Ann Lee\), who was graded out of 100; say --points as-is"
    ):
        case.run("canvas", text)
    with pytest.raises(UsageError, match="no maximum"):
        case.run("canvas", text, "--points", "scale")
    assert case.run("canvas", text, "--points", "as-is") == text.replace("x,A,", "x,A,7")


def test_the_template_is_never_overwritten(project: Project, case: Case) -> None:
    case.results("x,101,,,5,100,,\n")
    case.template.write_text(CANVAS)
    with pytest.raises(UsageError, match="template"):
        _run(project, "canvas", "--template", case.template, "--results", case.graded, "--out", case.template)


def test_a_short_row_is_refused(case: Case) -> None:
    case.results("x,101,,,5,100,,\n")
    with pytest.raises(UsageError, match=r"template.csv:2: 4 cells, expected at least 7"):
        case.run("canvas", CANVAS.splitlines()[0] + "\n101,101,S1,ann\n", "--assignment", "12")


def test_what_is_no_output_of_grade_class(case: Case) -> None:
    with pytest.raises(UsageError, match="grade-class"):
        case.run("canvas", CANVAS, "--assignment", "12")
    (case.graded / "results.csv").write_text("name,points\na,1\n")
    with pytest.raises(UsageError, match="submission, id, email, max"):
        case.run("canvas", CANVAS, "--assignment", "12")


@pytest.mark.parametrize("text", ["1,000", "1.000", "1,000.00", "(read only)", "hundred"])
def test_a_maximum_that_may_mean_anything_is_refused(case: Case, text: str) -> None:
    case.results("x,101,,,7,100,,\n")
    template = CANVAS.replace(",100.00,", f',"{text}",')
    for words in ([], ["--points", "scale"], ["--points", "as-is"]):
        with pytest.raises(UsageError, match=r"template.csv:4: the maximum is '.*', expected a number"):
            case.run("canvas", template, "--assignment", "12", *words)


def test_no_maximum_needs_a_word(case: Case) -> None:
    case.results("x,101,,,7,100,,\n")
    text = "".join(line for line in CANVAS.splitlines(keepends=True) if "Points Possible" not in line)
    with pytest.raises(UsageError, match="no maximum for x"):
        case.run("canvas", text, "--assignment", "12")
    assert "ann,A,4,7,91" in case.run("canvas", text, "--assignment", "12", "--points", "as-is")


@pytest.mark.parametrize("system", ["canvas", "moodle"])
def test_results_of_two_runs_are_not_mixed(case: Case, steps: list[Step], system: str) -> None:
    folder = case.graded / "submissions" / "x"
    folder.mkdir(parents=True)
    document = mixed(steps)
    (folder / "results.json").write_text(as_text(document))
    points = document.total.points
    words = ["--assignment", "12"] if system == "canvas" else []
    for wrong in (points + 0.01, ""):
        case.results(f"x,101,,,{wrong},100,,\n")
        with pytest.raises(UsageError, match=r"results.json: is of another run than results.csv, .* x \(101\)"):
            case.run(system, CANVAS if system == "canvas" else MOODLE, *words)
    case.results(f"x,101,,,{points},100,1,\n")
    case.run(system, CANVAS if system == "canvas" else MOODLE, *words)


def test_what_is_no_csv(case: Case) -> None:
    case.results(f"x,101,{'a' * 200_000},,7,100,,\n")
    with pytest.raises(UsageError, match=r"results.csv:\d: is not CSV: field larger"):
        case.run("canvas", CANVAS, "--assignment", "12")


def test_entities_begin_no_formula(case: Case, steps: list[Step]) -> None:
    folder = case.graded / "submissions" / "x"
    folder.mkdir(parents=True)
    document = mixed(steps, "0 < -1 and 'a'=+@b")
    (folder / "results.json").write_text(as_text(document))
    case.results(f"x,101,,,{document.total.points},100,,\n")
    cell = list(csv.reader(io.StringIO(case.run("moodle", MOODLE))))[1][10]
    assert "0 &lt; &#45;1 and &#x27;a&#x27;&#61;&#43;&#64;b" in cell


def _comment(case: Case, document: Results) -> str:
    folder = case.graded / "submissions" / "x"
    folder.mkdir(parents=True)
    (folder / "results.json").write_text(as_text(document))
    case.results(f"x,101,,,{document.total.points},100,,\n")
    return list(csv.reader(io.StringIO(case.run("moodle", MOODLE))))[1][10]


def test_how_to_repeat_a_test_is_not_why_it_failed(case: Case, steps: list[Step]) -> None:
    document = mixed(steps)
    repeat = "to repeat these random inputs, set RAYSTEPS_SEED=2026"
    failed = [test for step in document.steps for test in step.tests if not test.passed]
    assert len(failed) > 1
    failed[0].message = f"{repeat}\nthe ray comes from inside"
    for test in failed[1:]:
        test.message = repeat
    cell = _comment(case, document)
    assert "RAYSTEPS_SEED" not in cell
    assert f"  - test {failed[0].name}: the ray comes from inside<br>" in cell
    assert f"  - test {failed[1].name}: expected: a == b, got: 1 == 2<br>".replace("=", "&#61;") in cell.replace(
        "=", "&#61;"
    )


def test_one_reason_for_all_steps_is_said_once(case: Case, steps: list[Step]) -> None:
    document = mixed(steps)
    for at, step in enumerate(document.steps):
        said = ["Nothing was taken from this submission: it is no zip."]
        document.steps[at] = StepResult(step.id, "not-started", 0.0, step.max, step.bonus, messages=said)
    document.total.points = 0.0
    cell = _comment(case, document)
    assert cell.count("is no zip") == 1
    assert cell.count("not started") == len(steps)


def test_what_a_worksheet_without_names_and_comments_says(case: Case, capsys: pytest.CaptureFixture[str]) -> None:
    heading = 'ID;"Vollständiger Name";"E-Mail-Adresse";Bewertung;"Feedback als Kommentar"'
    text = f"{heading}\r\nTeilnehmer/in101;Ann;ann@uni.edu;;\r\n"
    case.results("x,s7,,ann@uni.edu,7,100,,\n")
    words = ["--points", "as-is", "--column", "identifier=ID", "--column", "grade=Bewertung"]
    with pytest.raises(UsageError, match="no student in it"):
        case.run("moodle", text, *words)
    said = capsys.readouterr().err
    assert "only the identifier tells whose a row is" in said
    assert "--column email=HEADING" in said
    assert "no comments are written" in said
    assert "--column feedback=HEADING" in said
    case.run("moodle", text, *words, "--column", "email=E-Mail-Adresse", "--column", "feedback=Feedback als Kommentar")
    said = capsys.readouterr().err
    assert "only the identifier" not in said
    assert "no comments" not in said


def test_which_folder_is_wanted(case: Case, tmp_path: Path) -> None:
    wanted = "--results wants the folder that grade-class wrote"
    with pytest.raises(UsageError, match=f"graded: holds no results.csv; {wanted}"):
        case.run("canvas", CANVAS, "--assignment", "12")
    (case.graded / "results.csv").write_bytes(b"submission,id\n\xff,1\n")
    with pytest.raises(UsageError, match=r"is not UTF-8, .* --resume, which writes it anew"):
        case.run("canvas", CANVAS, "--assignment", "12")
    case.graded = case.graded / "results.csv"
    with pytest.raises(UsageError, match=f"results.csv: is a file; {wanted}"):
        case.run("canvas", CANVAS, "--assignment", "12")
    case.graded = tmp_path / "nowhere"
    with pytest.raises(UsageError, match=f"nowhere: is not there; {wanted}"):
        case.run("canvas", CANVAS, "--assignment", "12")


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (None, "is not there"),
        (b"", "is empty"),
        (b'{"a": 1', r"is not JSON, or only a part of it \(line 1, column \d+\)"),
        (b'{"a": "\xff"}', "is not JSON"),
        (b"[" * 100_000, "is not JSON"),
    ],
)
def test_no_words_of_python_about_results(project: Project, tmp_path: Path, data: bytes | None, words: str) -> None:
    path = tmp_path / "results.json"
    if data is not None:
        path.write_bytes(data)
    expected = "; expected a results.json as checking or grading writes it$"
    with pytest.raises(UsageError, match=f"results.json: {words}{expected}"):
        _run(project, "autolab", "--results", path)
    with pytest.raises(UsageError, match=f"is a folder{expected}"):
        _run(project, "autolab", "--results", tmp_path)
