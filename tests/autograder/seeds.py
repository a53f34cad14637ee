"""The seeds over which right answers have to be right: 48 of a thousand, and all in a night."""

import pytest

A_THOUSAND = pytest.mark.parametrize(
    "seeds",
    [range(0, 1000, 21), pytest.param(range(1000), marks=pytest.mark.long)],
    ids=["some", "all"],
)
