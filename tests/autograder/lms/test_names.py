"""File names of Moodle and Canvas lead back to students, and to what these called their files."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.lms.file_names import CANVAS, MOODLE, copy_of, is_anonymous, origin
from autograder.roster import folded
from tests.autograder.lms.platforms import canvas_name, clean_filename, moodle_folder

P3 = "p3-pendulum"
NAMES = st.text(
    st.characters(exclude_categories=["Cs"], exclude_characters="/\\\x00"), min_size=1, max_size=20
)


@pytest.mark.parametrize(
    ("name", "number"),
    [
        ("p3-pendulum.ipynb", 0),
        ("p3-pendulum (1).ipynb", 1),
        ("p3-pendulum(12).ipynb", 12),
        ("p3-pendulum-Copy1.ipynb", 1),
        ("p3-pendulum-Copy12.ipynb", 12),
        ("p3-pendulum - Copy.ipynb", 1),
        ("p3-pendulum - Kopie (2).ipynb", 2),
        ("Copy of p3-pendulum.ipynb", 1),
        ("p3-pendulum-3.ipynb", 3),
        ("p3-pendulum-Copy1 (2).ipynb", 2),
        ("P3_Pendulum.IPYNB", 1),
        ("p3-pendulum.ipynb.txt", 1),
        ("p3-pendulum.ipynb.json", 1),
        ("problems_p3-pendulum_p3-pendulum.ipynb", 0),
        ("problems-p3-pendulum-p3-pendulum (2).ipynb", 2),
        ("Copy of problems_p3-pendulum_p3-pendulum.ipynb", 0),
        ("problems_p4-gravity_p3-pendulum.ipynb", None),
        ("p3-pendulum-final.ipynb", None),
        ("p3-pendulum2.ipynb", None),
        ("my p3-pendulum.ipynb", None),
        ("p3-pendulum.py", None),
        ("p4-gravity.ipynb", None),
        (".ipynb", None),
    ],
)
def test_copies_of_the_notebook(name, number):
    assert copy_of(name, P3) == number


@given(NAMES, st.integers(1, 10**9), NAMES, st.booleans())
def test_moodles_folders_lead_back(name, number, file, since):
    folder = moodle_folder(name, number, since)
    found = origin((folder, file))
    assert found.platform == MOODLE
    assert found.number == str(number)
    assert folded(found.name) == folded(clean_filename(name))
    assert found.parts == (file,)
    flat = origin((f"{moodle_folder(name, number)}_{file}",))
    assert (flat.number, flat.parts) == (str(number), (file,))


@given(NAMES, st.integers(1, 10**9), st.integers(1, 10**9), NAMES, st.booleans())
def test_canvas_names_lead_back(name, user, file, display, late):
    given_out = canvas_name(name, user, file, display, late)
    found = origin((given_out,))
    assert found.platform == CANVAS
    if "_" not in name:
        assert (found.number, found.late) == (str(user), late)
        assert given_out.endswith(found.parts[0])


def test_a_students_own_name_of_a_file_is_no_other_students():
    """Whoever calls a file as the platform calls another's hand-in hands in for nobody else."""
    inside = moodle_folder("Bob Doe", 2)
    assert origin((moodle_folder("Ada Lovelace", 1), inside, "x.ipynb")).number == "1"
    assert origin((canvas_name("Lovelace, Ada", 1, 7, "doebob_2_8_x.ipynb"),)).number == "1"


def test_an_outer_folder_and_typed_text_and_what_is_neithers():
    assert origin(("download", moodle_folder("Ada", 3), "sub", "a.ipynb")).parts == (
        "sub",
        "a.ipynb",
    )
    assert origin(("Ada_3_assignsubmission_onlinetext", "onlinetext.html")).typed
    assert origin(("lovelaceada_98_text.html",)).typed
    assert origin(("ada", "p3-pendulum.ipynb")) is None
    assert (
        origin(("ada", "work", "run_98_7654_data.csv")) is None
    )  # of a student, and not of Canvas
    assert is_anonymous(("anon_x9Yz1_7654_p3-pendulum.ipynb",))
    assert is_anonymous(("LATE_anon_x9Yz1_7654_p3-pendulum.ipynb",))
