import numpy as np
from hypothesis import given

from armdyn import spatial
from tests.armdyn.arms import a_few, assert_close, inertias, masses, vectors
from tests.armdyn.chains import angles, points, rotations

six = vectors(6, size=3, batch=(2,))


@a_few
@given(points(3), points(3))
def test_skew_is_the_cross_product(r, s):
    assert_close(spatial.skew(r) @ s, np.cross(r, s))


@a_few
@given(rotations(), angles, angles)
def test_rotation_turns_about_its_axis_by_its_angle(frame, a, b):
    axis, across = frame[:, 2], frame[:, 0]
    turn = spatial.rotation(axis, a)
    assert_close(turn @ axis, axis)
    assert_close(turn @ across, np.cos(a) * across + np.sin(a) * frame[:, 1])
    assert_close(turn @ spatial.rotation(axis, b), spatial.rotation(axis, a + b))


@a_few
@given(rotations(), points(2), points(1), six)
def test_a_motion_transform_moves_the_velocity_to_the_other_origin(R, p, where, v):
    """The velocity of a point of the body is one and the same from both frames."""
    X = spatial.motion_transform(R, np.array(p))
    there = np.matvec(X, v)
    from_here = v[..., 3:] + np.cross(v[..., :3], p + R @ where)
    from_there = there[..., 3:] + np.cross(there[..., :3], where)
    assert_close(np.matvec(R, from_there), from_here)


@a_few
@given(six, six, six)
def test_crosses(v, w, f):
    cross = spatial.motion_cross
    assert_close(np.matvec(cross(v), w), -np.matvec(cross(w), v))
    # Power is a scalar: its rate in a moving body has no term from the motion.
    power = np.vecdot(np.matvec(spatial.force_cross(v), f), w)
    assert_close(power, -np.vecdot(f, np.matvec(cross(v), w)), 100)
    swapped = spatial.swapped_cross(f)
    assert_close(np.matvec(swapped, v), np.matvec(spatial.force_cross(v), f))
    np.testing.assert_array_equal(swapped, -np.swapaxes(swapped, -1, -2))
    # The commutator of two crosses is the cross with their cross.
    commutator = cross(v) @ cross(w) - cross(w) @ cross(v)
    assert_close(commutator, cross(np.matvec(cross(v), w)), 100)


@a_few
@given(masses, points(1), inertias, six)
def test_rigid_inertia_carries_the_kinetic_energy(mass, com, I, v):
    about_com = np.diag([I, 2 * I, 1.5 * I])
    omega = v[..., :3]
    at_com = v[..., 3:] + np.cross(omega, com)
    K = mass * np.vecdot(at_com, at_com) + np.vecdot(omega, np.matvec(about_com, omega))
    inertia = spatial.rigid_inertia(mass, np.array(com), about_com)
    assert_close(np.vecdot(v, np.matvec(inertia, v)), K, mass)
