import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from armdyn import Link, Pendulum, Planar2R, SerialChain
from armdyn.base_parameters import base_parameters, on_link_axes
from armdyn.geometry import fall_time, joint_units, powers_of_length, reach
from armdyn.regressor import parameter_names, regressor
from armdyn.spatial import rotation
from tests.armdyn.arms import a_few, assert_close, between
from tests.armdyn.chains import links, rotations
from tests.armdyn.linked_arms import any_arm, planar_chains
from tests.armdyn.puma import puma_560
from tests.armdyn.urdf_files import Part, all_moving

ARM = Planar2R(l1=1.3, l2=0.8, lc1=0.5, lc2=0.4, m1=2, m2=1.5, I1=0.2, I2=0.1)


def stacked(arm, count=60):
    states = np.random.default_rng(4).uniform(-3, 3, (3, count, arm.n))
    Y = regressor(arm, *states)
    return Y.reshape(-1, Y.shape[-1])


@pytest.mark.parametrize(
    ("g", "on_axes", "rank"), [(9.81, True, 4), (9.81, False, 6), (0, True, 3), (0, False, 4)]
)
@pytest.mark.parametrize("l1", [1e-3, 1.3, 1e3])
def test_base_parameters_of_the_2r(g, on_axes, rank, l1):
    # Trap 6: these many while l1 is known.
    arm = replace(ARM, g=g, l1=l1)
    columns = on_link_axes(arm) if on_axes else None
    assert base_parameters(arm, columns).rank == rank


def test_five_parameters_only_while_l1_is_unknown():
    # m2 cx2 enters the inertia times l1 and gravity alone: with l1 unknown, as two parameters.
    with_gravity, without = stacked(ARM), stacked(replace(ARM, g=0))
    base = [parameter_names(ARM).index(name) for name in ("J1", "J2", "m1 cx1")]
    inertial, gravitational = without[:, 5], (with_gravity - without)[:, 5]
    lumped = np.column_stack([with_gravity[:, base], inertial, gravitational])
    assert np.linalg.matrix_rank(lumped) == 5
    known = np.column_stack([with_gravity[:, base], inertial + gravitational])
    assert np.linalg.matrix_rank(known) == base_parameters(ARM, on_link_axes(ARM)).rank == 4


def test_base_parameters_in_words():
    assert base_parameters(ARM, on_link_axes(ARM)).descriptions == (
        "m1 cx1 + 1.3 m2",
        "J1 + 1.69 m2",
        "m2 cx2",
        "J2",
    )
    assert str(base_parameters(Pendulum(1, 0.5, 1))) == ("3 base parameters: m1 cx1; m1 cy1; J1")


@a_few
@given(planar_chains(least_g=1))
def test_a_planar_chain_has_three_per_link(chain):
    base = base_parameters(chain)
    assert base.rank == 3 * chain.n
    # Each mass moves into the links before; that of the first is seen by no joint.
    assert {base.names[j] for j in base.independent} == {
        name for name in base.names if name.startswith("J") or " c" in name
    }
    l = np.array(chain.l)
    masses_in_J = base.combination[base.independent.index(3), 4::4]
    np.testing.assert_allclose(masses_in_J, l[0] ** 2, rtol=1e-7)
    assert not base.combination[:, 0].any()


def test_a_standing_chain_with_vertical_first_axis_shows_only_what_turns():
    link = Link("revolute", 2.0, com=(0.1, 0.2, 0.3), inertia=np.eye(3))
    assert base_parameters(SerialChain((link,))).descriptions == ("Jzz1",)
    slide = Link("prismatic", 2.0, com=(0.1, 0.2, 0.3), inertia=np.eye(3))
    assert base_parameters(SerialChain((slide,))).descriptions == ("m1",)
    # A second slider in another direction carries, and is carried by, the first.
    across = replace(slide, axis=(1.0, 0.0, 0.0))
    assert base_parameters(SerialChain((slide, across))).descriptions == ("m1", "m2")


@pytest.mark.parametrize("columns", [(), (0, 0), (8,), (-1,), (0.5,), "m1", 3, [True] * 3])
def test_bad_columns_are_refused(columns):
    with pytest.raises(ValueError, match=r"^columns = .* needs distinct indices from 0 to 7"):
        base_parameters(ARM, columns)


def in_the_arm_s_units(arm, seed=5):
    """Y at states of its own, (120 n, p), with lengths in reaches and times in fall times."""
    length, time, units = reach(arm), fall_time(arm), joint_units(arm)
    q, qd, qdd = np.random.default_rng(seed).uniform(-3, 3, (3, 120, arm.n)) * units
    Y = regressor(arm, q, qd / time, qdd / time**2) * units[:, np.newaxis] * (time / length) ** 2
    unit = length ** powers_of_length(parameter_names(arm))
    return Y.reshape(-1, Y.shape[-1]) * unit, unit


