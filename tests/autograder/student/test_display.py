"""What is printed in a notebook."""

import contextlib
import io

from hypothesis import given
from hypothesis import strategies as st

from autograder.student.display import say

WORDS = st.lists(st.text(st.characters(categories=["L", "N"]), min_size=1, max_size=20), min_size=1)


@given(WORDS)
def test_a_line_ends_between_words(words):
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        say(" ".join(words))
    lines = printed.getvalue().splitlines()
    assert " ".join(lines) == " ".join(words)
    assert max(map(len, lines)) <= 78
