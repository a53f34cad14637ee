"""The numbers of many mistakes at once are those that are formed one by one."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.judging.quantities import each
from autograder.judging.stacked import layouts, rows, unlike
from autograder.protocol import Call

NOTHING = np.zeros(0)


@each
def _parts(call, value):
    """Linear in the value for one call, and not so for the other; long motions speak of the second."""
    (is_square,) = call.args
    return (value**2 if is_square else 3 * value, value[:1] if len(value) > 2 else NOTHING)


def _of_all(calls, values):
    """Judged together: each less the first."""
    return [(np.asarray(value) - values[0][0],) for value in values]


@settings(max_examples=30)
@given(
    lengths=st.lists(st.integers(1, 4), min_size=1, max_size=6),
    squares=st.integers(0, 63),
    answers=st.integers(1, 12),
    seed=st.integers(0, 2**32 - 1),
    together=st.booleans(),
)
def test_motions_of_different_lengths(lengths, squares, answers, seed, together):
    rng = np.random.default_rng(seed)
    quantities = _of_all if together else _parts
    calls = [Call("f", (bool(squares >> k & 1),)) for k in range(len(lengths))]
    values = [[rng.uniform(-1, 1, length) for length in lengths] for _ in range(answers)]
    expected = quantities(calls, values[0])
    layout = layouts(expected, expected)
    found = unlike(layout, quantities, calls, values)
    for k, own in enumerate(values):
        for one, all_of_them in zip(rows(layout, quantities(calls, own)), found, strict=True):
            np.testing.assert_allclose(all_of_them[k], one, rtol=1e-9, atol=1e-12)
