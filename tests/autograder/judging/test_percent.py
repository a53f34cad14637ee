"""Shares are written in one way on cards, in reports and in tables."""

import re
from pathlib import Path

import pytest

import autograder
from autograder.judging.percent import percent

PACKAGE = Path(autograder.__file__).parent


@pytest.mark.parametrize(
    ("share", "text"),
    [(0.28, "28 %"), (1 / 3, "33 %"), (1.2, "120 %"), (0.01, "1 %"), (0.003, "0.3 %"), (1e-5, "0.001 %"),
     (-0.5, "50 %"), (0.0, "0 %"), (1.0, "100 %")],
)  # fmt: skip
def test_a_share_in_per_cent(share, text):
    assert percent(share) == text


def test_nothing_else_writes_a_share():
    """Python's own format has no space before the sign, and rounds otherwise."""
    found = [
        path.relative_to(PACKAGE)
        for path in PACKAGE.rglob("*.py")
        if re.search(r":\.\d%}|:%}", path.read_text(encoding="utf-8"))
    ]
    assert not found
