"""Who is in a class, and which entry is whose."""

from pathlib import Path

import pytest

from raysteps.classroom.entries import list_entries
from raysteps.classroom.roster import Student, match, read_roster
from raysteps.common.errors import UsageError

pytestmark = pytest.mark.portable


def _write(folder: Path, text: str) -> Path:
    path = folder / "roster.csv"
    path.write_bytes(text.encode())
    return path


def _student(line: int, **words: str) -> Student:
    return Student(line, words.pop("id", ""), words.pop("name", ""), words.pop("email", ""), **words)


@pytest.mark.parametrize(
    "text",
    [
        "id,name,email,submission,submitted_at\n7,Ann Lee,ann@x.edu,a.zip,2026-11-20T10:00:00+01:00\n",
        "\ufeffStudent ID;Full Name;E-Mail Address;File name;Submitted At\r\n"
        "7;Ann Lee;ann@x.edu;a.zip;2026-11-20 10:00:00+01:00\r\n\r\n",
        "Surname\tFirst_Name\tSIS User ID\tEMAIL\tFolder\tTime\nLee\tAnn\t7\tann@x.edu\ta.zip\t2026-11-20T10:00+01:00",
    ],
)
def test_headers_are_tolerant(tmp_path: Path, text: str) -> None:
    (student,) = read_roster(_write(tmp_path, text))
    assert (student.id, student.name, student.email) == ("7", "Ann Lee", "ann@x.edu")
    assert (student.submission, student.submitted_at) == ("a.zip", "2026-11-20T10:00:00+01:00")


@pytest.mark.parametrize(
    ("header", "told"),
    [
        ("id;Full Name;E-Mail;Folder;Time", None),
        ("id,,name,", None),
        (
            "id,submision,name",
            "column 'submision' (is it submission?); read are id, name, first name, last name, email",
        ),
        ("id,Last Name,Vornam", "column 'Vornam' (is it first name?); read are"),
        ("id,name,date,Name 2,Late,Late", "columns 'Name 2' and 'Late'; read are"),
        ("id,name,Section,Grade", "columns 'Section' and 'Grade'; read are"),
        ("id,abcd,bcde,cdef,defg,efgh,fghi,Submision", "'Submision' (is it submission?), 'abcd', 'bcde'"),
    ],
)
def test_a_column_that_is_passed_over_is_told(tmp_path: Path, header: str, told: str | None) -> None:
    said: list[str] = []
    path = _write(tmp_path, f"{header}\n7\n")
    assert [student.id for student in read_roster(path, said.append)] == ["7"]
    if told is None:
        assert not said
    else:
        (words,) = said
        assert words.startswith(f"{path}:1: nothing is read from the column")
        assert told in words


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("color,size\nred,1\n", r"roster\.csv:1: expected a header"),
        ("", r"roster\.csv:1: expected a header"),
        ("id\n", "found none"),
        ("id,name\n7,Ann\n8,Bob\n7,Cleo\n", r"roster\.csv:4: the id '7' stands in line 2, too"),
        ("name,email\nAnn,A@x.edu\nBob,a@X.edu\n", r"roster\.csv:3: the email"),
        ("id,name\n,\n7,A\n ,x\n,,\n", None),
        ("name\nAnn Lee\nBob\nANN  Lee\n", r"roster\.csv:4: the name 'ANN  Lee' stands in line 2, too"),
        ("id,email,time\n,,2026-11-20T10:00\n", r"roster\.csv:2: expected an id"),
        ("id,submitted_at\n7,yesterday\n", r"roster\.csv:2: submitted_at is 'yesterday'"),
        ("id,submitted_at\n7,2026-11-20\n", r"roster\.csv:2: submitted_at"),
        (
            'id,name\n6,Eva\n7,"Ann\n8,Bob\n',
            r"roster\.csv:3: is not CSV: a cell that begins with a quotation mark has no",
        ),
    ],
)
def test_messages_name_the_line(tmp_path: Path, text: str, message: str | None) -> None:
    path = _write(tmp_path, text)
    if message is None:
        assert [student.shown for student in read_roster(path)] == ["7", "x"]
        return
    with pytest.raises(UsageError, match=message):
        read_roster(path)


