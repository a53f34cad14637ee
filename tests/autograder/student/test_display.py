"""What is printed in a notebook."""

import contextlib
import io

from hypothesis import given
from hypothesis import strategies as st
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output

from autograder.student.display import say

WORDS = st.lists(st.text(st.characters(categories=["L", "N"]), min_size=1, max_size=20), min_size=1)


@given(WORDS)
def test_a_line_ends_between_words(words):
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        say(" ".join(words))
    lines = printed.getvalue().splitlines()
    assert " ".join(lines) == " ".join(words)
    assert max(map(len, lines)) <= 78


def test_in_a_notebook_the_window_breaks_the_lines(monkeypatch):
    """What is printed there would break within words where the window is narrow."""
    monkeypatch.setattr(InteractiveShell, "_instance", None)
    InteractiveShell.instance()
    try:
        with capture_output() as shown:
            say("The check took q < 0, & no name. " + 30 * "word ")
    finally:
        InteractiveShell.clear_instance()
    (output,) = shown.outputs
    assert shown.stdout == ""
    assert "q &lt; 0, &amp; no name" in output.data["text/html"]
    assert "\n" not in output.data["text/html"]
    assert output.data["text/plain"].startswith("The check took q < 0, & no name.")
