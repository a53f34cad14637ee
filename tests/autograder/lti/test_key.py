"""The course's key: made once, nobody else's, and named where it cannot be used."""

import json
import os
import stat
from contextlib import chdir

import pytest

from autograder.cli import main
from autograder.lti import LtiError, key, sending
from autograder.lti.sending import How
from tests.autograder.lti.a_class import marks


def test_the_key_is_made_once_and_is_nobody_elses(tmp_path, capsys):
    (tmp_path / "nbgrader_config.py").touch()
    with chdir(tmp_path):
        assert main(["lti", "key"]) == 0
        first = capsys.readouterr().out
        assert main(["lti", "key"]) == 0
        again = capsys.readouterr().out
    assert "lti-key.pem: made. Keep it to yourself." in first
    assert "lti-key.pem: there already." in again
    assert first.partition("\n")[2] == again.partition("\n")[2]
    assert "BEGIN PUBLIC KEY" in first
    assert "PRIVATE" not in first
    (held,) = json.loads((tmp_path / key.KEY_SET).read_text())["keys"]
    printed = first[first.index("{") : first.rindex("}") + 1]  # as one pastes it into Canvas
    assert json.loads(printed) == held
    assert {"kty", "e", "n", "kid", "alg", "use"} <= held.keys()
    assert (held["kty"], held["alg"], held["use"]) == ("RSA", "RS256", "sig")
    assert "d" not in held
    if os.name == "posix":
        assert stat.S_IMODE((tmp_path / key.PRIVATE).stat().st_mode) == 0o600


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such permissions")
def test_a_key_that_others_can_read_is_refused(root):
    (root / key.PRIVATE).chmod(0o640)
    with pytest.raises(LtiError, match=r"other accounts can read .*: chmod 600"):
        key.read(root)


@pytest.mark.parametrize("text", [b"", b"x", b"-----BEGIN PRIVATE KEY-----\nxx\n-----END"])
def test_a_damaged_key_is_said_to_be_one(root, text):
    (root / key.PRIVATE).write_bytes(text)
    with pytest.raises(LtiError, match=r"holds no private RSA key .* the new public key"):
        key.read(root)


def test_a_public_key_is_no_private_one(root):
    (root / key.PRIVATE).write_bytes((root / key.PUBLIC).read_bytes())
    with pytest.raises(LtiError, match="holds no private RSA key"):
        key.read(root)


def test_without_a_key_the_error_says_how_to_make_one(root, platform):
    (root / key.PRIVATE).unlink()
    with pytest.raises(LtiError, match="run `autograder lti key` first"):
        sending.send(root, marks(), How())
