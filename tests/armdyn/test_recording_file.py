"""Files with recordings: good ones in every form, and bad ones, each with what is said of it."""

import numpy as np
import pytest

from armdyn.recording_file import read

GOOD = "t,q1,q2,u1,u2\n0,0.1,0.2,1,2\n0.01,0.11,0.21,1.1,2.1\n0.02,0.12,0.22,1.2,2.2\n"


@pytest.fixture
def written(tmp_path):
    def write(text):
        path = tmp_path / "arm.csv"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write


def assert_is_good(recording):
    np.testing.assert_allclose(recording.t, [0, 0.01, 0.02], atol=1e-12)
    np.testing.assert_allclose(recording.q, [[0.1, 0.2], [0.11, 0.21], [0.12, 0.22]], rtol=1e-6)
    np.testing.assert_allclose(recording.u, [[1, 2], [1.1, 2.1], [1.2, 2.2]], rtol=1e-12)


@pytest.mark.parametrize(
    "text",
    [
        GOOD,
        GOOD.replace("t,", "t_s,").replace("q1,q2", "q1_rad,q2_rad").replace("u1,u2", "tau1_Nm,u2_Nm"),
        b"\xef\xbb\xbf" + GOOD.replace("\n", "\r\n").encode(),
        GOOD.replace(",", " , ").replace("\n", "\n\n"),
        "u2,note,q2,u1,q1,t,q1_dot\n2,a,.2,1,.1,0,\n2.1,,.21,1.1,.11,1e-2,x\n2.2,b,.22,1.2,.12,.02,nan\n",
        "t_ms,q1_deg,q2,u1,u2\n0,5.7295780,0.2,1,2\n10,6.3025358,0.21,1.1,2.1\n20,6.8754935,.22,1.2,2.2",
    ],
    ids=["plain", "units", "of a spreadsheet", "spaces", "any order", "ms and degrees"],
)  # fmt: skip
def test_good_files(written, text):
    assert_is_good(read(written(text)))


def test_one_joint_and_a_path_as_text(written):
    recording = read(str(written("t,q1_m,u1_N\n0,1,2\n1e-3,9,3\n")))
    assert recording.q.tolist() == [[1], [9]]


BAD = {
    "empty": ("", "arm.csv: has 0 lines; needs one with names, and 2 samples or more"),
    "names alone": ("t,q1,u1\n", "has 1 lines"),
    "one sample": ("t,q1,u1\n0,0,0\n", "has 2 lines"),
    "no names": ("0,1,2\n1,2,3\n2,3,4\n", "no column t, which may be named t_s or t_ms, too"),
    "no torque": (GOOD.replace("u2", "i2"), "no column u2, which may be named u2_Nm or u2_N, too"),
    "another unit": (GOOD.replace("u1", "u1_mNm"), "no column u1"),
    "counted from 0": (GOOD.replace("q1,q2", "q0,q1"), "column q0; needs joints .* from 1"),
    "twice": (GOOD.replace("u2", "tau1"), "two columns are u1; needs one"),
    "semicolons": (
        GOOD.replace(",", ";"),
        "the first line is 't;q1;q2;u1;u2'; separate .* by commas",
    ),
    "empty cell": (GOOD.replace("0.21", ""), "arm.csv, line 3: q2 is ''; needs a finite number"),
    "NaN": (GOOD.replace("2.1", "NaN"), "line 3: u2 is 'NaN'"),
    "infinite": (GOOD.replace("0.12", "inf"), "line 4: q1 is 'inf'"),
    "a word": (GOOD.replace("0.02", "<b>" * 99), "line 4: t is '<b><b>.*…'; needs a finite number"),
    "short line": (GOOD.replace(",1.2,2.2", ""), "line 4: u1 is ''"),
    "back in time": (
        GOOD.replace("0.02", "0.005"),
        "line 4: t is 0.005 s after 0.01 s; needs increasing",
    ),
    "same time": (GOOD.replace("0.02", "0.01"), "line 4: t is 0.01 s after 0.01 s"),
    "milliseconds": (
        GOOD.replace("0.01,", "10,").replace("0.02,", "20,"),
        "most steps of t are 10: are these ms. Name the column t_ms, or t_s",
    ),
    "degrees": (
        GOOD.replace("0.1,", "-40,").replace("0.12,", "35.5,"),
        "q1 goes from -40 to 35.5: are these degrees. Name the column q1_deg, or q1_rad",
    ),
    "a turn back": (GOOD.replace("0.22", "-6"), "line 4: q2 jumps by -6.21 rad; .* use np.unwrap"),
    "not text": (b"\x89PNG\r\n\x1a\n\x00\x00" * 9, "no column t, .* the first line is "),
}


@pytest.mark.parametrize("kind", BAD)
def test_bad_files(written, kind):
    text, says = BAD[kind]
    with pytest.raises(ValueError, match=says) as refused:
        read(written(text))
    assert len(str(refused.value)) < 250


def test_a_unit_that_is_said_is_believed(written):
    far = GOOD.replace("q1", "q1_rad").replace("t,", "t_s,").replace("\n0.0", "\n1")
    far = far.replace("0.1,", "-9,").replace("0.11,", "-6,").replace("0.12,", "-3.5,")
    assert read(written(far)).q[0, 0] == -9


def test_no_such_file(tmp_path):
    with pytest.raises(FileNotFoundError):
        read(tmp_path / "none.csv")