def test_other_encodings_are_refused_by_line(tmp_path: Path) -> None:
    path = tmp_path / "roster.csv"
    path.write_bytes(b"id,name\n7,Jos\xe9\n")
    with pytest.raises(UsageError, match=r"roster\.csv:2:\d+: is not UTF-8"):
        read_roster(path)
    path.write_bytes(b"PK\x03\x04\x14\x00\xe9")
    with pytest.raises(UsageError, match=r"roster\.csv: is a workbook or an archive; save the roster as `CSV UTF-8`"):
        read_roster(path)
    with pytest.raises(UsageError, match="cannot be read"):
        read_roster(tmp_path / "missing.csv")


def test_entries_are_found_by_id_email_and_name() -> None:
    students = [
        _student(2, id="s1", name="Ann Lee"),
        _student(3, id="s2", email="bob@x.edu"),
        _student(4, name="Cleo de Vries"),
        _student(5, id="s4", submission="odd name.zip"),
        _student(6, id="s5", name="Eve Fox"),
    ]
    entries = ["S1.zip", "bob", "Cleo de Vries_991_assignsubmission_file", "odd name.zip", "s99", "x_s5"]
    matches = match(entries, students)
    assert sorted(matches.pairs) == [(0, 0), (1, 1), (2, 2), (3, 3)]
    assert set(matches.entry_notes) == {4, 5}  # the end of a name may be what a student wrote there
    assert matches.student_notes == {}


def test_a_name_whose_last_part_comes_first_is_asked_about_and_not_taken() -> None:
    students = [_student(2, id="7", name="J\u00f6rg M\u00fcller"), _student(3, name="Ann Lee")]
    matches = match(["M\u00fcller, J\u00f6rg", "Nobody Here"], students)
    assert matches.pairs == []
    assert matches.entry_notes[0].endswith(
        f" Is it that of {students[0].name} ({students[0].shown}), with the last name first?"
    )
    assert matches.entry_notes[1].endswith('in the column "submission".')


def test_nobody_gets_an_entry_that_fits_several() -> None:
    students = [_student(2, id="1", name="Ann Lee"), _student(3, id="2", name="ann LEE")]
    matches = match(["ann_lee", "1.zip"], students)
    assert matches.pairs == [(1, 0)]
    assert "several students (1, 2)" in matches.entry_notes[0]


def test_the_longer_name_is_the_better_fit() -> None:
    students = [_student(2, id="12"), _student(3, id="12-3"), _student(4, name="Ann")]
    matches = match(["12-3_work.zip", "12_work", "ann_miller"], students)
    assert sorted(matches.pairs) == [(0, 1), (1, 0)]
    assert 2 in matches.entry_notes


def test_two_students_may_share_what_the_roster_names() -> None:
    students = [_student(2, id="1", submission="team"), _student(3, id="2", submission="team.zip"), _student(4, id="3")]
    matches = match(["team.zip", "3"], students)
    assert sorted(matches.pairs) == [(0, 0), (0, 1), (1, 2)]


def test_a_submission_that_the_roster_names_and_nobody_handed_in() -> None:
    matches = match(["1.zip"], [_student(2, id="1", submission="other.zip")])
    assert matches.pairs == []
    assert "other.zip, which is not there" in matches.student_notes[0]
    assert matches.entry_notes.keys() == {0}


def test_without_a_roster_there_is_nothing_to_note() -> None:
    assert match(["a", "b"], []).entry_notes == {}


def test_delimiters_in_quotes_do_not_count(tmp_path: Path) -> None:
    path = _write(tmp_path, '"name, as in the register, or else",id;"e;mail"\n'.replace(",id", ";id") + "Ann;7;a@x\n")
    assert [student.id for student in read_roster(path)] == ["7"]


def test_a_grading_worksheet_of_moodle_is_a_roster(tmp_path: Path) -> None:
    text = (
        'Identifier,"Full name","ID number","Email address",Status,Grade,"Last modified (submission)"\n'
        '"Participant 101","Ann Lee",S1,ann@uni.edu,Submitted,,"Friday, 20 November 2026, 10:00 AM"\n'
    )
    (student,) = read_roster(_write(tmp_path, text))
    assert (student.id, student.name, student.submitted_at) == ("S1", "Ann Lee", "")


