"""What stands behind the command's options is refused in a sentence with an example, before any work."""

import pytest

from autograder.cli import main

LONG = "x" * 300
RAW = ("Traceback", "Errno", "invalid", "isoformat", "literal", "int()", "must be in")
REFUSED = {
    ("open-solution", "p3-pendulum", "--on"): {
        **dict.fromkeys(("gestern", "2026-13-45", "99999", "0001-01-01", ""), "is no time; write it as"),
        "with full marks": "there is --full-marks for that",
        LONG: "is no time",
    },
    ("grade", "p3-pendulum", "--jobs"): dict.fromkeys(
        ("0", "-3", "two", "1.5", "", "9" * 30, "1001"), "is no number from 1 to 1000, such as 4"
    ),
    ("grade", "p3-pendulum", "--scheduler"): dict.fromkeys(
        ("nowhere", "", "tcp://x:abc", "foo://x:1", "x:99999", "x:0", "tcp://:1"),
        "is no address with a port, such as tcp://",
    ),
    ("try", "cart-pole", "--asks"): dict.fromkeys(("", "M,,C", "M,"), "write it as M,C"),
    ("new-problem", "cart-pole", "--asks"): dict.fromkeys(("", ",M"), "write it as M,C"),
    ("try", "cart-pole", "--to"): {
        "/nowhere/at/all": "there is no folder /nowhere/at to put all in",
        ".": "is no name of a file",
        "": "is no name of a file",
    },
    ("collect-zip", "--roster"): dict.fromkeys(("nowhere.zip", ""), "there is no file "),
    ("export", "--sheet"): dict.fromkeys(("nowhere.csv", "", LONG), "there is no file "),
    ("export", "--column"): dict.fromkeys(
        ("p3-pendulum", "=x", "p3=", "", LONG), "is no ASSIGNMENT=HEADING"
    ),
    ("export", "--count"): dict.fromkeys(("", "p1,,p2"), "write it as M,C"),
    ("export", "--to"): {"/nowhere/at/all": "there is no folder /nowhere/at to put all in"},
    ("try",): {"": "name a mechanism, such as cart-pole", LONG: "more than 100 characters"},
    ("new-problem",): {" ": "name a mechanism, such as cart-pole", LONG: "more than 100 characters"},
    **{(command,): {LONG: "more than 100 characters"}
       for command in ("grade", "report", "open-solution")},
}  # fmt: skip


@pytest.mark.parametrize(
    ("command", "value", "said"),
    [(command, *one) for command, values in REFUSED.items() for one in values.items()],
)
def test_it_is_refused_in_a_sentence(command, value, said, capsys):
    *before, last = command
    # As one word, since a value may begin with a hyphen.
    arguments = [*before, f"{last}={value}"] if last.startswith("-") else [last, value]
    with pytest.raises(SystemExit) as stopped:
        main(arguments)
    assert stopped.value.code == 2
    error = capsys.readouterr().err.splitlines()[-1]
    assert said in error
    assert not [word for word in RAW if word in error]
    assert len(error) < 200


@pytest.mark.parametrize(
    "arguments",
    [
        ["open-solution", "p3-pendulum", "--on", "2026-12-15"],
        ["open-solution", "p3-pendulum", "--on", "2026-12-15 12:00"],
        ["open-solution", "p3-pendulum", "--on", "2026-12-15T12:00+02:00"],
        ["grade", "p3-pendulum", "--jobs", "8", "--scheduler", "tcp://10.0.0.5:8786"],
        ["grade", "p3-pendulum", "--scheduler", "tls://[::1]:8786"],
        ["grade", "p3-pendulum", "--scheduler", "head.cluster:8786"],
        ["new-problem", "cart-pole", "--asks", "M, C"],
    ],
)
def test_what_is_right_is_taken(arguments, tmp_path, monkeypatch, capsys):
    """The next thing that is wrong is the folder."""
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 2
    assert "is not the course's folder" in capsys.readouterr().err
