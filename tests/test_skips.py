"""A test that lacks a program is skipped, and the last lines say what to install; in CI it fails."""

from pathlib import Path

import pytest

pytest_plugins = ["pytester"]

NEEDY = """
import pytest

@pytest.mark.parametrize("program", ["chromium", "octave", "chromium"])
def test_needy(needs, program):
    needs(program)

def test_in_need_of_a_library():
    why = "needs no_such_module: pip install -c constraints.txt -e .[peers]"
    pytest.importorskip("no_such_module", reason=why)

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


def test_the_last_lines_say_once_what_to_install(inner, monkeypatch):
    monkeypatch.delenv("CI", raising=False)
    inner.makepyfile(NEEDY)
    result = inner.runpytest_inprocess()
    result.assert_outcomes(passed=1, skipped=4, xfailed=1)
    *_, title, apt, pip, last = result.outlines
    assert title.strip("- ") == "4 skipped; to run them as well"
    assert apt == "apt install chromium octave"
    assert pip == "pip install -c constraints.txt -e .[peers]"
    assert "1 passed, 4 skipped" in last


def test_another_reason_is_a_line_of_its_own(inner, monkeypatch):
    monkeypatch.delenv("CI", raising=False)
    inner.makepyfile("import pytest\n@pytest.mark.skip(reason='not on Tuesdays')\ndef test(): pass")
    *_, _, why, _ = inner.runpytest_inprocess().outlines
    assert why == "not on Tuesdays"


def test_a_skip_fails_in_ci(inner, monkeypatch):
    monkeypatch.setenv("CI", "true")
    inner.makepyfile(NEEDY)
    result = inner.runpytest_inprocess()
    result.assert_outcomes(passed=1, failed=4, xfailed=1)
    result.stdout.fnmatch_lines(["*nothing may be skipped*needs chromium: apt install chromium*"])


def test_what_the_project_may_not_contain_is_skipped_in_ci_too(inner, monkeypatch):
    monkeypatch.setenv("CI", "true")
    why = "set DATA to the folder of a record, which is not part of the project"
    inner.makepyfile(f"import pytest\ndef test(): pytest.skip({why!r})")
    result = inner.runpytest_inprocess()
    result.assert_outcomes(skipped=1)
    *_, line, _ = result.outlines
    assert line == why


def test_module_skipped_whole_fails_in_ci(inner, monkeypatch):
    monkeypatch.setenv("CI", "true")
    inner.makepyfile("import pytest; pytest.importorskip('no_such_module')")
    inner.runpytest_inprocess().assert_outcomes(errors=1)
