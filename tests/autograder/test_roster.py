"""The class list: what spreadsheets write is read, and what is wrong is named by its line."""

import pytest

from autograder import roster
from autograder.roster import Person, RosterError

ADA = Person("ada", "Lovelace", "Ada", "ada@x.org", "11")
NAMES = "id,last_name,first_name,email,lms_id\n"


def written(tmp_path, text: str | bytes):
    path = tmp_path / "class.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


@pytest.mark.parametrize(
    "text",
    [
        f"{NAMES}ada,Lovelace,Ada,ada@x.org,11\n",
        f"\ufeff{NAMES}ada , Lovelace,Ada,ada@x.org,11\r\n\r\n,,,,\r\n",
        "ID;First name;Last name;E-mail;email;LMS ID\nada;Ada;Lovelace;x;ada@x.org;11\n",
        "lms-id\tid\temail\tlast name\tfirst name\n11\tada\tada@x.org\tLovelace\tAda\n",
        f'{NAMES}"ada","Lovelace","Ada","ada@x.org","11"',
    ],
)
def test_it_is_read_as_spreadsheets_write_it(tmp_path, text):
    assert roster.read(written(tmp_path, text)).people == {"ada": ADA}


def test_only_the_id_is_needed(tmp_path):
    people = roster.read(written(tmp_path, "id\nada\nbob\n")).people
    assert people == {"ada": Person("ada"), "bob": Person("bob")}
    assert people["ada"].name == "ada"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("name\nada\n", "line 1: no column is called id"),
        ("", "line 1: no column is called id"),
        (
            "ID;Nachname;Vorname\nada;Lovelace;Ada\n",
            "line 1: of the columns Nachname, Vorname, none is known: call them last_name, first_name",
        ),
        (b"PK\x03\x04\x14", ": it is a spreadsheet's own file: save it as CSV, in UTF-8"),
        ("id,email,email\nada,a,b\n", "line 1: two columns are called email"),
        (f"{NAMES}ada,,,,\n\nada,,,,\n", "line 4: id 'ada' is that of a student above"),
        (f"{NAMES}ada,,,,7\nbob,,,,7\n", "line 3: lms_id '7' is that of a student above"),
        (f"{NAMES}ada,,,A@x.org,\nbob,,,a@x.org,\n", "line 3: email 'a@x.org' is that of"),
        (f"{NAMES},Lovelace,Ada,,\n", "line 2: this student has no id"),
        (f'{NAMES}"a\nb",,,,\n', "line 3: 'a\\nb' cannot be the name of a folder"),
        (f"{NAMES}../bob,,,,\n", "line 2: '../bob' cannot be the name of a folder"),
        (f"{NAMES}a*,,,,\n", "line 2: 'a*' cannot be the name of a folder"),
        (NAMES.encode() + b"ada,L\xf6w,,,\n", "line 2: it is not UTF-8"),
        (f'{NAMES}ada,"{"x" * 200_000}",,,\n', "line 2: field larger than field limit"),
    ],
)
def test_what_is_wrong_is_named_with_its_line(tmp_path, text, said):
    with pytest.raises(RosterError) as refused:
        roster.read(written(tmp_path, text))
    assert said in str(refused.value)
    assert str(refused.value).startswith(str(tmp_path / "class.csv"))


def test_a_name_is_found_as_platforms_write_it(tmp_path):
    text = f"{NAMES}eve,O'Neil-Müller,Ève,,\nsam,Lee,Sam,,\nlee,Sam,Lee,,\n"
    people = roster.read(written(tmp_path, text))
    for name in (
        "Ève O'Neil-Müller",
        "Ève ONeil-Müller",
        "oneilmüllerève",
        "E\u0300ve O’Neil-Mu\u0308ller",
    ):
        assert [one.id for one in people.named(name)] == ["eve"]
    assert {one.id for one in people.named("Sam Lee")} == {"sam", "lee"}
    assert people.named("") == people.named("-") == people.named("Eve ONeil") == []


def test_a_student_is_taken_out_and_every_other_line_stays(tmp_path):
    text = 'id;last_name;note\nada;Lovelace;"two\nlines; here"\nbob;"Doe; Jr.";x\n\neve;Eve;"a ""q"""\n'
    assert roster.without(written(tmp_path, text), "ada") == text.replace(
        'ada;Lovelace;"two\nlines; here"\n', ""
    )
    assert roster.without(written(tmp_path, text), "Lovelace") == text
