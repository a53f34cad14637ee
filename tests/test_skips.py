"""A test that lacks a program is skipped on a developer's machine and fails in CI."""

from pathlib import Path

import pytest

pytest_plugins = ["pytester"]

NEEDY = """
import pytest

def test_needy(needs):
    needs("chromium")

def test_other():
    pass

@pytest.mark.xfail
def test_expected_to_fail():
    assert False
"""


@pytest.fixture
def inner(pytester, monkeypatch):
    """A test folder under this one's conftest, on a machine where no program is found."""
    pytester.makeconftest(Path(__file__).with_name("conftest.py").read_text())
    monkeypatch.setenv("PATH", "")
    return pytester


def test_skip_is_one_line_that_says_what_to_install(inner, monkeypatch):
    monkeypatch.delenv("CI", raising=False)
    inner.makepyfile(NEEDY)
    result = inner.runpytest_inprocess("-rs")
    result.assert_outcomes(passed=1, skipped=1, xfailed=1)
    result.stdout.fnmatch_lines(["SKIPPED*needs chromium: apt install chromium"])


def test_skip_fails_in_ci(inner, monkeypatch):
    monkeypatch.setenv("CI", "true")
    inner.makepyfile(NEEDY)
    result = inner.runpytest_inprocess()
    result.assert_outcomes(passed=1, failed=1, xfailed=1)
    result.stdout.fnmatch_lines(["*nothing may be skipped*needs chromium: apt install chromium*"])


def test_module_skipped_whole_fails_in_ci(inner, monkeypatch):
    monkeypatch.setenv("CI", "true")
    inner.makepyfile("import pytest; pytest.importorskip('no_such_module')")
    inner.runpytest_inprocess().assert_outcomes(errors=1)
