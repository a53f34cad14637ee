"""Random physical arms and states, as Hypothesis strategies."""

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from armdyn import Pendulum, Planar2R

# Each example is a whole batch of states.
a_few = settings(deadline=None, max_examples=25)


def between(low, high):
    return st.floats(low, high, allow_subnormal=False)


lengths = between(0.05, 3)
offsets = between(-2, 2)
masses = between(0.05, 20)
inertias = between(1e-3, 5)
frictions = between(0, 4)


def planar_arms(viscous=frictions, coulomb=frictions):
    return st.builds(
        Planar2R,
        l1=lengths,
        l2=lengths,
        lc1=offsets,
        lc2=offsets,
        m1=masses,
        m2=masses,
        I1=inertias,
        I2=inertias,
        g=between(0, 20),
        viscous=st.tuples(viscous, viscous),
        coulomb=st.tuples(coulomb, coulomb),
    )


def pendulums(viscous=frictions, coulomb=frictions):
    return st.builds(
        Pendulum.from_com,
        m=masses,
        lc=lengths,
        I_com=inertias,
        g=between(0, 20),
        viscous=viscous,
        coulomb=coulomb,
    )


def arms(viscous=frictions, coulomb=frictions):
    return planar_arms(viscous, coulomb) | pendulums(viscous, coulomb)


def vectors(n, size=6.0, batch=()):
    return hnp.arrays(float, (*batch, n), elements=between(-size, size))


@st.composite
def arms_and_states(draw, arm_strategy=None, parts=3):
    """An arm and `parts` arrays (q, q̇, then q̈ or u) with one common batch shape."""
    arm = draw(arm_strategy if arm_strategy is not None else arms())
    batch = draw(st.sampled_from([(), (1,), (4,), (2, 3)]))
    return arm, *(draw(vectors(arm.n, batch=batch)) for _ in range(parts))


def rate(function, x, direction, h=1e-3):
    """d/ds function(x + s·direction) at s = 0, by sixth-order central differences."""
    weights = {1: 45, 2: -9, 3: 1}
    terms = (
        w * (function(x + k * h * direction) - function(x - k * h * direction))
        for k, w in weights.items()
    )
    return sum(terms) / (60 * h)


def assert_close(a, b, size=1.0, tolerance=1e-12):
    """|a − b| ≤ tolerance · (the largest of a, b and `size`)."""
    a, b = np.asarray(a), np.asarray(b)
    assert a.shape == b.shape
    largest = max(np.max(np.abs(a)), np.max(np.abs(b)), np.max(size))
    assert np.max(np.abs(a - b)) <= tolerance * largest