@pytest.mark.parametrize(
    ("entry", "whose"),
    [
        ("leeann_4711_815_steps.zip", 0),  # by the name, which Canvas writes so
        ("leeann_LATE_4711_815_steps.zip", 0),
        ("devriescleo_99_816_steps.zip", 1),
        ("who_55_817_steps.zip", 3),  # by the number, of somebody whose name is not known
        ("foxeve_77_818_steps.zip", None),  # the number is another one's, who has another name
        ("evil_1_2_leeann_4711_815_steps.zip", None),  # only the beginning is the platform's
        ("Ann Lee_4711_assignsubmission_file", 0),
        ("Ann Lee_55_assignsubmission_file", 0),
        ("Eve Fox_77_assignsubmission_leeann_4711_1_.zip", None),
        ("twinjo_6_1_a.zip", 4),  # two of one name: the number tells which
        ("twinjo_8_1_a.zip", None),
    ],
)
def test_downloads_of_canvas_and_moodle(entry: str, whose: int | None) -> None:
    students = [
        _student(2, id="4711", name="Ann Lee"),
        _student(3, id="s2", name="Cleo de Vries"),
        _student(4, id="77", name="Dan Ray"),
        _student(5, id="55"),
        _student(6, id="6", name="Jo Twin"),
        _student(7, id="7", name="Jo Twin"),
    ]
    assert match([entry], students).pairs == ([] if whose is None else [(0, whose)])


@pytest.mark.parametrize(
    "entry", ["eva noe_99_file.tar", "Eva Noé", "EVA_NOE\u0301", "noeeva_99_1_a.zip", "noéeva_99_1_a.zip"]
)
def test_accents_may_be_left_out(entry: str) -> None:
    students = [_student(2, id="1", name="Ann Lee"), _student(3, id="2", name="Eva Noé")]
    assert match([entry], students).pairs == [(0, 1)]
    assert match([entry], [_student(2, id="2", name="Eva Noe")]).pairs == [(0, 0)]


def test_people_whose_names_differ_in_accents_only() -> None:
    students = [_student(2, id="1", name="Eva Noe"), _student(3, id="2", name="Eva Noé")]
    matches = match(["eva noe_99_file.tar", "Eva Noé.zip"], students)
    assert matches.pairs == [(1, 1)]  # nobody writes an accent that is not there, but it may have been left out
    assert "several students (1, 2)" in matches.entry_notes[0]


def test_signs_of_other_scripts_are_no_accents() -> None:
    assert match(["かき たろう"], [_student(2, name="がき たろう")]).pairs == []


def test_signs_that_nobody_sees_make_no_other_student(tmp_path: Path) -> None:
    roster = tmp_path / "roster.csv"
    roster.write_text("id,name\nann\u200b,Ann \u202eLee\n\u2066bob,Bob\nB\u00adob,Bob\n", encoding="utf-8")
    with pytest.raises(UsageError, match="the id 'Bob' stands in line 3, too"):
        read_roster(roster)
    roster.write_text('id,name,submission\nann\u200b,"Ann\n\u202eLee",ann\u202e.zip\n', encoding="utf-8")
    (student,) = read_roster(roster)
    assert (student.id, student.name, student.submission) == ("ann", "Ann Lee", "ann⟨U+202E⟩.zip")


@pytest.mark.parametrize("name", ["علی\u200cرضا رضایی", "क्\u200dष Rao", "Ann\u00ad Lee"])  # noqa: RUF001
def test_signs_of_its_own_spelling_part_no_name_from_its_entry(tmp_path: Path, name: str) -> None:
    students = read_roster(_write(tmp_path, f"id,name\n7,{name}\n8,Bob Day\n"))
    folder = tmp_path / "class" / f"{name}_123_assignsubmission_file"
    folder.mkdir(parents=True)
    entries = [entry.label for entry in list_entries(folder.parent, []).entries]
    assert match(entries, students).pairs == [(0, 0)]