def assert_base(arm, base):
    W, unit = in_the_arm_s_units(arm)
    kept, dropped = base.gap
    independent = list(base.independent)
    # All that the torque shows, to what was cut off …
    share = base.combination * unit / unit[independent, np.newaxis]
    assert_close(W[:, independent] @ share, W, tolerance=1e-8 + 100 * dropped)
    # … and nothing that it does not show: no base parameter changes without a trace.
    if independent:
        assert np.linalg.cond(W[:, independent]) < 300 / kept
        assert base.condition < 300 / kept
    np.testing.assert_array_equal(base.combination[:, independent], np.eye(base.rank))
    assert kept > base.cut > dropped
    assert len(base.dropped) == len(base.columns) - base.rank


@a_few
@given(any_arm)
def test_base_parameters_are_all_that_the_torque_shows(arm):
    assert_base(arm, base_parameters(arm))


@a_few
@given(st.lists(links(("revolute",)), min_size=3, max_size=3), between(-9, 0), rotations())
def test_axes_that_are_nearly_parallel_show_as_parallel_or_not_at_all(bodies, power, turn):
    # The angle between the axes from nothing to something: at none is the base a bad one.
    off = rotation(turn[:, 2], 10.0**power)
    first, second, third = (
        replace(body, axis=(0.0, 0.0, 1.0), rotation=R)
        for body, R in zip(bodies, (np.eye(3), off, off.T), strict=True)
    )
    arm = SerialChain((first, second, third))
    base = base_parameters(arm)
    assert_base(arm, base)
    if power < -7:
        exact = (replace(body, rotation=np.eye(3)) for body in arm.links)
        assert base.rank == base_parameters(replace(arm, links=tuple(exact))).rank


def test_a_puma_560_has_36_however_its_file_rounds():
    exact = base_parameters(puma_560())
    assert (exact.rank, exact.remark) == (36, "")
    for digits in (3, 4, 6):
        arm = puma_560(digits)
        base = base_parameters(arm)
        assert base.independent == exact.independent
        assert base.clear
        np.testing.assert_allclose(base.combination, exact.combination, atol=3 * 10.0**-digits)
        assert base.remark.startswith("2 more would show, by ")
        assert base.remark in str(base)
        # Each digit believed: the axis that is not quite upright shows two more of link 1.
        believed = base_parameters(arm, tolerance=0)
        assert believed.rank == 38
        assert believed.condition > 100 * base.condition
        assert_base(arm, believed)


def test_what_only_rounding_adds_is_not_in_the_words():
    exact, rounded = (base_parameters(puma_560(digits)) for digits in (None, 5))
    kinds = [[re.sub(r"[\d.]+ ", "", words) for words in b.descriptions] for b in (exact, rounded)]
    assert kinds[0] == kinds[1]
    assert rounded.dropped.keys() == exact.dropped.keys()


@pytest.mark.parametrize("digits", [4, 5, 6])
def test_parallel_axes_of_a_scara_stay_parallel_when_angles_are_rounded(digits):
    def arm(off):
        body = {"mass": 1.0, "inertia": np.eye(3)}
        return SerialChain(
            (
                Link("revolute", **body, rotation=rotation((1, 0, 0), off)),
                Link(
                    "revolute", **body, rotation=rotation((0, 1, 0), off), translation=(0.4, 0, 0)
                ),
                Link(
                    "prismatic", **body, rotation=rotation((1, 0, 0), -off), translation=(0.3, 0, 0)
                ),
                Link("revolute", **body, rotation=rotation((1, 0, 0), off)),
            )
        )

    exact, rounded = base_parameters(arm(0)), base_parameters(arm(10.0**-digits / 2))
    assert exact.rank == rounded.rank == 8
    assert exact.independent == rounded.independent
    assert base_parameters(arm(10.0**-digits / 2), tolerance=0).rank > 8


@st.composite
def square_arms(draw, most=5):
    """Joints as a file lists them, all at right angles, and gravity along one of the axes."""
    quarters, lengths = st.integers(-2, 2), st.sampled_from([0.0, 0.1, -0.35])
    return [
        Part(
            draw(st.sampled_from(["revolute", "revolute", "prismatic"])),
            xyz=draw(st.tuples(*[lengths] * 3)),
            rpy=tuple(np.pi / 2 * k for k in draw(st.tuples(*[quarters] * 3))),
            axis=draw(st.sampled_from([(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)])),
        )
        for _ in range(draw(st.integers(1, most)))
    ]


