"""Units: one spelling of each, whatever the lecturer types."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.mechanisms import MECHANISMS
from autograder.mechanisms.units import KNOWN, dimension_of, spelled
from autograder.mutation.checks import check_of

POWERS = st.lists(
    st.tuples(st.sampled_from([name for name in KNOWN if name != "1"]), st.integers(-3, 3)),
    min_size=1,
)


@pytest.mark.parametrize(
    ("typed", "read"),
    [
        ("kg m^2", "kg·m²"), ("kg*m**2", "kg·m²"), ("m/s^2", "m/s²"), ("m s^-2", "m/s²"),
        ("N/m", "N/m"), ("N*m*s/rad", "N·m·s/rad"), ("kg/(m*s)", "kg/(m·s)"), ("s^-1", "1/s"),
    ],
)  # fmt: skip
def test_a_unit_is_shown_in_one_spelling(typed, read):
    assert spelled(typed) == read


@given(POWERS)
def test_the_spelling_keeps_the_unit(powers):
    typed = "*".join(f"{name}**{power}" for name, power in powers)
    assert dimension_of(spelled(typed)) == dimension_of(typed)
    assert spelled(spelled(typed)) == spelled(typed)
    assert spelled(typed, per=typed) == "1"


@pytest.mark.parametrize("gravity", ["m/s^2", "m/s**2", "m*s^-2"])
@pytest.mark.parametrize("name", ["cart-pole", "spring-cart"])
def test_a_regressor_knows_gravity_in_every_spelling(name, gravity):
    mechanism = MECHANISMS[name]
    typed = replace(
        mechanism,
        parameters=tuple(
            replace(p, unit=gravity if p.unit == "m/s²" else p.unit.replace("·m²", " m^2"))
            for p in mechanism.parameters
        ),
    )
    assert typed.parameters == mechanism.parameters
    asked = check_of(typed, "regressor")
    assert asked.criteria == check_of(mechanism, "regressor").criteria
    assert not any("/(N/m)" in criterion.unit for criterion in asked.criteria)
