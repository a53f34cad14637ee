from fractions import Fraction

import numpy as np
import pytest

from armdyn import Pendulum, Planar2R

PENDULUM = {"m": 1.0, "lc": 0.5, "I": 2.0}
PLANAR = {"l1": 1, "l2": 1, "lc1": 0.5, "lc2": 0.5, "m1": 1, "m2": 1, "I1": 0.1, "I2": 0.1}
FRICTION = ("viscous", "coulomb")
NOT_NUMBERS = [
    np.nan, np.inf, -np.inf, True, np.True_, None, "1.0", 1j, [1.0], [[1.0], [2.0]], [], (), {},
    np.array([1.0]), 10**400, 1e60,
]  # fmt: skip


@pytest.mark.parametrize("value", NOT_NUMBERS, ids=lambda v: repr(v)[:12])
@pytest.mark.parametrize("name", [*PENDULUM, "g", *FRICTION])
def test_a_pendulum_names_what_is_not_a_number(name, value):
    with pytest.raises(ValueError, match=rf"^{name} = .*: needs one finite number, in \S+"):
        Pendulum(**PENDULUM | {name: value})


@pytest.mark.parametrize("value", NOT_NUMBERS, ids=lambda v: repr(v)[:12])
@pytest.mark.parametrize("name", [*PLANAR, "g"])
def test_a_planar_arm_names_what_is_not_a_number(name, value):
    with pytest.raises(ValueError, match=rf"^{name} = .*: needs one finite number, in \S+"):
        Planar2R(**PLANAR | {name: value})


@pytest.mark.parametrize("name", ["m", "I"])
@pytest.mark.parametrize("value", [0, -1.0])
def test_a_pendulum_needs_mass_and_inertia(name, value):
    with pytest.raises(ValueError, match=rf"^{name} = {value}: must be greater than 0 kg"):
        Pendulum(**PENDULUM | {name: value})


@pytest.mark.parametrize("name", ["lc", *FRICTION])
def test_a_pendulum_refuses_what_is_negative(name):
    with pytest.raises(ValueError, match=rf"^{name} = -0\.1: must not be negative"):
        Pendulum(**PENDULUM | {name: -0.1})


@pytest.mark.parametrize("name", ["l1", "l2"])
@pytest.mark.parametrize("value", [0, -1.0])
def test_a_link_needs_length(name, value):
    with pytest.raises(ValueError, match=rf"^{name} = {value}: must be greater than 0 m"):
        Planar2R(**PLANAR | {name: value})


@pytest.mark.parametrize("name", ["m1", "m2", "I1", "I2"])
def test_a_planar_arm_refuses_what_is_negative(name):
    with pytest.raises(ValueError, match=rf"^{name} = -2: must not be negative \(kg"):
        Planar2R(**PLANAR | {name: -2})


def test_zero_mass_and_a_counterweight_are_allowed():
    arm = Planar2R(**PLANAR | {"m1": 0, "I1": 0, "lc1": -0.3})
    assert (arm.m1, arm.I1, arm.lc1) == (0, 0, -0.3)


@pytest.mark.parametrize("name", FRICTION)
@pytest.mark.parametrize(
    "value",
    [0.1, [0.1], [0.1, 0.2, 0.3], [], None, "ab", {0.1, 0.2}, {0.1: 1, 0.2: 2}, np.array(0.1)],
    ids=lambda v: repr(v)[:16],
)
def test_friction_needs_one_number_per_joint(name, value):
    with pytest.raises(ValueError, match=rf"^{name} = .*needs 2 numbers, one per joint, in N·m"):
        Planar2R(**PLANAR, **{name: value})


@pytest.mark.parametrize("name", FRICTION)
@pytest.mark.parametrize("entry", [np.nan, True, None, "1", 1j, [1.0, 2.0], -0.1])
def test_friction_names_the_entry_at_fault(name, entry):
    ragged = isinstance(entry, list)
    value = [[1.0, 2.0], entry] if ragged else [0.1, entry]
    with pytest.raises(ValueError, match=rf"^{name}\[{0 if ragged else 1}\] = "):
        Planar2R(**PLANAR, **{name: value})


@pytest.mark.parametrize("sequence", [list, tuple, np.array])
def test_friction_is_kept_as_a_tuple_of_floats(sequence):
    arm = Planar2R(**PLANAR, viscous=sequence([1, 2]), coulomb=sequence([0, 3]))
    same = Planar2R(**PLANAR, viscous=(1.0, 2.0), coulomb=(0.0, 3.0))
    assert arm == same
    assert hash(arm) == hash(same)
    assert arm.viscous == (1.0, 2.0)
    assert all(type(entry) is float for entry in arm.viscous + arm.coulomb)


def test_any_real_number_becomes_a_float():
    arm = Planar2R(**PLANAR | {"m1": Fraction(1, 2), "I1": np.float32(0.5), "lc1": np.int8(1)})
    assert (arm.m1, arm.I1, arm.lc1) == (0.5, 0.5, 1.0)
    assert type(arm.m1) is type(arm.I1) is type(arm.lc1) is float


def test_the_largest_numbers_do_not_overflow():
    arm = Planar2R(*[1e50] * 8)
    assert np.isfinite(arm.M([0.0, 0.0])).all()


def test_every_parameter_gives_its_unit_and_meaning():
    for model in (Pendulum, Planar2R):
        for parameter in model.__dataclass_fields__.values():
            assert {"unit", "doc"} <= set(parameter.metadata)
