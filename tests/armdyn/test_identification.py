from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from armdyn import Link, Pendulum, Planar2R, PlanarChain, SerialChain
from armdyn.base_parameters import base_parameters, on_link_axes
from armdyn.consistency import consistent_parameters, pseudo_inertia
from armdyn.geometry import powers_of_length, reach
from armdyn.identify import excitation, identify
from armdyn.regressor import parameters, regressor
from tests.armdyn.arms import a_few, arms, between
from tests.armdyn.chains import links, spatial_chains
from tests.armdyn.puma import puma_560

ARM = Planar2R(1.3, 0.8, 0.5, 0.4, 2, 1.5, 0.2, 0.1, viscous=(0.3, 0.2), coulomb=(0.1, 0.05))
SMOOTH = replace(ARM, viscous=(0, 0), coulomb=(0, 0))


def motion(n, count=60, seed=0):
    return np.random.default_rng(seed).uniform(-3, 3, (3, count, n))


def consistency_of(arm, pi):
    base = base_parameters(arm)
    return consistent_parameters(
        base.combination, base.combination @ pi, base.columns, arm.n, reach(arm)
    )


def eigenvalues(pi, n):
    return np.linalg.eigvalsh(pseudo_inertia(np.reshape(pi, (n, -1))))


def on_earth(arm):
    # Gravity of 1e-10 would show a first moment, and nothing of its digits.
    gravity = {"gravity": (0.0, 0.0, -9.81)} if isinstance(arm, SerialChain) else {"g": 9.81}
    return replace(arm, **gravity)


@a_few
@given((arms() | spatial_chains(most=3)).map(on_earth))
def test_without_noise_the_parameters_come_back(arm):
    q, qd, qdd = motion(arm.n)
    # Joint axes that are nearly parallel leave parameters that are nearly not there.
    assume(excitation(arm, q, qd, qdd, friction=True, tolerance=0).condition < 1e4)
    u = arm.inverse_dynamics(q, qd, qdd)
    found = identify(arm, q, qd, qdd, u, friction=True, tolerance=0)
    base = found.base.combination @ parameters(arm)
    size = np.max(np.abs(u))
    np.testing.assert_allclose(found.estimate[: found.base.rank], base, rtol=1e-6, atol=1e-6 * size)
    np.testing.assert_allclose(
        found.friction, np.ravel([arm.viscous, arm.coulomb]), atol=1e-7 * size
    )
    assert found.rank == len(found.names) == found.base.rank + 2 * arm.n
    assert found.residual <= 1e-9 * size
    assert found.consistent


@a_few
@given((arms() | spatial_chains(most=3)).map(on_earth))
def test_the_bodies_that_are_found_move_as_the_arm_does(arm):
    q, qd, qdd = motion(arm.n)
    assume(excitation(arm, q, qd, qdd, tolerance=0).condition < 1e4)
    u = arm.inverse_dynamics(q, qd, qdd) - arm.f_vec(qd)
    pi = identify(arm, q, qd, qdd, u, tolerance=0).consistency.parameters
    again = regressor(arm, q, qd, qdd) @ pi
    np.testing.assert_allclose(again, u, atol=1e-6 * np.max(np.abs(u)))
    assert np.all(np.reshape(pi, (arm.n, -1))[:, 0] > 0)
    assert np.all(eigenvalues(pi, arm.n) > -1e-6)


def test_only_geometry_is_taken_from_the_model():
    q, qd, qdd = motion(2)
    u = ARM.inverse_dynamics(q, qd, qdd)
    guess = replace(ARM, lc1=0.1, lc2=-0.3, m1=7, m2=9, I1=4, I2=2, viscous=(0, 0), coulomb=(1, 1))
    a, b = (identify(model, q, qd, qdd, u, friction=True) for model in (ARM, guess))
    np.testing.assert_array_equal(a.estimate, b.estimate)


def test_on_the_axes_four_parameters_by_hand():
    q, qd, qdd = motion(2)
    u = SMOOTH.inverse_dynamics(q, qd, qdd)
    found = identify(SMOOTH, q, qd, qdd, u, columns=on_link_axes(SMOOTH))
    assert found.names == ("m1 cx1 + 1.3 m2", "J1 + 1.69 m2", "m2 cx2", "J2")
    expected = [2 * 0.5 + 1.5 * 1.3, 0.2 + 2 * 0.25 + 1.5 * 1.69, 1.5 * 0.4, 0.1 + 1.5 * 0.16]
    np.testing.assert_allclose(found.estimate, expected, rtol=1e-12)
    # The bodies found have their centres on the axes too.
    np.testing.assert_array_equal(found.consistency.parameters[[2, 6]], 0)