@a_few
@given(square_arms(), st.integers(4, 7))
def test_right_angles_are_right_however_a_file_rounds_them(parts, digits):
    rounded = [replace(p, rpy=tuple(round(angle, digits) for angle in p.rpy)) for p in parts]
    exact, found = base_parameters(all_moving(parts)), base_parameters(all_moving(rounded))
    assert found.independent == exact.independent
    assert found.clear
    np.testing.assert_allclose(found.combination, exact.combination, atol=1e-3)


def test_a_number_of_base_parameters_that_is_in_doubt_is_said_to_be():
    # In the midst of the singular values of an arm there is no gap.
    base = base_parameters(puma_560(), tolerance=0.05)
    assert base.rank < 36
    assert not base.clear
    assert base.remark.startswith("no clear gap: the last singular value that counts is ")
    assert base.remark in str(base)


def test_dropped_parameters_say_what_they_act_like():
    base = base_parameters(ARM)
    assert base.dropped == {"m1": "nothing", "m2": "1.3 m1 cx1 + 1.69 J1"}
    Y, names = stacked(ARM), list(parameter_names(ARM))
    acts_like = 1.3 * Y[:, names.index("m1 cx1")] + 1.69 * Y[:, names.index("J1")]
    np.testing.assert_allclose(Y[:, names.index("m2")], acts_like, atol=1e-11)
    assert base_parameters(puma_560()).dropped["m6 cy6"].startswith("−")


def test_columns_that_load_no_joint():
    base = base_parameters(ARM, (0,))
    assert (base.rank, base.descriptions, base.dropped) == (0, (), {"m1": "nothing"})


def larger(arm, factor):
    if isinstance(arm, SerialChain):
        bodies = (
            replace(b, translation=np.multiply(factor, b.translation).tolist()) for b in arm.links
        )
        return replace(arm, links=tuple(bodies))
    return replace(arm, **{name: factor * getattr(arm, name) for name in ("l1", "l2")})


SLIDE = SerialChain(
    (
        Link("revolute", 1.0, rotation=rotation((1, 0, 0), 0.7)),
        Link("prismatic", 1.0, axis=(1.0, 0.0, 0.0), translation=(0.2, 0.1, 0.3)),
        Link("revolute", 1.0, axis=(0.0, 1.0, 0.0), translation=(0.4, 0.0, 0.1)),
    )
)


@pytest.mark.parametrize("arm", [ARM, puma_560(4), SLIDE], ids=["2r", "puma", "slide"])
@pytest.mark.parametrize("factor", [1e-3, 1e3])
def test_the_unit_of_length_does_not_enter(arm, factor):
    here, there = base_parameters(arm), base_parameters(larger(arm, factor))
    assert here.independent == there.independent
    assert there.condition == pytest.approx(here.condition, rel=1e-6)
    assert there.length == pytest.approx(factor * here.length)
    np.testing.assert_allclose(there.singular_values, here.singular_values, atol=1e-9)


def test_the_parameters_that_are_kept_stand_for_the_others_well():
    # About an axis askew, Jzz shows best: kept instead, Jyy would stand for 29 of it.
    askew = Link("revolute", 1.0, axis=(0.0, 0.18, np.sqrt(1 - 0.18**2)))
    base = base_parameters(SerialChain((askew, askew), gravity=(0.0, 0.0, 0.0)))
    assert np.max(np.abs(base.combination)) < 1.5
    assert any(words.startswith("Jzz1 ") for words in base.descriptions)


def test_how_long_the_last_link_is_does_not_enter():
    here, there = (base_parameters(replace(ARM, l2=l2)) for l2 in (0.8, 1e6))
    assert there.descriptions == here.descriptions
    assert there.condition == here.condition


def test_where_the_arm_stands_does_not_enter():
    first, *others = puma_560(4).links
    far = SerialChain((replace(first, translation=(1e4, -2e4, 3e3)), *others))
    here, there = base_parameters(puma_560(4)), base_parameters(far)
    assert there.independent == here.independent
    np.testing.assert_allclose(there.combination, here.combination, atol=1e-6)


@pytest.mark.parametrize("tolerance", [-1e-9, 1.0, np.nan, "small", True, (1e-4,)])
def test_bad_tolerances_are_refused(tolerance):
    with pytest.raises(ValueError, match=r"^tolerance = "):
        base_parameters(ARM, tolerance=tolerance)


def test_a_pendulum_or_a_wrist_without_lengths_has_a_base_too():
    assert base_parameters(Pendulum(1, 0.5, 1)).length == 1
    assert base_parameters(Pendulum(1, 0.5, 1, g=1e-12)).descriptions == ("J1",)
    tiny = Link("revolute", 1.0, translation=(1e-200, 0.0, 0.0), axis=(0.0, 1.0, 0.0))
    assert base_parameters(SerialChain((tiny, tiny))).length == 1
