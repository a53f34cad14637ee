"""nbgrader's environment variables are gone again after an error."""

import os

import pytest
from nbgrader import utils

from autograder.nbgrader_glue import environment


class SomeError(Exception):
    pass


def fail_in(**variables):
    with utils.setenv(**variables):
        assert variables.items() <= os.environ.items()
        raise SomeError


@pytest.fixture
def mended(monkeypatch):
    monkeypatch.setattr(utils, "setenv", utils.setenv)
    environment.mend()


@pytest.mark.parametrize("before", [None, "grade"])
def test_afterwards_it_is_as_before(before, mended, monkeypatch):
    if before is None:
        monkeypatch.delenv("NBGRADER_EXECUTION", raising=False)
    else:
        monkeypatch.setenv("NBGRADER_EXECUTION", before)
    with pytest.raises(SomeError):
        fail_in(NBGRADER_EXECUTION="validate", NBGRADER_VALIDATING="1")
    assert os.environ.get("NBGRADER_EXECUTION") == before
    assert "NBGRADER_VALIDATING" not in os.environ
    with utils.setenv(NBGRADER_EXECUTION="autograde"):
        assert os.environ["NBGRADER_EXECUTION"] == "autograde"
    assert os.environ.get("NBGRADER_EXECUTION") == before