def test_standard_errors_are_those_of_least_squares():
    q, qd, qdd = motion(2, 40)
    u = ARM.inverse_dynamics(q, qd, qdd) + np.random.default_rng(1).normal(0, 0.5, q.shape)
    found = identify(ARM, q, qd, qdd, u, friction=True)
    # In terms of the normal equations, as the definition has it.
    F = np.concatenate([np.apply_along_axis(np.diag, -1, part) for part in (qd, np.sign(qd))], -1)
    Y = regressor(ARM, q, qd, qdd)[..., list(found.base.independent)]
    W = np.concatenate([Y, F], axis=-1).reshape(80, -1)
    inverse = np.linalg.inv(W.T @ W)
    estimate = inverse @ W.T @ u.ravel()
    rest = u.ravel() - W @ estimate
    variance = rest @ rest / (80 - 10)
    np.testing.assert_allclose(found.estimate, estimate, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(
        found.standard_error, np.sqrt(variance * np.diag(inverse)), rtol=1e-9
    )
    assert found.residual == pytest.approx(np.sqrt(variance))


def test_standard_errors_cover_the_truth():
    # Over many experiments, errors in units of their standard error have mean square 1.
    q, qd, qdd = motion(2, 50)
    clean, rng = ARM.inverse_dynamics(q, qd, qdd), np.random.default_rng(2)
    squares = []
    for _ in range(60):
        found = identify(ARM, q, qd, qdd, clean + rng.normal(0, 0.3, q.shape), friction=True)
        truth = np.concatenate(
            [found.base.combination @ parameters(ARM), *(ARM.viscous, ARM.coulomb)]
        )
        squares.append(np.mean(((found.estimate - truth) / found.standard_error) ** 2))
        assert 0.2 < found.residual < 0.4
    # 600 correlated squares: about 0.1 of scatter.
    assert 0.7 < np.mean(squares) < 1.4


def test_the_error_falls_with_the_root_of_the_samples():
    found = []
    for count in (50, 5000):
        q, qd, qdd = motion(2, count)
        noise = np.random.default_rng(3).normal(0, 0.3, q.shape)
        found.append(identify(ARM, q, qd, qdd, ARM.inverse_dynamics(q, qd, qdd) + noise, True))
    ratio = found[0].standard_error / found[1].standard_error
    assert np.all((ratio > 6) & (ratio < 16))


def test_friction_left_out_is_left_in_the_residual():
    q, qd, qdd = motion(2)
    u = ARM.inverse_dynamics(q, qd, qdd)
    assert identify(ARM, q, qd, qdd, u).residual > 0.1
    assert identify(ARM, q, qd, qdd, u, friction=True).residual < 1e-12
    assert len(identify(ARM, q, qd, qdd, u).friction) == 0


def test_batch_axes_are_all_samples():
    q, qd, qdd = motion(2, 60)
    u = ARM.inverse_dynamics(q, qd, qdd)
    flat = identify(ARM, q, qd, qdd, u, friction=True)
    stacked = identify(ARM, *(a.reshape(5, 12, 2) for a in (q, qd, qdd, u)), friction=True)
    np.testing.assert_array_equal(flat.estimate, stacked.estimate)


def test_the_condition_number_has_no_units():
    # The same experiment in other units of mass and length.
    q, qd, qdd = motion(2)
    small = replace(ARM, l1=1.3e-3, l2=0.8e-3, lc1=5e-4, lc2=4e-4, g=9.81e-3)
    assert excitation(small, q, qd, qdd).condition == pytest.approx(
        excitation(ARM, q, qd, qdd).condition, rel=1e-6
    )
    assert excitation(ARM, q, qd, qdd).sufficient


@pytest.mark.parametrize(
    ("moves", "friction", "rank", "confused"),
    [
        # Joint 2 stands still: what its link adds about joint 1 is one with link 1.
        ([1, 0], True, 8, (("viscous2",), ("coulomb2",))),
        # At rest only gravity is seen, and at q = 0 only its moment along x.
        ([0, 0], False, 2, (("m1 cy1",), ("J1 + 1.69 m2",), ("m2 cy2",), ("J2",))),
    ],
)
def test_a_poor_motion_says_what_it_hides(moves, friction, rank, confused):
    q, qd, qdd = (a * moves for a in motion(2))
    shown = excitation(ARM, q, qd, qdd, friction=friction)
    assert (shown.rank, shown.confused) == (rank, confused)
    assert not shown.sufficient
    assert np.isinf(shown.condition)
    with pytest.raises(ValueError, match=r"has no effect; .* needs a motion that moves more"):
        identify(ARM, q, qd, qdd, ARM.inverse_dynamics(q, qd, qdd), friction=friction)


def test_a_motion_that_confuses_two_parameters_names_both():
    # A pendulum that swings with q̈ in proportion to g sin q shows only their sum.
    pendulum = Pendulum(1, 0.5, 1)
    q = np.linspace(0.1, 1, 20)[:, np.newaxis]
    state = q, np.zeros_like(q), -2 * np.sin(q)
    columns = on_link_axes(pendulum)
    shown = excitation(pendulum, *state, columns=columns)
    assert shown.confused == (("m1 cx1", "J1"),)
    assert str(shown) == "shows 1 of 2 parameters (m1 cx1, J1: not told apart)"
    with pytest.raises(ValueError, match="m1 cx1, J1: not told apart"):
        identify(pendulum, *state, pendulum.inverse_dynamics(*state), columns=columns)
    # What it calls confused can indeed be traded: no torque changes.
    Y = regressor(pendulum, *state)
    np.testing.assert_allclose(Y @ [0, 2, 0, 9.81], 0, atol=1e-12)


def test_too_few_samples():
    q, qd, qdd = motion(2, 3)
    u = ARM.inverse_dynamics(q, qd, qdd)
    says = r"^q: 3 samples give 6 equations; 6 parameters .* need at least 4 samples"
    with pytest.raises(ValueError, match=says):
        identify(ARM, q, qd, qdd, u)
    assert excitation(ARM, q, qd, qdd).rank == 6
    assert excitation(ARM, q[:1], qd[:1], qdd[:1]).rank == 2
    four = motion(2, 4)
    identify(ARM, *four, ARM.inverse_dynamics(*four))


def test_bad_samples_are_named():
    q, qd, qdd = motion(2)
    u = ARM.inverse_dynamics(q, qd, qdd)
    with pytest.raises(ValueError, match=r"^u: got shape \(60, 1\)"):
        identify(ARM, q, qd, qdd, u[:, :1])
    with pytest.raises(ValueError, match=r"^u\[0, 0\] = nan"):
        identify(ARM, q, qd, qdd, u * np.nan)
    with pytest.raises(ValueError, match="needs batch axes that broadcast"):
        identify(ARM, q, qd, qdd, u[:7])
    with pytest.raises(ValueError, match=r"^q, qd, qdd: got shape \(0, 2\), needs at least 1"):
        excitation(ARM, *np.empty((3, 0, 2)))
    with pytest.raises(ValueError, match=r"^columns = "):
        identify(ARM, q, qd, qdd, u, columns=(1, 1))


def smooth_motion(n, moves=1.0):
    """q, q̇, q̈ of sums of sines, (200, n) each."""
    rng = np.random.default_rng(7)
    t = np.linspace(0, 10, 200)[:, np.newaxis]
    q, qd, qdd = np.zeros((3, 200, n))
    for harmonic in (1, 2, 3):
        rate, phase, size = (
            rng.uniform(*bounds, n) for bounds in ((0.7, 1.9), (0.0, 6.0), (0.3, 0.8))
        )
        angle = harmonic * rate * t + phase
        q = q + size * np.sin(angle)
        qd = qd + size * harmonic * rate * np.cos(angle)
        qdd = qdd - size * (harmonic * rate) ** 2 * np.sin(angle)
    return q * moves, qd * moves, qdd * moves


LONG = pytest.mark.long


@pytest.mark.parametrize("digits", [pytest.param(3, marks=LONG), 4, pytest.param(6, marks=LONG)])
def test_what_only_rounding_of_the_geometry_shows_is_not_known(digits):
    # The arm is exact; its file is not.
    arm, state = puma_560(), smooth_motion(6)
    noise = np.random.default_rng(8).normal(0, 0.3, state[0].shape)
    u = arm.inverse_dynamics(*state) + noise
    found = identify(puma_560(digits), *state, u)
    exact = identify(arm, *state, u)
    assert found.base.independent == exact.base.independent
    errors = found.estimate - found.base.combination @ parameters(arm)
    assert np.max(np.abs(errors / found.standard_error)) < 5
    np.testing.assert_allclose(found.standard_error, exact.standard_error, rtol=0.02)
    assert found.base.remark in str(found)
    # Believed to the last digit, the file has two parameters more, and they are noise.
    believed = identify(puma_560(digits), *state, u, tolerance=0)
    assert believed.rank == found.rank + 2
    assert np.max(believed.standard_error) > 200 * np.max(found.standard_error)


@pytest.mark.parametrize("moves", [[0, 1, 1, 0, 0, 0], [1, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1]])
def test_a_motion_shows_no_more_through_rounded_angles(moves):
    exact, rounded = (
        excitation(puma_560(digits), *smooth_motion(6, np.array(moves))) for digits in (None, 4)
    )
    assert exact.rank == rounded.rank < 36
    # The words hold the lengths, which are rounded, too.
    assert [len(group) for group in exact.confused] == [len(group) for group in rounded.confused]


# Turns, slides and turns; the unit of length is 1 m / factor, of torque 1 N·m / factor².
def slider(factor=1.0):
    body = {
        "inertia": factor**2 * np.diag([0.2, 0.3, 0.25]),
        "com": factor * np.array([0.1, 0, 0.2]),
    }
    about_x = ((1.0, 0.0, 0.0), (0.0, 0.6, -0.8), (0.0, 0.8, 0.6))
    placed = ((0.2, 0.1, 0.3), (0.4, 0.0, 0.1), (0.1, 0.1, 0.2))
    joints = ("revolute", "prismatic", "revolute")
    return SerialChain(
        tuple(
            Link(joint, 2.0, **body, rotation=about_x, translation=factor * np.array(p))
            for joint, p in zip(joints, placed, strict=True)
        ),
        gravity=factor * np.array([0.0, 0.0, -9.81]),
    )


def test_the_unit_of_length_does_not_enter():
    q, qd, qdd = motion(3)
    u = slider().inverse_dynamics(q, qd, qdd) + np.random.default_rng(9).normal(0, 0.3, q.shape)
    here = identify(slider(), q, qd, qdd, u)
    length, effort = np.array([1, 1e3, 1]), np.array([1e6, 1e3, 1e6])
    there = identify(slider(1e3), q * length, qd * length, qdd * length, u * effort)
    unit = 1e3 ** powers_of_length(here.base.names)[list(here.base.independent)]
    np.testing.assert_allclose(there.estimate, here.estimate * unit, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(there.standard_error, here.standard_error * unit, rtol=1e-6)
    assert there.excitation.condition == pytest.approx(here.excitation.condition, rel=1e-6)
    assert there.residual == pytest.approx(1e6 * here.residual)


def test_joints_of_different_noise():
    # Joint 2 is measured ten times better: told so, the fit makes use of it.
    q, qd, qdd = motion(2, 200)
    noise, rng = np.array([1.0, 0.1]), np.random.default_rng(10)
    errors: dict[str, list] = {"told": [], "not told": []}
    truth = base_parameters(SMOOTH).combination @ parameters(SMOOTH)
    for _ in range(30):
        u = SMOOTH.inverse_dynamics(q, qd, qdd) + rng.normal(0, noise, q.shape)
        told = identify(SMOOTH, q, qd, qdd, u, noise=noise)
        assert told.residual == pytest.approx(1, abs=0.2)
        assert "residual" in str(told)
        assert "times the noise" in str(told)
        errors["told"].append((told.estimate - truth) / told.standard_error)
        errors["not told"].append(identify(SMOOTH, q, qd, qdd, u).estimate - truth)
    assert 0.6 < np.mean(np.square(errors["told"])) < 1.6
    of_told = np.square(errors["told"]).mean(axis=0) * told.standard_error**2
    # What joint 2 feels, it now shows.
    better = of_told < np.square(errors["not told"]).mean(axis=0) / 10
    assert {name[-1] for name in np.array(told.names)[better]} == {"2"}
    assert np.count_nonzero(better) == 3
    # Only the proportions count.
    again = identify(SMOOTH, q, qd, qdd, u, noise=7 * noise)
    np.testing.assert_allclose(again.estimate, told.estimate, rtol=1e-9)
    np.testing.assert_allclose(again.standard_error, told.standard_error, rtol=1e-9)


@pytest.mark.parametrize(
    "noise", [[1.0], [1.0, 0.0], [1.0, -1.0], [[1.0, 1.0]], [1.0, np.nan], "big"]
)
def test_bad_noise_is_refused(noise):
    q, qd, qdd = motion(2)
    with pytest.raises(ValueError, match=r"^noise"):
        identify(ARM, q, qd, qdd, ARM.inverse_dynamics(q, qd, qdd), noise=noise)


def test_where_no_parameter_shows_friction_alone_is_found():
    q, qd, qdd = motion(2)
    f = ARM.f_vec(qd)
    assert excitation(ARM, q, qd, qdd, columns=(0,)).rank == 0
    with pytest.raises(ValueError, match=r"^columns: none of these parameters loads a joint"):
        identify(ARM, q, qd, qdd, f, columns=(0,))
    found = identify(ARM, q, qd, qdd, f, columns=(0,), friction=True)
    np.testing.assert_allclose(found.friction, np.ravel([ARM.viscous, ARM.coulomb]))
    assert found.consistent


def test_links_without_mass_or_inertia():
    # A file often has such links, between two joints at one place.
    x, y = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    body = {"com": (0.1, 0.0, 0.2), "inertia": np.diag([0.2, 0.3, 0.25])}
    arm = SerialChain(
        (
            Link("revolute", 0.0, axis=y),
            Link("revolute", 2.0, **body, axis=x),
            Link("revolute", 1.0, axis=y, translation=(0.3, 0.0, 0.0)),
            Link("revolute", 0.5, **body, axis=x),
        )
    )
    q, qd, qdd = motion(4)
    found = identify(arm, q, qd, qdd, arm.inverse_dynamics(q, qd, qdd))
    truth = found.base.combination @ parameters(arm)
    np.testing.assert_allclose(found.estimate, truth, atol=1e-9)
    assert found.consistent


def test_a_result_reads_as_a_table():
    q, qd, qdd = motion(2)
    noise = np.random.default_rng(4).normal(0, 0.1, q.shape)
    u = ARM.inverse_dynamics(q, qd, qdd) + noise
    lines = str(identify(ARM, q, qd, qdd, u, friction=True)).splitlines()
    assert len(lines) == 11
    assert lines[0].startswith("m1 cx1 + 1.3 m2   2.9")
    assert " ± " in lines[0]
    assert lines[6].startswith("viscous1")
    assert lines[-1].startswith("residual 0.")
    assert lines[-1].endswith("bodies with these parameters exist")


@a_few
@given(st.lists(links(), min_size=1, max_size=1), between(-1, 1), between(-1, 1), between(-1, 1))
def test_pseudo_inertia_holds_the_second_moments(body, x, y, z):
    # vᵀ P v with v = (x, 1) for a half-space normal: ∫ (n·p + d)² dm, never negative.
    (link,) = body
    P = pseudo_inertia(parameters(SerialChain((link,))))
    np.testing.assert_array_equal(P, P.T)
    v = np.array([x, y, z, 0.5])
    assert v @ P @ v > 0
    assert P[3, 3] == link.mass
    np.testing.assert_allclose(P[:3, 3], np.multiply(link.mass, link.com))
    J = np.trace(P[:3, :3]) * np.eye(3) - P[:3, :3]
    com = np.array(link.com)
    steiner = link.mass * (com @ com * np.eye(3) - np.outer(com, com))
    np.testing.assert_allclose(J, link.inertia + steiner, atol=1e-9)


@pytest.mark.parametrize("pi", [1.0, [1.0, 2.0, 3.0], np.zeros((4, 5))])
def test_pseudo_inertia_refuses_other_sizes(pi):
    with pytest.raises(ValueError, match=r"^pi: got shape .* needs \(..., 4\) or \(..., 10\)"):
        pseudo_inertia(pi)


def test_bad_arguments_of_consistency_are_named():
    base = base_parameters(ARM)
    good = {
        "combination": base.combination,
        "estimate": base.combination @ parameters(ARM),
        "columns": base.columns,
        "n": 2,
        "length": 1.0,
    }
    assert consistent_parameters(**good).exists
    for name, bad in {
        "combination": np.eye(7),
        "estimate": np.ones(5),
        "columns": (0, 8),
        "length": 0.0,
    }.items():
        with pytest.raises(ValueError, match=f"^{name}"):
            consistent_parameters(**good | {name: bad})
    with pytest.raises(ValueError, match=r"^combination: .* for n = 3 links"):
        consistent_parameters(**good | {"n": 3})
    with pytest.raises(ValueError, match=r"^pi\[2\] = nan"):
        pseudo_inertia([1.0, 0.0, np.nan, 1.0])
    with pytest.raises(ValueError, match=r"^pi = "):
        pseudo_inertia("heavy")


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("off", [-1e-3, 1e-3])
def test_the_border_of_the_bodies_of_the_2r(size, off):
    # By hand: J2 > 0 is free, its least mass |h2|²/J2; so J1 + m2 l1² must exceed l1² |h2|²/J2.
    arm = replace(SMOOTH, l1=1.3 * size, l2=0.8 * size)
    h2, J2 = 0.6 * size, 0.4 * size**2
    border = arm.l1**2 * h2**2 / J2
    m2 = 2 * h2**2 / J2
    first = border * (1 + off)
    # Any π with these base parameters will do to state them.
    pi = np.array([1, 0.5 * size, 0, first - m2 * arm.l1**2, m2, h2, 0, J2])
    found = consistency_of(arm, pi)
    assert found.exists == (off > 0)
    if found.exists:
        base = base_parameters(arm).combination
        np.testing.assert_allclose(
            base @ found.parameters, base @ pi, rtol=1e-9, atol=1e-12 * size**2
        )
        assert np.all(eigenvalues(found.parameters, 2) > 0)
    else:
        assert found.margin < 0
        assert found.parameters is None


@pytest.mark.parametrize("J", [-1e-3, 0.3])
def test_a_pendulum_is_consistent_with_any_positive_inertia(J):
    # Its mass is not seen: a heavier body nearer to the pivot does the same.
    pendulum = Pendulum(2, 0.5, 0.7)
    assert consistency_of(pendulum, [0, 1.0, 0, J]).exists == (J > 0)


def test_a_point_mass_is_on_the_border_and_exists():
    spread = consistency_of(
        PlanarChain((1, 1), (0.5, 0.4), (1, 2), (0, 0)), [1, 0.5, 0, 0.25, 2, 0.8, 0, 0.32]
    )
    assert spread.exists
    body = Link("prismatic", 1.0, com=(0.1, 0.2, 0.3))
    turning = Link("revolute", 1.0, com=(0.1, 0.0, 0.0))
    for chain in (SerialChain((body,)), SerialChain((body, turning))):
        assert consistency_of(chain, parameters(chain)).exists


@a_few
@given(spatial_chains(most=3))
def test_the_base_parameters_of_real_bodies_are_consistent(chain):
    assert consistency_of(chain, parameters(chain)).exists


def test_an_inertia_that_breaks_the_triangle_inequality_is_found():
    # A revolute wrist of three crossing axes shows all differences of its last link's inertia.
    turn = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    link = Link("revolute", 1.0, inertia=np.eye(3), rotation=turn)
    free = Link("revolute", 1.0, inertia=np.eye(3), rotation=turn.T)
    wrist = SerialChain((link, free, link))
    pi = parameters(wrist)
    assert consistency_of(wrist, pi).exists
    for change in (-1.5, 1.5):
        # Jzz of the last link: negative, or more than the masses of the others allow for.
        other = pi.copy()
        other[-1] += change
        assert consistency_of(wrist, other).exists == (change > 0)


def test_noise_can_make_a_light_link_impossible():
    light = replace(SMOOTH, m2=0.01, lc2=0.05, I2=1e-6)
    q, qd, qdd = motion(2, 30)
    rng = np.random.default_rng(5)
    clean = light.inverse_dynamics(q, qd, qdd)
    verdicts = []
    for _ in range(10):
        found = identify(light, q, qd, qdd, clean + rng.normal(0, 0.5, q.shape))
        J2 = found.estimate[found.names.index("J2")]
        if J2 < 0:
            assert not found.consistent
            assert "do not exist" in str(found)
        verdicts.append(found.consistent)
    assert not all(verdicts)


@pytest.mark.parametrize(
    ("more", "exists"), [(1.0, False), (0.1, True), (0.01, True), (-0.1, True)]
)
def test_where_the_two_bounds_of_the_2r_meet_the_search_still_ends(more, exists):
    # m1 in joint 1 and m2 a point: J1 = 0 asks for m1 lc1 = 0, or a very heavy m1.
    base = base_parameters(SMOOTH, on_link_axes(SMOOTH))
    points = replace(SMOOTH, I1=0.0, I2=0.0, lc1=0.0)
    estimate = base.combination @ parameters(points) + np.array([more, 0, 0, 0])
    found = consistent_parameters(base.combination, estimate, base.columns, 2, reach(SMOOTH))
    assert found.exists is exists
    assert abs(found.margin) < 1e-6
