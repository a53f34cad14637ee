"""Random arms that have links, and so a regressor: planar and spatial, as Hypothesis strategies."""

from hypothesis import strategies as st

from armdyn import PlanarChain
from tests.armdyn.arms import arms, between, inertias, lengths, masses, offsets
from tests.armdyn.chains import spatial_chains


@st.composite
def planar_chains(draw, most=5, least_g=0):
    n = draw(st.integers(1, most))
    l, lc, m, I, ly = (
        draw(st.tuples(*[each] * n)) for each in (lengths, offsets, masses, inertias, offsets)
    )
    return PlanarChain(l, lc, m, I, g=draw(between(least_g, 20)), ly=ly)


any_arm = arms() | planar_chains() | spatial_chains()
